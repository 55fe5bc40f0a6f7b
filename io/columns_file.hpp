// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Columns of numbers in a text file; "#" begins a comment.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace asperity::io {

/// The first `count` columns, [column][row]; what a row has beyond them is left out. Throws
/// SceneError with the line where a row has fewer numbers, or where there are none at all.
std::vector<std::vector<double>> read_columns(const std::string& file, std::size_t count);

} // namespace asperity::io
