// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Interpretation of the values in the file of a map: units, sizes, missing points.
#pragma once

#include "io/height_map.hpp"

#include <optional>
#include <string>

namespace asperity::io {

/// Values from which on a point counts as missing: files use 1e38 (Surfer) or the largest float or
/// double (SDF), and no height of a surface is 1e30 of any unit.
constexpr double no_height = 1e30;

/// Units that a file states.
struct MapUnits {
    std::optional<std::string> unit;       ///< unit of the heights
    double scale = 1.0;                    ///< factor of the values of the file
    std::optional<std::string> of_sizes{}; ///< unit of width and height; empty: as the heights
};

/// Converts heights and sizes of a map to Å and counts its missing points. Unit and size of the
/// scene override those of the file; a difference is added to map.doubts. Throws SceneError.
void complete(HeightMap& map, const MapUnits& units, const MapOptions& said);

/// Adds possible mistakes in the file to map.doubts: sizes that no map of roughness has, a value
/// that marks missing points, several maps in one. key: key of the scene that names the map.
void note_doubts(HeightMap& map, std::string_view key);

} // namespace asperity::io
