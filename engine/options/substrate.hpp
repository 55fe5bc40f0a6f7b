// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Data of the substrate: heights or atoms, and their statistics (made by engine/scene/surface.hpp).
#pragma once

#include "decomposition/bands.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
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

/// Positions of atoms of a substrate, Å.
struct AtomPositions {
    std::vector<double> x, y, z;
    /// Types, as indices of interface.pairs; empty: all atoms have one type.
    std::vector<std::int32_t> type{};
    std::size_t size() const { return x.size(); }
};

/// Returns the height of a spherical cap relative to its apex, at (dx, dy) from the apex, Å:
/// sqrt(R^2 - rho^2) - R, without the cancellation of this form; NaN beyond the equator.
inline double cap_of(double radius, double dx, double dy) {
    const double rho2 = dx * dx + dy * dy;
    return -rho2 / (radius + std::sqrt(radius * radius - rho2));
}

/// The two surfaces of a pair of rough solids; the heights of each are outwards from its own solid.
struct SurfacePair {
    SurfaceStatistics own, counter; ///< statistics of the block's surface, and the second solid's
    /// Heights of the second solid in its place, Å, turned over, turned and shifted: this rank's
    /// band of them.
    std::vector<double> counter_height;
    double correlation = 0.0;  ///< correlation of the heights; 0 if one surface is flat
    double band_overlap = 0.0; ///< overlap of the spectra, 1 for proportional ones, 0 for disjoint
    std::uint32_t digest = 0;  ///< CRC-32 of the values read from the file of the second solid
};

/// A substrate: its heights or atoms, and their statistics.
struct Surface {
    int sites = 0;
    double length = 0.0; ///< Å
    double radius = 0.0; ///< radius of the cap that the heights include, Å; 0: none
    /// Band of the heights on this rank, height[bands().at(x, y)]: height of the atom at (x, y)
    /// length / sites, Å; with `atoms`, height of the topmost atom nearest to this place.
    std::vector<double> height;
    AtomPositions atoms; ///< atoms in the box [0, length); empty: one atom per height
    long long holes = 0; ///< number of NaN heights, which mean no solid
    SurfaceStatistics statistics;
    /// Surfaces whose heights add up to `height`; empty: one rough surface.
    std::optional<SurfacePair> pair{};
    std::string origin; ///< author of a measured map, if its file names one
    /// CRC-32 of the values read from a file of a map or atoms, before any processing.
    std::optional<std::uint32_t> file_digest;
    std::vector<std::string> doubts; ///< sentences on possible mistakes in the file of a map
    std::vector<std::string> notes;  ///< sentences on clipping and resampling
    Communicator ranks{};            ///< ranks that hold the heights

    /// Returns the division of the heights among the ranks.
    Bands bands() const { return {ranks, sites}; }
};

/// Returns the correlation length of a substrate, Å: the wavelength of the mean wavevector of its
/// roughness; a quarter of the box for a smooth substrate.
inline double correlation_length(const Surface& s) {
    double power = 0.0, mean = 0.0;
    for (const SpectrumBin& bin : s.statistics.spectrum) {
        power += bin.realised * bin.modes;
        mean += bin.realised * bin.modes * bin.q;
    }
    return mean > 0.0 ? 2.0 * std::numbers::pi * power / mean : 0.25 * s.length;
}

} // namespace asperity
