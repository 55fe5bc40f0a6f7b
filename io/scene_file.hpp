// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Common functions of the readers of a scene's files (maps, atoms, tables).
//
// These files come from other programs and may be damaged: sizes are compared with the file and
// with the free memory before anything is allocated. Mistakes in them are mistakes of the scene
// (SceneError).
#pragma once

#include "io/error.hpp"

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace asperity::io {

/// Throws SceneError with a problem (Problem).
[[noreturn]] void refuse(std::string where, std::string what, std::string why, std::string fix);
/// Returns the advice for a file of another format: "convert it first: asperity convert X.gwy
/// X.h5".
std::string convert_first(const std::string& file);
/// Throws SceneError if `bytes` exceed the free memory. where: file; what: contents, "the height
/// map".
void require_memory(const std::string& where, const char* what, double bytes);

/// Returns true if the first bytes of the file are those of HDF5.
bool is_hdf5(const std::string& file);

/// Removes the next word from a line and returns the word; empty at the end of the line or at "#".
std::string_view take_word(std::string_view& line);
/// Parses a number. Returns NaN if the number is out of the range of double, nothing if the word is
/// no number.
std::optional<double> number_of(std::string_view word);

} // namespace asperity::io
