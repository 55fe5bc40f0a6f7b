// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Maps of heights (or other quantities) from files: the contents of a file, and the map that a
// scene uses.
//
//     format        recognized by      size and unit
//     HDF5          its first bytes    attributes unit (or units), scale, size_x, size_y, size_unit
//     NumPy         its first bytes    none
//     text matrix   numbers            none
//
// HDF5: the data set is named after a colon ("map.h5:/NAME"); otherwise it is /heights, or the only
// data set of numbers with two dimensions. Its attribute origin names the author. Sizes are in
// size_unit, by default in the unit of the heights; attributes that the data set lacks are taken
// from "/". A value is multiplied by `scale`, for the unit of the file and of the scene; values of
// 1e30 and more are missing points. Text: one row of the map per line, numbers separated by blanks;
// # starts a comment. Row r is y = r, column c is x = c. A map of n points is n pixels wide. Files
// of other formats are converted first (python/asperity/maps/convert.py).
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace asperity::io {

/// Heights of a map, with the metadata of its file.
struct HeightMap {
    std::string format; ///< format, as in the table above
    std::string source; ///< file (and data set)
    std::string origin; ///< author of the map, if the file names one
    std::size_t rows = 0, columns = 0;
    /// heights[y * columns + x], Å (or the unit of MapOptions::quantity); NaN at missing points.
    std::vector<double> heights;
    std::optional<double> width, height; ///< widths along x and y, Å; empty if the file has none
    std::string unit = "Å";              ///< unit of the heights in the file: "nm", "0.03 nm"
    bool unit_assumed = false; ///< neither the file nor the scene states a unit, and Å is assumed
    std::size_t missing = 0;   ///< number of points without a finite height
    /// Place of the first missing point: file:line:column or [row, column].
    std::string first_missing;
    std::string first_missing_text;  ///< text at that place
    std::vector<std::string> doubts; ///< possible mistakes in the file, one sentence each
    std::vector<std::string> notes;  ///< assumptions, fillings and cuts, one sentence each
};

/// Quantity of the values of a map.
struct MapQuantity {
    std::string_view one = "height",
                     all = "heights";      ///< names; the plural names the data set
    std::string_view unit = "Å";           ///< unit of the numbers that the reader returns
    std::string_view key = "surface.file"; ///< key of the scene that names the map
    std::string_view kind = "length";      ///< dimension of the unit, for messages
};

/// Options of a scene for reading a map. Unit and size override those of the file; a difference is
/// noted in HeightMap::doubts.
struct MapOptions {
    std::string unit = "auto";    ///< unit of the heights; "auto": as the file states, otherwise Å
    bool fill = false;            ///< fill missing points by Laplace's equation; false: refuse them
    bool crop = false;            ///< cut a map that is not square to its middle; false: refuse it
    std::optional<double> size{}; ///< shorter edge, Å; empty: as the file states
    bool holes = false;           ///< keep missing points as NaN
    MapQuantity quantity{};
};

/// Reads the map of a file without further demands. name: a file, or file:/dataset. Throws
/// SceneError.
HeightMap read_map_file(const std::string& name, const MapOptions& said = {});
/// Reads a map for a scene, which must be square and, without options.holes, complete. Throws
/// SceneError with the line and column of the mistake, or the row and column in HDF5.
HeightMap read_height_map(const std::string& name, const MapOptions& options = {});

/// Replaces every NaN of heights[y * columns + x] by the solution of Laplace's equation with the
/// surrounding heights as boundary values: the mean of its four neighbours (fewer at the map's
/// edge), to 1e-9 of the largest height. At least one height must be a number.
void fill_missing(std::vector<double>& heights, std::size_t rows, std::size_t columns);

/// A column of numbers to be written in the file of a map.
struct MapColumn {
    std::string name, unit; ///< path in the file ("/spectrum/q") and unit of the values
    std::vector<double> values;
};
/// Writes the HDF5 data set /heights (with unit and sizes) and the columns through OutputFile.
/// Throws FileError.
void write_height_map(const std::string& file, const HeightMap& map,
                      const std::vector<MapColumn>& columns = {});

} // namespace asperity::io
