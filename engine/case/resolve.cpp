// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/case/resolving.hpp"
#include "engine/case/site_map.hpp"
#include "engine/case/spacing_limits.hpp"
#include "engine/case/wall_shape.hpp"

#include "engine/options/branches_in_series.hpp"
#include "engine/scene/parse_path.hpp"
#include "engine/units.hpp"
#include "io/error.hpp"
#include "io/terminal.hpp"
#include "kernels/device/device.hpp"
#include "kernels/variant.hpp"
#include "theory/jkr.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace asperity {

namespace {

/// Returns the path of the file that a key names, with the data set of a map; empty, with a
/// problem, if there is none. required_by: text of the problem if the scene does not set the key.
std::string path_of_map(const Scene& scene, const std::string& key, const std::string& name,
                        bool atoms, const std::string& required_by, io::Problems& problems) {
    std::string file = name, dataset;
    if (const std::size_t colon = file.find(":/"); colon != std::string::npos && !atoms) {
        dataset = file.substr(colon);
        file.resize(colon);
    }
    if (const std::string found = find_beside_scene(scene, file, key); !found.empty())
        return found + dataset;
    const std::string looked = places_looked_at(scene, file, key);
    const bool named = scene.positions.is_set(key);
    problems.add(named ? key : "surface.kind",
                 named ? fmt::format("= \"{}\": there is no such file", name) : required_by,
                 "looked for " + looked,
                 fmt::format("give the path of a {}, relative to the scene or to the working "
                             "directory",
                             atoms ? "file of atoms" : "height map"));
    return {};
}

/// Returns the file of kind = "file" or "atoms".
std::string file_of(const Scene& scene, io::Problems& problems) {
    if (!scene.surface.reads_file()) return {};
    const bool atoms = scene.surface.kind == SurfaceKind::atoms;
    return path_of_map(scene, "surface.file", scene.surface.file, atoms,
                       fmt::format("= \"{}\" needs surface.file", atoms ? "atoms" : "file"),
                       problems);
}

/// Returns the file of the map of a second solid.
std::string counter_file_of(const Scene& scene, io::Problems& problems) {
    const Scene::Surface::Counter& counter = scene.surface.counter;
    if (!counter.given()) return {};
    return path_of_map(scene, "surface.counter", counter.file, false, {}, problems);
}

/// Parses output.fields, whose members the reader has accepted.
MapTimes maps_of(const Scene& scene, io::Problems& problems) {
    MapTimes maps;
    std::vector<std::string> kinds;
    for (const std::string& field : scene.output.fields) {
        constexpr std::string_view every = "every:";
        std::string kind = field;
        if (field == "relaxed") maps.relaxed = true;
        if (field == "pull-off") maps.pull_off = true;
        if (field == "segments") maps.segments = true;
        if (field.starts_with(after_approach))
            maps.after_approach.emplace_back(std::stod(field.substr(after_approach.size())), field);
        if (field.starts_with(every)) {
            kind = every;
            maps.every = std::stoll(field.substr(every.size()));
        }
        if (std::find(kinds.begin(), kinds.end(), kind) != kinds.end())
            problems.add("output.fields", fmt::format("has \"{}\" twice", kind),
                         "maps of one kind are written once", "leave one of them out");
        kinds.push_back(kind);
    }
    std::sort(maps.after_approach.begin(), maps.after_approach.end());
    return maps;
}

SurfaceOptions surface_options(const Scene& scene) {
    const Scene::Surface& s = scene.surface;
    SurfaceOptions options;
    options.kind = s.kind;
    options.sites = substrate_sites(s.sites, s.lattice_ratio);
    options.length = scene.edge();
    options.rms = s.kind == SurfaceKind::file && !scene.gives_rms() ? 0.0 : s.rms;
    options.hurst = s.hurst;
    options.rolloff = s.rolloff;
    options.cutoff = s.q_max.value_or(0.5 * options.sites);
    options.amplitudes = s.amplitudes;
    options.seed = static_cast<std::uint64_t>(s.seed);
    options.radius = s.radius.value_or(0.0);
    options.detrend = s.detrend != Detrend::none;
    options.periodic = s.detrend == Detrend::periodic;
    options.line_noise = s.line_noise;
    options.holes = s.kind == SurfaceKind::file && s.file_missing == MapMissing::hole;
    options.repeats = !scene.has_free_edges();
    options.counter = s.counter.given();
    return options;
}

BlockOptions block_of(const Scene& scene, bool dynamic) {
    BlockOptions block;
    block.sites = scene.surface.sites;
    block.spacing = scene.surface.spacing;
    block.young = scene.block.young * units::gigapascal;
    block.poisson = scene.block.poisson;
    block.atom_mass = scene.block.atom_mass * units::atomic_mass;
    block.thickness = scene.block.thickness;
    block.layers_per_level = scene.block.layers_per_level;
    block.multiscale = dynamic && scene.block_model() == BlockModel::multiscale;
    block.continuum = scene.block_model() == BlockModel::continuum;
    block.finite_strain = scene.block.strain == Strain::finite;
    for (const auto& [ratio, time] : scene.block.prony)
        block.branches.push_back({ratio, time * units::picosecond});
    const auto coat = [](Solid& solid, const auto& layers, double surface_stress) {
        for (const auto& [thickness, young, poisson] : layers)
            solid.layers.push_back({{young * units::gigapascal, poisson}, thickness});
        solid.surface_stress = surface_stress * units::newton_per_metre;
    };
    coat(block, scene.block.layers, scene.block.surface_stress);
    if (const Scene::Surface::Counter& counter = scene.surface.counter; counter.is_elastic()) {
        block.counter.emplace();
        block.counter->young = *counter.young * units::gigapascal;
        block.counter->poisson = counter.poisson;
        coat(*block.counter, counter.layers, counter.surface_stress);
        const double own = block.Solid::contact_modulus(), other = block.counter->contact_modulus();
        block.branches = branches_in_series(block.branches, own / (own + other));
    }
    block.top_spring = {scene.drive.stiffness.value_or(0.0) * units::newton_per_metre,
                        scene.drive.mass.value_or(0.0) * units::atomic_mass};
    block.free_edges = scene.has_free_edges() && !dynamic;
    return block;
}

/// Returns the reason why numerics.precision = "mixed" does not apply; empty if it does.
std::string why_in_double(const Case& c) {
    const Scene& scene = c.scene;
    if (scene.interface.kind == InterfaceKind::wall) return "over a wall";
    if (scene.surface.kind == SurfaceKind::atoms) return "over a substrate of atoms anywhere";
    if (scene.surface.lattice_ratio != 1.0) return "over a substrate of another spacing";
    if (scene.interface.potential_name() == Tabulated::name) return "with a tabulated potential";
    if (c.effects.device) return "on a device";
    return {};
}

/// Fills in the interface except its potentials.
void fill_interface(Case& c) {
    const Scene& scene = c.scene;
    const Scene::Interface& i = scene.interface;
    const double a = scene.surface.spacing, site = a * a;
    InterfaceOptions& options = c.simulation.interface;
    options.tail = i.tail;
    const std::string in_double = why_in_double(c);
    options.mixed = scene.numerics.precision == Precision::mixed && in_double.empty();
    if (scene.numerics.precision == Precision::mixed && !options.mixed)
        c.notes.push_back("numerics.precision has no effect: pairs are in double precision " +
                          in_double);
    options.mixed_on_request = !c.effects.dynamic;
    if (i.kind == InterfaceKind::atoms) return;
    if (i.law == WallLawKind::smeared) {
        std::visit(
            [&]<class P>(const P& p) {
                if constexpr (P::has_tail) options.wall = SmearedWall<P>(p, 1.0 / site, i.tail);
            },
            options.potential);
        return;
    }
    const double adhesion = i.adhesion / units::milli_per_unit;
    // E* q/2 of the shortest wave along an axis, q = pi / a, and the attraction's own curvature.
    const double shortest_wave = 0.5 * std::numbers::pi * c.simulation.block.stiffest_modulus() / a;
    const double curvature = adhesion / (i.range * i.range);
    const double stiffness = i.stiffness ? *i.stiffness * units::gigapascal
                                         : std::max(1000.0 * shortest_wave, 50.0 * curvature);
    if (options.shape) {
        const double range = options.shape->length() > 0.0 ? options.shape->length() : i.range;
        options.wall = ShapedWall(options.shape->shape(), adhesion * site, range, stiffness * site);
    } else {
        options.wall = ExponentialWall(adhesion * site, i.range, stiffness * site);
    }
    if (options.has_law_factors()) options.find_mean_law_factors();
}

/// Fills in flat on flat, and the bounds over flat layers of each type of atoms.
void fill_flat_reference(Case& c, io::Problems& problems) {
    const BlockOptions& block = c.simulation.block;
    const InterfaceOptions& interface = c.simulation.interface;
    if (c.scene.surface.kind == SurfaceKind::atoms)
        c.notes.push_back(fmt::format(
            "delta_gamma is that of one flat layer of the block's lattice{}, a unit of measure: "
            "the substrate has atoms of its own, and no theory applies to it",
            interface.by_type.empty() ? "" : " with interface.potential"));
    try {
        c.flat = flat_reference(interface, block.spacing, block.sites, c.substrate());
    } catch (const std::invalid_argument& e) {
        problems.add("interface.potential", std::string(": ") + e.what(),
                     "the lattices are too wide or too narrow for it, or it ends before it binds",
                     "take a potential that is zero at about surface.spacing (interface.r0), and a "
                     "cutoff of 1.5 times that at least; 4 r0 is usual");
    }
    const double area = block.spacing * block.spacing;
    c.scales.stiffness = c.flat.stiffness * area;
    c.largest_tension = c.flat.largest_tension;
    double smallest_tension = c.largest_tension;
    if (!interface.by_type.empty()) smallest_tension = HUGE_VAL;
    for (const PairPotential& pair : interface.by_type) {
        InterfaceOptions layer = interface;
        layer.potential = pair;
        try {
            const FlatReference flat =
                flat_reference(layer, block.spacing, block.sites, c.substrate());
            c.scales.stiffness = std::max(c.scales.stiffness, flat.stiffness * area);
            c.largest_tension = std::max(c.largest_tension, flat.largest_tension);
            smallest_tension = std::min(smallest_tension, flat.largest_tension);
        } catch (const std::invalid_argument&) { // a flat layer of this type does not bind
        }
    }
    find_scales(c, std::min(smallest_tension, c.largest_tension));
}

/// Notes a tolerance whose forces, in the block's longest wave, matter beside the work of adhesion.
void note_coarse_tolerance(Case& c) {
    if (c.effects.dynamic) return;
    constexpr double coarse = 0.01;
    const BlockOptions& block = c.simulation.block;
    const double force = c.tolerance, area = block.spacing * block.spacing;
    const double energy =
        units::milli_per_unit * 0.5 * force * force / (block.softest_wave() * area * area);
    const double fraction = energy / c.flat.work_of_adhesion;
    if (!(fraction > coarse) || !std::isfinite(fraction)) return;
    c.notes.push_back(fmt::format(
        "drive.tolerance = {:.2g}, {:.2g} MPa on a site, is coarse for this block: in its longest "
        "wave such forces stand for {:.2g} meV/Å², {:.2g} of the work of adhesion; take {:.1g} or "
        "less",
        c.scene.drive.tolerance, force / area / units::megapascal, energy, fraction,
        c.scene.drive.tolerance * std::sqrt(coarse / fraction)));
}

/// Limits steps: no step may jump over the potential, and no pull can exceed the strongest binding.
void limit_steps(Case& c, io::Problems& refused) {
    const Scene& scene = c.scene;
    c.simulation.drive.displacement_step = scene.drive.displacement_step;
    // The width of the potential: its depth over its largest force.
    const double tension = c.largest_tension * units::gigapascal;
    const double width = c.flat.work_of_adhesion / units::milli_per_unit / tension;
    if (tension > 0.0) {
        c.longest_step = 0.5 * width;
        c.simulation.drive.displacement_step =
            std::min(scene.drive.displacement_step, c.longest_step);
        if (!c.effects.dynamic && scene.drive.displacement_step > c.longest_step)
            c.notes.push_back(fmt::format(
                "drive.displacement_step = {:.6g} Å: steps are {:.3g} Å at most, half the width of "
                "the potential (its depth over its largest force)",
                scene.drive.displacement_step, c.longest_step));
        const double pull = -scene.drive.load * units::megapascal;
        if (pull > tension && scene.surface.kind != SurfaceKind::atoms)
            refused.add(
                "drive.load",
                fmt::format("= {:.6g} MPa is a larger pull than any attraction of this scene",
                            scene.drive.load),
                fmt::format("the largest tension of two flat surfaces is {:.4g} MPa",
                            tension / units::megapascal),
                "take a smaller pull");
    }
    if (c.effects.dynamic && tension > 0.0) {
        const double travel = scene.drive.velocity * units::metre_per_second * scene.drive.timestep;
        if (travel > 0.1 * width)
            refused.add(
                "drive.velocity",
                fmt::format("= {:.6g} m/s moves the block by {:.3g} Å in a time step",
                            scene.drive.velocity, travel),
                fmt::format("the potential is {:.3g} Å wide (its depth over its largest force), "
                            "and a step must not jump over it",
                            width),
                fmt::format("take {:.3g} m/s or less with this time step",
                            scene.drive.velocity * 0.1 * width / travel));
    }
}

/// Returns the device of a scene whose steps a device takes.
DeviceChoice device_of(const Scene& scene, io::Problems& refused) {
    const DeviceChoice& asked = scene.numerics.device;
    if (asked.kind == DeviceChoice::Kind::emulated) return asked;
    const int there = cuda_device_count();
    if (asked.index >= there)
        refused.add("numerics.device",
                    fmt::format("= {} asks for a CUDA device that is not there", asked.index),
                    !cuda_device() ? std::string("this program was built without CUDA")
                    : there == 0   ? std::string("no CUDA device was found on this machine")
                                   : fmt::format("this machine has {}, counted from 0", there),
                    "take \"auto\" (a device if there is one), \"none\" or \"emulated\", or a "
                    "machine that has the device");
    return {DeviceChoice::Kind::cuda, asked.index};
}

/// Fills in the drive of the block and its steps.
void fill_motion(Case& c, io::Problems& refused) {
    const Scene& scene = c.scene;
    const BlockOptions& block = c.simulation.block;
    DriveOptions& drive = c.simulation.drive;
    const double crossing = block.thickness * block.spacing / block.sound_speed();
    drive.velocity = scene.drive.velocity * units::metre_per_second;
    drive.ramp = scene.drive.ramp ? *scene.drive.ramp * units::picosecond : crossing;
    drive.area = c.area();
    drive.control = scene.drive.control;
    if (scene.drive.max_steps > 0) drive.max_steps = scene.drive.max_steps;
    drive.load_force = scene.drive.load * units::megapascal * drive.area;
    if (c.effects.temperature)
        drive.average_over = c.scales.length > 0.0
                                 ? std::min(crossing, 0.1 * c.scales.length / drive.velocity)
                                 : crossing;
    if (c.effects.temperature && c.effects.dynamic)
        c.notes.push_back(fmt::format(
            "the force of a warm block fluctuates: an approach or a load ends by its average over "
            "{:.3g} ps (segments[].pressure, with pressure_scatter)",
            drive.average_over / units::picosecond));
    c.simulation.interface.slides = c.effects.sliding;

    c.simulation.dt = scene.drive.timestep;
    if (c.effects.damping) {
        c.simulation.damping = scene.drive.damping * units::per_picosecond;
        c.simulation.damping_from = scene.drive.damping_from;
    }
    if (c.effects.temperature) c.simulation.temperature = scene.drive.temperature;
    c.simulation.seed = static_cast<std::uint64_t>(scene.drive.seed);

    const double highest = block.highest_frequency(c.scales.stiffness);
    double of_top = 0.0;
    if (const TopSpring& spring = block.top_spring; spring.mass > 0.0) {
        const double column = block.modulus_of_compression() * block.spacing;
        of_top = std::sqrt((spring.stiffness + column * c.sites()) / spring.mass);
    }
    c.longest_timestep = 2.0 / std::max(highest, of_top);
    const double period = std::numbers::pi * c.longest_timestep; // period of the fastest vibration
    if (c.effects.dynamic && scene.drive.timestep >= c.longest_timestep)
        refused.add(
            "drive.timestep",
            fmt::format("= {:.4g} fs is over the stability limit of {:.4g} fs",
                        scene.drive.timestep, c.longest_timestep),
            fmt::format("the {} has a period of {:.4g} fs, and velocity Verlet diverges for steps "
                        "longer than 1/pi of it",
                        of_top > highest
                            ? "vibration of a top plane of drive.mass on drive.stiffness"
                            : "block's fastest vibration (block.young, block.poisson, "
                              "block.atom_mass, the interface)",
                        period),
            fmt::format("take {:.2g} fs or less: a tenth of the period keeps the energy to a "
                        "fraction of a percent",
                        0.1 * period));
}

/// Gives slides under load the load at which the path was before: that of the last approach,
/// relaxed state or load. (check_path() refuses others.)
void set_loads_of_slides(Case& c) {
    const double megapascal = units::megapascal * c.scene.edge() * c.scene.edge();
    double load = 0.0;
    for (Segment& segment : c.simulation.drive.path) {
        if (segment.kind == Segment::approach || segment.kind == Segment::relax)
            load = c.scene.drive.load * megapascal;
        if (segment.kind == Segment::load) load = segment.amount;
        if (segment.under) segment.under = load;
    }
}

/// Checks that the ranks can share the box, and how evenly.
void look_at_ranks(Case& c, io::Problems& refused) {
    try {
        const ProcessGrid grid = c.grid(0);
        if (c.effects.relaxation) ProcessGrid::slabs(c.ranks, 0, c.scene.surface.sites);
        if (grid.imbalance() > 0.1)
            c.notes.push_back(
                fmt::format("{} ranks share {} sites unevenly: the largest tile has {:.0f} % "
                            "more than the mean",
                            c.ranks, c.scene.surface.sites, 100.0 * grid.imbalance()));
    } catch (const std::invalid_argument& e) {
        refused.add("surface.sites", std::string(": ") + e.what());
    }
}

/// Fills in the maps of the sites that the scene has, and their largest values in the scene.
void find_site_maps(Case& c, const Communicator& world, io::Problems& problems) {
    Scene::Interface& keys = c.scene.interface;
    InterfaceOptions& options = c.simulation.interface;
    for (const io::SiteQuantity& of : keys.site_maps()) {
        if (of.scales_law && !keys.has_adhesion()) continue;
        const auto map = site_map(c, of, world, problems);
        if (!map) continue;
        const bool no_zero =
            of.zero == io::SiteQuantity::refused ||
            (of.zero == io::SiteQuantity::taken_without_repulsion && keys.shape_repels());
        if (map->least == 0.0 && no_zero)
            problems.add(fmt::format("interface.{}", of.name),
                         fmt::format("= \"{}\" is 0 at some sites", map->source),
                         std::string(of.why_no_zero), std::string(of.instead_of_zero));
        set_largest(keys, of.map, map->largest);
        options.maps[of.map] = map;
    }
    if (keys.hardness) options.hardness = *keys.hardness * units::gigapascal;
}

/// Derives all consequences of keys that do not contradict each other.
void derive(Case& c, const Communicator& world, io::Problems& problems) {
    find_site_maps(c, world, problems);
    if (!problems.empty()) return;
    io::Problems refused = c.scene.problems();
    refuse_unsupported(c, refused);
    refuse_above_hardness(c, refused);
    c.edge_pinning = edge_pinning(c);
    refuse_pinned_edge(c, refused);
    for (std::string& note : notes_on_keys(c))
        c.notes.push_back(std::move(note));
    fill_interface(c);
    if (!check_tables(c, problems)) return;
    fill_flat_reference(c, problems);
    limit_steps(c, refused);
    note_coarse_tolerance(c);
    find_softness(c);
    if (c.effects.device) c.simulation.device = device_of(c.scene, refused);
    fill_motion(c, refused);
    refuse_out_of_proportion(c, refused, c.notes);
    for (std::string& note : notes_on_validity(c))
        c.notes.push_back(std::move(note));
    if (const auto note = note_on_soft_box(c)) c.notes.push_back(*note);
    look_at_ranks(c, refused);
    c.refused = refused.list();
}

} // namespace

double Case::load_in_megapascal() const {
    return simulation.drive.load_force / (units::megapascal * area());
}

/// Returns a length with a unit of its size: "332.8 Å", "26.62 µm", "1.6 mm".
static std::string length_in_words(double length) {
    constexpr double micrometre = 1e4, millimetre = 1e7; // Å
    if (length < 10.0 * micrometre) return fmt::format("{:.1f} Å", length);
    if (length < millimetre) return fmt::format("{:.4g} µm", length / micrometre);
    return fmt::format("{:.4g} mm", length / millimetre);
}

std::string Case::box_in_words() const {
    const int sites = simulation.block.sites;
    if (!in_newtons())
        return fmt::format("{0} x {0} sites, {1} wide", sites, length_in_words(edge()));
    return fmt::format("{0} x {0} sites, {1} nm wide{2}", sites, io::cell(0.1 * edge()),
                       effects.free_edges ? ", with free edges" : "");
}

std::string Case::block_in_words() const {
    const BlockOptions& block = simulation.block;
    if (effects.free_edges) return "a half-space";
    if (block.continuum)
        return fmt::format("a continuum, {} thick",
                           length_in_words(block.thickness * block.spacing));
    return fmt::format("{} layers ({})", block.thickness,
                       length_in_words(block.thickness * block.spacing));
}

bool Case::jumps_as_a_whole() const {
    return simulation.drive.control == Control::top && !effects.free_edges;
}

bool Case::box_jumps() const {
    const bool leads = has(Segment::approach) || has(Segment::pull_off);
    return softness > 1.0 && leads && !effects.free_edges && !radius();
}

std::optional<double> Case::flat_loss() const {
    if (!box_jumps() || simulation.drive.control == Control::top) return {};
    return flat.work_of_adhesion * loss_of_flat(softness);
}

double Case::smooth_pull_off() const {
    const double flat_on_flat = largest_tension * units::gigapascal * area();
    if (!radius()) return flat_on_flat;
    const double work = flat.work_of_adhesion / units::milli_per_unit;
    return std::min(flat_on_flat, theory::jkr::pull_off_force(work, *radius()));
}

ProcessGrid Case::grid(int rank) const {
    if (!effects.dynamic) return ProcessGrid::slabs(ranks, rank, simulation.block.grid());
    return ProcessGrid(ranks, rank, simulation.block.sites, static_cast<int>(levels.size()));
}

std::vector<std::pair<std::string, std::uint32_t>> Case::digests() const {
    std::vector<std::pair<std::string, std::uint32_t>> all;
    if (table_digest) all.emplace_back("interface.table", *table_digest);
    for (const auto& map : simulation.interface.site_maps())
        all.emplace_back("interface." + map->name, map->digest);
    return all;
}

std::vector<std::string> Case::inputs() const {
    std::vector<std::string> files = {scene.file, file.substr(0, file.find(":/"))};
    if (!counter_file.empty()) files.push_back(counter_file.substr(0, counter_file.find(":/")));
    files.insert(files.end(), table_files.begin(), table_files.end());
    if (!scene.fit.found.empty()) files.push_back(scene.fit.found);
    for (const auto& map : simulation.interface.site_maps())
        if (!map->file.empty()) files.push_back(map->file.substr(0, map->file.find(":/")));
    return files;
}

bool Case::has(Segment::Kind kind) const {
    return std::any_of(path().begin(), path().end(),
                       [&](const Segment& s) { return s.kind == kind; });
}

bool Case::is_cycle() const {
    return std::all_of(path().begin(), path().end(), [](const Segment& s) {
        return s.kind == Segment::approach || s.kind == Segment::pull_off ||
               s.kind == Segment::relax;
    });
}

void Case::require_runnable() const {
    if (!refused.empty()) throw io::SceneError(refused);
}

Case resolve(const Scene& scene, int ranks, io::Problems& problems, const Communicator& world) {
    if (const auto missing = missing_level())
        throw io::SceneError(io::Problem{
            "asperity", "is built for another processor",
            fmt::format("its kernels need x86-64-{}, which this processor lacks", name(*missing)),
            "build it on this machine, or for all with -DASPERITY_LEVELS=all"});
    Case c;
    c.scene = scene;
    c.ranks = ranks;
    io::Problems found = scene.problems();
    c.simulation.drive.path = parse_path(scene.drive.path, scene.edge() * scene.edge(), found);
    set_loads_of_slides(c);
    c.effects.dynamic = dynamic_effect(c);
    c.simulation.block = block_of(scene, c.effects.dynamic);
    c.surface = surface_options(scene);
    c.output = scene.output;
    c.theory = scene.theory;
    c.levels = level_shapes(c.simulation.block);
    c.file = file_of(scene, found);
    c.counter_file = counter_file_of(scene, found);
    c.maps = maps_of(scene, found);
    find_potentials(c, found);
    check_keys(c, found);
    c.effects = effects_of(c);
    if (problems.empty() && found.empty()) derive(c, world, found);
    for (const io::Problem& problem : found.list()) {
        const bool told =
            std::any_of(problems.list().begin(), problems.list().end(),
                        [&](const io::Problem& p) { return p.where == problem.where; });
        if (!told) problems.add(problem);
    }
    return c;
}

Case resolve(const Scene& scene, int ranks) {
    io::Problems problems;
    Case c = resolve(scene, ranks, problems);
    problems.throw_if_any();
    return c;
}

Case read_case_text(const std::string& text, const std::string& file,
                    const std::vector<std::string>& overrides, int ranks,
                    const Communicator& world) {
    io::Problems problems;
    const Scene scene = read_scene_text(text, file, overrides, problems);
    Case c = resolve(scene, ranks, problems, world);
    problems.throw_if_any();
    return c;
}

Case read_case(const std::string& file, const std::vector<std::string>& overrides, int ranks,
               const Communicator& world) {
    return read_case_text(io::read_scene_file(file), file == io::standard_input ? "stdin" : file,
                          overrides, ranks, world);
}

} // namespace asperity
