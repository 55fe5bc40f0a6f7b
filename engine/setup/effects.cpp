// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/setup/resolving.hpp"

#include "kernels/device/device.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace asperity {

namespace {

using Switch = Effects::Switch;

/// What several rules ask of a case.
bool follows_path(const Case& c) {
    return std::any_of(c.path.begin(), c.path.end(),
                       [](const Segment& s) { return s.kind != Segment::zero_load; });
}
std::string equilibria(const Case& c) {
    return c.has(Segment::zero_load) ? "drive.path = [\"zero-load\"]"
                                     : "drive.mode = \"quasistatic\"";
}
Switch off_without_time(const Case& c) { return {false, "no time passes: " + equilibria(c)}; }

Switch damping(const Case& c) {
    if (!c.in_time) return off_without_time(c);
    const Scene::Drive& drive = c.scene.drive;
    if (drive.damping == 0.0) return {false, "drive.damping = 0"};
    if (drive.damping_from >= 1.0)
        return {false,
                fmt::format("drive.damping_from = {:.4g}: no layer is damped", drive.damping_from)};
    return {true, fmt::format("drive.damping = {:.4g} 1/ps", drive.damping)};
}

Switch temperature(const Case& c) {
    if (!c.in_time) return off_without_time(c);
    const double temperature = c.scene.drive.temperature;
    return {temperature > 0.0, fmt::format("drive.temperature = {:.4g} K", temperature)};
}

Switch coarse_levels(const Case& c) {
    if (!c.in_time) return off_without_time(c);
    const Scene::Block& block = c.scene.block;
    if (block.model == BlockModel::lattice) return {false, "block.model = \"lattice\""};
    if (c.levels.size() == 1)
        return {false, fmt::format("{} layers make one level", block.thickness)};
    return {true,
            fmt::format("block.model = \"multiscale\", {} layers a level", block.layers_per_level)};
}

Switch relaxation(const Case& c) {
    if (!c.in_time) return {true, equilibria(c)};
    if (c.scene.block.strain == Strain::finite)
        return {false, "block.strain = \"finite\": states are found wave by wave, and waves do not "
                       "add up"};
    return {true, "a copy of the lowest layer is relaxed where the approach ends"};
}

Switch observation(const Case& c) {
    if (!follows_path(c)) return off_without_time(c);
    return {true, c.in_time ? fmt::format("output.series = {}: every so many steps",
                                          c.scene.output.series)
                            : "always: at every point of a quasi-static path"};
}

Switch maps(const Case& c) {
    const MapTimes& m = c.maps;
    if (m.zero_load || m.pull_off || m.segments || (follows_path(c) && m.every) ||
        !m.after_zero_load.empty())
        return {true, "output.fields asks for them"};
    return {false, "output.fields asks for no state of this path"};
}

struct Rule {
    Effect effect;
    std::string_view name;
    Switch (*decide)(const Case&);
};

/// In the order of Effect.
constexpr std::array<Rule, effect_count> rules = {{
    {Effect::inertia, "inertia",
     [](const Case& c) {
         return c.in_time ? Switch{true, "drive.path is followed in time"} : off_without_time(c);
     }},
    {Effect::lateral, "lateral displacements",
     [](const Case& c) {
         if (c.scene.interface.kind == InterfaceKind::wall)
             return Switch{false, "interface.kind = \"wall\""};
         return c.scene.interface.frictionless ? Switch{false, "interface.frictionless = true"}
                                               : Switch{true, "three components a node"};
     }},
    {Effect::damping, "damping", damping},
    {Effect::temperature, "temperature", temperature},
    {Effect::finite_strain, "finite strain",
     [](const Case& c) {
         return c.scene.block.strain == Strain::finite ? Switch{true, "block.strain = \"finite\""}
                                                       : Switch{false, "block.strain = \"linear\""};
     }},
    {Effect::coarse_levels, "coarse levels", coarse_levels},
    {Effect::skipping, "skipping of far sites",
     [](const Case& c) {
         if (c.scene.interface.kind == InterfaceKind::wall)
             return Switch{false, "interface.kind = \"wall\": one gap a site"};
         return Switch{true, "always: what is beyond interface.cutoff adds exact zeros"};
     }},
    {Effect::sliding, "sliding",
     [](const Case& c) {
         return c.has(Segment::slide) ? Switch{true, "drive.path has a \"slide\""}
                                      : Switch{false, "drive.path has no \"slide\""};
     }},
    {Effect::tail, "long-range tail",
     [](const Case& c) {
         if (c.scene.interface.kind == InterfaceKind::wall)
             return Switch{false, "interface.kind = \"wall\": a part of its law"};
         return Switch{c.scene.interface.tail,
                       fmt::format("interface.tail = {}", c.scene.interface.tail)};
     }},
    {Effect::curvature, "curvature",
     [](const Case& c) {
         return c.scene.surface.radius ? Switch{true, fmt::format("surface.radius = {:.6g} Å",
                                                                  *c.scene.surface.radius)}
                                       : Switch{false, "surface.radius = \"none\""};
     }},
    {Effect::relaxation, "relaxation", relaxation},
    {Effect::observation, "energies and contact", observation},
    {Effect::maps, "maps", maps},
    {Effect::trajectory, "trajectory",
     [](const Case& c) {
         const auto& every = c.scene.output.trajectory;
         return every ? Switch{true, fmt::format("output.trajectory = {}", *every)}
                      : Switch{false, "output.trajectory = \"none\""};
     }},
    {Effect::checkpoints, "checkpoints",
     [](const Case& c) {
         return Switch{
             c.scene.output.checkpoint > 0.0,
             fmt::format("output.checkpoint = {:.4g} s of wall time", c.scene.output.checkpoint)};
     }},
    {Effect::theory, "theory",
     [](const Case& c) {
         if (c.scene.surface.kind == SurfaceKind::atoms)
             return Switch{false, "surface.kind = \"atoms\": the theory is of one layer with "
                                  "heights"};
         return Switch{true, "always: one solution for each result"};
     }},
    {Effect::device, "device",
     [](const Case& c) {
         const DeviceChoice& asked = c.scene.numerics.device;
         if (!asked) return Switch{false, "numerics.device = \"none\""};
         if (asked.kind == DeviceChoice::Kind::automatic) {
             const std::string any = "numerics.device = \"auto\"";
             if (cuda_device_count() == 0) return Switch{false, any + ": no CUDA device is here"};
             const auto problems = device_problems(c);
             if (!problems.empty()) return Switch{false, any + ": it " + problems.front().what};
             return Switch{true, any};
         }
         return Switch{true, asked.kind == DeviceChoice::Kind::emulated
                                 ? "numerics.device = \"emulated\""
                                 : fmt::format("numerics.device = {}", asked.index)};
     }},
}};

constexpr bool in_order() {
    for (std::size_t i = 0; i < effect_count; ++i)
        if (rules[i].effect != static_cast<Effect>(i)) return false;
    return true;
}
static_assert(in_order(), "a rule for each effect, in the order of the enumeration");

} // namespace

std::string_view name(Effect effect) { return rules[static_cast<std::size_t>(effect)].name; }

Effects effects_of(const Case& c) {
    Effects effects;
    for (std::size_t i = 0; i < effect_count; ++i)
        effects.switches[i] = rules[i].decide(c);
    return effects;
}

} // namespace asperity
