// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The substrate as numbers: its heights or atoms, and their statistics (engine/scene/surface.hpp
// makes it).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace asperity {

/// One bin of the radially averaged spectrum.
struct SpectrumBin {
    double q = 0.0;        ///< mean wavevector of the bin's modes, 1/Å
    double realised = 0.0; ///< C(q), Å^4
    double target = 0.0;   ///< C(q) of the options (0 for flat and measured surfaces), Å^4
    int modes = 0;
};

/// Statistics of the roughness, without the cap; lowest and highest include it.
struct SurfaceStatistics {
    double rms = 0.0;                  ///< Å
    double rms_slope = 0.0;            ///< sqrt(<hx^2 + hy^2>), spectral derivative
    double rms_curvature = 0.0;        ///< sqrt(<(hxx + hyy)^2>) / 2, spectral, 1/Å
    double lowest = 0.0;               ///< Å
    double highest = 0.0;              ///< Å
    std::vector<SpectrumBin> spectrum; ///< bins of width q_L
};

/// Positions of atoms anywhere, Å.
struct AtomPositions {
    std::vector<double> x, y, z;
    /// Types, counted from 0 in the scene's pairs; empty: all atoms are of one.
    std::vector<std::int32_t> type{};
    std::size_t size() const { return x.size(); }
};

/// A substrate: its heights or atoms, and their statistics.
struct Surface {
    int sites = 0;
    double length = 0.0; ///< Å
    double radius = 0.0; ///< radius of the cap that the heights include, Å; 0: none
    /// height[y * sites + x] of the atom at (x, y) length / sites, Å; with `atoms`, of the topmost
    /// atom nearest to this place.
    std::vector<double> height;
    AtomPositions atoms; ///< atoms in the box [0, length); empty: one for each height
    long long holes = 0; ///< heights that are not numbers: no solid is there
    SurfaceStatistics statistics;
    std::string origin; ///< owner of a measured map, if its file names one
    /// CRC-32 of the values read from a file of a map or atoms, before any processing.
    std::optional<std::uint32_t> file_digest;
    std::vector<std::string> doubts; ///< sentences on possible mistakes in the file of a map
    std::vector<std::string> notes;  ///< sentences on clipping and resampling
};

} // namespace asperity
