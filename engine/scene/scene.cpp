// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/scene/scene.hpp"
#include "engine/scene/scene_needs.hpp"

#include "engine/options/segment.hpp"
#include "io/json.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string_view>

#include <fmt/format.h>

namespace asperity {

using io::at_least;
using io::between;
using io::positive;

namespace {

template <class Visit>
void each_potential(EachPotential& all, Visit visit) {
    std::apply([&](auto&... p) { (visit(p), ...); }, all);
}

/// Binds the parameters: epsilon and r0; others with the potential's name before: morse_D.
template <class P>
std::string key_of(const char* parameter) {
    if (std::is_same_v<P, LennardJones>) return parameter;
    return fmt::format("{}_{}", P::name, parameter);
}

template <class P>
void bind_potential(io::Schema& schema, P& potential, const std::vector<io::Schema::Need>& needs) {
    P::parameters(
        potential, [&](const char* name, const char* unit, double& value, const char* meaning) {
            schema.number(key_of<P>(name), value, unit, positive(), meaning).needs = needs;
        });
}

/// Adds the keys of the file of a map that the key `of` names. unit: unit of its numbers.
template <class Map>
void bind_map_file(io::Schema& schema, const std::string& name, const std::string& of,
                   const std::string& unit, Map& map, const io::Schema::Need& given) {
    schema
        .number_or(name + "_size", map.size, "auto", "Å", positive(),
                   "edge of the map of " + of +
                       "; \"auto\": as the file states, otherwise the edge of the box")
        .needs = {given};
    schema
        .key(name + "_unit", map.unit,
             "unit of the map of " + of + "; \"auto\": as the file states, otherwise " + unit)
        .needs = {given};
    schema
        .choice<MapMissing>(name + "_missing", map.missing,
                            {{"refuse", MapMissing::refuse}, {"fill", MapMissing::fill}},
                            "points without a value in the map of " + of +
                                ", as surface.file_missing")
        .needs = {given};
    schema
        .choice<MapCrop>(name + "_crop", map.crop,
                         {{"none", MapCrop::none}, {"middle", MapCrop::middle}},
                         "a map of " + of + " that is not square, as surface.file_crop")
        .needs = {given};
}

/// Gives a key that may be a map of the sites what it needs, and adds the keys of its file.
void bind_site_map(io::Schema& schema, io::Schema::Key& key, SiteMapKeys& map,
                   const io::Schema::Need& need) {
    key.needs = {need};
    const std::string name = key.name, of = "interface." + name, unit = key.unit;
    const io::Schema::Need given = Needs::acting(
        {[is_met = need.is_met, &map] { return is_met() && map.given(); },
         of + " names no map of a wall"},
        "give " + of + " a map or a formula", {of, "interface.kind", "interface.law"});
    bind_map_file(schema, name, of, unit, map, given);
}

/// Adds a key of the layers of a solid.
io::Schema::Key& bind_layers(io::Schema& schema, std::string name,
                             std::vector<std::array<double, 3>>& layers, std::string doc) {
    return schema.rows<3>(
        std::move(name), layers,
        {{{"thickness", "Å", positive(), "\"2 nm\""},
          {"Young's modulus", "GPa", io::Range{0.0, 1e6, true, false}, "\"10 GPa\""},
          {"Poisson's ratio", "", io::Range{-1.0, 0.5, true, true}, "0.3"}}},
        std::move(doc));
}

/// Adds the keys of a second solid.
void bind_counter(io::Schema& schema, Scene::Surface::Counter& counter, const Needs& needs) {
    schema
        .key("counter", counter.file,
             "map of a second solid, in a file as for surface.file, over a wall on a quasi-static "
             "path; \"none\": the substrate is rigid. The map of the keys above is then that of "
             "the block, and both maps have heights outwards from their own solid. The second "
             "solid is turned over about the y axis onto the first: h(x, y) + h_counter(-x, y), "
             "from the middle of the maps, before it is turned and shifted. detrend, line_noise "
             "and resample are for both maps, rms for the first, and radius is that of both, 1/R "
             "= 1/R_1 + 1/R_2")
        .needs = {needs.refusing(needs.wall, "over atoms",
                                 "two solids are computed as one, and the registry of two "
                                 "deformable lattices, their lateral displacements and contacts "
                                 "beside a site are not those of one: a composite is for walls",
                                 "take interface.kind = \"wall\", or leave counter out"),
                  needs.refusing(needs.equilibria, "on a dynamic path",
                                 "two solids are one in which the compliances of each wave add "
                                 "up, at rest and without inertia",
                                 "take drive.mode = \"quasistatic\", or leave counter out")};
    bind_map_file(schema, "counter", "surface.counter", "Å", counter, needs.counter);
    schema
        .number("counter_shift_x", counter.shift_x, "Å", {},
                "shift of the second solid along x, after its turn")
        .needs = {needs.counter};
    schema
        .number("counter_shift_y", counter.shift_y, "Å", {},
                "shift of the second solid along y, after its turn")
        .needs = {needs.counter};
    schema
        .number("counter_turn", counter.turn, "", between(-360.0, 360.0),
                "turn of the second solid about the middle of its map, degrees, counter-clockwise "
                "from above; other than quarter turns need a map wider than the box")
        .needs = {needs.counter};
    schema
        .number_or("counter_young", counter.young, "rigid", "GPa", io::Range{0.0, 1e6, true, false},
                   "Young's modulus of the second solid")
        .needs = {needs.counter};
    schema
        .number("counter_poisson", counter.poisson, "", io::Range{-1.0, 0.5, true, true},
                "Poisson's ratio of the second solid")
        .needs = {needs.counter, needs.elastic_counter};
    bind_layers(schema, "counter_layers", counter.layers,
                "coatings of the second solid, from its surface inwards, as block.layers; it is "
                "as thick as the block")
        .needs = {needs.counter, needs.elastic_counter};
    schema
        .number("counter_surface_stress", counter.surface_stress, "N/m", at_least(0.0),
                "tension of the second solid's surface")
        .needs = {needs.counter, needs.elastic_counter};
}

/// Returns the first word of a member of drive.path.
std::string segment_name(const std::string& member) {
    const std::size_t first = std::min(member.find_first_not_of(' '), member.size());
    return member.substr(first, member.find(' ', first) - first);
}

} // namespace

std::string Scene::Interface::potential_name() const {
    return std::apply(
        [&](const auto&... p) {
            return std::string(std::array{p.name...}[static_cast<std::size_t>(potential)]);
        },
        potentials);
}

void set_largest(Scene::Interface& interface, SiteMapOf map, double largest) {
    switch (map) {
    case SiteMapOf::adhesion:
        interface.adhesion = largest;
        break;
    case SiteMapOf::hardness:
        interface.hardness = largest;
        break;
    }
}

bool Scene::only_relaxes() const {
    return drive.path.size() == 1 && segment_name(drive.path.front()) == word(Segment::relax);
}

bool Scene::is_dynamic() const {
    return drive.mode == DriveMode::dynamic &&
           std::none_of(drive.path.begin(), drive.path.end(), [](const std::string& member) {
               return segment_name(member) == word(Segment::relax);
           });
}

BlockModel Scene::block_model() const {
    if (block.model != BlockModel::automatic) return block.model;
    if (is_dynamic()) return BlockModel::multiscale;
    return interface.has_adhesion() ? BlockModel::continuum : BlockModel::lattice;
}

namespace {

/// Adds the keys of a self-affine surface, and of its curvature.
void bind_roughness(io::Schema& schema, Scene& scene, const Needs& needs) {
    auto& surface = scene.surface;
    io::Schema::Key& rms =
        schema.number("rms", surface.rms, "Å", at_least(0.0),
                      "rms height; a map from a file is scaled only if the scene sets this key");
    rms.omitted = [&scene] { return scene.surface.reads_file() && !scene.gives_rms(); };
    rms.needs = {needs.rough, needs.heights("the atoms stand where their file says",
                                            "leave it out, and scale the file")};
    schema.number("hurst", surface.hurst, "", between(0.0, 1.0), "Hurst exponent H").needs = {
        needs.self_affine};
    schema
        .number("rolloff", surface.rolloff, "", at_least(1.0),
                "roll-off wavevector q0 / q_L, below which C(q) is constant")
        .needs = {needs.self_affine};
    schema
        .number_or("q_max", surface.q_max, "nyquist", "", at_least(1.0),
                   "largest wavevector q1 / q_L, above which C(q) is zero; \"nyquist\" is sites/2, "
                   "the upper limit")
        .needs = {needs.self_affine};
    schema.removed({"surface.cutoff", "", "it is called surface.q_max",
                    "write q_max with the same number; without it the spectrum ends at Nyquist"});
    schema
        .choice<Amplitudes>("amplitudes", surface.amplitudes,
                            {{"gaussian", Amplitudes::gaussian}, {"fixed", Amplitudes::fixed}},
                            "random amplitudes and phases, or random phases only")
        .needs = {needs.self_affine};
    schema
        .integer("seed", surface.seed, at_least(0),
                 "seed of the surface: the same seed makes a bitwise identical surface")
        .needs = {needs.self_affine};
    schema
        .number_or("radius", surface.radius, "none", "Å", positive(),
                   "radius of a spherical cap under the roughness")
        .needs = {
        needs.heights("the atoms stand where their file says", "leave it out, and curve the file")};
}

/// Adds the keys of a surface from a file.
void bind_surface_file(io::Schema& schema, Scene& scene, const Needs& needs) {
    auto& surface = scene.surface;
    schema
        .key("file", surface.file,
             "for kind = \"file\": HDF5 (file.h5 or file.h5:/path), .npy or a plain matrix of "
             "numbers; for kind = \"atoms\": HDF5 with /position, /type and the block's periodic "
             "/box; `asperity convert` converts other formats; searched in the folder of the "
             "scene, then in the working directory")
        .needs = {needs.file};
    schema
        .number_or("file_size", surface.file_size, "auto", "Å", positive(),
                   "edge of the map; \"auto\": as the file states, otherwise the edge of the box")
        .needs = {needs.heights("the file says how wide its periodic box is", "leave it out"),
                  needs.map};
    schema
        .key("file_unit", surface.file_unit,
             "unit of the map's heights; \"auto\": as the file states, otherwise Å")
        .needs = {
        needs.heights("files of atoms say their unit, or are in Å",
                      "leave it out; give /position and /box of the file an attribute unit"),
        needs.map};
    schema
        .choice<Detrend>(
            "detrend", surface.detrend,
            {{"none", Detrend::none}, {"plane", Detrend::plane}, {"periodic", Detrend::periodic}},
            "removes from a map of a file nothing, the mean plane, or the mean plane and the jumps "
            "between opposite edges")
        .needs = {needs.heights("the atoms stand where their file says", "leave it out"),
                  needs.any_map};
    schema
        .choice<MapMissing>("file_missing", surface.file_missing,
                            {{"refuse", MapMissing::refuse},
                             {"fill", MapMissing::fill},
                             {"hole", MapMissing::hole}},
                            "points of the map without a height: refused, filled by Laplace's "
                            "equation, or holes without a solid in a wall (a punch)")
        .needs = {needs.map};
    schema
        .choice<MapCrop>("file_crop", surface.file_crop,
                         {{"none", MapCrop::none}, {"middle", MapCrop::middle}},
                         "a map that is not square: refused, or cut to its middle")
        .needs = {needs.map};
    schema
        .choice<LineNoise>(
            "line_noise", surface.line_noise,
            {{"keep", LineNoise::keep},
             {"align-rows", LineNoise::align_rows},
             {"isotropic", LineNoise::isotropic}},
            "noise of a scan from line to line: kept; reduced by subtracting the median steps "
            "between lines; or waves across the lines scaled down to the spectrum along the lines")
        .needs = {needs.heights("the atoms stand where their file says", "leave it out"),
                  needs.any_map};
    schema
        .choice<Resample>(
            "resample", surface.resample,
            {{"none", Resample::none}, {"band-limited", Resample::band_limited}},
            "resampling of a map without N x N values to the lattice: refused, or band-limited")
        .needs = {needs.heights("the atoms stand where their file says", "leave it out"),
                  needs.any_map};
}

/// Adds the keys of the section [surface].
void bind_surface(io::Schema& schema, Scene& scene, const Needs& needs) {
    auto& surface = scene.surface;
    schema.section("surface", "The rough substrate, rigid unless counter gives it an elasticity.");
    schema.choice<SurfaceKind>("kind", surface.kind,
                               {{"flat", SurfaceKind::flat},
                                {"self-affine", SurfaceKind::self_affine},
                                {"file", SurfaceKind::file},
                                {"atoms", SurfaceKind::atoms}},
                               "the substrate: one layer of atoms with heights, generated or from "
                               "a map; \"atoms\": atoms of a file at arbitrary positions");
    schema.count_or_length("sites", surface.sites, scene.width, between(fewest_sites, most_sites),
                           "number of sites along an edge of the box, N; or its width (\"133 "
                           "nm\"), rounded to whole spacings");
    schema
        .choice<Boundary>(
            "boundary", surface.boundary,
            {{"periodic", Boundary::periodic}, {"free", Boundary::free}},
            "edges of the box: periodic surfaces, or a substrate that ends at the edges below an "
            "infinite half-space (a tip, a lens, a punch; over a wall, quasi-static)")
        .needs = {needs.refusing(needs.equilibria, "on a dynamic path",
                                 "a surface without images is known wave by wave, at rest",
                                 "take drive.mode = \"quasistatic\", or boundary = \"periodic\""),
                  needs.refusing(needs.wall, "without a wall",
                                 "a surface without images answers normal forces alone",
                                 "take interface.kind = \"wall\", or boundary = \"periodic\"")};
    schema.number("spacing", surface.spacing, "Å", positive(),
                  "lattice constant a of the block (and of the substrate at lattice_ratio 1)");
    schema
        .number("lattice_ratio", surface.lattice_ratio, "", between(0.1, 10.0),
                "block spacing divided by substrate spacing, rounded to whole atoms; 1.618 is "
                "incommensurate")
        .needs = {
        needs.heights("the atoms stand where their file says",
                      "leave it out: the file has its own spacing"),
        needs.refusing({[&scene] { return scene.interface.kind != InterfaceKind::wall; }, ""},
                       "with a wall",
                       "a wall has a height below each site, and no lattice of its own",
                       "take lattice_ratio = 1, or interface.kind = \"atoms\"")};
    bind_roughness(schema, scene, needs);
    bind_surface_file(schema, scene, needs);
    bind_counter(schema, surface.counter, needs);
}

/// Adds the key block.model.
void bind_model(io::Schema& schema, Scene& scene, const Needs& needs) {
    schema
        .choice<BlockModel>(
            "model", scene.block.model,
            {{"auto", BlockModel::automatic},
             {"lattice", BlockModel::lattice},
             {"multiscale", BlockModel::multiscale},
             {"continuum", BlockModel::continuum}},
            "dynamic paths: every atom (lattice), or cells that become coarser with depth "
            "(multiscale); quasi-static paths: the exact static response of the lattice (lattice "
            "or multiscale), or over a wall that of an elastic continuum; auto: multiscale on "
            "dynamic paths, on quasi-static ones continuum over a wall and lattice over atoms, "
            "smeared "
            "ones too")
        .needs = {
        needs.refusing(
            {[&scene] { return scene.block.model != BlockModel::continuum || !scene.is_dynamic(); },
             ""},
            "on a dynamic path", "a continuum is solved as waves at rest, without inertia",
            "take drive.mode = \"quasistatic\", or model = \"multiscale\""),
        needs.refusing({[&scene] {
                            return scene.block.model != BlockModel::continuum ||
                                   scene.interface.kind == InterfaceKind::wall;
                        },
                        ""},
                       "over atoms", "the sites are then atoms of the block's lattice",
                       "take interface.kind = \"wall\", or model = \"lattice\""),
        {[&scene] { return scene.is_dynamic() || scene.interface.kind == InterfaceKind::wall; },
         "no time passes on this path"}};
    schema.removed({"block.model", "spectral",
                    "a quasi-static path is always one of waves, and a dynamic path never",
                    "leave block.model out, and take drive.mode = \"quasistatic\" or drive.path = "
                    "[\"relax\"]"});
}

/// Adds the keys of the section [block].
void bind_block(io::Schema& schema, Scene& scene, const Needs& needs) {
    auto& block = scene.block;
    schema.section("block", "The elastic block.");
    bind_model(schema, scene, needs);
    schema.number("young", block.young, "GPa", io::Range{0.0, 1e6, true, false},
                  "Young's modulus E");
    schema.number("poisson", block.poisson, "", io::Range{-1.0, 0.5, true, true},
                  "Poisson's ratio");
    schema.number("atom_mass", block.atom_mass, "u", positive(), "mass of an atom").needs = {
        needs.dynamic};
    schema
        .count_or_length("thickness", block.thickness, scene.height, between(1, most_layers),
                         "thickness in lattice layers, or a length (\"33 nm\"), rounded to whole "
                         "layers; by default N")
        .needs = {needs.periodic};
    schema
        .integer("layers_per_level", block.layers_per_level, between(2, 1024),
                 "thickness of each level of the multiscale block, in its own cells")
        .needs = {needs.dynamic, needs.multiscale};
    schema
        .choice<Strain>("strain", block.strain,
                        {{"linear", Strain::linear}, {"finite", Strain::finite}},
                        "small strain, or geometrically exact springs")
        .needs = {needs.refusing(
        needs.dynamic, "on a quasi-static path",
        "on such a path the block is a sum of waves, and at finite strain waves do not add up",
        "take drive.mode = \"dynamic\" with an approach, or strain = \"linear\"")};
    auto& prony = schema.rows<2>(
        "prony", block.prony,
        {{{"modulus over young", "", positive(), "0.5"},
          {"relaxation time", "ps", positive(), "\"1 ns\""}}},
        "branches of a viscoelastic block (quasi-static paths) with ascending times, for example "
        "[[9.0, \"1 ns\"], [1.5, \"20 ns\"]]; young is then the relaxed modulus, and "
        "drive.velocity determines the time between points; or a file that `asperity prony` has "
        "made from a master curve, which also sets young");
    prony.text = &scene.fit.file;
    prony.example = "rubber.toml";
    prony.needs = {needs.refusing(needs.equilibria, "on a dynamic path",
                                  "only the block of a quasi-static path can be viscoelastic",
                                  "take drive.mode = \"quasistatic\", or leave prony out"),
                   {[&scene] { return !scene.only_relaxes(); },
                    "drive.path is one relaxation, and its state is the relaxed one"}};
    constexpr const char* at_rest = "only the block of a quasi-static path, which is the waves of "
                                    "its surface, has them";
    bind_layers(schema, "layers", block.layers,
                "coatings between the block's own material and its surface (quasi-static paths), "
                "from the surface upwards; in a lattice a thickness is rounded to whole layers")
        .needs = {needs.refusing(needs.equilibria, "on a dynamic path", at_rest,
                                 "take drive.mode = \"quasistatic\", or leave layers out")};
    schema
        .number("surface_stress", block.surface_stress, "N/m", at_least(0.0),
                "tension of the block's surface (quasi-static paths)")
        .needs = {needs.refusing(needs.equilibria, "on a dynamic path", at_rest,
                                 "take drive.mode = \"quasistatic\", or leave surface_stress out")};
    schema.removed({"block.seams", "",
                    "levels always reflect the waves that the next level cannot carry",
                    "leave it out; drive.damping with drive.damping_from damps the sound that the "
                    "rigid top would return"});
}

/// Adds the keys of a wall.
void bind_wall(io::Schema& schema, Scene& scene, const Needs& needs) {
    auto& interface = scene.interface;
    schema
        .choice<WallLawKind>(
            "law", interface.law,
            {{"exponential", WallLawKind::exponential},
             {"smeared", WallLawKind::smeared},
             {"dugdale", WallLawKind::dugdale},
             {"power", WallLawKind::power},
             {"9-3", WallLawKind::nine_three},
             {"8-2", WallLawKind::eight_two},
             {"table", WallLawKind::table}},
            "law of a wall. With a linear repulsion below a gap of 0: an energy per area of "
            "-adhesion exp(-gap/range), with a largest tension of T = adhesion/range; a constant "
            "tension T up to the range (\"dugdale\"); or an energy of -adhesion/(1 + "
            "gap/range)^exponent, with a largest tension of exponent T (\"power\"). Powers 9 and "
            "3, or 8 and 2, of range/gap in the energy, which is deepest at the range, with a "
            "largest tension of 1.466 T and 1.026 T; interface.table; or the substrate's atoms "
            "smeared over their layer (potential, cutoff, tail)")
        .needs = {needs.wall};
    schema.removed({"interface.law", "lennard-jones",
                    "the smeared atoms have whatever potential interface.potential names",
                    "write law = \"smeared\"; interface.potential is \"lennard-jones\" where the "
                    "scene does not say"});
    bind_site_map(
        schema,
        schema.number_or_text(
            "adhesion", interface.adhesion, interface.maps[SiteMapOf::adhesion].source, "meV/Å^2",
            at_least(0.0), "map.npy",
            "work of adhesion of flat surfaces, Δγ, for a wall that is not smeared; 0: no "
            "attraction. A value for each site is given by a map, in a file as for surface.file, "
            "or by a formula, \"stripes LOW HIGH PERIOD\", \"discs LOW HIGH RADIUS DISTANCE\", "
            "\"rings MEAN AMPLITUDE PERIOD\" (MEAN (1 + AMPLITUDE cos(2 π r/PERIOD)), r from the "
            "middle of the box) or \"patches LOW HIGH LENGTH SEED\" (random, with this correlation "
            "length), for example \"stripes 10 mJ/m^2 50 mJ/m^2 20 nm\" or \"rings 50 mJ/m^2 0.2 "
            "10 nm\""),
        interface.maps[SiteMapOf::adhesion], needs.adhesion);
    bind_site_map(
        schema,
        schema.number_or_text(
            "hardness", interface.hardness, interface.maps[SiteMapOf::hardness].source, "none",
            "GPa", positive(), "map.npy",
            "largest net pressure of a site over a wall on a quasi-static path: a site at the "
            "hardness takes a permanent set (a cap on the pressure, without pile-up and "
            "hardening); \"none\": the surface does not yield. A value for each site as for "
            "adhesion"),
        interface.maps[SiteMapOf::hardness], needs.yielding);
    schema
        .number("range", interface.range, "Å", positive(),
                "range of the laws except smeared and table")
        .needs = {needs.ranged};
    schema
        .number("exponent", interface.exponent, "", io::Range{1.0, 100.0},
                "exponent of the energy of law = \"power\"; the tension falls with one power more")
        .needs = {needs.power};
    schema
        .number_or("stiffness", interface.stiffness, "auto", "GPa/Å", positive(),
                   "stiffness of the linear repulsion; \"auto\": nearly a hard wall, 500 π "
                   "E*/spacing (a thousand times the stiffness of the block for its shortest "
                   "wave), and at least 50 adhesion/range²")
        .needs = {needs.touched};

    schema
        .choice<EdgePinning>("edge_pinning", interface.edge_pinning,
                             {{"refuse", EdgePinning::refuse}, {"allow", EdgePinning::allow}},
                             "allows or refuses the pull-off of a sphere whose force would be more "
                             "than 1.3 times too large, because the spacing does not resolve the "
                             "range and rows of sites pin the edge of the contact")
        .needs = {needs.adhesion};
}

/// Adds the keys of the section [interface].
void bind_interface(io::Schema& schema, Scene& scene, const Needs& needs) {
    auto& interface = scene.interface;
    schema.section("interface", "The interaction between substrate and lowest layer.");
    schema.choice<InterfaceKind>("kind", interface.kind,
                                 {{"atoms", InterfaceKind::atoms}, {"wall", InterfaceKind::wall}},
                                 "pairs of atoms, or a wall, which acts by a law of the gap below "
                                 "each site without lateral forces (quasi-static paths)");
    std::vector<std::pair<std::string, int>> names;
    each_potential(interface.potentials,
                   [&](auto& p) { names.emplace_back(p.name, static_cast<int>(names.size())); });
    schema
        .choice<int>("potential", interface.potential, names,
                     "potential of the pairs, or of the atoms of a smeared wall")
        .needs = {needs.pairs};
    each_potential(interface.potentials, [&]<class P>(P& p) {
        bind_potential(schema, p, {needs.pairs, needs.potential(P::name)});
    });
    schema
        .key("table", interface.table,
             "file of potential = \"table\": text of distances in Å and energies in eV (law = "
             "\"table\": gaps in Å, and energies in any unit, which adhesion scales); a line above "
             "more than two columns names them (\"# r F V\"); searched in the folder of the scene, "
             "then in the working directory")
        .needs = {needs.table};
    schema
        .number_or("cutoff", interface.cutoff, "4 r0", "Å", positive(),
                   "distance beyond which atoms do not interact, at most half the box. \"4 r0\": "
                   "four times the distance of zero energy, for each type of interface.pairs, and "
                   "at most the last distance of a table")
        .needs = {needs.pairs};
    schema.removed({"interface.morse_r0", "",
                    "it is the place of the minimum, and interface.r0 where the energy is zero",
                    "write interface.morse_r_min with the same number"});
    schema
        .list("pairs", interface.pairs, {},
              "potentials of the types of a substrate of atoms from a file: [\"Au 0.1 3.28\", \"C "
              "morse 0.02 1.5 3.9 10\"] each with the potential's name and the cutoff, if they "
              "differ from potential and cutoff, and the parameters in the order above; units may "
              "follow. []: interface.potential for atoms of one type")
        .needs = {
        needs.refusing({[&scene] { return scene.surface.kind == SurfaceKind::atoms; }, ""},
                       "without a substrate of atoms from a file",
                       "the atoms of other substrates are of one type, with interface.potential",
                       "leave it out, or take surface.kind = \"atoms\"")};
    schema.key("tail", interface.tail, "continuum correction beyond the cutoff").needs = {
        needs.pairs, needs.heights("the tail is that of one layer of known density",
                                   "take a larger interface.cutoff, and tail = false")};
    schema.key("frictionless", interface.frictionless,
               "no lateral tractions, and normal displacements only (quasi-static paths)");
    bind_wall(schema, scene, needs);
}

/// Adds the keys of time steps, loads and convergence.
void bind_motion(io::Schema& schema, Scene& scene, const Needs& needs) {
    auto& drive = scene.drive;
    schema.number("timestep", drive.timestep, "fs", positive(), "time step of velocity Verlet")
        .needs = {needs.dynamic};
    schema
        .number("damping", drive.damping, "1/ps", at_least(0.0),
                "rate Γ of the damping force -m Γ v, with v relative to the drive, which moves the "
                "top plane or the far end of its spring (drive.stiffness)")
        .needs = {needs.dynamic};
    schema
        .number("damping_from", drive.damping_from, "", between(0.0, 1.0),
                "fraction of the thickness above which damping acts")
        .needs = {needs.dynamic, needs.damping};
    schema
        .number_or("ramp", drive.ramp, "auto", "ps", at_least(0.0),
                   "duration of smooth changes of the top plane's velocity; \"auto\": one sound "
                   "transit of the block")
        .needs = {needs.dynamic};
    schema.quantity_or(
        "load", drive.load, "MPa", {"nN", "a force", &scene.force},
        "pressure, or force on the box (\"20 nN\"), at which an approach ends, or under which "
        "\"relax\" finds the state; the state after an approach is without load");
    schema
        .number("temperature", drive.temperature, "K", at_least(0.0),
                "temperature; above 0 with a Langevin thermostat")
        .needs = {needs.dynamic};
    schema.integer("seed", drive.seed, at_least(0), "seed of the thermal noise").needs = {
        needs.dynamic, needs.temperature};
    schema.number_or_none("max_steps", drive.max_steps, "", at_least(1),
                          "largest number of time steps, or points of a quasi-static path, after "
                          "which the run stops");
    schema
        .number("tolerance", drive.tolerance, "", positive(),
                "largest residual force of a relaxation, as a fraction of the smallest force on a "
                "site that decides the state (`asperity plan` prints this force); on a "
                "quasi-static path also the error of the energy per site and Å")
        .was = {"eV/Å",
                "it is a fraction of the smallest force on a site that decides the state, "
                "which `asperity plan` prints",
                "leave it out, or give the fraction: 2.5e-4 is the default"};
}

/// Adds the keys of the section [drive].
void bind_drive(io::Schema& schema, Scene& scene, const Needs& needs) {
    auto& drive = scene.drive;
    schema.section("drive", "The motion of the top plane, and the time step.");
    schema.choice<DriveMode>(
        "mode", drive.mode,
        {{"dynamic", DriveMode::dynamic}, {"quasistatic", DriveMode::quasistatic}},
        "time steps (velocity Verlet), or force balance at each position");
    schema.list(
        "path", drive.path, {},
        "segments of the run, in order: \"approach\" to drive.load, \"pull-off\", \"relax\" "
        "(quasi-static, first: the state under drive.load), \"load 100 MPa\", \"height 12 Å\" "
        "(height of the lowest layer of the undeformed block, or its mean height if controlled), "
        "\"slide x 5 Å\" (or y, at the same height; over a wall also \"under load\" and \"until "
        "steady\"), \"hold 20 ps\" (dynamic, or with block.prony)");
    schema
        .number("velocity", drive.velocity, "m/s", positive(),
                "speed of the top plane (dynamic), or of the quantity of drive.control (with "
                "block.prony)")
        .needs = {needs.time};
    schema
        .choice<Control>(
            "control", drive.control,
            {{"top", Control::top}, {"mean-height", Control::mean_height}},
            "quantity that a quasi-static path prescribes: the height of the top plane, or the "
            "mean height of the lowest layer, for which the block never jumps as a whole")
        .needs = {
        needs.refusing(needs.equilibria, "on a dynamic path",
                       "a dynamic path prescribes the top plane; the mean height of the lowest "
                       "layer follows from the motion of the block",
                       "take drive.mode = \"quasistatic\", or control = \"top\""),
        needs.refusing({[&scene] { return !scene.has_free_edges(); }, ""},
                       "with surface.boundary = \"free\"",
                       "the surface goes on beyond the box, and displacements are measured from "
                       "far away",
                       "take control = \"top\""),
        needs.held};
    schema.removed({"drive.hold", "", "it is called drive.control",
                    "write control = \"top\" or \"mean-height\""});
    schema.removed({"drive.states", "", "a run reports one state at zero load",
                    "leave it out; `asperity states SCENE` searches for further states"});
    schema
        .number("displacement_step", drive.displacement_step, "Å", positive(),
                "largest step of the quantity of drive.control between points of a quasi-static "
                "path; in a slide over a wall at least half a spacing of the sites")
        .needs = {needs.equilibria};
    schema
        .number_or("stiffness", drive.stiffness, "none", "N/m", positive(),
                   "stiffness of a spring between drive and top plane, for the whole box, like the "
                   "cantilever of an instrument; \"none\": the drive moves the top plane itself")
        .needs = {
        needs.held,
        needs.refusing({[&scene] { return scene.drive.control == Control::top; }, ""},
                       "with drive.control = \"mean-height\"",
                       "the mean height is prescribed as by a machine that is hard, whatever holds "
                       "the top plane",
                       "take control = \"top\", or leave stiffness out"),
        needs.refusing({[&scene] { return scene.block.prony.empty(); }, ""}, "with block.prony",
                       "what a block remembers is measured from a top plane that the drive moves",
                       "leave stiffness or prony out"),
        needs.refusing(
            {[&needs] { return !needs.dynamic.is_met() || !needs.temperature.is_met(); }, ""},
            "with drive.temperature",
            "a top plane on a spring is damped without thermal noise of its own, and would cool "
            "the block",
            "leave stiffness or temperature out")};
    schema
        .number_or("mass", drive.mass, "block", "u", positive(),
                   "mass of the top plane on the spring of drive.stiffness; \"block\": the mass of "
                   "the block's nodes, so that the spring does not oscillate faster than the block")
        .needs = {needs.dynamic, needs.spring};
    schema.removed({"drive.step", "", "it is called drive.displacement_step",
                    "write displacement_step with the same length"});
    bind_motion(schema, scene, needs);
}

/// Adds the keys of the section [theory].
void bind_theory(io::Schema& schema, Scene& scene, const Needs& needs) {
    auto& theory = scene.theory;
    schema.section("theory", "Persson's theory for the same surface.");
    schema
        .number_or("delta_gamma", theory.delta_gamma, "flat", "meV/Å^2", positive(),
                   "Δγ of the theory; \"flat\": the flat reference of the scene's interface")
        .needs = {needs.one_layer};
    schema
        .number("beta", theory.beta, "", io::Range{0.0, 1.0, true, false},
                "β, correction to the elastic energy of partial contact")
        .needs = {needs.one_layer};
    schema
        .choice<std::optional<AreaFactor>>(
            "area_factor", theory.area_factor,
            {{"auto", std::nullopt},
             {"gaussian", AreaFactor::gaussian},
             {"small-slope", AreaFactor::small_slope},
             {"none", AreaFactor::none},
             {"lattice", AreaFactor::lattice}},
            "area that adheres, over the projected area: 1 (\"none\"), or a factor that follows "
            "from "
            "the slope; \"auto\": \"none\" over a wall, whose law acts on the projected area, and "
            "\"gaussian\" over atoms")
        .needs = {needs.one_layer};
    schema
        .choice<TheorySpectrum>(
            "spectrum", theory.spectrum,
            {{"target", TheorySpectrum::target}, {"realised", TheorySpectrum::realised}},
            "spectrum of the theory: the scene's power law, or the spectrum of the surface")
        .needs = {needs.one_layer};
    schema.key("clip", theory.clip, "clip the target spectrum at Nyquist, like the surface")
        .needs = {needs.one_layer};
    schema.removed({"theory.renormalised", "", "the renormalised theory is no part of a run",
                    "leave it out; `asperity theory`, sweeps and reports compute it"});
}

/// Adds the keys of the section [numerics].
void bind_numerics(io::Schema& schema, Scene& scene) {
    auto& numerics = scene.numerics;
    schema.section("numerics", "Arithmetic.");
    schema.choice<Precision>("precision", numerics.precision,
                             {{"double", Precision::double_precision}, {"mixed", Precision::mixed}},
                             "precision of the pairs across the interface; \"mixed\": single "
                             "precision, for a substrate with the block's lattice");
    schema.removed(
        {"numerics.accuracy", "",
         "it held for one material; `asperity cost` measures the errors of the scene itself",
         "leave it out; `asperity cost SCENE --target 1%` prints the cheapest --set that "
         "keeps an error"});
    using Device = DeviceChoice::Kind;
    std::vector<std::pair<std::string, DeviceChoice>> devices = {
        {"none", {}}, {"emulated", {Device::emulated}}, {"auto", {Device::automatic}}};
    for (int n = 0; n < 8; ++n)
        devices.push_back({std::to_string(n), {Device::cuda, n}});
    schema
        .choice<DeviceChoice>("device", numerics.device, devices,
                              "computes the time steps on the processor (\"none\"), or on a CUDA "
                              "device by its number (further ranks of a machine use the following "
                              "devices in turn); \"auto\": on a CUDA device if there is one; "
                              "\"emulated\": a device emulated by the processor, for tests")
        .numerals = true;
}

/// Adds the keys of the section [output].
void bind_output(io::Schema& schema, Scene& scene, const Needs& needs) {
    auto& output = scene.output;
    schema.section("output", "The output of a run.");
    schema
        .number_or("trajectory", output.trajectory, "none", "", at_least(1),
                   "steps between frames of the lowest layer (H5MD, in run.h5)")
        .needs = {needs.refusing(
        needs.dynamic, "", "frames are taken from time steps, and a quasi-static path has none",
        "leave it out: the maps of output.fields hold the states")};
    schema
        .key("velocities", output.velocities,
             "writes velocities in the frames of the trajectory too")
        .needs = {needs.dynamic, needs.trajectory};
    schema.list("fields", output.fields,
                {"relaxed", std::string(after_approach), "pull-off", "segments", "every:"},
                "times of maps: of the relaxed state, a number of ps after the end of the "
                "approach, at the largest attraction of the pull-off, at the end of each segment "
                "of drive.path, and periodically, in steps (points of a quasi-static path)");
    schema.removed(
        {"output.fields", "zero-load", "the state can carry a load", "write \"relaxed\""});
    schema.removed({"output.fields", "after-zero-load:", "it is the time after the approach",
                    "write \"after-approach:N\""});
    const io::Schema::Need mapped = Needs::acting(
        {[&output] { return !output.fields.empty(); }, "output.fields names no state"},
        "take output.fields = [\"relaxed\"]", {"output.fields"});
    schema
        .choice<StressPoints>(
            "stress", output.stress.points,
            {{"none", StressPoints::none},
             {"section", StressPoints::section},
             {"volume", StressPoints::volume}},
            "stresses below the surface with each map of a state: the largest ones with "
            "their places, and all components in a vertical section and at the depth of "
            "the largest (section), or at all depths of the section too (volume)")
        .needs = {
        needs.refusing(needs.equilibria, "on a dynamic path", "its solids are not in equilibrium",
                       "take drive.mode = \"quasistatic\", or stress = \"none\""),
        needs.refusing(needs.wall, "over atoms",
                       "the forces between single atoms are no pressure on a continuum",
                       "take interface.kind = \"wall\", or stress = \"none\""),
        needs.refusing({[&scene] { return scene.block_model() == BlockModel::continuum; }, ""},
                       "with a lattice", "the stresses are those of a continuum",
                       "take block.model = \"continuum\", or stress = \"none\""),
        mapped};
    const io::Schema::Need stressed =
        Needs::acting({[&output] { return output.stress.points != StressPoints::none; },
                       "output.stress is \"none\""},
                      "take output.stress = \"section\"", {"output.stress"});
    schema
        .number_or("stress_depth", output.stress.depth, "auto", "Å", positive(),
                   "largest depth of the section; \"auto\": three times the depth of the largest "
                   "stress of von Mises, and all layers")
        .needs = {stressed};
    schema
        .integer("stress_depths", output.stress.depths, between(2, 1024),
                 "number of depths of the section, from the surface")
        .needs = {stressed};
    schema
        .number(
            "stress_friction", output.stress.friction, "", between(-2.0, 2.0),
            "friction coefficient of a traction along x in phase with the pressure, where it is "
            "repulsive: the block slides along +x over the substrate")
        .needs = {stressed};
    schema.integer("series", output.series, at_least(1), "steps between rows of the series")
        .needs = {needs.dynamic};
    schema.number_or_none("checkpoint", output.checkpoint, "s", positive(),
                          "wall time between checkpoints");
}

} // namespace

io::Schema bind(Scene& scene) {
    io::Schema schema;
    const auto shared_needs =
        std::make_shared<const Needs>(scene); // the closures of the needs refer to it
    const Needs& needs = *shared_needs;
    bind_surface(schema, scene, needs);
    bind_block(schema, scene, needs);
    bind_interface(schema, scene, needs);
    bind_drive(schema, scene, needs);
    bind_theory(schema, scene, needs);
    bind_numerics(schema, scene);
    bind_output(schema, scene, needs);

    schema.variations({"sweep",
                       "What `asperity sweep` varies: any key above, with a list of values or a "
                       "range start:stop:step or start:stop:xFACTOR. Other commands pass over it.",
                       "surface.rms = [1, 2, 3]", &scene.sweep});
    schema.own(shared_needs);
    return schema;
}

} // namespace asperity
