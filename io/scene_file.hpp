// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What the readers of files that a scene names share (maps, atoms, tables).
//
// Such files come from elsewhere and may be damaged: sizes are compared with the file and with the
// memory there is before anything is allocated. What is wrong is a mistake of the scene:
// SceneError.
#pragma once

#include "io/error.hpp"

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace asperity::io {

[[noreturn]] void refuse(std::string where, std::string what, std::string why, std::string fix);
/// What to do with a file of another format: "convert it first: asperity convert X.gwy X.h5".
std::string convert_first(const std::string& file);
/// Refuses what is larger than the memory; what: "the height map".
void require_memory(const std::string& where, const char* what, double bytes);

/// Whether the first bytes are those of HDF5.
bool is_hdf5(const std::string& file);

/// Takes the next word off a line, which ends at its "#"; empty: there is none.
std::string_view take_word(std::string_view& line);
/// A number, or NaN for what no double holds; nothing if the word is none.
std::optional<double> number_of(std::string_view word);

} // namespace asperity::io
