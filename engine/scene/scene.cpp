// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/scene/scene.hpp"

#include "engine/scene/accuracy.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <string_view>

#include <fmt/format.h>

namespace asperity {

using io::above;
using io::any;
using io::at_least;
using io::between;
using io::positive;

io::Schema bind(Scene& scene) {
    io::Schema schema;

    auto& surface = scene.surface;
    schema.section("surface", "The rigid, rough substrate.");
    schema.choice<SurfaceKind>("kind", surface.kind,
                               {{"flat", SurfaceKind::flat},
                                {"self-affine", SurfaceKind::self_affine},
                                {"file", SurfaceKind::file}},
                               "what the substrate is");
    schema.integer("sites", surface.sites, between(4, 32768),
                   "N; the periodic box is N spacings wide");
    schema.number("spacing", surface.spacing, "Å", positive(),
                  "lattice constant a of the block (and of the substrate at lattice_ratio 1)");
    schema.number(
        "lattice_ratio", surface.lattice_ratio, "", between(0.1, 10.0),
        "block spacing over substrate spacing; 1.618 is incommensurate (rounded to whole atoms)");
    schema
        .number("rms", surface.rms, "Å", at_least(0.0),
                "rms height; a map from a file is scaled to it only if the scene gives it")
        .omitted = [&surface] { return surface.kind == SurfaceKind::file && !surface.rms_given; };
    schema.number("hurst", surface.hurst, "", between(0.0, 1.0), "Hurst exponent H");
    schema.number("rolloff", surface.rolloff, "", at_least(1.0),
                  "q0 / q_L: C(q) is constant below");
    schema.number("cutoff", surface.cutoff, "", at_least(1.0),
                  "q1 / q_L: C(q) is zero above; clipped at Nyquist, sites/2");
    schema.choice<Amplitudes>("amplitudes", surface.amplitudes,
                              {{"gaussian", Amplitudes::gaussian}, {"fixed", Amplitudes::fixed}},
                              "random amplitudes and phases, or random phases alone");
    schema.integer("seed", surface.seed, at_least(0), "of the surface: same seed, same bits");
    schema.number_or("radius", surface.radius, "none", "Å", positive(), "of a spherical cap");
    schema.text(
        "file", surface.file,
        "for kind = \"file\": HDF5 (file.h5 or file.h5:/path) or a text matrix, looked for beside "
        "the scene, then in the working directory");
    schema.number_or("file_size", surface.file_size, "auto", "Å", positive(),
                     "edge of the map; \"auto\": what the file says, else the box");
    schema.text("file_unit", surface.file_unit,
                "of the map's heights; \"auto\": what the file says, else Å");
    schema.choice<Detrend>(
        "detrend", surface.detrend,
        {{"none", Detrend::none}, {"plane", Detrend::plane}, {"periodic", Detrend::periodic}},
        "what is taken off a map from a file: nothing, the mean plane, or that "
        "and the jumps between opposite edges");
    schema.choice<Resample>("resample", surface.resample,
                            {{"none", Resample::none}, {"band-limited", Resample::band_limited}},
                            "how a map that has not N x N values is brought onto the lattice");

    auto& block = scene.block;
    schema.section("block", "The elastic block.");
    schema.choice<BlockModel>("model", block.model,
                              {{"lattice", BlockModel::lattice},
                               {"multiscale", BlockModel::multiscale},
                               {"spectral", BlockModel::spectral}},
                              "every atom, or coarser with depth, or the static surface response");
    schema.number("young", block.young, "GPa", positive(), "Young's modulus E");
    schema.number("poisson", block.poisson, "", io::Range{-1.0, 0.5, true, true},
                  "Poisson's ratio");
    schema.number("atom_mass", block.atom_mass, "u", positive(), "mass of an atom");
    schema.integer("thickness", block.thickness, between(1, 1 << 20),
                   "in lattice layers; N where the scene does not say");
    schema.integer("layers_per_level", block.layers_per_level, between(2, 1024),
                   "thickness of each level of the multiscale block, in its own cells");
    schema.choice<Strain>("strain", block.strain,
                          {{"linear", Strain::linear}, {"finite", Strain::finite}},
                          "small strain, or geometrically exact springs");

    auto& interface = scene.interface;
    schema.section("interface", "Lennard-Jones between substrate and lowest layer.");
    schema.number("epsilon", interface.epsilon, "eV", positive(), "depth of the well");
    schema.number("r0", interface.r0, "Å", positive(), "distance of zero energy");
    schema.number("cutoff", interface.cutoff, "Å", positive(),
                  "no interaction beyond; half the box at most");
    schema.boolean("tail", interface.tail, "continuum correction beyond the cutoff");
    schema.boolean("frictionless", interface.frictionless,
                   "spectral block: no lateral tractions, normal displacements only");

    auto& drive = scene.drive;
    schema.section("drive", "What is done to the top plane, and how time passes.");
    schema.choice<DriveMode>(
        "mode", drive.mode,
        {{"dynamic", DriveMode::dynamic}, {"quasistatic", DriveMode::quasistatic}},
        "velocity Verlet, or force balance at each top position");
    schema.list_of<PathPart>("path", drive.path,
                             {{"approach", PathPart::approach},
                              {"pull-off", PathPart::pull_off},
                              {"zero-load", PathPart::zero_load}},
                             "the parts of the run, in order");
    schema.number("velocity", drive.velocity, "m/s", positive(), "of the top plane (dynamic)");
    schema.number("step", drive.step, "Å", positive(),
                  "largest top displacement per point (quasistatic)");
    schema.number("timestep", drive.timestep, "fs", positive(), "of velocity Verlet");
    schema.number("damping", drive.damping, "1/ps", at_least(0.0),
                  "rate Γ of the force -m Γ v, v relative to the top plane");
    schema.number("damping_from", drive.damping_from, "", between(0.0, 1.0),
                  "fraction of the thickness above which damping acts");
    schema.number_or(
        "ramp", drive.ramp, "auto", "ps", at_least(0.0),
        "time over which the top plane's velocity is reversed smoothly; \"auto\": one sound "
        "transit of the block");
    schema.number("load", drive.load, "MPa", any(),
                  "pressure at which the approach ends, or a path that starts at \"zero-load\"");
    schema.number("temperature", drive.temperature, "K", at_least(0.0),
                  "above 0: Langevin thermostat");
    schema.integer("seed", drive.seed, at_least(0), "of the thermal noise");
    schema.integer("max_steps", drive.max_steps, at_least(0),
                   "stop after so many steps (points of a quasi-static path); 0: no limit");
    schema.number("tolerance", drive.tolerance, "eV/Å", positive(),
                  "largest residual force of a relaxation; of a quasi-static path, error of the "
                  "energy for each site and Å");

    auto& theory = scene.theory;
    schema.section("theory", "Persson's theory for the same surface.");
    schema.number_or("delta_gamma", theory.delta_gamma, "flat", "meV/Å^2", positive(),
                     "\"flat\": the flat reference of this scene's interface");
    schema.number("beta", theory.beta, "", io::Range{0.0, 1.0, true, false},
                  "correction to the elastic energy");
    schema.choice<AreaFactor>("area_factor", theory.area_factor,
                              {{"gaussian", AreaFactor::gaussian},
                               {"small-slope", AreaFactor::small_slope},
                               {"none", AreaFactor::none}},
                              "how the true area follows from the slope");
    schema.choice<TheorySpectrum>(
        "spectrum", theory.spectrum,
        {{"target", TheorySpectrum::target}, {"realised", TheorySpectrum::realised}},
        "the spectrum asked for, or that of the surface made");
    schema.boolean("clip", theory.clip, "clip the target spectrum at Nyquist, like the surface");

    auto& numerics = scene.numerics;
    schema.section("numerics", "Arithmetic.");
    schema.choice<Precision>(
        "precision", numerics.precision,
        {{"double", Precision::double_precision}, {"mixed", Precision::mixed}},
        "of the pairs across the interface: \"mixed\" works them out in single precision");
    schema.number_or("accuracy", numerics.accuracy, "none", "", io::Range{0.0, 1.0, true, true},
                     "\"1%\": choose the cheapest settings that reach it");

    auto& output = scene.output;
    schema.section("output", "What is written.");
    schema.integer_or("trajectory", output.trajectory, "none", at_least(1),
                      "steps between frames of the lowest layer (H5MD, in run.h5)");
    schema.boolean("velocities", output.velocities, "in the frames of the trajectory too");
    schema.list(
        "fields", output.fields, {"zero-load", std::string(after_zero_load), "pull-off", "every:"},
        "when maps are written: at zero load, so many ps after the approach has ended, at the "
        "largest attraction of the pull-off, every so many steps (points of a quasi-static path)");
    schema.integer("series", output.series, at_least(1), "steps between rows of the series");
    schema.number("checkpoint", output.checkpoint, "s", at_least(0.0),
                  "wall time between checkpoints; 0: none");

    schema.variations("sweep",
                      "What `asperity sweep` varies: any key above, with a list of values or a "
                      "range start:stop:step. Other commands pass over it.",
                      "surface.rms = [1, 2, 3]", scene.sweep);
    return schema;
}

bool Scene::has(PathPart part) const {
    return std::find(drive.path.begin(), drive.path.end(), part) != drive.path.end();
}

bool Scene::writes_field(const std::string& which) const {
    return std::find(output.fields.begin(), output.fields.end(), which) != output.fields.end();
}

std::vector<std::pair<double, std::string>> Scene::delayed_fields() const {
    std::vector<std::pair<double, std::string>> list;
    for (const std::string& field : output.fields)
        if (field.starts_with(after_zero_load))
            list.emplace_back(std::stod(field.substr(after_zero_load.size())), field);
    std::sort(list.begin(), list.end());
    return list;
}

namespace {

/// The map of kind = "file": beside the scene, then in the working directory (the other way round
/// if it was named on the command line).
void find_map(Scene& scene, io::Problems& problems) {
    namespace fs = std::filesystem;
    std::string file = scene.surface.file, dataset;
    if (const std::size_t colon = file.find(":/"); colon != std::string::npos) {
        dataset = file.substr(colon);
        file.resize(colon);
    }
    std::vector<fs::path> places = {fs::path(scene.file).parent_path() / file, fs::path(file)};
    if (scene.positions.where("surface.file").starts_with("--set")) std::swap(places[0], places[1]);
    std::error_code error;
    for (const fs::path& place : places)
        if (fs::is_regular_file(place, error)) {
            scene.surface.file = fs::absolute(place).lexically_normal().string() + dataset;
            return;
        }
    std::string looked = places[0].string();
    if (places[1] != places[0]) looked += " and " + places[1].string();
    const bool named = scene.positions.is_set("surface.file");
    problems.add(
        named ? "surface.file" : "surface.kind",
        named ? fmt::format("= \"{}\": there is no such file", scene.surface.file)
              : "= \"file\" needs surface.file",
        "looked for " + looked,
        "give the path of a height map, relative to the scene or to the working directory");
}

} // namespace

Scene read_scene_text(const std::string& text, const std::string& file,
                      const std::vector<std::string>& overrides) {
    Scene scene;
    scene.file = file;
    scene.name = std::filesystem::path(file).stem().string();
    if (scene.name.empty()) scene.name = "scene";

    io::Problems wrong;
    bind(scene).read(text, file, overrides, scene.positions, wrong);
    scene.surface.rms_given = scene.positions.is_set("surface.rms");
    if (!scene.positions.is_set("block.thickness")) scene.block.thickness = scene.surface.sites;

    if (wrong.empty()) {
        io::Problems uncovered = scene.problems();
        choose_accuracy(scene, uncovered);
        for (const io::Problem& problem : uncovered.list())
            wrong.add(problem);
    }
    // Keys that could not be read still have their defaults, so the checks between keys can go on;
    // what they find about such a key is left out, it has been complained about already.
    io::Problems contradictions = scene.problems();
    if (scene.surface.kind == SurfaceKind::file) find_map(scene, contradictions);
    check_scene(scene, contradictions);
    for (const io::Problem& problem : contradictions.list()) {
        const bool told =
            std::any_of(wrong.list().begin(), wrong.list().end(),
                        [&](const io::Problem& p) { return p.where == problem.where; });
        if (!told) wrong.add(problem);
    }
    wrong.throw_if_any();
    return scene;
}

Scene read_scene(const std::string& file, const std::vector<std::string>& overrides) {
    return read_scene_text(io::read_scene_file(file), file, overrides);
}

void check_scene(const Scene& scene, io::Problems& problems) {
    const auto& [surface, interface, drive] = std::tie(scene.surface, scene.interface, scene.drive);

    const double half = scene.edge() / 2.0;
    if (interface.cutoff > half)
        // Where the cutoff is the default, the box is what the scene chose.
        problems.add(io::Problem{
            scene.positions.where(scene.positions.is_set("interface.cutoff") ? "interface.cutoff"
                                                                             : "surface.sites"),
            fmt::format("interface.cutoff = {:.6g} Å is more than half the box", interface.cutoff),
            fmt::format(
                "the box is {} x {:.6g} Å = {:.6g} Å wide, and an atom must not meet the same "
                "neighbour twice",
                surface.sites, surface.spacing, scene.edge()),
            fmt::format("take a cutoff of {:.6g} Å at most, or surface.sites = {} at least", half,
                        static_cast<int>(std::ceil(2.0 * interface.cutoff / surface.spacing)))});
    const double minimum = std::pow(2.0, 1.0 / 6.0) * interface.r0;
    if (interface.cutoff <= minimum)
        problems.add(
            "interface.cutoff", fmt::format("= {:.6g} Å leaves no attraction", interface.cutoff),
            fmt::format("the minimum of the potential is at 2^(1/6) r0 = {:.6g} Å", minimum),
            fmt::format("the usual cutoff is 4 r0 = {:.6g} Å", 4.0 * interface.r0));

    if (surface.kind == SurfaceKind::self_affine && surface.rolloff > surface.cutoff)
        problems.add("surface.rolloff",
                     fmt::format("= {:.6g} is above surface.cutoff = {:.6g}", surface.rolloff,
                                 surface.cutoff),
                     "the spectrum falls between the two", "give rolloff <= cutoff");
    if (surface.kind == SurfaceKind::self_affine && surface.rms > 0.0 &&
        surface.rolloff > surface.sites / 2.0)
        problems.add("surface.rolloff", fmt::format("= {:.6g} is beyond Nyquist", surface.rolloff),
                     fmt::format("a grid of {} sites holds nothing above q = {} q_L", surface.sites,
                                 surface.sites / 2),
                     "give a smaller rolloff or more sites");
    if (surface.radius && *surface.radius < scene.edge() * std::numbers::sqrt2 / 2.0)
        problems.add(
            "surface.radius",
            fmt::format("= {:.6g} Å is less than half the diagonal of the box", *surface.radius),
            fmt::format("the cap would not reach the corners, {:.6g} Å from the centre",
                        scene.edge() * std::numbers::sqrt2 / 2.0),
            "give a larger radius or fewer sites");

    if (interface.frictionless && scene.block.model != BlockModel::spectral)
        problems.add("interface.frictionless", "= true with a block that is not spectral",
                     "only the spectral block can leave lateral displacements out: its stiffness "
                     "for normal forces alone is known wave by wave",
                     "take block.model = \"spectral\", or frictionless = false");

    const auto& path = drive.path;
    if (path.empty())
        problems.add("drive.path", "is empty", "there would be nothing to do",
                     "for example path = [\"approach\", \"pull-off\"]");
    for (std::size_t i = 0; i < path.size(); ++i) {
        const bool approach = path[i] == PathPart::approach;
        const bool follows_pull_off = i > 0 && path[i - 1] == PathPart::pull_off;
        if (approach && i > 0 && !follows_pull_off)
            problems.add("drive.path",
                         "has an \"approach\" from a state that is in contact already",
                         "an approach starts out of reach", "put a \"pull-off\" before it");
        if (path[i] == PathPart::pull_off && (i == 0 || follows_pull_off))
            problems.add("drive.path", "has a \"pull-off\" with nothing to pull off",
                         "it starts where an \"approach\" or \"zero-load\" ends",
                         "for example path = [\"approach\", \"pull-off\"]");
        if (path[i] == PathPart::zero_load && i > 0)
            problems.add("drive.path", "has \"zero-load\" after something else",
                         "it goes straight to the relaxed state and needs nothing before it",
                         "take it out, or take path = [\"zero-load\"]: after an approach the state "
                         "under zero load is found anyway");
    }
    if (surface.kind == SurfaceKind::file && surface.rms_given && surface.rms == 0.0)
        problems.add("surface.rms", "= 0 Å with a map", "a map scaled to nothing is a flat surface",
                     "take kind = \"flat\", or leave rms out to take the map as it is");
    if (scene.block.strain == Strain::finite && scene.block.model == BlockModel::spectral)
        problems.add("block.strain", "= \"finite\" with block.model = \"spectral\"",
                     "the spectral block adds up waves, and at finite strain waves do not add up",
                     "take block.model = \"multiscale\" or \"lattice\", or strain = \"linear\"");
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
    if (scene.field_stride() == 0)
        problems.add("output.fields", "has an \"every:\" without a number of steps",
                     "maps are written every so many steps (points of a quasi-static path)",
                     "for example fields = [\"zero-load\", \"every:1000\"]");
    for (const auto& [delay, field] : scene.delayed_fields())
        if (scene.without_time() || !scene.has(PathPart::pull_off))
            problems.add("output.fields", "asks for \"" + field + "\"",
                         "no pull-off goes on in time after zero load",
                         "take a dynamic path with a pull-off, or take it out of output.fields");
    if (scene.writes_field("pull-off") && !scene.has(PathPart::pull_off))
        problems.add("output.fields", "asks for \"pull-off\"", "drive.path has no pull-off",
                     "add it to drive.path or take it out of output.fields");
    if (scene.output.trajectory &&
        (scene.has(PathPart::zero_load) || drive.mode == DriveMode::quasistatic))
        problems.add("output.trajectory", fmt::format("= {}", *scene.output.trajectory),
                     "frames are taken over time, and this path has none",
                     "leave it out: the maps of output.fields hold the states");
}

void not_yet(const Scene& scene, io::Problems& problems) {
    const auto refuse = [&](const std::string& key, const std::string& value, std::string instead) {
        problems.add(key, "= " + value + " is not available yet",
                     "it is part of the scene format, and this release does not compute it",
                     std::move(instead));
    };
    if (scene.block.model == BlockModel::spectral && !scene.without_time())
        refuse("block.model", "\"spectral\" on a path in time",
               "use drive.mode = \"quasistatic\", or \"multiscale\" (\"lattice\" is the "
               "reference)");
    const auto parts = static_cast<std::size_t>(
        std::count(scene.drive.path.begin(), scene.drive.path.end(), PathPart::approach));
    if (parts > 1 && !scene.without_time())
        refuse("drive.path", "a path of several cycles in time",
               "use path = [\"approach\", \"pull-off\"], or drive.mode = \"quasistatic\"");
    if (scene.drive.mode == DriveMode::dynamic && scene.drive.path.size() > 1 &&
        scene.drive.path.front() == PathPart::zero_load)
        refuse("drive.path", "a pull-off from \"zero-load\" in time",
               "use path = [\"approach\", \"pull-off\"], or drive.mode = \"quasistatic\"");
}

std::vector<std::string> notes(const Scene& scene) {
    std::vector<std::string> list;
    const auto& surface = scene.surface;
    if (scene.block.model == BlockModel::multiscale) {
        int sites = surface.sites, halvings = 0;
        while (sites % 2 == 0)
            sites /= 2, ++halvings;
        double reach = 0.0; // what the levels above that halving can carry at layers_per_level each
        for (int level = 0; level <= halvings; ++level)
            reach += std::ldexp(scene.block.layers_per_level, level);
        if (2.0 * reach < scene.block.thickness)
            list.push_back(
                fmt::format("{} sites can be halved {} times only, so the coarsest level is "
                            "much thicker than layers_per_level; a power of two costs least",
                            surface.sites, halvings));
    }
    if (scene.block.thickness < surface.sites)
        list.push_back(
            fmt::format("the block is thinner ({} layers) than wide ({} sites): the longest waves "
                        "feel the rigid top plane",
                        scene.block.thickness, surface.sites));
    if (scene.has(PathPart::zero_load) && scene.drive.load != 0.0)
        list.push_back(fmt::format("the \"zero-load\" state carries drive.load = {:.6g} MPa; its "
                                   "binding energy leaves out the load's potential",
                                   scene.drive.load));
    const auto idle = [&](const std::string& key, const std::string& reason) {
        if (scene.positions.is_set(key)) list.push_back(key + " has no effect: " + reason);
    };
    if (!scene.output.trajectory) idle("output.velocities", "output.trajectory is \"none\"");
    if (surface.kind != SurfaceKind::file) idle("surface.file", "surface.kind is not \"file\"");
    if (surface.kind == SurfaceKind::flat) idle("surface.rms", "surface.kind is \"flat\"");
    if (surface.kind != SurfaceKind::self_affine)
        for (const char* key : {"surface.hurst", "surface.rolloff", "surface.cutoff"})
            idle(key, "surface.kind is not \"self-affine\"");
    if (scene.block.model != BlockModel::multiscale)
        idle("block.layers_per_level", "block.model is not \"multiscale\"");
    return list;
}

std::optional<long long> Scene::field_stride() const {
    constexpr std::string_view every = "every:";
    for (const std::string& field : output.fields) {
        if (!field.starts_with(every)) continue;
        long long n = 0;
        const char* end = field.data() + field.size();
        const auto [stop, error] = std::from_chars(field.data() + every.size(), end, n);
        return error == std::errc() && stop == end && n > 0 ? n : 0;
    }
    return std::nullopt;
}

std::string scene_toml(const Scene& scene, bool with_docs) {
    Scene copy = scene;
    return bind(copy).toml(with_docs);
}

io::JsonValue scene_json(const Scene& scene) {
    Scene copy = scene;
    return bind(copy).json();
}

std::string scene_markdown() {
    Scene defaults;
    return "# The scene file\n\n"
           "Written by `asperity defaults --markdown`; do not edit. A scene is a TOML file. A "
           "quantity is a "
           "number in the unit named, or a string with a unit of the same kind (\"0.3 nm\", \"100 "
           "meV\", "
           "\"5 m/s\", \"77.2 GPa\"). Every key may be left out. `--set section.key=value` "
           "overrides one.\n" +
           bind(defaults).markdown();
}

} // namespace asperity
