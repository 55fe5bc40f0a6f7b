// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/setup/effects.hpp"

#include "engine/block/block.hpp"

#include <fmt/format.h>

#include <tuple>
#include <utility>

namespace asperity {

namespace {

struct Entry {
    std::string_view name, unit;
    Occurs occurs;
};

/// In the order of Effect.
constexpr std::array<Entry, effect_count> entries = {{
    {"inertia", "node-steps", Occurs::always},
    {"lateral displacements", "steps", Occurs::always},
    {"damping", "node-steps", Occurs::always},
    {"temperature", "steps", Occurs::always},
    {"finite strain", "node-steps", Occurs::always},
    {"coarse levels", "steps", Occurs::always},
    {"skipping of far sites", "sites", Occurs::when_due},
    {"long-range tail", "sites", Occurs::always},
    {"curvature", "surfaces", Occurs::always},
    {"relaxation", "iterations", Occurs::path_end},
    {"energies and contact", "steps", Occurs::when_due},
    {"maps", "maps", Occurs::path_end},
    {"trajectory", "frames", Occurs::when_due},
    {"checkpoints", "files", Occurs::when_due},
    {"theory", "solutions", Occurs::when_due},
}};

const Entry& entry(Effect effect) { return entries[static_cast<std::size_t>(effect)]; }

bool coarsens(const Scene& scene) {
    BlockOptions block;
    block.sites = scene.surface.sites;
    block.thickness = scene.block.thickness;
    block.layers_per_level = scene.block.layers_per_level;
    return scene.block.model == BlockModel::multiscale && plan_levels(block).size() > 1;
}

} // namespace

std::string_view name(Effect effect) { return entry(effect).name; }
std::string_view unit_of(Effect effect) { return entry(effect).unit; }
Occurs occurs(Effect effect) { return entry(effect).occurs; }

void Effects::decide(Effect effect, bool on, std::string why) {
    decisions_[static_cast<std::size_t>(effect)] = {on, std::move(why)};
}

Effects::Effects(const Scene& scene) {
    const auto& [surface, block, drive, output] =
        std::tie(scene.surface, scene.block, scene.drive, scene.output);
    // Time passes on a dynamic path; equilibria have none.
    const bool direct = scene.has(PathPart::zero_load);
    const bool in_time = !scene.without_time();
    const std::string equilibria =
        direct ? "drive.path = [\"zero-load\"]" : "drive.mode = \"quasistatic\"";
    const std::string timeless = "no time passes: " + equilibria;

    decide(Effect::inertia, in_time, in_time ? "drive.path is followed in time" : timeless);
    decide(Effect::lateral, !scene.interface.frictionless,
           scene.interface.frictionless ? "interface.frictionless = true"
                                        : "three components a node");
    const bool damped = in_time && drive.damping > 0.0 && drive.damping_from < 1.0;
    decide(Effect::damping, damped,
           !in_time ? timeless
           : damped ? fmt::format("drive.damping = {:.4g} 1/ps", drive.damping)
           : drive.damping > 0.0
               ? fmt::format("drive.damping_from = {:.4g} leaves no layer", drive.damping_from)
               : "drive.damping = 0");
    const bool warm = in_time && drive.temperature > 0.0;
    decide(Effect::temperature, warm,
           in_time ? fmt::format("drive.temperature = {:.4g} K", drive.temperature) : timeless);
    const bool finite = block.strain == Strain::finite;
    decide(Effect::finite_strain, finite,
           finite ? "block.strain = \"finite\"" : "block.strain = \"linear\"");
    const bool coarse = coarsens(scene);
    decide(Effect::coarse_levels, coarse,
           block.model == BlockModel::lattice    ? "block.model = \"lattice\""
           : block.model == BlockModel::spectral ? "block.model = \"spectral\""
           : coarse ? fmt::format("block.model = \"multiscale\", {} layers a level",
                                  block.layers_per_level)
                    : fmt::format("{} layers make one level", block.thickness));
    decide(Effect::skipping, true, "always: what is beyond interface.cutoff adds exact zeros");
    decide(Effect::tail, scene.interface.tail,
           scene.interface.tail ? "interface.tail = true" : "interface.tail = false");
    decide(Effect::curvature, surface.radius.has_value(),
           surface.radius ? fmt::format("surface.radius = {:.6g} Å", *surface.radius)
                          : "surface.radius = \"none\"");
    const bool relaxes = !in_time || scene.has(PathPart::approach);
    decide(Effect::relaxation, relaxes,
           !in_time  ? equilibria
           : relaxes ? "drive.path has an approach: a copy of where it ends is relaxed"
                     : "drive.path has no approach");
    const bool follows = scene.has(PathPart::approach) || scene.has(PathPart::pull_off);
    decide(Effect::observation, follows,
           in_time   ? fmt::format("output.series = {}: every so many steps", output.series)
           : follows ? "always: at every point of a quasi-static path"
                     : timeless);
    const bool maps = (relaxes && scene.writes_field("zero-load")) ||
                      scene.writes_field("pull-off") || (follows && scene.field_stride());
    decide(Effect::maps, maps,
           maps ? "output.fields asks for them" : "output.fields asks for no state of this path");
    decide(Effect::trajectory, output.trajectory.has_value(),
           output.trajectory ? fmt::format("output.trajectory = {}", *output.trajectory)
                             : "output.trajectory = \"none\"");
    decide(Effect::checkpoints, output.checkpoint > 0.0,
           fmt::format("output.checkpoint = {:.4g} s of wall time", output.checkpoint));
    decide(Effect::theory, true, "always: one solution beside the result");
}

std::vector<std::string> EffectBooks::differences(const Effects& planned, bool complete) const {
    std::vector<std::string> list;
    for (std::size_t i = 0; i < effect_count; ++i) {
        const auto effect = static_cast<Effect>(i);
        const Done& done = done_[i];
        if (!planned.on(effect) && (done.calls > 0 || done.bytes > 0))
            list.push_back(fmt::format("{} was not called for ({}), but took {} {} and {} bytes",
                                       name(effect), planned.why(effect), done.calls,
                                       unit_of(effect), done.bytes));
        const bool must =
            occurs(effect) == Occurs::always || (occurs(effect) == Occurs::path_end && complete);
        if (planned.on(effect) && must && done.calls == 0)
            list.push_back(fmt::format("{} was called for ({}) and did not take place",
                                       name(effect), planned.why(effect)));
    }
    return list;
}

io::JsonValue EffectBooks::json(const Effects& planned) const {
    io::JsonValue all = io::JsonValue::object();
    for (std::size_t i = 0; i < effect_count; ++i) {
        const auto effect = static_cast<Effect>(i);
        io::JsonValue one = io::JsonValue::object();
        one["planned"] = planned.on(effect);
        one["calls"] = done_[i].calls;
        one["unit"] = std::string(unit_of(effect));
        one["bytes"] = static_cast<long long>(done_[i].bytes);
        all[std::string(name(effect))] = std::move(one);
    }
    return all;
}

} // namespace asperity
