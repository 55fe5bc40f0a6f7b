// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A piece of a case: the case on fewer sites, whose surface has the short waves of the case's, made
// and taken through its states and its path, with the memory and the time that this takes. plan.cpp
// continues the numbers of pieces to the size of the case.
#pragma once

#include "engine/setup/case.hpp"

#include <array>

namespace asperity {

struct Piece {
    /// Of a run. Kept: states of the energy guard, or the points that a path goes back to. Rest:
    /// relaxations, and quasi-static paths. Maps: while one state's are written.
    enum Part : std::size_t { surface, interface, block, kept, rest, maps, parts };
    std::array<double, parts> bytes{};
    double table = 0.0; ///< bytes of the waves' stiffness, which each rank holds whole
    int sites = 0;      ///< across
    double atoms = 0.0; ///< of the substrate
    double nodes = 0.0; ///< of all levels
    // Seconds of one idle processor:
    double making = 0.0; ///< surface, tables, block
    double far_step = 0.0,
           near_step = 0.0; ///< of dynamic paths, beyond the interaction range and in contact
    double resting = 0.0;   ///< all states, and quasi-static paths
    bool ended = true;      ///< these, within the time for them
};
/// On this rank alone. seconds: for states and paths; 0: a few iterations, for the memory alone.
/// of_file: the surface of a case that reads it from a file, which has so many atoms; without it
/// one of that size is made.
Piece rehearse(const Case& c, int sites, double seconds, const Surface* of_file, double atoms);

} // namespace asperity
