// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/commands/command_line.hpp"

#include "decomposition/communicator.hpp"
#include "engine/case/contact_estimate.hpp"
#include "engine/case/site_field.hpp"
#include "engine/plan/plan.hpp"
#include "engine/theory/theory_case.hpp"
#include "io/error.hpp"
#include "io/json.hpp"
#include "io/terminal.hpp"

#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace asperity {

namespace {

/// Returns the check of a scene for programs: a sweep calls it before it varies the scene, so that
/// the problems of a run of the scene itself are listed, not thrown.
io::Json check_json(const Case& c, const Communicator& world) {
    const Scene& scene = c.scene;
    io::Json all;
    all["name"] = scene.name;
    all["scene"] = scene_json(scene);
    all["sweep"] = io::Json::array();
    for (const io::Variation& variation : scene.sweep) {
        all["sweep"].push_back(
            {{"key", variation.key}, {"values", variation.values}, {"where", variation.where}});
    }
    all["effects"] = effects_json(c.effects);
    all["theory_needs_surface"] = theory_needs_surface(c);
    if (const auto beyond = beyond_edges(c))
        all["beyond_edges"] = {{"part", beyond->part}, {"width", beyond->width}};
    all["notes"] = io::Json::array();
    all["problems"] = io::Json::array();
    try {
        const std::vector<std::string> notes = examine(c, world);
        all["longest_timestep"] = c.longest_timestep;
        all["edge_pinning"] = c.edge_pinning;
        all["box_softness"] = c.box_jumps() ? c.softness : 0.0;
        all["notes"] = notes;
    } catch (const io::SceneError& error) {
        all["problems"] = io::problems_json(error.problems());
    }
    return all;
}

int check(const Arguments& given, const Communicator& world) {
    const Case c = case_of(given, world.size(), world);
    if (given.json) {
        const io::Json all = check_json(c, world);
        if (world.root()) fmt::print("{}\n", io::json_text(all));
        return all["problems"].empty() ? io::exit_code::done : io::exit_code::scene;
    }
    const std::vector<std::string> notes = examine(c, world);
    if (!world.root() || given.quiet) return io::exit_code::done;
    io::print_text(stdout, "{}: nothing wrong\n", c.scene.file);
    io::print_text(stdout, "  {}; {}\n", c.box_in_words(), c.block_in_words());
    if (c.effects.dynamic)
        fmt::print("  time step {:.4g} fs, usable up to {:.2g} fs\n", c.simulation.dt,
                   usable_timestep(c.longest_timestep));
    for (const std::string& note : notes)
        io::print_text(stdout, "  note: {}\n", note);
    return io::exit_code::done;
}

} // namespace

Command check_command() {
    const auto given = std::make_shared<Arguments>();
    return {.options = {takes::scene(*given), takes::set(*given), takes::quiet(*given),
                        takes::json(*given)},
            .act = [given](const Communicator& world) { return check(*given, world); }};
}

} // namespace asperity
