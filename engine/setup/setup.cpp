// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/setup/setup.hpp"

#include "engine/setup/memory.hpp"
#include "engine/units.hpp"
#include "io/atoms_file.hpp"
#include "io/digest.hpp"
#include "io/error.hpp"
#include "io/height_map.hpp"
#include "io/json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <numbers>
#include <span>
#include <stdexcept>

namespace asperity {

namespace {

std::string shown(const std::string& type) {
    return type.size() <= 20 ? type : type.substr(0, 20) + "...";
}

/// "2 types: Au (300 atoms), C (255)".
std::string types_of(const io::AtomsFile& file) {
    std::vector<std::size_t> count(file.types.size(), 0);
    for (const std::int32_t type : file.type)
        ++count[static_cast<std::size_t>(type)];
    std::string text = fmt::format("{} types: ", count.size());
    for (std::size_t t = 0; t < count.size(); ++t)
        text += fmt::format("{}{} ({}{})", t ? ", " : "", shown(file.types[t]), count[t],
                            t ? "" : " atoms");
    return text;
}

/// For each type of the file its row of interface.pairs.
std::vector<std::int32_t> rows_of(const Scene& scene, const io::AtomsFile& file) {
    io::Problems problems = scene.problems();
    const std::vector<TypedPair> pairs = typed_pairs(scene, problems);
    std::vector<std::int32_t> rows;
    for (const std::string& type : file.types) {
        const auto row = std::find_if(pairs.begin(), pairs.end(),
                                      [&](const TypedPair& p) { return p.type == type; });
        if (row == pairs.end())
            throw std::invalid_argument(
                pairs.empty()
                    ? fmt::format("the atoms in {} are of {}; give each type its potential, for "
                                  "example interface.pairs = [\"{} 0.1 3.28\", \"{} 0.05 3\"] with "
                                  "epsilon in eV and r0 in Å, or one type to all",
                                  scene.surface.file, types_of(file), shown(file.types[0]),
                                  shown(file.types[1]))
                    : fmt::format("interface.pairs has no type '{}', and the atoms in {} are of "
                                  "{}; give it a potential there",
                                  shown(type), scene.surface.file, types_of(file)));
        rows.push_back(static_cast<std::int32_t>(row - pairs.begin()));
    }
    return rows;
}

/// The atoms of the scene's file, whose periodic box must be the block's.
Surface atoms_of_file(const Scene& scene, const SurfaceOptions& options) {
    const auto& s = scene.surface;
    io::AtomsFile file = io::read_atoms_file(s.map);
    const double edge = options.length;
    // Files have six digits and more.
    const auto differs = [&](double width) { return std::abs(width - edge) > 1e-6 * edge; };
    if (differs(file.width_x) || differs(file.width_y)) {
        const double sites = std::round(file.width_x / s.spacing);
        const bool square = std::abs(file.width_x - file.width_y) <= 1e-6 * file.width_x;
        throw std::invalid_argument(fmt::format(
            "the periodic box of the atoms in {} is {:.8g} x {:.8g} Å, and the block's {:.8g} x "
            "{:.8g} Å ({} sites of {:.6g} Å); {}",
            s.file, file.width_x, file.width_y, edge, edge, s.sites, s.spacing,
            square && sites >= 4.0 && sites <= 32768.0
                ? fmt::format("take surface.sites = {0:.0f} and surface.spacing = {1:.10g}, or "
                              "repeat or cut the atoms",
                              sites, file.width_x / sites)
                : std::string("repeat or cut the atoms to the block's square box")));
    }
    const std::size_t count = file.x.size();
    std::vector<std::int32_t> type;
    if (file.types.size() > 1 || !scene.interface.pairs.empty()) {
        const std::vector<std::int32_t> rows = rows_of(scene, file);
        for (const std::int32_t t : file.type)
            type.push_back(rows[static_cast<std::size_t>(t)]);
    }
    io::Digest digest;
    for (const auto* values : {&file.x, &file.y, &file.z})
        digest.update(std::as_bytes(std::span(*values)));
    digest.update(std::as_bytes(std::span(std::as_const(type))));
    Surface surface = surface_from_atoms(
        options, {std::move(file.x), std::move(file.y), std::move(file.z), std::move(type)});
    surface.notes.insert(surface.notes.begin(),
                         fmt::format("{}: {} atoms{}, {}",
                                     std::filesystem::path(s.file).filename().string(), count,
                                     file.types.size() > 1   ? " of " + types_of(file)
                                     : file.types[0].empty() ? ""
                                                             : " of type " + shown(file.types[0]),
                                     file.format));
    surface.notes.insert(surface.notes.begin() + 1, file.notes.begin(), file.notes.end());
    surface.file_digest = digest.value();
    return surface;
}

/// The map of the scene's file, on every rank. The root alone reads it: in a process of its own,
/// where the HDF5 library may crash, and of many ranks' processes only one is wanted.
io::HeightMap map_of_file(const Scene& scene, const Communicator& ranks) {
    const auto& s = scene.surface;
    io::HeightMap map;
    std::string head;
    ranks.on_root([&] {
        map = io::read_height_map(s.map, {s.file_unit, s.file_missing == MapMissing::fill,
                                          s.file_crop == MapCrop::middle});
        if (ranks.size() == 1) return;
        io::Json json = {{"sites", map.sites}, {"unit", map.unit}, {"origin", map.origin}};
        json["notes"] = map.notes;
        if (map.size) json["size"] = *map.size;
        head = io::json_text(json);
    });
    if (ranks.size() == 1) return map;
    std::array<std::uint64_t, 2> sizes = {head.size(), map.heights.size()};
    ranks.broadcast(std::as_writable_bytes(std::span(sizes)));
    head.resize(sizes[0]);
    map.heights.resize(sizes[1]);
    ranks.broadcast(std::as_writable_bytes(std::span(head)));
    ranks.broadcast(std::span(map.heights));
    const io::Json json = io::parse_json(head, s.file);
    map.sites = json["sites"];
    map.unit = json["unit"];
    map.origin = json["origin"];
    map.notes = json["notes"].get<std::vector<std::string>>();
    if (json.contains("size")) map.size = json["size"].get<double>();
    return map;
}

} // namespace

Surface scene_surface(const Scene& scene, const Communicator& ranks) {
    require_memory_for_surface(scene);
    const auto& s = scene.surface;
    SurfaceOptions options;
    options.kind = s.kind;
    options.sites = substrate_sites(s.sites, s.lattice_ratio);
    options.length = scene.edge();
    options.rms = s.rms;
    options.hurst = s.hurst;
    options.rolloff = s.rolloff;
    options.cutoff = s.cutoff;
    options.amplitudes = s.amplitudes;
    options.seed = static_cast<std::uint64_t>(s.seed);
    options.radius = s.radius.value_or(0.0);
    try {
        if (s.kind == SurfaceKind::atoms) return atoms_of_file(scene, options);
        if (s.kind != SurfaceKind::file) return make_surface(options);
        io::HeightMap map = map_of_file(scene, ranks);
        options.map_edge = s.file_size.value_or(map.size.value_or(0.0));
        const int covered = sites_of_map(options);
        if (map.sites != covered && s.resample == Resample::none)
            throw std::invalid_argument(fmt::format(
                "the map in {} has {} x {} values, but covers {} x {} atoms of the substrate; give "
                "a map of that size, set surface.sites = {}, or let it be resampled with "
                "surface.resample = \"band-limited\"",
                s.file, map.sites, map.sites, covered, covered, map.sites));
        options.rms = s.rms_given ? s.rms : 0.0;
        options.detrend = s.detrend != Detrend::none;
        options.periodic = s.detrend == Detrend::periodic;
        const double edge = options.map_edge > 0.0 ? options.map_edge : options.length;
        if (options.map_edge <= 0.0)
            map.notes.push_back(fmt::format("the file does not say how wide the map is: taken as "
                                            "wide as the box, {:.6g} Å (surface.file_size)",
                                            edge));
        io::Digest digest;
        digest.update(std::as_bytes(std::span(std::as_const(map.heights))));
        const double width = map.size.value_or(0.0);
        digest.update(std::as_bytes(std::span(&width, 1)));
        Surface surface =
            surface_from_heights(options, std::move(map.heights), map.sites, map.sites);
        surface.origin = std::move(map.origin);
        surface.file_digest = digest.value();
        surface.notes.insert(
            surface.notes.begin(),
            fmt::format("{}: {} x {} points of {:.4g} Å, {:.6g} Å wide, heights in {}",
                        std::filesystem::path(s.file).filename().string(), map.sites, map.sites,
                        edge / map.sites, edge, map.unit));
        surface.notes.insert(surface.notes.begin() + 1, map.notes.begin(), map.notes.end());
        return surface;
    } catch (const std::invalid_argument& e) {
        io::Problems problems = scene.problems();
        problems.add(s.reads_file() ? "surface.file" : "surface.kind",
                     std::string(": ") + e.what());
        problems.throw_if_any();
        throw;
    }
}

namespace {

/// Of a scene whose steps a device takes.
DeviceChoice device_of(const Scene& scene, io::Problems& problems) {
    const int asked = scene.numerics.device, there = cuda_device_count();
    if (asked == emulated_device_asked) return {DeviceChoice::Kind::emulated, 0};
    const int index = asked == any_device ? 0 : asked;
    if (index >= there)
        problems.add("numerics.device",
                     fmt::format("= {} asks for a CUDA device that is not there", index),
                     !cuda_device() ? std::string("this program was built without CUDA")
                     : there == 0   ? std::string("no CUDA device was found on this machine")
                                    : fmt::format("this machine has {}, counted from 0", there),
                     "take \"auto\" (a device if there is one), \"none\" or \"emulated\", or a "
                     "machine that has the device");
    return {DeviceChoice::Kind::cuda, index};
}

} // namespace

InterfaceOptions interface_options(const Scene& scene) {
    const Scene::Interface& i = scene.interface;
    const double a = scene.surface.spacing, site = a * a;
    InterfaceOptions options;
    options.potential = {i.epsilon, i.r0, i.cutoff};
    if (!i.pairs.empty()) {
        io::Problems problems = scene.problems();
        for (const TypedPair& pair : typed_pairs(scene, problems))
            options.by_type.push_back(pair.potential);
    }
    options.tail = i.tail;
    options.mixed = scene.numerics.precision == Precision::mixed;
    options.single_too = scene.without_time() && !options.mixed;
    if (i.kind == InterfaceKind::atoms) return options;
    if (i.law == WallLawKind::lennard_jones) {
        options.wall = LennardJonesWall(options.potential, 1.0 / site, i.tail);
        return options;
    }
    const double adhesion = i.adhesion / units::milli_per_unit;
    // E* q/2 of the shortest wave along an axis, q = pi / a, and the attraction's own curvature.
    const double modulus =
        scene.block.young * units::gigapascal / (1.0 - scene.block.poisson * scene.block.poisson);
    const double shortest_wave = 0.5 * std::numbers::pi * modulus / a;
    const double curvature = adhesion / (i.range * i.range);
    const double stiffness = i.stiffness ? *i.stiffness * units::gigapascal
                                         : std::max(1000.0 * shortest_wave, 50.0 * curvature);
    options.wall = ExponentialWall(adhesion * site, i.range, stiffness * site);
    return options;
}

namespace {

/// Forces that the tolerance lets pass, in the block's longest wave, beside the work of adhesion.
void note_coarse_tolerance(const Scene& scene, Setup& setup) {
    constexpr double coarse = 0.01;
    const BlockOptions& block = setup.simulation.block;
    const double tolerance = scene.drive.tolerance, area = block.spacing * block.spacing;
    const double energy =
        units::milli_per_unit * 0.5 * tolerance * tolerance / (block.softest_wave() * area * area);
    const double share = energy / setup.flat.work_of_adhesion;
    if (!scene.without_time() || !(share > coarse) || !std::isfinite(share)) return;
    setup.notes.push_back(fmt::format(
        "drive.tolerance = {:.2g} eV/Å, {:.2g} MPa on a site, is coarse for this block: in its "
        "longest wave such forces stand for {:.2g} meV/Å², {:.2g} of the work of adhesion; take "
        "{:.1g} or less",
        tolerance, tolerance / area / units::megapascal, energy, share,
        tolerance * std::sqrt(coarse / share)));
}

/// No step may jump over the potential, and no pull can be larger than what binds most.
void limit_steps(const Scene& scene, Setup& setup, io::Problems& problems) {
    // The width of the potential: its depth over its largest force.
    const double tension = setup.largest_tension * units::gigapascal;
    const double width = setup.flat.work_of_adhesion / units::milli_per_unit / tension;
    if (tension > 0.0) {
        setup.longest_step = 0.5 * width;
        if (scene.without_time() && scene.drive.step > setup.longest_step)
            setup.notes.push_back(
                fmt::format("drive.step = {:.6g} Å: steps are {:.3g} Å at most, half the width of "
                            "the potential (its depth over its largest force)",
                            scene.drive.step, setup.longest_step));
        const double pull = -scene.drive.load * units::megapascal;
        if (pull > tension && scene.surface.kind != SurfaceKind::atoms)
            problems.add(
                "drive.load",
                fmt::format("= {:.6g} MPa pulls harder than anything binds", scene.drive.load),
                fmt::format("the largest tension of flat on flat is {:.4g} MPa",
                            tension / units::megapascal),
                "take a smaller pull");
    }
    if (setup.effects.on(Effect::inertia) && tension > 0.0) {
        const double travel = scene.drive.velocity * units::metre_per_second * scene.drive.timestep;
        if (travel > 0.1 * width)
            problems.add(
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

} // namespace

Setup make_setup(const Scene& scene, int ranks) {
    Setup setup;
    setup.effects = Effects(scene);
    const auto on = [&](Effect effect) { return setup.effects.on(effect); };
    io::Problems problems = scene.problems();
    setup.notes = notes(scene);

    BlockOptions& block = setup.simulation.block;
    block.sites = scene.surface.sites;
    block.spacing = scene.surface.spacing;
    block.young = scene.block.young * units::gigapascal;
    block.poisson = scene.block.poisson;
    block.atom_mass = scene.block.atom_mass * units::atomic_mass;
    block.thickness = scene.block.thickness;
    block.layers_per_level = scene.block.layers_per_level;
    block.multiscale = on(Effect::coarse_levels);
    block.finite_strain = on(Effect::finite_strain);
    setup.levels = level_shapes(block);

    InterfaceOptions& interface = setup.simulation.interface;
    interface = interface_options(scene);
    if (scene.surface.kind == SurfaceKind::atoms)
        setup.notes.push_back(fmt::format(
            "delta_gamma is that of one flat layer of the block's lattice{}, a unit of measure: "
            "the substrate has atoms of its own, and no theory applies to it",
            interface.by_type.empty() ? "" : " with interface.epsilon, r0 and cutoff"));
    const int substrate = substrate_sites(block.sites, scene.surface.lattice_ratio);
    try {
        setup.flat = flat_reference(interface, block.spacing, block.sites, substrate);
    } catch (const std::invalid_argument& e) {
        problems.add("interface.epsilon", std::string(": ") + e.what());
    }
    setup.site_stiffness = setup.flat.stiffness * block.spacing * block.spacing;
    setup.largest_tension = setup.flat.largest_tension;
    for (const LennardJones& pair : interface.by_type) {
        InterfaceOptions layer = interface;
        layer.potential = pair;
        try {
            const FlatReference flat = flat_reference(layer, block.spacing, block.sites, substrate);
            setup.site_stiffness =
                std::max(setup.site_stiffness, flat.stiffness * block.spacing * block.spacing);
            setup.largest_tension = std::max(setup.largest_tension, flat.largest_tension);
        } catch (const std::invalid_argument&) { // a flat layer of this type does not bind
        }
    }

    limit_steps(scene, setup, problems);
    note_coarse_tolerance(scene, setup);
    if (on(Effect::device)) setup.simulation.device = device_of(scene, problems);

    auto& drive = setup.simulation.drive;
    const double crossing = block.thickness * block.spacing / block.sound_speed();
    drive.velocity = scene.drive.velocity * units::metre_per_second;
    drive.ramp = scene.drive.ramp ? *scene.drive.ramp * units::picosecond : crossing;
    drive.load_force = scene.drive.load * units::megapascal * scene.edge() * scene.edge();
    drive.approach = scene.has(PathPart::approach);
    drive.pull_off = scene.has(PathPart::pull_off);

    setup.simulation.dt = scene.drive.timestep;
    if (on(Effect::damping)) {
        setup.simulation.damping = scene.drive.damping * units::per_picosecond;
        setup.simulation.damping_from = scene.drive.damping_from;
    }
    if (on(Effect::temperature)) setup.simulation.temperature = scene.drive.temperature;
    setup.simulation.seed = static_cast<std::uint64_t>(scene.drive.seed);

    setup.longest_timestep = 2.0 / block.highest_frequency(setup.site_stiffness);
    const double period = std::numbers::pi * setup.longest_timestep; // of the fastest vibration
    if (on(Effect::seams)) {
        // Every 0.7 of the limit of a step, or as often as there are steps. That
        // of a single step is stable where (omega dt/2)² + share/2 < 1, and a share is 1 at most.
        const double rare = std::floor(0.7 * setup.longest_timestep / scene.drive.timestep);
        block.absorption_span = std::max(1.0, rare) * scene.drive.timestep;
        setup.longest_timestep *= std::numbers::sqrt2 / 2.0;
    }
    if (on(Effect::inertia) && scene.drive.timestep >= setup.longest_timestep)
        problems.add(
            "drive.timestep",
            fmt::format("= {:.4g} fs is over the stability limit of {:.4g} fs",
                        scene.drive.timestep, setup.longest_timestep),
            fmt::format("the block's fastest vibration has a period of {:.4g} fs, and velocity "
                        "Verlet diverges for steps longer than 1/{} of it{}",
                        period, on(Effect::seams) ? "(√2 pi)" : "pi",
                        on(Effect::seams) ? " where seams absorb" : ""),
            fmt::format("take {:.2g} fs or less: a tenth of the period keeps the energy to a "
                        "fraction of a percent",
                        0.1 * period));
    try {
        const ProcessGrid grid = make_grid(scene, setup, ranks, 0);
        if (grid.imbalance() > 0.1)
            setup.notes.push_back(
                fmt::format("{} ranks share {} sites unevenly: the largest tile has {:.0f} % "
                            "more than the mean",
                            ranks, block.sites, 100.0 * grid.imbalance()));
    } catch (const std::invalid_argument& e) {
        problems.add("surface.sites", std::string(": ") + e.what());
    }
    problems.throw_if_any();
    return setup;
}

Setup examine(const Scene& scene, int ranks, const Communicator& world) {
    io::Problems problems = scene.problems();
    not_yet(scene, problems);
    Setup setup;
    try {
        setup = make_setup(scene, ranks);
    } catch (const io::SceneError& error) {
        for (const io::Problem& problem : error.problems())
            problems.add(problem);
    }
    if (scene.surface.reads_file()) {
        try {
            const Surface surface = scene_surface(scene, world);
            setup.notes.insert(setup.notes.end(), surface.notes.begin(), surface.notes.end());
        } catch (const io::SceneError& error) {
            for (const io::Problem& problem : error.problems())
                problems.add(problem);
        } catch (const RootFailure& error) { // whose reason the root has
            problems.add("surface.file", std::string(": ") + error.what());
        }
    }
    problems.throw_if_any();
    return setup;
}

ProcessGrid make_grid(const Scene& scene, const Setup& setup, int ranks, int rank) {
    if (scene.without_time()) return ProcessGrid::slabs(ranks, rank, scene.surface.sites);
    return ProcessGrid(ranks, rank, scene.surface.sites, static_cast<int>(setup.levels.size()));
}

} // namespace asperity
