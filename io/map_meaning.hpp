// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Meaning of the numbers of a map's file: units, sizes, points without a height.
#pragma once

#include "io/height_map.hpp"

#include <optional>
#include <string>

namespace asperity::io {

/// Numbers this large stand for points without a height: 1e38 of Surfer, the largest float or
/// double (SDF). No height of a surface is 1e30 of any unit.
constexpr double no_height = 1e30;

/// Units that a file states.
struct MapUnits {
    std::optional<std::string> unit;       ///< unit of the heights
    double scale = 1.0;                    ///< a number of the file is so many units
    std::optional<std::string> of_sizes{}; ///< unit of width and height; empty: that of the heights
};

/// Converts heights and sizes of a map to Å and counts its missing points. Unit and size of the
/// scene hold over those of the file; if they differ, a doubt names both. Throws SceneError.
void complete(HeightMap& map, const MapUnits& units, const MapOptions& said);

/// Adds to map.doubts what may be wrong with the file: sizes that no map of roughness has, a height
/// that stands for none, maps on top of one another.
void note_doubts(HeightMap& map);

} // namespace asperity::io
