// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// `asperity plan`: what a scene will simulate and what not, and what it will take, before it is
// run. Memory is that of a piece of the case (rehearsal.hpp) times the ratio of the counts that
// each part grows with. Time steps are counted along the path and timed on a piece. States, and
// quasi-static paths, are timed on pieces of twice as many sites across each, while there is time
// for it, and continued by the power of the width that the last two show.
#pragma once

#include "engine/plan/rehearsal.hpp"

#include <cstdio>
#include <vector>

namespace asperity {

struct Plan {
    std::array<double, Piece::parts> bytes{}; ///< of each part, of all ranks
    std::vector<double> bytes_of_rank;        ///< the most that each holds at once
    // Seconds of idle processors, without messages between machines:
    double making = 0.0; ///< surface, tables, block
    double moving = 0.0; ///< time steps
    double rest = 0.0;   ///< states, and quasi-static paths
    double factor = 1.0; ///< that the last may be off by, either way
    bool ended = true;   ///< these on a piece; else they take longer
    long long steps = 0; ///< of a dynamic path
    double start = 0.0;  ///< height of the lowest layer at the start, Å
    int sites = 0;       ///< across the largest piece
};
/// threads: of a rank; 0: of the memory alone, without a look into files.
Plan make_plan(const Case& c, int threads);
void print_plan(std::FILE* to, const Case& c, int threads, const Plan& plan);

/// Throws io::SceneError if a run of this case is refused (Case::require_runnable()) or does not
/// fit into the memory of its machines: the ranks of each machine together are held against what is
/// available there. Collective.
void require_memory(const Case& c, const Communicator& ranks);

} // namespace asperity
