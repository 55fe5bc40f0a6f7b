// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Functions that the readers of a scene's files share (maps, atoms, tables).
//
// Such files come from elsewhere and may be damaged: sizes are compared with the file and with the
// free memory before anything is allocated. Every mistake in them is one of the scene: SceneError.
#pragma once

#include "io/error.hpp"

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace asperity::io {

/// Throws SceneError with this problem.
[[noreturn]] void refuse(std::string where, std::string what, std::string why, std::string fix);
/// Returns the advice for a file of another format: "convert it first: asperity convert X.gwy
/// X.h5".
std::string convert_first(const std::string& file);
/// Throws SceneError if so many bytes exceed the free memory. what: "the height map".
void require_memory(const std::string& where, const char* what, double bytes);

/// Returns true if the first bytes of the file are those of HDF5.
bool is_hdf5(const std::string& file);

/// Removes the next word from a line, which ends at its "#", and returns it; empty at the end.
std::string_view take_word(std::string_view& line);
/// Returns the number of a word: NaN if no double holds it, nothing if the word is no number.
std::optional<double> number_of(std::string_view word);

} // namespace asperity::io
