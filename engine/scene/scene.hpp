// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The scene: all settings of a user, as a plain struct in the units of the scene file.
//
// Scene{} is the paper's flat case. bind() connects every field with its key, unit, range and line
// of documentation. Its list is the only place with the names of keys; the reader, `asperity
// defaults`, result.json and docs/reference/scene.md follow from the list. Names and defaults do
// not change from release to release: tests/engine/scene_test.cpp has them all. resolve()
// (engine/case/case.hpp) checks a scene and derives the case.
#pragma once

#include "engine/options/device_choice.hpp"
#include "engine/options/drive_options.hpp"
#include "engine/options/output_options.hpp"
#include "engine/options/theory_options.hpp"
#include "engine/scene/surface.hpp"
#include "io/scene_reader.hpp"
#include "io/site_quantities.hpp"
#include "kernels/pair_potential.hpp"

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

namespace asperity {

// Choices of the keys of a scene; bind() has their words and meanings.
enum class Detrend { none, plane, periodic };
enum class Boundary { periodic, free };
enum class MapMissing { refuse, fill, hole };
enum class MapCrop { none, middle };
enum class Resample { none, band_limited };
/// Model of the block: cells of the lattice, all or coarser with depth on dynamic paths, or on
/// quasi-static paths over a wall a continuum; automatic stands for one of them
/// (Scene::block_model()).
enum class BlockModel { automatic, lattice, multiscale, continuum };
enum class Strain { linear, finite };
enum class InterfaceKind { atoms, wall };
enum class WallLawKind { smeared, exponential, dugdale, power, nine_three, eight_two, table };
/// Treatment of spheres whose contact edge is pinned by rows of sites.
enum class EdgePinning { refuse, allow };
enum class DriveMode { dynamic, quasistatic };
enum class Precision { double_precision, mixed };
/// Returns a tuple with one object of each kind of PairPotential; declared for its type only.
template <class... P>
std::tuple<P...> one_of_each(const std::variant<P...>&);
using EachPotential = decltype(one_of_each(PairPotential()));

/// Prefix of an entry of output.fields: "after-approach:140", 140 ps after the end of the approach.
inline constexpr std::string_view after_approach = "after-approach:";

/// Bounds of the numbers of sites and layers.
inline constexpr int fewest_sites = 4, most_sites = 32768, most_layers = 1 << 20;

/// Keys of a quantity that may be a map of the sites (engine/case/site_map.hpp).
struct SiteMapKeys {
    std::string source{};         ///< file of a map, or a formula; empty: one number for all sites
    std::optional<double> size{}; ///< edge of the map, Å; empty: as surface.file_size
    std::string unit = "auto";    ///< unit of the map; "auto": that of the file, else the key's
    MapMissing missing = MapMissing::refuse;
    MapCrop crop = MapCrop::none;

    /// Returns true if the scene has a map.
    bool given() const { return !source.empty(); }
};

/// A scene, with one struct for each section.
struct Scene {
    /// Section [surface].
    struct Surface {
        SurfaceKind kind = SurfaceKind::self_affine;
        int sites = 512;                        ///< N
        double spacing = 2.6;                   ///< a, Å
        Boundary boundary = Boundary::periodic; ///< edges of the box
        double lattice_ratio = 1.0;             ///< block spacing divided by substrate spacing
        double rms = 3.0; ///< Å; maps from a file are scaled only if the key is given
        double hurst = 0.8;
        double rolloff = 3.0;        ///< q0 / q_L
        std::optional<double> q_max; ///< q1 / q_L; empty: the Nyquist wavevector, sites/2
        Amplitudes amplitudes = Amplitudes::gaussian;
        long long seed = 1;
        std::optional<double> radius;    ///< Å; empty: not curved
        std::string file = "heights.h5"; ///< file as the scene gives it
        /// Edge of the map, Å; empty: as the file states, otherwise the edge of the box.
        std::optional<double> file_size;
        /// Unit of the heights; "auto": as the file states, otherwise Å.
        std::string file_unit = "auto";
        MapMissing file_missing = MapMissing::refuse;
        MapCrop file_crop = MapCrop::none;
        Detrend detrend = Detrend::none;
        LineNoise line_noise = LineNoise::keep;
        Resample resample = Resample::none;

        /// Second solid, with a surface of its own, whose map lies on that of the keys above.
        struct Counter {
            std::string file = "none";    ///< file of its map as the scene gives it
            std::optional<double> size{}; ///< edge of the map, Å; empty: as `file_size`
            std::string unit = "auto";    ///< unit of the heights
            MapMissing missing = MapMissing::refuse;
            MapCrop crop = MapCrop::none;
            double shift_x = 0.0, shift_y = 0.0; ///< Å
            double turn = 0.0;                   ///< degrees, counter-clockwise from above
            std::optional<double> young{};       ///< GPa; empty: rigid
            double poisson = 0.42;
            std::vector<std::array<double, 3>> layers{}; ///< rows as in Block::layers
            double surface_stress = 0.0;                 ///< N/m

            bool given() const { return file != "none" && !file.empty(); }
            bool is_elastic() const { return given() && young.has_value(); }
        } counter;

        bool reads_file() const { return kind == SurfaceKind::file || kind == SurfaceKind::atoms; }
    } surface;

    /// Section [block].
    struct Block {
        BlockModel model = BlockModel::automatic; ///< value in the scene
        double young = 77.2;                      ///< GPa
        double poisson = 0.42;
        double atom_mass = 197.0; ///< u
        int thickness = 512;      ///< number of lattice layers; default after reading: N
        int layers_per_level = 4;
        Strain strain = Strain::linear;
        /// Branches: modulus divided by young, and relaxation time, ps.
        std::vector<std::array<double, 2>> prony;
        /// Layers from the surface upwards: thickness, Å, Young's modulus, GPa, Poisson's ratio.
        std::vector<std::array<double, 3>> layers;
        double surface_stress = 0.0; ///< N/m
    } block;

    /// Origin of block.prony and block.young if block.prony names a file.
    struct Fit {
        std::string file;                ///< name in the scene; empty: the scene lists the branches
        std::string found;               ///< path of the file
        std::string source;              ///< the measurement to which the branches were fitted
        double young = 0.0;              ///< relaxed modulus of the file, GPa
        std::optional<double> rms_error; ///< relative error of the fit
    } fit;

    /// Section [interface].
    struct Interface {
        InterfaceKind kind = InterfaceKind::atoms;
        int potential = 0; ///< index of a kind of PairPotential
        /// Parameters of all kinds; the cutoff is the member below.
        EachPotential potentials;
        std::string table = "table.txt"; ///< file of potential = "table", as the scene gives it
        std::optional<double> cutoff;    ///< Å; empty: 4 r0; r0 is the zero of the potential
        std::vector<std::string> pairs;  ///< potentials of atoms from a file, by type
        bool tail = false;
        /// Normal displacements only; after reading: true over a wall.
        bool frictionless = false;
        WallLawKind law = WallLawKind::exponential; ///< law of a wall
        double adhesion = 100.0; ///< work of adhesion, meV/Å^2; laws except "smeared"
        /// Largest net pressure of a site over a wall, GPa; empty: no site yields.
        std::optional<double> hardness;
        /// Keys of the maps of the sites; in a case the number beside a map is its largest value.
        PerSiteMap<SiteMapKeys> maps;
        double range = 1.0;    ///< range, Å; laws except "smeared" and "table"
        double exponent = 3.0; ///< exponent of the law "power"
        /// Stiffness of the repulsion, GPa/Å, of laws whose shape begins at contact; empty: derived
        /// from the block.
        std::optional<double> stiffness;
        EdgePinning edge_pinning = EdgePinning::refuse;

        /// Returns the quantities for which the scene has a map of the sites.
        std::vector<io::SiteQuantity> site_maps() const {
            std::vector<io::SiteQuantity> given;
            for (const io::SiteQuantity& of : io::site_quantities)
                if (maps[of.map].given()) given.push_back(of);
            return given;
        }
        /// Returns true for a wall with a law other than "smeared", which has a work of adhesion as
        /// a key.
        bool has_adhesion() const {
            return kind == InterfaceKind::wall && law != WallLawKind::smeared;
        }
        /// Returns true for laws whose shape includes a repulsion.
        bool shape_repels() const {
            return law == WallLawKind::nine_three || law == WallLawKind::eight_two ||
                   law == WallLawKind::table;
        }
        std::string potential_name() const; ///< returns the value of interface.potential
    } interface;

    /// Section [drive].
    struct Drive {
        DriveMode mode = DriveMode::dynamic;
        std::vector<std::string> path = {"approach", "pull-off"}; ///< segments (segment.hpp)
        double velocity = 5.0;                                    ///< m/s
        double displacement_step = 0.25;                          ///< Å
        Control control = Control::top;  ///< held quantity of a quasi-static path
        std::optional<double> stiffness; ///< N/m, of the whole box; empty: rigid
        std::optional<double> mass;      ///< u, of a top plane on a spring; empty: the block's
        double timestep = 10.0;          ///< fs
        double damping = 0.05;           ///< 1/ps
        double damping_from = 0.0;       ///< fraction of the thickness above which damping acts
        std::optional<double> ramp;      ///< ps; empty: one sound transit of the block
        double load = 0.0;               ///< MPa
        double temperature = 0.0;        ///< K
        long long seed = 1;              ///< seed of the thermal noise
        long long max_steps = 0;         ///< 0 ("none"): no limit
        double tolerance = 2.5e-4;       ///< fraction of the smallest force that decides the state
    } drive;

    TheoryOptions theory;

    /// Section [numerics].
    struct Numerics {
        Precision precision = Precision::double_precision;
        DeviceChoice device;
    } numerics;

    /// Section [output].
    struct Output : OutputOptions {
        std::vector<std::string> fields = {"relaxed"};
    } output;

    std::vector<io::Variation> sweep; ///< [sweep]: for `asperity sweep` only

    /// surface.sites and block.thickness given as lengths, Å; reading converts the lengths to
    /// numbers of sites and layers.
    std::optional<double> width, height;
    /// drive.load given as a force, nN; reading converts the force to a pressure.
    std::optional<double> force;

    // Origin of the scene.
    std::string file;           ///< file as given on the command line
    std::string name = "scene"; ///< the file's name without folder and ending
    io::Positions positions;

    /// Returns true for a dynamic path, which is made of time steps.
    bool is_dynamic() const;
    /// Returns the model of the block: block.model, or the one that "auto" stands for.
    BlockModel block_model() const;
    /// Returns true if the path is a single relaxation.
    bool only_relaxes() const;
    /// Returns the edge of the box, Å
    double edge() const { return surface.sites * surface.spacing; }
    /// Returns an empty list of problems that knows the positions of this scene's keys.
    io::Problems problems() const { return io::Problems(positions); }
    bool has_free_edges() const { return surface.boundary == Boundary::free; }
    /// Returns true if the scene reads a map of heights, of surface.file or surface.counter.
    bool reads_map() const { return surface.kind == SurfaceKind::file || surface.counter.given(); }
    /// Returns true if the scene sets surface.rms; otherwise maps are not scaled.
    bool gives_rms() const { return positions.is_set("surface.rms"); }
};

/// Sets the number beside a map of the sites to the largest value of the map, in the key's unit.
void set_largest(Scene::Interface& interface, SiteMapOf map, double largest);

/// Returns all keys, bound to the fields of this scene, which must outlive the schema.
io::Schema bind(Scene& scene);

/// Adds to problems the keys whose needs (column `needs` of bind()) are not met and which are
/// refused without them.
void refuse_unmet_needs(const Scene& scene, io::Problems& problems);
/// Returns notes on keys that are set but have no effect, one sentence for each reason.
std::vector<std::string> notes_on_idle_keys(const Scene& scene);

/// Reads the keys of a scene. Overrides are "section.key=value". Throws io::SceneError with the
/// mistakes in single keys; resolve() (engine/case/case.hpp) checks the keys together.
Scene read_scene(const std::string& file, const std::vector<std::string>& overrides = {});
/// Reads a scene from a text in memory. file: name shown in messages. Throws io::SceneError.
Scene read_scene_text(const std::string& text, const std::string& file,
                      const std::vector<std::string>& overrides = {});
/// Reads a scene from a text in memory and adds its mistakes to problems; wrong keys keep their
/// defaults.
Scene read_scene_text(const std::string& text, const std::string& file,
                      const std::vector<std::string>& overrides, io::Problems& problems);

/// Returns the scene as TOML, with_docs: with a comment for each key.
std::string scene_toml(const Scene& scene, bool with_docs = true);
/// Returns the values of all keys: {section: {key: value}}.
nlohmann::ordered_json scene_json(const Scene& scene);
/// Returns the unit of each value of scene_json(), in the same form.
nlohmann::ordered_json scene_units(const Scene& scene);
/// Returns the page docs/reference/scene.md.
std::string scene_markdown();

} // namespace asperity
