// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// `asperity plan`: the effects of a scene and the cost of its run, before it is run. Memory is
// measured on a small piece of the case (rehearsal.hpp) and scaled by the counts (sites, nodes,
// ...) to which each part is proportional. Time steps are counted along the path and timed on a
// piece. Relaxed states and quasi-static paths are timed on pieces of doubling width, as long as
// time allows, and extrapolated with the power of the width between the last two.
#pragma once

#include "engine/plan/rehearsal.hpp"

#include <nlohmann/json_fwd.hpp>

#include <cstdio>
#include <string>
#include <utility>
#include <vector>

namespace asperity {

/// Estimated memory and time of a run.
struct Plan {
    std::array<double, Piece::parts> bytes{}; ///< memory of each part, all ranks together
    std::vector<double> bytes_of_rank;        ///< peak memory of each rank, bytes
    /// Arrays that are not divided among the ranks, with their size on a rank, bytes. They are part
    /// of `bytes`, those of the reading of files excepted.
    std::vector<std::pair<std::string, double>> whole;
    double state_bytes = 0.0;  ///< size of the maps of a state in run.h5 before compression, bytes
    double stress_bytes = 0.0; ///< size of the stresses below a state there; 0: none are written
    /// Size of a frame of the trajectory in run.h5, bytes; 0: none is written.
    double frame_bytes = 0.0;
    // Seconds of idle processors, without messages between machines:
    double making = 0.0; ///< surface, tables and block
    double moving = 0.0; ///< time steps
    double rest = 0.0;   ///< states, and quasi-static paths
    double factor = 1.0; ///< uncertainty of `rest`, as a factor in both directions
    /// States and paths of a piece were completed; false: times are lower bounds.
    bool ended = true;
    long long steps = 0; ///< number of steps of a dynamic path
    double start = 0.0;  ///< height of the lowest layer at the start, Å
    int sites = 0;       ///< number of sites across the largest piece
};
/// Estimates memory and time of a run. threads: number of threads of a rank; 0: memory only,
/// without reading files.
Plan make_plan(const Case& c, int threads);
/// Prints effects, memory and time. node: memory of a node, bytes; 0: nothing is said of nodes.
void print_plan(std::FILE* to, const Case& c, int threads, const Plan& plan, double node = 0.0);
/// Returns the effects as JSON: {name: {"on", "because"}}.
nlohmann::ordered_json effects_json(const Effects& effects);
/// Returns the plan as JSON: {"name", "effects": {name: {"on", "because"}}, "ranks", "threads",
/// "sites_of_rank", "steps", "bytes": {"surface", "interface", "block", "kept", "rest", "maps",
/// "altogether", "rank", "available", "state", "stress", "frame"}, "whole": [{"what", "bytes"}],
/// "seconds": {"surface", "steps", "rest", "altogether", "factor"}, "ended"}, named as the members
/// of Plan and parts of Piece. bytes.altogether: peak memory; seconds.altogether: time of the whole
/// run; bytes.rank: peak memory of a rank; bytes.state, bytes.stress, bytes.frame: size in run.h5
/// before compression. node: memory of a node, bytes; if it is above 0, "ranks_of_node" is the
/// number of ranks that fit into it.
nlohmann::ordered_json plan_json(const Case& c, int threads, const Plan& plan, double node = 0.0);

/// Throws io::SceneError if a run of this case is refused (Case::require_runnable()) or does not
/// fit into the memory of its machines: the memory of all ranks of each machine is compared with
/// the memory left there, and that of each rank with its own limits. Collective.
void require_memory(const Case& c, const Communicator& ranks);

} // namespace asperity
