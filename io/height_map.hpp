// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Height maps: what a file holds, and what a scene takes of it.
//
//     format        recognized by      size and unit
//     HDF5          its first bytes    attributes unit (or units), scale, size_x, size_y, size_unit
//     NumPy         its first bytes    none
//     text matrix   numbers            none
//
// HDF5: the data set is that named after a colon ("map.h5:/NAME"), else /heights, else the only one
// of numbers with two dimensions; its attribute origin says whose map it is. Sizes are in
// size_unit, else in the unit of the heights; an attribute that the data set lacks is taken from
// the file. A number stands for `scale` units, whoever says the unit; numbers of 1e30 and more are
// missing points. Text: one row of the map a line, numbers separated by blanks; # starts a comment.
// Row r is y = r, column c is x = c. A map of n points is n pixels wide. Files of other formats are
// converted first (python/asperity/maps/convert.py).
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace asperity::io {

/// Heights of a map and what its file says of them.
struct HeightMap {
    std::string format; ///< format, one of the table above
    std::string source; ///< file (and data set)
    std::string origin; ///< owner of the map, if the file names one
    std::size_t rows = 0, columns = 0;
    /// heights[y * columns + x], Å, or what MapOptions::quantity says; NaN at missing points
    std::vector<double> heights;
    std::optional<double> width, height; ///< widths along x and y, Å; empty: not in the file
    std::string unit = "Å";              ///< unit of the heights in the file: "nm", "0.03 nm"
    bool unit_assumed = false;           ///< neither the file nor the scene gives a unit: Å
    std::size_t missing = 0;             ///< number of points without a finite height
    /// place of the first missing point: file:line:column or [row, column]
    std::string first_missing;
    std::string first_missing_text;  ///< text at that place
    std::vector<std::string> doubts; ///< possible mistakes in the file, one sentence each
    std::vector<std::string> notes;  ///< assumptions, fillings and cuts, one sentence each
};

/// Quantity that the numbers of a map stand for.
struct MapQuantity {
    std::string_view one = "height",
                     all = "heights";      ///< names; the plural names the data set
    std::string_view unit = "Å";           ///< unit of the numbers that the reader returns
    std::string_view key = "surface.file"; ///< key of the scene that names the map
    std::string_view kind = "length";      ///< dimension of the unit, for messages
};

/// Options of a scene for reading a map. Unit and size hold over those of the file; doubts name
/// both.
struct MapOptions {
    std::string unit = "auto"; ///< unit of the heights; "auto": the unit of the file, else Å
    bool fill = false;         ///< missing points are filled by Laplace's equation; false: refused
    bool crop = false;         ///< a map that is not square is cut to its middle; false: refused
    std::optional<double> size{}; ///< shorter edge, Å; empty: the size in the file
    bool holes = false;           ///< missing points stay, as NaN
    MapQuantity quantity{};
};

/// Reads the map of a file. name: a file, or file:/dataset. Throws SceneError.
HeightMap read_map_file(const std::string& name, const MapOptions& said = {});
/// Reads a map that is square, whole (but for holes) and finite, as a scene needs it. Throws
/// SceneError with the line and column of the mistake, or the row and column in HDF5.
HeightMap read_height_map(const std::string& name, const MapOptions& options = {});

/// Gives every NaN of heights[y * columns + x] the mean of its neighbours (four, fewer at the map's
/// edge): Laplace's equation with the heights around as boundary values, to 1e-9 of the largest
/// height. At least one height must be a number.
void fill_missing(std::vector<double>& heights, std::size_t rows, std::size_t columns);

/// A column of numbers that is written beside the heights.
struct MapColumn {
    std::string name, unit; ///< path in the file ("/spectrum/q") and unit of the values
    std::vector<double> values;
};
/// Writes the HDF5 data set /heights (with unit and sizes) and the columns, whole or not at all.
/// Throws FileError.
void write_height_map(const std::string& file, const HeightMap& map,
                      const std::vector<MapColumn>& columns = {});

} // namespace asperity::io
