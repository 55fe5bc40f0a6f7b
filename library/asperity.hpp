// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// libasperity: runs of Asperity from C++, and its engine in a loop of your own.
//
// clang-format off
//     #include <asperity.hpp>
//     #include <cstdio>
//
//     int main() {
//         libasperity::Options options;
//         options.progress = [](const libasperity::Progress& now) { std::puts(now.phase.c_str()); };
//         const auto scene = libasperity::Scene::read("scene.toml", {"surface.sites=64"});
//         const auto result = libasperity::run(scene, "results/mine", options);
//         const auto gap = result.map("zero-load", "gap");
//         std::printf("%g %s\n", result.number("binding_energy"),
//                     result.unit("binding_energy").c_str());
//     }
// clang-format on
//
// Keys of scenes are in docs/reference/scene.md, names and units of results in
// docs/reference/result.md; they mean the same here as for the program. Every function throws
// libasperity::Error. A run takes OpenMP's threads; two runs at once in one process are not
// supported.
//
// Versions: MAJOR.MINOR.PATCH. Before 1.0 a new MINOR may change this header and has a soname of
// its own (libasperity.so.0.1); from 1.0 on only a new MAJOR does. The classes hold one pointer
// each; std::string, std::vector and std::function cross the border, so compile with the C++
// library that libasperity was compiled with (its new string ABI).
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#define LIBASPERITY_API __attribute__((visibility("default")))

namespace libasperity {

/// "0.1.0", of the library in use.
LIBASPERITY_API std::string version();

/// What went wrong, why, and what to do, as the program would print it.
class LIBASPERITY_API Error : public std::runtime_error {
public:
    Error(int code, const std::string& text) : std::runtime_error(text), code_(code) {}
    /// The program's exit code: 1 internal, 2 scene or call, 3 physics guard, 4 files.
    int code() const { return code_; }

private:
    int code_;
};

/// Everything that a run is told, read and checked.
class LIBASPERITY_API Scene {
public:
    /// From a TOML file. overrides: "section.key=value", as behind --set.
    static Scene read(const std::string& file, const std::vector<std::string>& overrides = {});
    /// From TOML text. name: of the scene, in messages and in the result.
    static Scene parse(const std::string& text, const std::vector<std::string>& overrides = {},
                       const std::string& name = "scene");

    std::string name() const;
    std::string toml() const; ///< every key with its value
    /// Worth knowing before a run, not wrong.
    std::vector<std::string> notes() const;

    class Inside;
    const Inside& inside() const { return *inside_; }

private:
    explicit Scene(std::shared_ptr<const Inside> inside) : inside_(std::move(inside)) {}
    std::shared_ptr<const Inside> inside_;
};

struct Progress {
    std::string phase;      ///< for people: "approach, F = -12.3 eV/Å"
    long long steps = 0;    ///< or iterations
    double time = 0.0;      ///< fs; 0 where no time passes
    double fraction = -1.0; ///< of the whole path, 0 to 1; negative: unknown
};

struct Options {
    /// Called about five times a second on rank 0. What it throws ends the run, without a
    /// checkpoint.
    std::function<void(const Progress&)> progress;
    /// Asked about twice a second on rank 0, between steps or iterations. True: the run writes a
    /// checkpoint and returns a result that is not finished.
    std::function<bool()> stop;
    double wall_limit = 0.0; ///< s; as if stop said true then; 0: none
    bool resume = false;     ///< go on from the checkpoint in the directory, if there is one
    bool restart = false;    ///< throw away an unfinished run in the directory
};

/// Values on the lattice: values[y * nx + x].
struct Map {
    std::size_t ny = 0, nx = 0;
    std::string unit;
    std::vector<double> values;
    double at(std::size_t y, std::size_t x) const { return values.at(y * nx + x); }
};

/// What a run left in its directory.
class LIBASPERITY_API Result {
public:
    static Result load(const std::string& directory);

    std::string directory() const;
    /// False: stopped before the end of its path, or failed; Options::resume goes on.
    bool finished() const;
    /// Why not: "signal" (also Options::stop), "wall_limit", "max_steps", or the failure. Else
    /// empty.
    std::string stopped() const;

    /// A number of result.json by its name; dots lead deeper: "theory.gamma_eff".
    bool has(const std::string& name) const;
    double number(const std::string& name) const;
    std::string unit(const std::string& name) const; ///< "1" for a pure number
    std::string json() const;                        ///< the whole file

    /// A column of the series along the path: "mean_height", "force".
    std::vector<std::string> series() const;
    std::vector<double> series(const std::string& column) const;
    /// States with maps ("zero-load"), the names of their maps ("gap", "pressure"), and one of
    /// them.
    std::vector<std::string> states() const;
    std::vector<std::string> maps(const std::string& state) const;
    Map map(const std::string& state, const std::string& name) const;
    /// Heights of the substrate.
    Map heights() const;

    class Inside;

private:
    explicit Result(std::shared_ptr<const Inside> inside) : inside_(std::move(inside)) {}
    std::shared_ptr<const Inside> inside_;
};

/// Runs the scene and writes into the directory, which is made; a finished result there is refused.
/// Prints nothing on the standard output. Collective on all ranks of a Parallel: an error of the
/// scene or of the physics is thrown on all of them; any other ends them all, as the program does.
LIBASPERITY_API Result run(const Scene& scene, const std::string& directory,
                           const Options& options = {});

// ---- In your own loop: an engine that is stepped, looked at and led by the program.
//
//     libasperity::Simulation sim(libasperity::Scene::read("scene.toml"));
//     while (!sim.done() && sim.force() <= 0.0) sim.step(100);
//     sim.set_top_velocity(-2.0);
//
// Objects may live side by side, and calls that work (step, relax, save) wait for each other. An
// object is a handle: copies of it are the same engine. A Simulation takes the ranks of a Parallel,
// each of which has a tile of the sites: all of them make the same calls with the same arguments,
// but for what is written to their own sites.

/// Values on the lattice where the engine has them, row by row; keeps the engine alive. Those of a
/// simulation are current until its next step, and again when step() has returned or an observer is
/// called.
struct View {
    double* data = nullptr;
    std::size_t ny = 0, nx = 0;
    std::ptrdiff_t row = 0; ///< distance between rows, in doubles
    std::shared_ptr<const void> owner;
    double& operator()(std::size_t y, std::size_t x) const {
        return data[static_cast<std::ptrdiff_t>(y) * row + static_cast<std::ptrdiff_t>(x)];
    }
};
struct VectorView {
    View x, y, z;
};

/// Sites of a rank: ny times nx from (y, x) on.
struct Tile {
    std::size_t y = 0, x = 0, ny = 0, nx = 0;
};

/// eV, since the start; balance_error: what the energy balance is off by, over the largest of its
/// terms.
struct Energies {
    double elastic = 0.0, interface = 0.0, kinetic = 0.0;
    double work = 0.0;   ///< done on the block: by the top plane, the medium that damps, noise,
                         ///< and an external field
    double damped = 0.0; ///< lost to the medium that damps
    double balance_error = 0.0;
};

/// Of the two ways of a path, meV/Å^2; empty until that way has ended.
struct BothWays {
    std::optional<double> approach, pull_off;
};

/// Of each site: height above the substrate below it, Å; whether its nearest atom is in contact (1
/// or 0); normal force per a^2, GPa (positive pushes apart).
struct SiteMaps {
    Map gap, contact, pressure;
};

/// A state of force balance under no load.
struct RestState {
    double binding_energy = 0.0; ///< meV/Å^2
    double elastic_energy = 0.0; ///< meV/Å^2
    double contact_fraction = 0.0, repulsive_fraction = 0.0;
    double mean_height = 0.0; ///< Å
    double residual = 0.0;    ///< largest force left on a site, eV/Å
    long long iterations = 0;
    SiteMaps maps;
};

/// A scene's path in time, a step at a time.
///
/// A step takes forces at its start and then moves the sites. Its numbers (time, force, energies)
/// are those of that start, as in the rows of a run's series; u has moved on by one step when it
/// returns. The path starts and turns as `asperity run` has it, to the same bits.
class LIBASPERITY_API Simulation {
public:
    /// Throws Error 2 for a scene without time, and for what a run would refuse.
    explicit Simulation(const Scene& scene);
    Scene scene() const;
    /// From a file of save(): the same bits as if it had never stopped.
    static Simulation resume(const std::string& file);

    /// Called about twenty times a second between steps or iterations. What it throws ends the call
    /// there; the state is whole.
    using Look = std::function<void()>;
    /// n steps, or fewer: none are made past the end of the scene's path (done()). Returns how many
    /// were. The last one is observed, as are those of output.series and of observers. Throws Error
    /// 3 where the physics fails a guard: then this simulation has ended.
    long long step(long long n = 1, const Look& look = {});
    /// f is called after each step whose number divides by n, which is observed. Observers look and
    /// write as the program does between two steps, but do not step.
    void every(long long n, std::function<void()> f);
    /// The path has come to its end. Never while the top is led by hand.
    bool done() const;

    // Of the last step; zero before the first one.
    long long steps() const;    ///< that were made
    double time() const;        ///< ps
    double force() const;       ///< of the substrate on the lowest layer, eV/Å; positive pushes
    double top_force() const;   ///< elastic, on the top plane, eV/Å
    double mean_height() const; ///< of the lowest layer above the substrate's zero, Å
    // Of the last observed step.
    Energies energy() const;
    double contact_fraction() const;   ///< sites whose nearest atom is in contact, over all
    double repulsive_fraction() const; ///< sites that are pushed away

    // Of the ways of the scene's path, as in result.json.
    std::string segment() const; ///< of drive.path, as the scene has it; "done" after the last
    BothWays work_of_adhesion() const;
    BothWays work_of_drive() const;
    std::optional<double> lost_in_cycle() const; ///< meV/Å^2

    // The top plane. It is led by the scene's drive until a velocity is given.
    double top_position() const; ///< displacement since the start, Å
    /// At once: the plane stands there in the next step. Far jumps send a wave through the block.
    void set_top_position(double z);
    double top_velocity() const; ///< in the next step, m/s; positive moves away
    void set_top_velocity(double v);
    void release_top(); ///< back to the scene's drive, where that was

    // Of the lowest layer, not copied. What is written to u or v is felt by the next step, and the
    // energy balance then starts anew; values that are no numbers are refused there (Error 2).
    VectorView u(); ///< displacements, Å
    VectorView v(); ///< velocities half a step before u, Å/fs
    /// Forces of the last step, of the substrate and from outside, eV/Å; to be read. Not on a
    /// device.
    VectorView f();
    View substrate_height() const; ///< Å; to be read
    double substrate_edge() const; ///< of the box, Å
    double spacing() const;        ///< of the sites, Å
    Tile tile() const;             ///< whose sites the views and maps of this rank are
    SiteMaps maps() const;         ///< of the sites as they are now

    /// Forces on the sites of the lowest layer beside the substrate's, eV/Å, from the next step on;
    /// they are copied. Throws Error 2 for another shape, for values that are no numbers, and on a
    /// device.
    void set_external(const Map& x, const Map& y, const Map& z);
    /// The field that acts, to be changed in place; empty views where none does.
    VectorView external();
    void clear_external();
    double external_work() const; ///< done by it so far, eV

    /// The state at zero load that the sites come to from where they are. A copy is relaxed: the
    /// simulation stays as it is. Throws Error 3 if none is found, 2 with an external field.
    RestState relax(const Look& look = {});

    /// Everything but the observers, in one file (HDF5).
    void save(const std::string& file);

    class Inside;

private:
    explicit Simulation(std::shared_ptr<Inside> inside) : inside_(std::move(inside)) {}
    std::shared_ptr<Inside> inside_;
};

/// A point of a path without time: force balance at what is held.
struct Point {
    double top = 0.0; ///< displacement of the top plane since the start, Å; 0 where the mean
                      ///< height is held
    double mean_height = 0.0; ///< of the lowest layer above the substrate's zero, Å
    double force = 0.0;       ///< of the substrate on the lowest layer, eV/Å; positive pushes
    double energy = 0.0;      ///< elastic and of the interface, eV
    double elastic_energy = 0.0, interface_energy = 0.0; ///< eV
    double work = 0.0;       ///< of what holds the block, since the start, eV
    double dissipated = 0.0; ///< at instabilities, since the start, eV
    long long instabilities = 0;
    double contact_fraction = 0.0, repulsive_fraction = 0.0;
    long long number = 0; ///< of points since the start
};

/// A scene without time: its solids in force balance, where they are led. What is found depends on
/// the way there, as on a path of `asperity run`; what is lost on it is counted.
///
///     libasperity::Statics statics(libasperity::Scene::read("scene.toml"));
///     statics.set_mean_height(3.1);
///     const libasperity::Point point = statics.relax();
///
/// It starts out of reach. The mean height is held, or the top plane; the first one that is set
/// decides, or a load, which then holds what drive.hold says. Of a scene in time the same solids
/// are taken, as if drive.mode were "quasistatic".
class LIBASPERITY_API Statics {
public:
    explicit Statics(const Scene& scene);
    /// Where the next relax() goes. Throw Error 2 where the other one is held.
    void set_mean_height(double z); ///< Å above the substrate's zero
    void set_top(double z);         ///< displacement since the start, Å
    /// MPa; positive presses. Reached where the force comes to it, from below on the way in, from
    /// above on the way out.
    void set_load(double pressure);
    /// "100 MPa"
    void set_load(const std::string& pressure);
    /// Goes there, point by point, and returns the point there (without a target: where it is).
    /// look: as of Simulation; after what it throws, the same call goes on. Throws Error 3 where no
    /// equilibrium is found, or where the solids part before a pull is reached.
    Point relax(const Simulation::Look& look = {});
    Point now() const;     ///< of the last relax()
    SiteMaps maps() const; ///< of the sites there

    class Inside;

private:
    std::shared_ptr<Inside> inside_;
};

/// In a program that mpirun starts: MPI and runs on all its ranks, from the construction of the one
/// object to its end. Does nothing in a program started alone. Without it a run takes one process.
/// Throws Error where a launcher has started several processes that MPI does not connect. Where
/// OMP_NUM_THREADS is not set, the ranks of a machine share its processors from then on.
class LIBASPERITY_API Parallel {
public:
    Parallel(int& argc, char**& argv);
    /// In a program that has started MPI itself: the ranks of a communicator, by its number in
    /// Fortran (MPI_Comm_c2f). What is begun before the object ends keeps them.
    explicit Parallel(int communicator);
    ~Parallel();
    Parallel(const Parallel&) = delete;
    Parallel& operator=(const Parallel&) = delete;
    int rank() const;
    int size() const;

private:
    class Inside;
    std::unique_ptr<Inside> inside_;
};

} // namespace libasperity
