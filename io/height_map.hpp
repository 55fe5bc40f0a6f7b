// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Height maps from and to files: measured or synthetic, as a text matrix or in HDF5.
//
// Text: one row of the map a line, numbers separated by blanks, tabs, commas or semicolons; #
// starts a comment. Row r is y = r, column c is x = c. HDF5: the two-dimensional data set of the
// file, or the one named after a colon ("map.h5:/topography"); attributes unit, size_x, size_y are
// used where present (sizes in the same unit as the heights); attribute origin, of the data set or
// of the file, says whose map it is.
//
// A map must be square, whole and finite. What is wrong with it is a mistake of the scene that
// names it (exit 2), told with the line and column, or the row and column in HDF5.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace asperity::io {

struct HeightMap {
    int sites = 0;               ///< values along an edge
    std::vector<double> heights; ///< Å; heights[y * sites + x]
    std::optional<double> size;  ///< edge of the map, Å, where the file tells it
    std::string unit = "Å";      ///< the heights had in the file
    std::string source;          ///< the file (and data set)
    std::string origin;          ///< whose map it is, where the file tells it; HDF5 only
};

/// unit "auto": what the file says, else Å. Throws SceneError.
HeightMap read_height_map(const std::string& file, const std::string& unit = "auto");

/// Text if the name ends in .txt, .dat, .csv or .asc, else HDF5 data set /heights (with unit and
/// sizes). Whole or not at all. Throws FileError.
void write_height_map(const std::string& file, const HeightMap& map);

} // namespace asperity::io
