// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/case/resolving.hpp"

#include "kernels/device/device.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace asperity {

namespace {

Effect device_effect(const Case& c) {
    const DeviceChoice& asked = c.scene.numerics.device;
    if (!asked) return {false, "numerics.device = \"none\""};
    if (asked.kind == DeviceChoice::Kind::emulated) return {true, "numerics.device = \"emulated\""};
    if (asked.kind != DeviceChoice::Kind::automatic)
        return {true, fmt::format("numerics.device = {}", asked.index)};
    const std::string any = "numerics.device = \"auto\"";
    if (cuda_device_count() == 0) return {false, any + ": no CUDA device is here"};
    const auto problems = device_problems(c);
    if (!problems.empty()) return {false, any + ": it " + problems.front().what};
    return {true, any};
}

/// Returns the key that makes a path one of equilibria, with its value.
std::string key_of_equilibria(const Case& c) {
    return c.has(Segment::relax) ? "drive.path = [\"relax\"]" : "drive.mode = \"quasistatic\"";
}

/// Returns the effect of fields in place of numbers of the interface.
Effect site_maps_effect(const Scene::Interface& interface) {
    std::vector<std::string> keys, fields; // keys that may be fields, and those that are
    for (const io::SiteQuantity& of : io::site_quantities) {
        keys.push_back(fmt::format("interface.{}", of.name));
        if (const SiteMapKeys& map = interface.maps[of.map]; map.given())
            fields.push_back(fmt::format("{} = \"{}\"", keys.back(), map.source));
    }
    return {!fields.empty(), fields.empty()
                                 ? fmt::format("{} are no fields", fmt::join(keys, " and "))
                                 : fmt::format("{}", fmt::join(fields, ", "))};
}

Effect yielding_effect(const Scene::Interface& interface) {
    if (const SiteMapKeys& map = interface.maps[SiteMapOf::hardness]; map.given())
        return {interface.hardness.has_value(),
                fmt::format("interface.hardness = \"{}\"", map.source)};
    if (!interface.hardness) return {false, "interface.hardness = \"none\""};
    return {true, fmt::format("interface.hardness = {:.6g} GPa", *interface.hardness)};
}

/// Returns an effect of the block or of an elastic second solid: the block's, unless the second
/// solid alone has it.
Effect of_either(bool of_block, bool of_counter, std::string why_of_block,
                 std::string why_of_counter) {
    return {of_block || of_counter,
            of_block || !of_counter ? std::move(why_of_block) : std::move(why_of_counter)};
}

Effect layers_effect(const Scene& s) {
    const auto why = [](const char* key, const auto& list) {
        return list.empty() ? fmt::format("{} = []", key)
                            : fmt::format("{} has {} of them", key, list.size());
    };
    const Scene::Surface::Counter& counter = s.surface.counter;
    return of_either(!s.block.layers.empty(), counter.is_elastic() && !counter.layers.empty(),
                     why("block.layers", s.block.layers),
                     why("surface.counter_layers", counter.layers));
}

Effect surface_stress_effect(const Scene& s) {
    const auto why = [](const char* key, double value) {
        return fmt::format("{} = {:.4g} N/m", key, value);
    };
    const Scene::Surface::Counter& counter = s.surface.counter;
    return of_either(s.block.surface_stress > 0.0,
                     counter.is_elastic() && counter.surface_stress > 0.0,
                     why("block.surface_stress", s.block.surface_stress),
                     why("surface.counter_surface_stress", counter.surface_stress));
}

/// Sets the effects of the section [output].
void add_outputs(const Case& c, bool follows_path, Effects& e) {
    const Scene& s = c.scene;
    const MapTimes& m = c.maps;
    e.maps.on = m.relaxed || m.pull_off || m.segments || (follows_path && m.every) ||
                !m.after_approach.empty();
    e.maps.why =
        e.maps ? "output.fields asks for them" : "output.fields asks for no state of this path";
    e.trajectory = {s.output.trajectory.has_value(),
                    s.output.trajectory
                        ? fmt::format("output.trajectory = {}", *s.output.trajectory)
                        : "output.trajectory = \"none\""};
    e.checkpoints = {s.output.checkpoint > 0.0,
                     fmt::format("output.checkpoint = {:.4g} s of wall time", s.output.checkpoint)};
}

} // namespace

std::vector<std::pair<const char*, Effect>> Effects::list() const {
    // clang-format off
    return {{"dynamic", dynamic}, {"lateral displacements", lateral}, {"damping", damping},
            {"temperature", temperature}, {"finite strain", finite_strain},
            {"coarse levels", coarse_levels}, {"skipping of far sites", skipping},
            {"sliding", sliding}, {"long-range tail", tail},
            {"numbers of each site", site_maps}, {"curvature", curvature},
            {"second solid", counter}, {"free edges", free_edges}, {"viscoelastic block", branches}, {"layers", layers},
            {"surface stress", surface_stress}, {"yielding surface", yielding}, {"spring of the machine", spring},
            {"relaxation", relaxation},
            {"energies and contact", observation}, {"maps", maps}, {"trajectory", trajectory},
            {"checkpoints", checkpoints}, {"theory", theory}, {"device", device}};
    // clang-format on
}

bool Effects::has(std::string_view name) const {
    if (name.empty()) return true;
    for (const auto& [called, effect] : list())
        if (called == name) return effect;
    throw std::logic_error(fmt::format("no effect is called \"{}\"", name));
}

Effect dynamic_effect(const Case& c) {
    if (c.scene.is_dynamic()) return {true, "the path is dynamic"};
    return {false, "a state of force balance: " + key_of_equilibria(c)};
}

Effects effects_of(const Case& c) {
    const Scene& s = c.scene;
    const bool wall = s.interface.kind == InterfaceKind::wall, dynamic = c.effects.dynamic;
    const bool follows_path =
        std::any_of(c.path().begin(), c.path().end(),
                    [](const Segment& segment) { return segment.kind != Segment::relax; });
    const std::string equilibria = key_of_equilibria(c);
    const std::string no_time = "a state of force balance: " + equilibria;
    const auto timed = [&](bool on, std::string why) {
        return dynamic ? Effect{on, std::move(why)} : Effect{false, no_time};
    };
    const auto pairs = [&](bool on, std::string why, const char* of_wall) {
        return wall ? Effect{false, std::string("interface.kind = \"wall\"") + of_wall}
                    : Effect{on, std::move(why)};
    };
    Effects e;
    e.dynamic = c.effects.dynamic;
    e.lateral = pairs(
        !s.interface.frictionless,
        s.interface.frictionless ? "interface.frictionless = true" : "three components a node", "");
    const bool nowhere = s.drive.damping > 0.0 && s.drive.damping_from >= 1.0;
    e.damping = timed(s.drive.damping > 0.0 && !nowhere,
                      nowhere ? fmt::format("drive.damping_from = {:.4g}: no layer is damped",
                                            s.drive.damping_from)
                              : fmt::format("drive.damping = {:.4g} 1/ps", s.drive.damping));
    e.temperature = timed(s.drive.temperature > 0.0,
                          fmt::format("drive.temperature = {:.4g} K", s.drive.temperature));
    const bool finite = s.block.strain == Strain::finite;
    e.finite_strain = {finite, finite ? "block.strain = \"finite\"" : "block.strain = \"linear\""};
    const bool lattice = s.block_model() == BlockModel::lattice;
    e.coarse_levels = timed(!lattice && c.levels.size() > 1,
                            lattice ? "block.model = \"lattice\""
                            : c.levels.size() == 1
                                ? fmt::format("{} layers make one level", s.block.thickness)
                                : fmt::format("block.model = \"multiscale\", {} layers a level",
                                              s.block.layers_per_level));
    e.skipping =
        pairs(true, "always: what is beyond interface.cutoff adds exact zeros", ": one gap a site");
    e.sliding.on = c.has(Segment::slide);
    e.sliding.why = fmt::format("drive.path has {} \"slide\"", e.sliding ? "a" : "no");
    e.tail = pairs(s.interface.tail, fmt::format("interface.tail = {}", s.interface.tail),
                   ": a part of its law");
    e.site_maps = site_maps_effect(s.interface);
    e.curvature = {s.surface.radius.has_value(),
                   s.surface.radius ? fmt::format("surface.radius = {:.6g} Å", *s.surface.radius)
                                    : "surface.radius = \"none\""};
    e.free_edges = {s.has_free_edges() && !dynamic, s.has_free_edges()
                                                        ? "surface.boundary = \"free\""
                                                        : "surface.boundary = \"periodic\""};
    e.branches = {!s.block.prony.empty() && !dynamic && follows_path,
                  s.block.prony.empty()
                      ? "block.prony = []"
                      : fmt::format("block.prony has {} of them", s.block.prony.size())};
    const Scene::Surface::Counter& counter = s.surface.counter;
    e.counter = {counter.given(), fmt::format("surface.counter = \"{}\"", counter.file)};
    e.layers = layers_effect(s);
    e.surface_stress = surface_stress_effect(s);
    e.yielding = yielding_effect(s.interface);
    e.spring = {s.drive.stiffness.has_value() && follows_path,
                s.drive.stiffness ? fmt::format("drive.stiffness = {:.4g} N/m", *s.drive.stiffness)
                                  : "drive.stiffness = \"none\""};
    e.relaxation = {!dynamic || !finite,
                    !dynamic ? equilibria
                    : finite ? "block.strain = \"finite\": states are found wave by wave, and "
                               "waves do not add up"
                             : "a copy of the lowest layer is relaxed where the approach ends"};
    e.observation = {follows_path,
                     !follows_path ? no_time
                     : dynamic     ? fmt::format("every {} steps (output.series)", s.output.series)
                                   : "always: at every point of a quasi-static path"};
    add_outputs(c, follows_path, e);
    const NoTheory none = no_theory(s, e);
    e.theory = {none.why.empty(), none.why.empty() ? "always: Persson's theory of this scene"
                                                   : none.key + ": the theories are " + none.limit};
    e.device = device_effect(c);
    return e;
}

NoTheory no_theory(const Scene& scene, const Effects& effects) {
    const auto none = [](std::string key, std::string what, std::string limit, std::string fix) {
        std::string why = fmt::format("{} ({}), and the theories are {}", what, key, limit);
        return NoTheory{std::move(key), std::move(why), std::move(limit), std::move(fix)};
    };
    constexpr const char* one_modulus = "of a half-space of one modulus";
    if (scene.surface.kind == SurfaceKind::atoms)
        return none("surface.kind", "the substrate's atoms stand anywhere",
                    "of one layer with heights",
                    "take a surface with heights: self-affine, flat or file");
    if (effects.free_edges)
        return none("surface.boundary", "the substrate ends at the edges of the box",
                    "of endless surfaces", "take boundary = \"periodic\"");
    if (effects.yielding)
        return none("interface.hardness", "the surface yields", "of elastic surfaces",
                    "leave interface.hardness out");
    for (const io::SiteQuantity& of : scene.interface.site_maps())
        return none(fmt::format("interface.{}", of.name),
                    fmt::format("the {} differs from site to site", of.words),
                    fmt::format("of one {}", of.words),
                    fmt::format("give interface.{} a number, for example the mean", of.name));
    if (effects.counter && effects.branches && effects.sliding)
        return none("surface.counter", "the block may be rough itself, and slides",
                    "of a flat block that slides", "leave surface.counter out");
    const auto key_of = [](const Effect& effect) {
        return effect.why.substr(0, effect.why.find(' '));
    };
    if (effects.layers)
        return none(key_of(effects.layers), "a solid has layers", one_modulus,
                    fmt::format("leave {} out, with the modulus of the material that bends most",
                                key_of(effects.layers)));
    if (effects.surface_stress)
        return none(key_of(effects.surface_stress), "a surface has a tension", one_modulus,
                    fmt::format("leave {} out", key_of(effects.surface_stress)));
    return {};
}

} // namespace asperity
