// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// libasperity: runs of Asperity from C++.
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
// Keys of scenes are in docs/scene.md, names and units of results in docs/result.md; they mean the
// same here as for the program. Every function throws libasperity::Error. A run takes OpenMP's
// threads; two runs at once in one process are not supported.
//
// Versions: MAJOR.MINOR.PATCH. Before 1.0 a new MINOR may change this header and has a soname of
// its own (libasperity.so.0.1); from 1.0 on only a new MAJOR does. The classes hold one pointer
// each; std::string, std::vector and std::function cross the border, so compile with the C++
// library that libasperity was compiled with (its new string ABI).
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
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

/// In a program that mpirun starts: MPI and runs on all its ranks, from the construction of the one
/// object to its end. Does nothing in a program started alone. Without it a run takes one process.
/// Throws Error where a launcher has started several processes that MPI does not connect.
class LIBASPERITY_API Parallel {
public:
    Parallel(int& argc, char**& argv);
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
