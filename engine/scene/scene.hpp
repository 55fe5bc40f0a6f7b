// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The scene: everything a user may choose, as a plain struct in the units of the scene file.
//
// Scene{} is the paper's flat case. bind() ties every field to its key, unit, range and line of
// documentation; that list is the only place where keys are named, and the reader, `asperity
// defaults`, result.json and docs/reference/scene.md all follow from it. Names and defaults do not
// change from release to release: tests/engine/scene_test.cpp has them all. What a scene means, and
// what is wrong with it, is found by resolve() (engine/setup/case.hpp).
#pragma once

#include "engine/scene/device_choice.hpp"
#include "engine/scene/surface.hpp"
#include "io/scene_reader.hpp"
#include "kernels/pair_potential.hpp"
#include "theory/area_factor.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

namespace asperity {

enum class Detrend { none, plane, periodic };
enum class MapMissing { refuse, fill };
enum class MapCrop { none, middle };
enum class Resample { none, band_limited };
/// How the block is resolved on a dynamic path. On quasi-static paths it is the waves of the
/// lattice.
enum class BlockModel { lattice, multiscale };
enum class Strain { linear, finite };
enum class InterfaceKind { atoms, wall };
enum class WallLawKind { smeared, exponential };
/// Of rows of sites that hold the edge of a contact.
enum class EdgePinning { refuse, allow };
enum class DriveMode { dynamic, quasistatic };
/// What a quasi-static path moves from point to point.
enum class Control { top, mean_height };
using theory::AreaFactor;
enum class TheorySpectrum { target, realised };
enum class Precision { double_precision, mixed };
/// One of each kind of PairPotential.
template <class... P>
std::tuple<P...> one_of_each(const std::variant<P...>&);
using EachPotential = decltype(one_of_each(PairPotential()));

/// Of output.fields: "after-approach:140", 140 ps after the approach has ended.
inline constexpr std::string_view after_approach = "after-approach:";

struct Scene {
    struct Surface {
        SurfaceKind kind = SurfaceKind::self_affine;
        int sites = 512;            ///< N
        double spacing = 2.6;       ///< a, Å
        double lattice_ratio = 1.0; ///< block spacing over substrate spacing
        double rms = 3.0;           ///< Å; a map from a file is scaled to it only if it is given
        double hurst = 0.8;
        double rolloff = 3.0;        ///< q0 / q_L
        std::optional<double> q_max; ///< q1 / q_L; empty: the Nyquist wavevector, sites/2
        Amplitudes amplitudes = Amplitudes::gaussian;
        long long seed = 1;
        std::optional<double> radius;    ///< Å; empty: not curved
        std::string file = "heights.h5"; ///< as the scene gives it
        std::optional<double>
            file_size; ///< edge of the map, Å; empty: what the file says, else the box
        std::string file_unit = "auto"; ///< of the heights; "auto": what the file says, else Å
        MapMissing file_missing = MapMissing::refuse;
        MapCrop file_crop = MapCrop::none;
        Detrend detrend = Detrend::none;
        LineNoise line_noise = LineNoise::keep;
        Resample resample = Resample::none;

        bool reads_file() const { return kind == SurfaceKind::file || kind == SurfaceKind::atoms; }
    } surface;

    struct Block {
        BlockModel model = BlockModel::multiscale;
        double young = 77.2; ///< GPa
        double poisson = 0.42;
        double atom_mass = 197.0; ///< u
        int thickness = 512; ///< lattice layers; after reading: N unless the scene says otherwise
        int layers_per_level = 4;
        Strain strain = Strain::linear;
        io::Schema::Pairs prony; ///< of each branch: modulus over young, relaxation time, ps
    } block;

    struct Interface {
        InterfaceKind kind = InterfaceKind::atoms;
        int potential = 0;               ///< which of PairPotential
        EachPotential potentials;        ///< with their keys; cutoffs come from the one below
        std::string table = "table.txt"; ///< of potential = "table", as the scene gives it
        std::optional<double> cutoff;    ///< Å; empty: 4 r0, r0 where the potential is zero
        std::vector<std::string> pairs;  ///< of atoms from a file, by type
        bool tail = false;
        bool frictionless = false;                  ///< normal displacements only; after reading:
                                                    ///< true over a wall
        WallLawKind law = WallLawKind::exponential; ///< of a wall
        double adhesion = 100.0;                    ///< meV/Å^2, exponential
        double range = 1.0;                         ///< Å, exponential
        std::optional<double> stiffness;            ///< GPa/Å, exponential; empty: by the block
        EdgePinning edge_pinning = EdgePinning::refuse;

        std::string potential_name() const;
    } interface;

    struct Drive {
        DriveMode mode = DriveMode::dynamic;
        std::vector<std::string> path = {"approach", "pull-off"}; ///< segments (segment.hpp)
        double velocity = 5.0;                                    ///< m/s
        double displacement_step = 0.25;                          ///< Å
        Control control = Control::top;                           ///< of a quasi-static path
        double timestep = 10.0;                                   ///< fs
        double damping = 0.05;                                    ///< 1/ps
        double damping_from = 0.0;  ///< fraction of the thickness above which damping acts
        std::optional<double> ramp; ///< ps; empty: one sound transit of the block
        double load = 0.0;          ///< MPa
        double temperature = 0.0;   ///< K
        long long seed = 1;         ///< of the thermal noise
        long long max_steps = 0;    ///< 0 ("none"): no limit
        double tolerance = 2.5e-4;  ///< of the smallest force that decides the state
    } drive;

    struct Theory {
        std::optional<double> delta_gamma; ///< meV/Å^2; empty: the flat reference
        double beta = 0.45;
        AreaFactor area_factor = AreaFactor::gaussian;
        TheorySpectrum spectrum = TheorySpectrum::target;
        bool clip = true;
    } theory;

    struct Numerics {
        Precision precision = Precision::double_precision;
        DeviceChoice device;
    } numerics;

    struct Output {
        std::optional<long long> trajectory; ///< steps between frames; empty: none
        bool velocities = false;             ///< in the frames too
        std::vector<std::string> fields = {"relaxed"};
        long long series = 100;    ///< steps between rows
        double checkpoint = 600.0; ///< s of wall time; 0 ("none"): none
    } output;

    std::vector<io::Variation> sweep; ///< [sweep]: for `asperity sweep` only

    /// surface.sites and block.thickness where they are given as lengths, Å; reading makes counts
    /// of them.
    std::optional<double> width, height;

    // Where it came from.
    std::string file;           ///< as given on the command line
    std::string name = "scene"; ///< the file's name without folder and ending
    io::Positions positions;

    double edge() const { return surface.sites * surface.spacing; } ///< of the box, Å
    /// An empty list of problems that knows this scene's positions.
    io::Problems problems() const { return io::Problems(positions); }
    /// The scene itself says so: only then is a map scaled.
    bool gives_rms() const { return positions.is_set("surface.rms"); }
};

/// The keys of the parameters of potentials, each with the potential's name.
std::vector<std::pair<std::string, std::string>> keys_of_potentials();

/// Every key, bound to the fields of this scene (which must outlive the schema).
io::Schema bind(Scene& scene);

/// Reads the keys; throws io::SceneError with all that is wrong with single ones. What they mean
/// together is for resolve() (engine/setup/case.hpp). Overrides are "section.key=value".
Scene read_scene(const std::string& file, const std::vector<std::string>& overrides = {});
/// The same from a text in memory; file is the name shown in messages.
Scene read_scene_text(const std::string& text, const std::string& file,
                      const std::vector<std::string>& overrides = {});
/// The same; what is wrong is added to the list, and those keys have their defaults.
Scene read_scene_text(const std::string& text, const std::string& file,
                      const std::vector<std::string>& overrides, io::Problems& problems);

std::string scene_toml(const Scene& scene, bool with_docs = true);
nlohmann::ordered_json scene_json(const Scene& scene);
/// The unit of each value there.
nlohmann::ordered_json scene_units(const Scene& scene);
/// docs/reference/scene.md
std::string scene_markdown();

} // namespace asperity
