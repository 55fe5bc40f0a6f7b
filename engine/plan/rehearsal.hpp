// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A piece of a case: the case on fewer sites, whose surface has the short waves of the case's. It
// is taken through its states and its path to measure memory and time. plan.cpp continues the
// numbers of pieces to the size of the case.
#pragma once

#include "engine/case/case.hpp"

#include <array>

namespace asperity {

/// Measured memory and time of a piece.
struct Piece {
    /// Parts of a run's memory. kept: states of the energy guard, or the points that a path goes
    /// back to; rest: relaxations, and quasi-static paths; maps: while the maps of one state are
    /// written.
    enum Part : std::size_t { surface, interface, block, kept, rest, maps, parts };
    std::array<double, parts> bytes{};
    double table = 0.0; ///< bytes of the waves' stiffness, which each rank holds whole
    int sites = 0;      ///< number of sites across
    double atoms = 0.0; ///< number of atoms of the substrate
    double nodes = 0.0; ///< number of nodes of all levels
    // Seconds of one idle processor:
    double making = 0.0; ///< surface, tables and block
    /// Steps of dynamic paths, beyond the interaction range and in contact.
    double far_step = 0.0, near_step = 0.0;
    double resting = 0.0; ///< all states, and quasi-static paths
    bool ended = true;    ///< states and paths ended within the time for them
};
/// Makes a piece and measures it, on this rank alone. seconds: time for states and paths; 0: a few
/// iterations, for the memory only. of_file: the surface of a case that reads it from a file, with
/// so many atoms; without it one of that size is made.
Piece rehearse(const Case& c, int sites, double seconds, const Surface* of_file, double atoms);

} // namespace asperity
