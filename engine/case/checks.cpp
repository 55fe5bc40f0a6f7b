// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Checks over several keys: contradictions between them, combinations that are not available, and
// notes.
#include "engine/case/potential_table.hpp"
#include "engine/case/resolving.hpp"

#include "engine/case/contact_estimate.hpp"
#include "engine/case/spacing_limits.hpp"
#include "engine/options/sweep_limits.hpp"
#include "engine/units.hpp"
#include "kernels/variant.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string_view>

namespace asperity {

namespace {

/// Adds a problem of a segment: what is wrong with its place, why, and what to do instead.
using RefuseSegment =
    std::function<void(const std::string& why_not, const char* why, const std::string& instead)>;

/// Checks a slide. apart: the path is beyond the interaction range before the slide; loaded: the
/// path has been led to a load.
void check_slide(const Case& c, const Segment& segment, bool apart, bool loaded,
                 const RefuseSegment& refuse) {
    const bool wall = c.scene.interface.kind == InterfaceKind::wall;
    if (apart)
        refuse("beyond the interaction range", "nothing slides there",
               "put an \"approach\" before it");
    if (c.scene.interface.tail)
        refuse("with interface.tail = true", "the tail has no lateral forces",
               "take a larger interface.cutoff and tail = false");
    if (!wall && c.scene.interface.frictionless)
        refuse("without lateral forces", "with interface.frictionless nothing resists it",
               "take frictionless = false");
    if (c.scene.has_free_edges())
        refuse("over a map with free edges",
               "the map moves periodically, and its edges would move along",
               "take surface.boundary = \"periodic\"");
    if (c.scene.interface.hardness && wall)
        refuse("over a surface that yields",
               "the heights move under the block, and a set by sliding is another one",
               "leave interface.hardness out");
    if (c.scene.surface.counter.given() && c.scene.surface.radius)
        refuse("of a curved solid over another (surface.counter, surface.radius)",
               "the sum of two spheres moves with neither of them",
               "leave surface.radius or surface.counter out");
    if (c.scene.surface.counter.given() && segment.until_steady)
        refuse("over a second solid", "a rough block has no shape that slides on unchanged",
               "leave \"until steady\" out, and give the slide a length");
    if (c.scene.surface.counter.given() && c.output.stress.points != StressPoints::none &&
        c.output.stress.friction == 0.0)
        refuse("over a second solid with output.stress",
               "of two rough solids the pressure acts on slopes of both, and the friction "
               "at each place is not known",
               "give output.stress_friction, a friction in phase with the pressure");
    for (const io::SiteQuantity& of : c.scene.interface.site_maps())
        refuse(fmt::format("over a field of the {}", of.words),
               "the heights move under the block, and the field would stay",
               fmt::format("give interface.{} a number", of.name));
    if (wall && c.effects.dynamic)
        refuse("over a wall on a dynamic path",
               "a wall moves under a block that is in force balance",
               "take drive.mode = \"quasistatic\"");
    if (!wall && (segment.under || segment.until_steady))
        refuse("over atoms",
               "a slide over atoms is at the same height, and as long as the scene says",
               "leave \"under load\" and \"until steady\" out, or take "
               "interface.kind = \"wall\"");
    if (segment.under && !loaded)
        refuse("after a segment that leads to no load", "there is none to keep",
               "put a \"load\" before it");
    if (segment.under && !c.scene.block.prony.empty() && c.scene.drive.control == Control::top)
        refuse("with block.prony and drive.control = \"top\"",
               "a viscoelastic block under load would creep as a whole",
               "take drive.control = \"mean-height\"");
}

/// Checks that the segments of the path can follow one another.
void check_path(const Case& c, io::Problems& problems) {
    if (c.scene.drive.path.empty())
        problems.add("drive.path", "is empty", "there would be nothing to do",
                     "for example path = [\"approach\", \"pull-off\"]");
    bool apart = true;   // beyond the interaction range
    bool loaded = false; // a load was led to, and no height since
    for (std::size_t i = 0; i < c.path().size(); ++i) {
        const Segment& segment = c.path()[i];
        const RefuseSegment refuse = [&](const std::string& why_not, const char* why,
                                         const std::string& instead) {
            problems.add("drive.path", fmt::format("has \"{}\" {}", segment.text, why_not), why,
                         instead);
        };
        const bool after_all = apart;
        apart = segment.kind == Segment::pull_off;
        switch (segment.kind) {
        case Segment::approach:
            if (!after_all)
                refuse("from a state that is in contact already",
                       "an approach starts beyond the interaction range",
                       "put a \"pull-off\" before it, or lead it further with \"load\" or "
                       "\"height\"");
            loaded = true;
            break;
        case Segment::pull_off:
            if (after_all)
                refuse("with nothing to pull off",
                       "it starts where an \"approach\" or \"relax\" ends",
                       "for example path = [\"approach\", \"pull-off\"]");
            loaded = false;
            break;
        case Segment::relax:
            if (i > 0)
                refuse("after something else",
                       "it goes straight to the relaxed state and needs nothing before it",
                       "take it out, or take path = [\"relax\"]: after an approach the state "
                       "under zero load is found anyway");
            loaded = true;
            break;
        case Segment::load:
            loaded = true;
            break;
        case Segment::height:
            loaded = false;
            break;
        case Segment::slide:
            check_slide(c, segment, after_all, loaded, refuse);
            break;
        case Segment::hold:
            if (!c.effects.dynamic && c.scene.block.prony.empty())
                refuse(
                    "on a quasi-static path", "equilibria do not change while they are held",
                    "take it out, or give the block viscoelastic branches (block.prony), or take "
                    "drive.mode = \"dynamic\"");
            else if (after_all)
                refuse("beyond the interaction range", "nothing happens there",
                       "put an \"approach\" before it");
            break;
        }
    }
}

/// Checks that the layers of a solid are not too thin for the lattice, nor too thick for the block.
void check_thickness(const Scene& scene, const char* key,
                     const std::vector<std::array<double, 3>>& layers, io::Problems& problems) {
    const bool continuum = scene.block_model() == BlockModel::continuum;
    double sum = 0.0; // in cells
    for (std::size_t i = 0; i < layers.size(); ++i) {
        const double thickness = layers[i][0], spacing = scene.surface.spacing;
        if (thickness < 0.5 * spacing && !continuum) {
            problems.add(
                key, fmt::format("has a layer {} of {:.4g} Å", i + 1, thickness),
                fmt::format("a lattice layer is {:.4g} Å thick (surface.spacing)", spacing),
                "take a thicker layer or a smaller surface.spacing");
            return;
        }
        sum += continuum ? thickness / spacing : std::round(thickness / spacing);
    }
    if (!layers.empty() && sum >= scene.block.thickness && !scene.has_free_edges())
        problems.add(
            key,
            fmt::format("are {:.6g} lattice layers thick, {:.4g} Å", sum,
                        sum * scene.surface.spacing),
            fmt::format("a solid has {} (block.thickness), and its own material is beyond its "
                        "layers",
                        scene.block.thickness),
            fmt::format("take block.thickness = {:.0f} or more, or thinner layers",
                        sum + std::max(1.0, 0.5 * scene.surface.sites)));
}

/// Checks that the stiffnesses of a viscoelastic block and of an elastic second solid have one
/// ratio for all waves, so that both relax as one solid with branches of its own
/// (branches_in_series()).
void check_series(const Case& c, io::Problems& problems) {
    const BlockOptions& block = c.simulation.block;
    if (block.branches.empty() || !block.counter) return;
    constexpr const char* why =
        "two solids relax as one only if their stiffnesses have the same ratio for all waves";
    if (block.is_coated())
        problems.add("block.prony",
                     "against an elastic surface.counter, with layers or a surface stress", why,
                     "leave the layers and surface stresses of both solids out, or leave prony "
                     "out");
    const bool half_spaces = block.free_edges && block.continuum;
    if (!half_spaces && block.poisson != block.counter->poisson)
        problems.add(
            "block.prony",
            fmt::format("against a surface.counter of another Poisson's ratio, {:.6g} instead of "
                        "{:.6g}",
                        block.counter->poisson, block.poisson),
            fmt::format("{}, and solids as thick as block.thickness have it if their Poisson's "
                        "ratios are equal",
                        why),
            fmt::format("take surface.counter_poisson = {:.6g} and surface.counter_young = {:.6g}, "
                        "which has the same E*, or leave counter_young and counter_poisson out, or "
                        "leave prony out",
                        block.poisson,
                        block.young * block.counter->contact_modulus() /
                            block.Solid::contact_modulus() / units::gigapascal));
}

/// Checks the layers and the surface stress of the block.
void check_layers(const Case& c, io::Problems& problems) {
    const Scene& scene = c.scene;
    const auto& block = scene.block;
    if (block.surface_stress > 0.0 && !block.prony.empty())
        problems.add("block.surface_stress",
                     fmt::format("= {:.6g} N/m with block.prony", block.surface_stress),
                     "branches relax the whole stiffness of a wave, and the tension of a surface "
                     "does not relax",
                     "leave surface_stress or prony out");
    check_series(c, problems);
    check_thickness(scene, "block.layers", block.layers, problems);
    if (scene.surface.counter.is_elastic())
        check_thickness(scene, "surface.counter_layers", scene.surface.counter.layers, problems);
}

/// Checks what a surface that yields cannot have.
void check_hardness(const Case& c, io::Problems& problems) {
    const auto refuse = [&](const std::string& with, const char* why, const char* fix) {
        problems.add("interface.hardness", with, why, fix);
    };
    if (!c.scene.block.prony.empty())
        refuse("with block.prony", "the set of a surface on a viscoelastic block is not computed",
               "leave hardness or block.prony out");
    if (c.has(Segment::relax))
        refuse("with \"relax\" in drive.path",
               "the set depends on the path of the load, and a relaxation has none",
               "take drive.mode = \"quasistatic\" and path = [\"approach\"], which finds the "
               "state at zero load as well");
}

/// Checks what a substrate of atoms anywhere cannot have.
void check_atoms(const Scene& scene, io::Problems& problems) {
    const Scene::Interface& interface = scene.interface;
    if (interface.kind == InterfaceKind::wall)
        problems.add("interface.kind", "= \"wall\" with surface.kind = \"atoms\"",
                     "a wall stands in place of atoms",
                     "take interface.kind = \"atoms\", or surface.kind = \"file\" with a map");
    if (interface.cutoff && *interface.cutoff > largest_cell_cutoff)
        problems.add("interface.cutoff",
                     fmt::format("= {:.6g} with surface.kind = \"atoms\"", *interface.cutoff),
                     "the cells of atoms hold for cutoffs up to 100 Å",
                     "take a cutoff of 100 Å or less");
}

/// Adds notes on the branches of a viscoelastic block: their file, and those that the path cannot
/// excite.
void note_branches(const Case& c, std::vector<std::string>& list) {
    const Scene& scene = c.scene;
    if (scene.fit.rms_error)
        list.push_back(fmt::format(
            "block.prony: \"{}\" is a fit of {}, with an rms error of {:.2g} "
            "% of the moduli",
            scene.fit.file, scene.fit.source.empty() ? "a master curve" : scene.fit.source,
            100.0 * *scene.fit.rms_error));
    if (scene.fit.young > 0.0 && scene.fit.young != scene.block.young)
        list.push_back(fmt::format("block.young = {:.6g} GPa holds over the {:.6g} GPa of \"{}\"",
                                   scene.block.young, scene.fit.young, scene.fit.file));
    if (!c.effects.branches) return;
    // A way of some hundred steps, slides and holds; as slow as the path can look closer.
    const double an_angstrom = 100.0 / scene.drive.velocity; // ps: Å over m/s
    const double a_step = scene.drive.displacement_step * an_angstrom;
    double path = 200.0 * a_step;
    for (const Segment& segment : c.path()) {
        if (segment.kind == Segment::hold) path += segment.amount / units::picosecond;
        if (segment.kind == Segment::slide) path += std::abs(segment.amount) * an_angstrom;
    }
    std::vector<double> springs, relaxed;
    for (const auto& [ratio, time] : scene.block.prony) {
        if (time > 1000.0 * path) springs.push_back(time);
        if (time < 0x1p-16 * a_step) relaxed.push_back(time);
    }
    const auto times = [](const std::vector<double>& some) {
        if (some.size() == 1) return fmt::format("{:.4g} ps", some[0]);
        return fmt::format("{} times from {:.4g} to {:.4g} ps", some.size(), some.front(),
                           some.back());
    };
    const auto say = [&](const std::vector<double>& some, const std::string& where,
                         const char* stay, const char* stays) {
        if (some.empty()) return;
        const bool one = some.size() == 1;
        list.push_back(fmt::format("block.prony: {} {} {}: {}", times(some), one ? "is" : "are",
                                   where, one ? stays : stay));
    };
    say(springs, fmt::format("far beyond the path, which takes some {:.1g} ps", path),
        "these branches stay springs", "this branch stays a spring");
    say(relaxed, fmt::format("below the shortest step of the path, {:.1g} ps", 0x1p-16 * a_step),
        "these branches are always relaxed", "this branch is always relaxed");
}

/// Refuses cutoffs that reach around the box, over too many atoms, or to no attraction.
void check_cutoff(const Case& c, io::Problems& problems) {
    const Scene& scene = c.scene;
    const Scene::Surface& surface = scene.surface;
    const Scene::Interface& interface = scene.interface;
    const bool wall = interface.kind == InterfaceKind::wall;
    const bool pairs = !wall || interface.law == WallLawKind::smeared;
    const PairPotential& potential = c.simulation.interface.potential;
    const double half = scene.edge() / 2.0;
    const double cutoff = interface.cutoff.value_or(cutoff_of(potential));
    const double minimum = minimum_of(potential);
    if (cutoff > half && !wall) {
        // If the cutoff is the default, the box is the choice of the scene.
        const bool is_set = scene.positions.is_set("interface.cutoff");
        const double sites = std::ceil(2.0 * cutoff / surface.spacing);
        problems.add(io::Problem{
            scene.positions.where(is_set ? "interface.cutoff" : "surface.sites"),
            fmt::format("interface.cutoff = {:.6g} Å{} is more than half the box", cutoff,
                        is_set ? "" : " (4 r0, of interface.r0)"),
            fmt::format(
                "the box is {} x {:.6g} Å (surface.spacing) = {:.6g} Å wide, and an atom must not "
                "meet the same neighbour twice",
                surface.sites, surface.spacing, scene.edge()),
            (half > minimum ? fmt::format("take a cutoff of {:.6g} Å at most", half)
                            : std::string("take a larger surface.spacing")) +
                (sites <= most_sites ? fmt::format(", or surface.sites = {:.0f} at least", sites)
                                     : std::string())});
    } else if (!wall && surface.kind != SurfaceKind::atoms) {
        const double between_atoms =
            scene.edge() / substrate_sites(surface.sites, surface.lattice_ratio);
        const double most = largest_cutoff(surface.spacing, between_atoms);
        if (cutoff > most)
            problems.add(
                "interface.cutoff", fmt::format("= {:.6g} Å reaches over too many atoms", cutoff),
                fmt::format("with sites {:.6g} Å and atoms of the substrate {:.6g} Å apart it may "
                            "be {:.6g} Å",
                            surface.spacing, between_atoms, most),
                4.0 * zero_of(potential) <= most
                    ? fmt::format("take {:.6g} Å (4 r0) and interface.tail = true, or a smaller "
                                  "surface.lattice_ratio",
                                  4.0 * zero_of(potential))
                    : "take a larger surface.spacing, or a smaller surface.lattice_ratio");
    }
    if (cutoff <= minimum && pairs)
        problems.add(
            "interface.cutoff", fmt::format("= {:.6g} Å leaves no attraction", cutoff),
            fmt::format("the minimum of the potential is at {:.6g} Å", minimum),
            fmt::format("take interface.cutoff = {:.6g} Å (4 r0)", 4.0 * zero_of(potential)));
}

/// Refuses spectra and caps that the box cannot hold.
void check_shape(const Case& c, io::Problems& problems) {
    const Scene& scene = c.scene;
    const Scene::Surface& surface = scene.surface;
    if (surface.kind == SurfaceKind::self_affine && surface.q_max &&
        surface.rolloff > *surface.q_max)
        problems.add("surface.rolloff",
                     fmt::format("= {:.6g} is above surface.q_max = {:.6g}", surface.rolloff,
                                 *surface.q_max),
                     "the spectrum falls between the two", "give rolloff <= q_max");
    if (surface.kind == SurfaceKind::self_affine && surface.rms > 0.0 &&
        surface.rolloff > surface.sites / 2.0)
        problems.add("surface.rolloff", fmt::format("= {:.6g} is beyond Nyquist", surface.rolloff),
                     fmt::format("a grid of {} sites holds nothing above q = {} q_L", surface.sites,
                                 surface.sites / 2),
                     "give a smaller rolloff or more sites (surface.sites)");
    if (surface.radius && !scene.has_free_edges() &&
        *surface.radius < scene.edge() * std::numbers::sqrt2 / 2.0)
        problems.add(
            "surface.radius",
            fmt::format("= {:.6g} Å is less than half the diagonal of the box", *surface.radius),
            fmt::format("the cap would not reach the corners, {:.6g} Å from the centre",
                        scene.edge() * std::numbers::sqrt2 / 2.0),
            "give a larger radius or fewer sites");
}

/// Refuses walls and frictionless contacts on paths that have none.
void check_interface(const Case& c, io::Problems& problems) {
    const Scene::Interface& interface = c.scene.interface;
    const bool wall = interface.kind == InterfaceKind::wall;
    if (wall && c.effects.dynamic)
        problems.add("interface.kind", "= \"wall\" on a dynamic path",
                     "a wall takes no lateral tractions, and dynamic paths cannot leave out "
                     "lateral displacements",
                     "take drive.mode = \"quasistatic\" or drive.path = [\"relax\"], or kind = "
                     "\"atoms\"");
    else if (wall && !interface.frictionless)
        problems.add("interface.frictionless", "= false with a wall",
                     "a law of the gap has no lateral forces", "leave it out");
    if (interface.has_adhesion() && interface.shape_repels() && interface.adhesion == 0.0)
        problems.add("interface.adhesion", "= 0 meV/Å^2 with a law that repels by itself",
                     "the work of adhesion multiplies its repulsion too, and nothing would repel",
                     "take an adhesion above zero, or law = \"exponential\"");
    if (interface.frictionless && !wall && c.effects.dynamic)
        problems.add("interface.frictionless", "= true on a dynamic path",
                     "lateral displacements can be left out only where the block's stiffness for "
                     "normal forces alone is known wave by wave",
                     "take drive.mode = \"quasistatic\" or drive.path = [\"relax\"], or "
                     "frictionless = false");
}

/// Refuses holes without a wall, and a map that is scaled to nothing.
void check_map(const Case& c, io::Problems& problems) {
    const Scene& scene = c.scene;
    const Scene::Surface& surface = scene.surface;
    const bool wall = scene.interface.kind == InterfaceKind::wall;
    if (surface.kind == SurfaceKind::file && surface.file_missing == MapMissing::hole && !wall)
        problems.add("surface.file_missing", "= \"hole\" without a wall",
                     "of a layer of atoms no place is empty", "take interface.kind = \"wall\"");
    if (surface.kind == SurfaceKind::file && scene.gives_rms() && surface.rms == 0.0)
        problems.add("surface.rms", "= 0 Å with a map", "a map scaled to nothing is a flat surface",
                     "take kind = \"flat\" and no file, or leave rms out to take the map as it is");
}

/// Refuses relaxation times that do not grow.
void check_branches(const Case& c, io::Problems& problems) {
    const auto& prony = c.scene.block.prony;
    for (std::size_t i = 1; i < prony.size(); ++i)
        if (prony[i][1] <= prony[i - 1][1])
            problems.add("block.prony",
                         fmt::format("has {:.6g} ps after {:.6g} ps", prony[i][1], prony[i - 1][1]),
                         "the relaxation times are to grow from branch to branch",
                         "write the branches in the order of their times, each time once");
}

/// Refuses a temperature without damping.
void check_thermostat(const Case& c, io::Problems& problems) {
    const Scene::Drive& drive = c.scene.drive;
    if (drive.temperature > 0.0 && drive.damping_from >= 1.0)
        problems.add("drive.damping_from",
                     fmt::format("= {:.6g} with a temperature", drive.damping_from),
                     "the thermostat acts where the damping does, and that is nowhere",
                     "give a fraction below 1");
    if (drive.temperature > 0.0 && drive.damping == 0.0)
        problems.add("drive.temperature",
                     fmt::format("= {:.6g} K with drive.damping = 0", drive.temperature),
                     "the Langevin thermostat gives and takes heat through the damping",
                     "give a damping, for example 0.05 1/ps");
}

/// Refuses maps of states that the path does not have.
void check_fields(const Case& c, io::Problems& problems) {
    if (!c.maps.after_approach.empty() && (!c.effects.dynamic || !c.has(Segment::pull_off)))
        problems.add("output.fields", "asks for \"" + c.maps.after_approach.front().second + "\"",
                     "no dynamic pull-off follows an approach",
                     "take a dynamic path with a pull-off, or take it out of output.fields");
    if (c.maps.segments && c.path().size() == 1 && c.starts_with(Segment::relax))
        problems.add("output.fields", "asks for \"segments\"",
                     "drive.path is one relaxation, whose state is \"relaxed\"",
                     "take \"relaxed\" in its place");
    if (c.maps.pull_off && !c.has(Segment::pull_off))
        problems.add("output.fields", "asks for \"pull-off\"", "drive.path has no pull-off",
                     "add it to drive.path or take it out of output.fields");
}

} // namespace

void check_keys(const Case& c, io::Problems& problems) {
    const Scene& scene = c.scene;
    check_cutoff(c, problems);
    check_shape(c, problems);
    refuse_unmet_needs(scene, problems);
    if (scene.surface.kind == SurfaceKind::atoms) check_atoms(scene, problems);
    check_interface(c, problems);
    check_path(c, problems);
    check_map(c, problems);
    check_branches(c, problems);
    check_layers(c, problems);
    if (scene.interface.hardness) check_hardness(c, problems);
    check_thermostat(c, problems);
    if (scene.numerics.device && scene.numerics.device.kind != DeviceChoice::Kind::automatic)
        for (const io::Problem& p : device_problems(c))
            problems.add(p.where, p.what, p.why, p.fix);
    check_fields(c, problems);
}

std::vector<io::Problem> device_problems(const Case& c) {
    std::vector<io::Problem> list;
    const auto refuse = [&](std::string with, std::string why, std::string instead) {
        list.push_back({"numerics.device", "is not available with " + std::move(with),
                        std::move(why), std::move(instead)});
    };
    if (!c.effects.dynamic)
        refuse("a quasi-static path",
               "a device takes time steps; equilibria are relaxed by the "
               "processor",
               "take numerics.device = \"none\", or drive.mode = \"dynamic\" with an approach");
    if (c.scene.surface.kind == SurfaceKind::atoms)
        refuse("surface.kind = \"atoms\"",
               "the device sums over a map of heights, and has no lists of cells of atoms anywhere",
               "take numerics.device = \"none\"");
    else if (c.scene.surface.lattice_ratio != 1.0)
        refuse(fmt::format("surface.lattice_ratio = {:.6g}", c.scene.surface.lattice_ratio),
               "the device sums over a substrate of the block's own lattice only",
               "take numerics.device = \"none\", or surface.lattice_ratio = 1");
    if (c.scene.block.strain == Strain::finite)
        refuse("block.strain = \"finite\"",
               "the device has the elastic forces of small strain only",
               "take numerics.device = \"none\", or block.strain = \"linear\"");
    if (c.has(Segment::slide))
        refuse("a slide in drive.path",
               "a device keeps its copy of the substrate where it is, and a slide moves it",
               "take numerics.device = \"none\"");
    if (!fuses(processor_level()))
        refuse(fmt::format("kernels of level {}", name(processor_level())),
               "a device fuses multiplications with additions, and these kernels do not: the same "
               "scene would have other bits",
               "take a processor with AVX2 and FMA (and no ASPERITY_KERNELS), or numerics.device = "
               "\"none\"");
    return list;
}

void refuse_above_hardness(const Case& c, io::Problems& refused) {
    if (!c.effects.yielding) return;
    const double hardness = c.simulation.interface.mean_hardness();
    const auto check = [&](const char* key, const std::string& load, double force) {
        if (force < hardness * c.area()) return;
        refused.add(key, load,
                    fmt::format("a mean pressure of {:.6g} MPa is not below the {}hardness of "
                                "{:.6g} MPa (interface.hardness): the whole surface would yield, "
                                "and nothing would bear the load",
                                force / c.area() / units::megapascal,
                                c.simulation.interface.maps[SiteMapOf::hardness] ? "mean " : "",
                                hardness / units::megapascal),
                    "take a smaller load or a larger hardness");
    };
    if (c.has(Segment::approach))
        check("drive.load", fmt::format("= {:.6g} MPa", c.scene.drive.load),
              c.scene.drive.load * units::megapascal * c.area());
    for (const Segment& segment : c.path())
        if (segment.kind == Segment::load)
            check("drive.path", fmt::format("has \"{}\"", segment.text), segment.amount);
}

void refuse_unsupported(const Case& c, io::Problems& refused) {
    const Scene& scene = c.scene;
    const auto refuse = [&](const std::string& key, const std::string& value, std::string instead) {
        refused.add(key, "= " + value + " is not available yet",
                    "it is part of the scene format, and this release does not compute it",
                    std::move(instead));
    };
    if (scene.drive.mode == DriveMode::dynamic && c.path().size() > 1 &&
        c.starts_with(Segment::relax))
        refuse("drive.path", "a dynamic path from \"relax\"",
               "use path = [\"approach\", \"pull-off\"], or drive.mode = \"quasistatic\"");
}

std::vector<std::string> notes_on_keys(const Case& c) {
    const Scene& scene = c.scene;
    std::vector<std::string> list;
    const auto& surface = scene.surface;
    if (c.effects.dynamic && scene.block_model() == BlockModel::multiscale) {
        int sites = surface.sites, halvings = 0;
        while (sites % 2 == 0)
            sites /= 2, ++halvings;
        double reach = 0.0; // layers above that halving, at layers_per_level each
        for (int level = 0; level <= halvings; ++level)
            reach += std::ldexp(scene.block.layers_per_level, level);
        if (2.0 * reach < scene.block.thickness)
            list.push_back(
                fmt::format("{} sites can be halved {} times only, so the coarsest level is "
                            "much thicker than layers_per_level; a power of two costs least",
                            surface.sites, halvings));
    }
    if (scene.block.thickness < surface.sites && !scene.has_free_edges())
        list.push_back(
            fmt::format("the block is thinner ({} layers) than wide ({} sites): the longest waves "
                        "feel the rigid top plane",
                        scene.block.thickness, surface.sites));
    if (c.has(Segment::relax) && scene.drive.load != 0.0)
        list.push_back(fmt::format(
            "the relaxed state carries drive.load = {}; its binding energy leaves out the load's "
            "potential",
            c.in_newtons() ? fmt::format("{:.6g} nN", scene.drive.load * units::megapascal *
                                                          c.area() / units::nanonewton)
                           : fmt::format("{:.6g} MPa", scene.drive.load)));
    double load = std::abs(scene.drive.load); // MPa
    for (const Segment& segment : c.path())
        if (segment.kind == Segment::load)
            load = std::max(load, std::abs(segment.amount) / (units::megapascal * c.area()));
    const BlockOptions& block = c.simulation.block; // the layers of a column have one pressure
    const double strain = load * units::megapascal /
                          (block.free_edges ? modulus_under_load(block) : block.softest_column());
    if (strain > 0.05 && scene.block.strain == Strain::linear)
        list.push_back(fmt::format(
            "a load of {:.4g} MPa strains the {} by {:.2g} %, and block.strain = \"linear\" "
            "describes small strains",
            load, block.layers.empty() || block.free_edges ? "block" : "softest layer of the block",
            100.0 * strain));
    if (surface.counter.given() && !surface.counter.is_elastic())
        list.push_back("the second solid is rigid (surface.counter_young)");
    for (const MaterialLayer& layer : c.simulation.block.layers) {
        if (c.simulation.block.continuum) break;
        const std::ptrdiff_t number = &layer - c.simulation.block.layers.data() + 1;
        const double cells = std::round(layer.thickness / surface.spacing);
        const double made = cells * surface.spacing;
        if (std::abs(made - layer.thickness) > 0.01 * layer.thickness)
            list.push_back(fmt::format("block.layers: layer {} of {:.4g} Å has {} lattice layers, "
                                       "{:.4g} Å",
                                       number, layer.thickness, cells, made));
    }
    if (const auto note = note_on_contact_edge(c)) list.push_back(*note);
    for (std::size_t i = 0; i < c.simulation.interface.tables.size();
         ++i) // no pair of atoms binds with more
        if (const double depth = c.simulation.interface.tables[i]->depth(); depth > 10.0)
            list.push_back(fmt::format("the well of {} is {:.4g} eV deep: its energies are read in "
                                       "eV, and may be meV",
                                       c.table_files[i], depth));
    note_branches(c, list);
    for (std::string& note : notes_on_idle_keys(scene))
        list.push_back(std::move(note));
    return list;
}

} // namespace asperity
