// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Values out of proportion with the box, the block or the step of a scene, as a wrong unit makes
// them: a run with them would not end, or its numbers would mean nothing.
#include "engine/case/resolving.hpp"

#include "engine/case/contact_estimate.hpp"
#include "engine/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace asperity {

namespace {

constexpr double most_steps = 1e9, most_points = 1e6;
constexpr const char* unit_fix = "correct the number or its unit";

/// A part of the time or the way of a path, the key that decides it, and what to do.
struct Part {
    double amount;
    std::string key, what, fix;
};

/// Returns the least way of the drive that only stretches the spring of the top plane, Å.
double way_of_spring(const Case& c) {
    const TopSpring& spring = c.simulation.block.top_spring;
    if (!spring) return 0.0;
    constexpr double part = 0.1; // share of the pull-off force of smooth surfaces
    double way = 0.0, force = 0.0;
    for (const Segment& segment : c.path()) {
        double to = force;
        if (segment.kind == Segment::approach) to = c.simulation.drive.load_force;
        if (segment.kind == Segment::load) to = segment.amount;
        if (segment.kind == Segment::pull_off) to = -part * c.smooth_pull_off();
        way += std::abs(to - force) / spring.stiffness;
        force = segment.kind == Segment::pull_off ? 0.0 : to;
    }
    return way;
}

/// Returns the least way of the top plane that the path asks for, at right angles and along, Å.
double least_way(const Case& c) {
    double way = 0.0, at = 0.0;
    for (const Segment& segment : c.path()) {
        if (segment.kind == Segment::slide) way += std::abs(segment.amount);
        if (segment.kind == Segment::height)
            way += std::abs(segment.amount - at), at = segment.amount;
        if (segment.kind == Segment::approach || segment.kind == Segment::pull_off)
            way += c.scales.length;
    }
    if (c.scene.surface.kind == SurfaceKind::self_affine) way += 3.0 * c.scene.surface.rms;
    return way;
}

void refuse_heights(const Case& c, io::Problems& refused) {
    const auto& surface = c.scene.surface;
    const double edge = c.scene.edge();
    const bool given = surface.kind == SurfaceKind::self_affine || c.scene.gives_rms();
    if (given && surface.kind != SurfaceKind::flat && surface.rms > edge)
        refused.add(
            "surface.rms", fmt::format("= {:.6g} Å is higher than the box is wide", surface.rms),
            fmt::format("the box is {:.6g} Å wide, and a surface as high as that is none", edge),
            fmt::format("{}: the rms height of a rough surface is below a tenth of its "
                        "width, here {:.3g} Å",
                        unit_fix, 0.1 * edge));
    const auto& interface = c.scene.interface;
    if (interface.has_adhesion() && interface.law != WallLawKind::table &&
        interface.adhesion > 0.0 && interface.range > edge)
        refused.add("interface.range",
                    fmt::format("= {:.6g} Å is wider than the box", interface.range),
                    fmt::format("the box is {:.6g} Å wide, and an attraction that reaches beyond "
                                "it acts on the block as a whole",
                                edge),
                    fmt::format("{}, or take a wider box (surface.sites)", unit_fix));
}

/// Returns the problem with a spring so soft that its stretch makes a path without an end.
std::string soft_spring(const Case& c) {
    return fmt::format("= {:.6g} N/m makes a path that cannot end: the drive moves {:.2g} Å to "
                       "stretch so soft a spring",
                       c.scene.drive.stiffness.value_or(0.0), way_of_spring(c));
}

/// Refuses a dynamic path of more steps than a run can make.
void refuse_long_times(const Case& c, io::Problems& refused) {
    const Scene& scene = c.scene;
    const double dt = c.simulation.dt, velocity = c.simulation.drive.velocity;
    double hold = 0.0;
    for (const Segment& segment : c.path())
        if (segment.kind == Segment::hold) hold += segment.amount;
    const double turns = static_cast<double>(c.path().size()) - 1.0,
                 ramps = c.simulation.drive.ramp * turns;
    const double way = least_way(c) / velocity, stretch = way_of_spring(c) / velocity;
    const Part parts[] = {
        {stretch, "drive.stiffness", soft_spring(c),
         fmt::format("take {:.2g} N/m or more",
                     2e3 * scene.drive.stiffness.value_or(0.0) * stretch / (most_steps * dt))},
        {way, "drive.velocity",
         fmt::format("= {:.6g} m/s makes a path that cannot end", scene.drive.velocity),
         fmt::format("take {:.2g} m/s or more, or drive.mode = \"quasistatic\"",
                     2e3 * scene.drive.velocity * way / (most_steps * dt))},
        {ramps, scene.drive.ramp ? "drive.ramp" : "block.young",
         scene.drive.ramp
             ? fmt::format("= {:.6g} ps makes a path that cannot end", *scene.drive.ramp)
             : fmt::format("= {:.6g} GPa: sound takes {:.3g} ps through so soft or thick a block, "
                           "and the drive changes its velocity over that time",
                           scene.block.young, c.simulation.drive.ramp / units::picosecond),
         scene.drive.ramp ? "leave it out: the default is one transit of sound"
                          : "correct block.young or block.thickness, or give drive.ramp"},
        {hold, "drive.path", "has a \"hold\" that cannot end", "give a shorter time"}};
    const Part& largest =
        *std::max_element(std::begin(parts), std::end(parts),
                          [](const Part& a, const Part& b) { return a.amount < b.amount; });
    const double steps = (way + stretch + ramps + hold) / dt;
    if (!(steps > most_steps) || scene.drive.max_steps > 0) return;
    const std::string why = fmt::format("the path takes {:.2g} steps of {:.3g} fs at least, and "
                                        "{:.0e} are the most",
                                        steps, dt, most_steps);
    const std::string some = "; drive.max_steps makes a part of it";
    if (dt < 1e-3 * c.longest_timestep)
        refused.add("drive.timestep", fmt::format("= {:.6g} fs makes a path that cannot end", dt),
                    why,
                    fmt::format("take {:.2g} fs, a tenth of the fastest vibration's period{}",
                                0.1 * 3.14159 * c.longest_timestep, some));
    else
        refused.add(largest.key, largest.what, why, largest.fix + some);
}

/// Refuses a quasi-static path of more points than a run can make.
void refuse_short_steps(const Case& c, io::Problems& refused) {
    const Scene& scene = c.scene;
    if (c.path().size() == 1 && c.starts_with(Segment::relax)) return;
    const double asked = scene.drive.displacement_step, stretch = way_of_spring(c),
                 way = least_way(c) + stretch;
    const double step = std::min(asked, c.longest_step);
    if (!(way / step > most_points) || scene.drive.max_steps > 0) return;
    const std::string why = fmt::format(
        "the path takes {:.2g} points at least, and {:.0e} are the most", way / step, most_points);
    if (stretch > 0.5 * way)
        refused.add("drive.stiffness", soft_spring(c), why,
                    fmt::format("take {:.2g} N/m or more; drive.max_steps makes a part of it",
                                *scene.drive.stiffness * stretch / step / (0.01 * most_points)));
    else if (asked <= c.longest_step)
        refused.add("drive.displacement_step",
                    fmt::format("= {:.6g} Å makes a path that cannot end", asked), why,
                    fmt::format("take {:.2g} Å; drive.max_steps makes a part of it",
                                std::max(asked * way / step / (0.01 * most_points),
                                         std::min(0.25, c.longest_step))));
    else
        refused.add("drive.path",
                    fmt::format("takes steps of {:.2g} Å over a way of {:.3g} Å", step, way),
                    why + ": a step is half the width of the attraction at most",
                    "take a longer range of the attraction, or a shorter way");
}

/// Refuses damping, heat and loads that a time step or the block cannot follow.
void refuse_violence(const Case& c, io::Problems& refused) {
    const Scene& scene = c.scene;
    const double dt = c.simulation.dt;
    if (c.effects.damping && c.effects.dynamic && c.simulation.damping * dt > 1.0)
        refused.add(
            "drive.damping",
            fmt::format("= {:.6g} 1/ps stops the atoms within a time step", scene.drive.damping),
            fmt::format("the momentum decays in {:.3g} fs, and a step is {:.3g} fs",
                        1.0 / c.simulation.damping, dt),
            fmt::format("take {:.2g} 1/ps or less", 0.1 * units::picosecond / dt));
    if (c.effects.temperature && c.largest_tension > 0.0) {
        constexpr double boltzmann = 8.617333e-5; // eV/K
        const double width = c.scales.length;
        const double travel =
            dt * std::sqrt(boltzmann * scene.drive.temperature / c.simulation.block.atom_mass);
        if (travel > 0.3 * width)
            refused.add("drive.temperature",
                        fmt::format("= {:.6g} K moves an atom by {:.3g} Å in a time step",
                                    scene.drive.temperature, travel),
                        fmt::format("the potential is {:.3g} Å wide", width),
                        fmt::format("take {:.2g} K or less with this time step",
                                    scene.drive.temperature * std::pow(0.1 * width / travel, 2)));
    }
    const auto look = [&](const char* key, double load, const std::string& shown) {
        if (const auto problem = load_out_of_proportion(c, load))
            refused.add(key, fmt::format("{} {}", shown, problem->what), problem->why,
                        problem->fix);
    };
    look("drive.load", scene.drive.load, fmt::format("= {:.6g} MPa", scene.drive.load));
    for (const Segment& segment : c.path())
        if (segment.kind == Segment::load)
            look("drive.path", segment.amount / (units::megapascal * c.area()),
                 fmt::format("has \"{}\", which", segment.text));
    if (!c.effects.dynamic && scene.drive.tolerance >= 1.0)
        refused.add("drive.tolerance",
                    fmt::format("= {:.6g} takes every state for balanced", scene.drive.tolerance),
                    "it is a fraction of the smallest force that decides the state",
                    "take 2.5e-4, the default");
}

constexpr double most_beyond = 0.05; ///< part of a sphere's attraction that a box may leave out

/// Returns a number of sites whose box is at least this wide, as text. width: Å.
std::string sites_for(const Case& c, double width) {
    return fmt::format("{:.0f}", 2.0 * std::ceil(0.5 * width / c.simulation.block.spacing));
}

/// Refuses a load under which a sphere's contact would be wider than a substrate that ends at the
/// edges of the box, or than the sphere.
void refuse_wide_contact(const Case& c, const std::optional<BeyondEdges>& beyond,
                         io::Problems& refused) {
    if (c.surface.repeats || !c.radius()) return;
    constexpr double widest = 0.8; // radius of a contact over that of the sphere
    const SphereOnBlock sphere = sphere_of(c);
    const double of_sphere = widest * *c.radius();
    const double most = sphere.load(std::min(0.5 * c.edge(), of_sphere));
    const double fits = 0.9 * most; // a load that does
    const bool smaller =
        most > 0.0 && attraction_beyond(c, sphere.contact_radius(fits), c.edge()) < most_beyond;
    const std::string less =
        smaller ? fmt::format(", or a load of {:.3g} nN at most", fits / units::nanonewton)
                : std::string();
    const auto look = [&](const char* key, double load, const std::string& shown) {
        if (!(load > most)) return;
        const double radius = sphere.contact_radius(load);
        const std::string wide = fmt::format("by JKR it would be {:.4g} nm wide", 0.2 * radius);
        if (radius > of_sphere) {
            const double held = 0.9 * sphere.load(of_sphere);
            const std::string smaller_load =
                held > 0.0 ? fmt::format("surface.sites = {} and a load of {:.3g} nN at most, ",
                                         sites_for(c, 2.0 * *c.radius()), held / units::nanonewton)
                           : std::string();
            return refused.add(
                key, fmt::format("{} needs a contact wider than the sphere allows", shown),
                fmt::format("{}, and the sphere is {:.4g} nm", wide, 0.2 * *c.radius()),
                fmt::format("take {}a larger surface.radius or a stiffer block", smaller_load));
        }
        const double wanted = std::max(2.5 * radius, beyond ? beyond->width : 0.0);
        refused.add(key, fmt::format("{} needs a contact wider than the box", shown),
                    fmt::format("{}, and the substrate is {:.4g} nm", wide, 0.1 * c.edge()),
                    fmt::format("take surface.sites = {}{}", sites_for(c, wanted), less));
    };
    if (c.has(Segment::approach) || c.has(Segment::relax))
        look("drive.load", c.simulation.drive.load_force,
             fmt::format("= {:.4g} nN", c.simulation.drive.load_force / units::nanonewton));
    for (const Segment& segment : c.path())
        if (segment.kind == Segment::load)
            look("drive.path", segment.amount, fmt::format("has \"{}\", which", segment.text));
}

/// Refuses a box with free edges that leaves out a part of the sphere's attraction that matters,
/// and notes one that leaves out less.
void look_beyond_edges(const Case& c, const BeyondEdges& beyond, io::Problems& refused,
                       std::vector<std::string>& notes) {
    constexpr double noted = 0.005;
    if (!(beyond.part > noted)) return;
    const std::string why =
        fmt::format("the substrate ends at the free edges, {:.3g} nm from the axis, and the "
                    "attraction of a sphere of {:.4g} nm beyond them is about {:.2g} % of its "
                    "pull-off force",
                    0.05 * c.edge(), 0.1 * *c.radius(), 100.0 * beyond.part);
    const std::string fix = fmt::format("take surface.sites = {}, or a larger surface.spacing",
                                        sites_for(c, beyond.width));
    if (beyond.part > most_beyond)
        refused.add(
            "surface.sites",
            fmt::format("= {} makes a box too narrow for the attraction", c.scene.surface.sites),
            why, fix);
    else
        notes.push_back(why + "; " + fix);
}

/// Refuses a block and an interface of which one is nothing beside the other: forces of a site
/// vanish in the rounding of its position, or the attraction is stronger than any solid holds.
void refuse_unlike_solids(const Case& c, io::Problems& refused) {
    const Scene& scene = c.scene;
    const auto& interface = scene.interface;
    const BlockOptions& block = c.simulation.block;
    const bool wall = interface.kind == InterfaceKind::wall;
    const std::string attraction = !interface.has_adhesion() ? "interface.epsilon or interface.r0"
                                                             : "interface.adhesion or "
                                                               "interface.range";
    double softest = HUGE_VAL;
    for (const Material& material : block.materials())
        softest = std::min(softest, material.contact_modulus());
    constexpr double strongest = 1e6; // times the modulus
    const double tension = c.largest_tension * units::gigapascal;
    if (tension > strongest * softest)
        refused.add(
            "block.young",
            fmt::format("= {:.6g} GPa: the attraction is {:.2g} times as strong", scene.block.young,
                        tension / softest),
            fmt::format("it pulls with up to {:.3g} GPa, and the softest material has an E* "
                        "of {:.3g} GPa (block.young, block.poisson, block.layers)",
                        c.largest_tension, softest / units::gigapascal),
            fmt::format("{}, or those of {}", unit_fix, attraction));
    const double height = 4.5 * scene.surface.rms + block.spacing;
    // The minimiser of walls finds the mean height on its own, so that its stiffness is no matter.
    const bool of_mean = !wall || (scene.drive.control == Control::top && !scene.only_relaxes());
    const double of_block = block.shortest_wave(),
                 of_top = of_mean ? block.modulus_of_compression() * block.spacing * block.spacing /
                                        (block.thickness * block.spacing)
                                  : 0.0;
    const double stiffest = std::max({of_block, of_top, c.scales.stiffness});
    const double lost = 4.0 * std::numeric_limits<double>::epsilon() * stiffest * height;
    constexpr double part = 0.01; // share of the force that decides the state
    if (!(lost > part * c.scales.force) || c.effects.dynamic) return;
    const bool of_wall = c.scales.stiffness == stiffest;
    const bool stressed = 4.0 * block.surface_stress > 0.5 * of_block;
    refused.add(
        of_wall && wall ? "interface.stiffness"
        : of_wall       ? "interface.epsilon"
        : stressed      ? "block.surface_stress"
                        : "block.poisson",
        "leaves nothing of the forces that decide the state",
        fmt::format("a site is held with {:.2g} eV/Å², so that the rounding of its position "
                    "is a force of {:.1g} eV/Å, and {:.1g} eV/Å decide the state",
                    stiffest, lost, c.scales.force),
        fmt::format("{}: {} decide both", unit_fix,
                    of_wall ? "interface.stiffness (auto: block.young, block.poisson, "
                              "block.layers), " +
                                  attraction
                            : "block.young, block.poisson, block.layers, "
                              "block.surface_stress, " +
                                  attraction));
}

} // namespace

std::optional<io::Problem> load_out_of_proportion(const Case& c, double megapascal) {
    const double modulus = modulus_under_load(c.simulation.block) / units::megapascal;
    if (!(std::abs(megapascal) > modulus)) return {};
    return io::Problem{"", "strains the block by more than its thickness",
                       fmt::format("its modulus under this load is {:.4g} MPa", modulus),
                       fmt::format("{}: take a load below {:.2g} MPa", unit_fix, 0.05 * modulus)};
}

std::optional<io::Problem> way_out_of_proportion(const Case& c, double way) {
    const double step = c.simulation.drive.displacement_step;
    if (!(std::abs(way) / step > most_points)) return {};
    return io::Problem{
        "", fmt::format("is {:.3g} Å from here", std::abs(way)),
        fmt::format("steps of {:.3g} Å (drive.displacement_step) would be {:.2g} points, and "
                    "{:.0e} are the most",
                    step, std::abs(way) / step, most_points),
        fmt::format("{}, or go there in parts", unit_fix)};
}

void refuse_out_of_proportion(const Case& c, io::Problems& refused,
                              std::vector<std::string>& notes) {
    const std::size_t before = refused.list().size();
    refuse_heights(c, refused);
    refuse_unlike_solids(c, refused);
    if (refused.list().size() > before) return; // further problems would have the same cause
    if (c.effects.dynamic)
        refuse_long_times(c, refused);
    else
        refuse_short_steps(c, refused);
    refuse_violence(c, refused);
    const std::optional<BeyondEdges> beyond = beyond_edges(c);
    const std::size_t so_far = refused.list().size();
    refuse_wide_contact(c, beyond, refused);
    if (beyond && refused.list().size() == so_far) look_beyond_edges(c, *beyond, refused, notes);
}

} // namespace asperity
