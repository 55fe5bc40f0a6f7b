// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A piece of a case: the case on fewer sites, whose surface has the short waves of the case's. The
// piece is run through its states and its path to measure memory and time, which plan.cpp
// extrapolates to the size of the case.
#pragma once

#include "engine/case/case.hpp"

#include <array>

namespace asperity {

/// Measured memory and time of a piece.
struct Piece {
    /// Parts of a run's memory. kept: copies of states, for the guard or as last points of a path;
    /// rest: work arrays of relaxations and quasi-static paths; maps: the maps of a state while
    /// they are written; parts: their number.
    enum Part : std::size_t { surface, interface, block, kept, rest, maps, parts };
    std::array<double, parts> bytes{};
    double map = 0.0;              ///< size of the heights around the tile in the interface, bytes
    int sites = 0;                 ///< number of sites across
    double nodes = 0.0;            ///< number of nodes of all levels
    std::size_t maps_of_sites = 0; ///< number of InterfaceMaps::of_sites
    // Seconds of one idle processor:
    double making = 0.0; ///< surface, tables and block
    /// Time of a step of a dynamic path beyond the interaction range, and in contact.
    double far_step = 0.0, near_step = 0.0;
    double resting = 0.0; ///< all relaxed states and quasi-static paths
    long long points = 0; ///< points of a quasi-static path that were made
    bool ended = true;    ///< states and paths were completed within the given time
};
/// Makes a piece of `sites` sites across and measures it, on this rank alone. seconds: limit of the
/// time for states and paths; 0: a few iterations, to measure memory only. of_file: the surface if
/// the case reads it from a file; otherwise nullptr. atoms: number of atoms of such a surface.
Piece rehearse(const Case& c, int sites, double seconds, const Surface* of_file, double atoms);

} // namespace asperity
