// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Height maps: what a file holds, and what a scene takes of it.
//
//     format       recognized by         size and unit
//     HDF5         its first bytes       attributes unit (or units), scale, size_x, size_y,
//     size_unit NumPy        its first bytes       none text matrix  numbers               none
//
// HDF5: the data set named after a colon ("map.h5:/NAME"), else /heights, else the only one of
// numbers with two dimensions; attribute origin says whose map it is. Sizes are in size_unit, else
// in the unit of the heights; an attribute that the data set has not is looked for at the file.
// A number is `scale` units, whoever says the unit. Numbers of 1e30 and more are missing points.
// Text: one row of the map a line, numbers separated by blanks; # starts a comment. Row r is y = r,
// column c is x = c. A map of n points is n pixels wide. Files of other formats are converted first
// (python/asperity/convert.py).
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace asperity::io {

struct HeightMap {
    std::string format; ///< as in the table above
    std::string source; ///< the file (and data set)
    std::string origin; ///< whose map it is, where the file tells it
    std::size_t rows = 0, columns = 0;
    std::vector<double> heights;         ///< Å, heights[y * columns + x]; NaN where one is missing
    std::optional<double> width, height; ///< along x and y, Å, where the file tells them
    std::string unit = "Å";              ///< of the heights in the file: "nm", "0.03 nm"
    bool unit_assumed = false;           ///< neither the file nor the scene says it: Å
    std::size_t missing = 0;             ///< points without a finite height
    std::string first_missing;       ///< the place of the first: file:line:column or [row, column]
    std::string first_missing_text;  ///< what stands there
    std::vector<std::string> doubts; ///< what may be wrong with the file, one sentence each
    std::vector<std::string> notes;  ///< what was assumed, filled or cut, one sentence each
};

/// What the scene says of a map. Unit and size hold over what the file says; doubts name both.
struct MapOptions {
    std::string unit = "auto";    ///< of the heights; "auto": what the file says, else Å
    bool fill = false;            ///< missing points: by Laplace's equation; else they are refused
    bool crop = false;            ///< not square: the middle; else it is refused
    std::optional<double> size{}; ///< the shorter edge, Å; empty: what the file says
};

/// What the file holds; name: a file, or file:/dataset. Throws SceneError.
HeightMap read_map_file(const std::string& name, const MapOptions& said = {});
/// What a scene takes of it: a map that is square, whole and finite. Throws SceneError, told with
/// the line and column, or the row and column in HDF5.
HeightMap read_height_map(const std::string& name, const MapOptions& options = {});

/// Gives every NaN of heights[y * columns + x] the value that makes it the mean of its neighbours
/// (four, fewer at the map's edge): Laplace's equation with the heights around as boundary values.
/// To 1e-9 of the largest height; there must be one that is no NaN.
void fill_missing(std::vector<double>& heights, std::size_t rows, std::size_t columns);

/// What is written beside the heights.
struct MapColumn {
    std::string name, unit; ///< "/spectrum/q"
    std::vector<double> values;
};
/// HDF5 data set /heights (with unit and sizes). Whole or not at all. Throws FileError.
void write_height_map(const std::string& file, const HeightMap& map,
                      const std::vector<MapColumn>& columns = {});

} // namespace asperity::io
