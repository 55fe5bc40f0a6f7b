// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/commands/command_line.hpp"

#include "decomposition/communicator.hpp"
#include "engine/plan/plan.hpp"
#include "io/error.hpp"
#include "io/json.hpp"
#include "io/terminal.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <omp.h>

namespace asperity {

namespace {

struct PlanArguments : Arguments {
    int ranks = 0;               ///< number of ranks to plan for; 0: the ranks of this call
    std::string memory_per_node; ///< memory of a node to plan for; empty: none
};

int plan(const PlanArguments& given, const Communicator& world) {
    const Case c = case_of(given, given.ranks > 0 ? given.ranks : world.size());
    double node = 0.0;
    if (!given.memory_per_node.empty()) {
        const std::optional<double> said = io::parse_memory(given.memory_per_node);
        if (!said)
            throw io::SceneError(
                io::Problem{"--memory-per-node " + given.memory_per_node, "is no size of memory",
                            "a number and its unit are needed", "for example 256GB or 62.5GiB"});
        node = *said;
    }
    const std::vector<std::string> notes = examine(c, world);
    const int cores = omp_get_max_threads() * world.size();
    world.on_root([&] {
        const int threads = std::max(1, cores / c.ranks);
        if (given.json) {
            io::Json all = plan_json(c, threads, make_plan(c, threads), node);
            all["notes"] = notes;
            fmt::print("{}\n", io::json_text(all));
            return;
        }
        print_plan(stdout, c, threads, make_plan(c, threads), node);
        for (const std::string& note : notes)
            if (!given.quiet) io::print_text(stdout, "note: {}\n", note);
    });
    return io::exit_code::done;
}

} // namespace

Command plan_command() {
    const auto given = std::make_shared<PlanArguments>();
    return {.options = {takes::scene(*given),
                        takes::set(*given),
                        {"--ranks", "N", "for so many ranks (default: as started)", &given->ranks},
                        {"--memory-per-node", "SIZE",
                         "say how many ranks fit into a node of this memory, for example 256GB",
                         &given->memory_per_node},
                        takes::quiet(*given),
                        takes::json(*given)},
            .act = [given](const Communicator& world) { return plan(*given, world); }};
}

} // namespace asperity
