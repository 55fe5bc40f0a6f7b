// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Height maps for a scene: square, whole and finite. What a file holds is read by map_file.hpp.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace asperity::io {

struct HeightMap {
    int sites = 0;                    ///< values along an edge
    std::vector<double> heights;      ///< Å; heights[y * sites + x]
    std::optional<double> size;       ///< edge of the map, Å, where the file tells it
    std::string unit = "Å";           ///< the heights had in the file
    std::string origin;               ///< whose map it is, where the file tells it
    std::vector<std::string> notes{}; ///< what was assumed, filled or cut, one sentence each

    /// Written beside the heights, not read.
    struct Column {
        std::string name, unit; ///< "/spectrum/q"
        std::vector<double> values;
    };
    std::vector<Column> columns{};
};

struct MapOptions {
    std::string unit = "auto"; ///< of the heights; "auto": what the file says, else Å
    bool fill = false;         ///< missing points: by Laplace's equation; else they are refused
    bool crop = false;         ///< not square: the middle; else it is refused
};

/// Throws SceneError, told with the line and column, or the row and column in HDF5.
HeightMap read_height_map(const std::string& file, const MapOptions& options = {});

/// Gives every NaN of heights[y * columns + x] the value that makes it the mean of its neighbours
/// (four, fewer at the map's edge): Laplace's equation with the heights around as boundary values.
/// To 1e-9 of the largest height; there must be one that is no NaN.
void fill_missing(std::vector<double>& heights, std::size_t rows, std::size_t columns);

/// HDF5 data set /heights (with unit and sizes). Whole or not at all. Throws FileError.
void write_height_map(const std::string& file, const HeightMap& map);

} // namespace asperity::io
