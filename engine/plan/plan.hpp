// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// `asperity plan`: the effects of a scene and the cost of its run, before it is run. Memory is that
// of a piece of the case (rehearsal.hpp) times the ratio of the counts that each part grows with.
// Time steps are counted along the path and timed on a piece. States, and quasi-static paths, are
// timed on pieces of twice as many sites across each, while there is time for it, and continued by
// the power of the width that the last two show.
#pragma once

#include "engine/plan/rehearsal.hpp"

#include <nlohmann/json_fwd.hpp>

#include <cstdio>
#include <vector>

namespace asperity {

/// Estimated memory and time of a run.
struct Plan {
    std::array<double, Piece::parts> bytes{}; ///< memory of each part, all ranks together
    std::vector<double> bytes_of_rank;        ///< largest memory that each rank holds at once
    double state_bytes = 0.0; ///< maps of a state in run.h5 before they are compressed
    double frame_bytes = 0.0; ///< frame of the trajectory in run.h5; 0: none is written
    // Seconds of idle processors, without messages between machines:
    double making = 0.0; ///< surface, tables and block
    double moving = 0.0; ///< time steps
    double rest = 0.0;   ///< states, and quasi-static paths
    double factor = 1.0; ///< uncertainty of `rest`, a factor either way
    bool ended = true;   ///< states and paths ended on a piece; false: they take longer
    long long steps = 0; ///< number of steps of a dynamic path
    double start = 0.0;  ///< height of the lowest layer at the start, Å
    int sites = 0;       ///< number of sites across the largest piece
};
/// Estimates a run. threads: number of threads of a rank; 0: estimate the memory only, without
/// reading files.
Plan make_plan(const Case& c, int threads);
void print_plan(std::FILE* to, const Case& c, int threads, const Plan& plan);
/// Returns the effects for programs: {name: {"on", "because"}}.
nlohmann::ordered_json effects_json(const Effects& effects);
/// Returns the plan for programs: {"name", "effects": {name: {"on", "because"}}, "ranks",
/// "threads", "sites_of_rank", "steps", "bytes": {"surface", "interface", "block", "kept", "rest",
/// "maps", "altogether", "rank", "available", "state", "frame"}, "seconds": {"surface", "steps",
/// "rest", "altogether", "factor"}, "ended"}, named as the members of Plan; altogether: largest
/// bytes at once, and seconds of the whole run; rank: largest bytes of a rank; state, frame: in
/// run.h5, before compression.
nlohmann::ordered_json plan_json(const Case& c, int threads, const Plan& plan);

/// Throws io::SceneError if a run of this case is refused (Case::require_runnable()) or does not
/// fit into the memory of its machines: the ranks of each machine together are compared with the
/// memory available there. Collective.
void require_memory(const Case& c, const Communicator& ranks);

} // namespace asperity
