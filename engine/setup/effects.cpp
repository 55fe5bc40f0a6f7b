// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/setup/effects.hpp"

#include "engine/block/block.hpp"
#include "kernels/device/device.hpp"

#include <fmt/format.h>

namespace asperity {

namespace {

using Switch = Effects::Switch;

/// What several rules ask of a scene.
bool in_time(const Scene& s) { return !s.without_time(); }
bool follows_path(const Scene& s) { return s.has(PathPart::approach) || s.has(PathPart::pull_off); }

std::string equilibria(const Scene& s) {
    return s.has(PathPart::zero_load) ? "drive.path = [\"zero-load\"]"
                                      : "drive.mode = \"quasistatic\"";
}
Switch off_without_time(const Scene& s) { return {false, "no time passes: " + equilibria(s)}; }

Switch damping(const Scene& s) {
    if (!in_time(s)) return off_without_time(s);
    if (s.drive.damping == 0.0) return {false, "drive.damping = 0"};
    if (s.drive.damping_from >= 1.0)
        return {false, fmt::format("drive.damping_from = {:.4g}: no layer is damped",
                                   s.drive.damping_from)};
    return {true, fmt::format("drive.damping = {:.4g} 1/ps", s.drive.damping)};
}

Switch temperature(const Scene& s) {
    if (!in_time(s)) return off_without_time(s);
    return {s.drive.temperature > 0.0,
            fmt::format("drive.temperature = {:.4g} K", s.drive.temperature)};
}

Switch coarse_levels(const Scene& s) {
    if (!in_time(s)) return off_without_time(s);
    if (s.block.model == BlockModel::lattice) return {false, "block.model = \"lattice\""};
    BlockOptions block;
    block.sites = s.surface.sites;
    block.thickness = s.block.thickness;
    block.layers_per_level = s.block.layers_per_level;
    if (level_shapes(block).size() == 1)
        return {false, fmt::format("{} layers make one level", block.thickness)};
    return {true,
            fmt::format("block.model = \"multiscale\", {} layers a level", block.layers_per_level)};
}

Switch relaxation(const Scene& s) {
    if (!in_time(s)) return {true, equilibria(s)};
    if (s.block.strain == Strain::finite)
        return {false, "block.strain = \"finite\": states are found wave by wave, and waves do not "
                       "add up"};
    return {true, "a copy of the lowest layer is relaxed where the approach ends"};
}

Switch observation(const Scene& s) {
    if (!follows_path(s)) return off_without_time(s);
    return {true, in_time(s)
                      ? fmt::format("output.series = {}: every so many steps", s.output.series)
                      : "always: at every point of a quasi-static path"};
}

Switch maps(const Scene& s) {
    if (s.writes_field("zero-load") || s.writes_field("pull-off") ||
        (follows_path(s) && s.field_stride()) || !s.delayed_fields().empty())
        return {true, "output.fields asks for them"};
    return {false, "output.fields asks for no state of this path"};
}

struct Rule {
    Effect effect;
    std::string_view name;
    Switch (*decide)(const Scene&);
};

/// In the order of Effect.
constexpr std::array<Rule, effect_count> rules = {{
    {Effect::inertia, "inertia",
     [](const Scene& s) {
         return in_time(s) ? Switch{true, "drive.path is followed in time"} : off_without_time(s);
     }},
    {Effect::lateral, "lateral displacements",
     [](const Scene& s) {
         if (s.interface.kind == InterfaceKind::wall)
             return Switch{false, "interface.kind = \"wall\""};
         return s.interface.frictionless ? Switch{false, "interface.frictionless = true"}
                                         : Switch{true, "three components a node"};
     }},
    {Effect::damping, "damping", damping},
    {Effect::temperature, "temperature", temperature},
    {Effect::finite_strain, "finite strain",
     [](const Scene& s) {
         return s.block.strain == Strain::finite ? Switch{true, "block.strain = \"finite\""}
                                                 : Switch{false, "block.strain = \"linear\""};
     }},
    {Effect::coarse_levels, "coarse levels", coarse_levels},
    {Effect::seams, "absorbing seams",
     [](const Scene& s) {
         if (const Switch levels = coarse_levels(s); !levels.on) return levels;
         const bool absorb = s.block.seams == Seams::absorb;
         return Switch{absorb, fmt::format("block.seams = \"{}\"", absorb ? "absorb" : "reflect")};
     }},
    {Effect::skipping, "skipping of far sites",
     [](const Scene& s) {
         if (s.interface.kind == InterfaceKind::wall)
             return Switch{false, "interface.kind = \"wall\": one gap a site"};
         return Switch{true, "always: what is beyond interface.cutoff adds exact zeros"};
     }},
    {Effect::tail, "long-range tail",
     [](const Scene& s) {
         if (s.interface.kind == InterfaceKind::wall)
             return Switch{false, "interface.kind = \"wall\": a part of its law"};
         return Switch{s.interface.tail, fmt::format("interface.tail = {}", s.interface.tail)};
     }},
    {Effect::curvature, "curvature",
     [](const Scene& s) {
         return s.surface.radius
                    ? Switch{true, fmt::format("surface.radius = {:.6g} Å", *s.surface.radius)}
                    : Switch{false, "surface.radius = \"none\""};
     }},
    {Effect::relaxation, "relaxation", relaxation},
    {Effect::states, "all states",
     [](const Scene& s) {
         const bool all = s.drive.states == States::all && s.has(PathPart::zero_load);
         return Switch{all, fmt::format("drive.states = \"{}\"", all ? "all" : "first")};
     }},
    {Effect::observation, "energies and contact", observation},
    {Effect::maps, "maps", maps},
    {Effect::trajectory, "trajectory",
     [](const Scene& s) {
         const auto& every = s.output.trajectory;
         return every ? Switch{true, fmt::format("output.trajectory = {}", *every)}
                      : Switch{false, "output.trajectory = \"none\""};
     }},
    {Effect::checkpoints, "checkpoints",
     [](const Scene& s) {
         return Switch{
             s.output.checkpoint > 0.0,
             fmt::format("output.checkpoint = {:.4g} s of wall time", s.output.checkpoint)};
     }},
    {Effect::theory, "theory",
     [](const Scene& s) {
         if (s.surface.kind == SurfaceKind::atoms)
             return Switch{false, "surface.kind = \"atoms\": the theory is of one layer with "
                                  "heights"};
         return Switch{true, "always: one solution for each result"};
     }},
    {Effect::device, "device",
     [](const Scene& s) {
         const int asked = s.numerics.device;
         if (asked == no_device) return Switch{false, "numerics.device = \"none\""};
         if (asked == any_device) {
             const std::string any = "numerics.device = \"auto\"";
             if (cuda_device_count() == 0) return Switch{false, any + ": no CUDA device is here"};
             const auto problems = device_problems(s);
             if (!problems.empty()) return Switch{false, any + ": it " + problems.front().what};
             return Switch{true, any};
         }
         return Switch{true, asked == emulated_device_asked
                                 ? "numerics.device = \"emulated\""
                                 : fmt::format("numerics.device = {}", asked)};
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

Effects::Effects(const Scene& scene) {
    for (std::size_t i = 0; i < effect_count; ++i)
        switches_[i] = rules[i].decide(scene);
}

} // namespace asperity
