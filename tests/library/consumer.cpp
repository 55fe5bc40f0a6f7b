// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
//     consumer SCENE DIRECTORY REFERENCE [one-fails]
//
// Uses all of libasperity's header from outside (tests/cli/library.sh compiles it against an
// installed prefix). REFERENCE: what the program made of the same scene. Exit code 0: all is as it
// should be. With "one-fails" the last rank alone gives run() no directory.
#include <asperity.hpp>

#include <cmath>
#include <cstdio>
#include <numeric>
#include <string>
#include <vector>

namespace {

int failures = 0;

void expect(bool right, const std::string& what) {
    if (right) return;
    std::fprintf(stderr, "FAILED: %s\n", what.c_str());
    ++failures;
}

/// The error's code and whether its text has the words; 0: nothing was thrown.
template <class Call>
int code_of(const Call& call, const std::string& words) {
    try {
        call();
    } catch (const libasperity::Error& error) {
        expect(std::string(error.what()).find(words) != std::string::npos,
               std::string("'") + words + "' in: " + error.what());
        return error.code();
    }
    return 0;
}

void same_result(const libasperity::Result& mine, const libasperity::Result& other) {
    for (const char* name : {"binding_energy", "delta_gamma", "theory.renormalised.gamma_eff"})
        expect(mine.number(name) == other.number(name), name);
    expect(mine.series() == other.series(), "names of the series");
    for (const std::string& column : mine.series())
        expect(mine.series(column) == other.series(column), "series " + column);
    expect(mine.map("zero-load", "gap").values == other.map("zero-load", "gap").values, "gaps");
}

/// Stepped by hand, the path has the rows and works of the run.
void same_steps(const libasperity::Scene& scene, const libasperity::Result& reference,
                const std::string& file) {
    using namespace libasperity;
    Simulation sim(scene);
    const std::vector<double> time = reference.series("time"), force = reference.series("force"),
                              elastic = reference.series("elastic_energy");
    std::size_t row = 0, rows = 0;
    sim.every(10, [&] {
        while (row < time.size() && time[row] < sim.time())
            ++row; // the run also records the step after each way
        expect(row < time.size() && time[row] == sim.time() && force[row] == sim.force() &&
                   elastic[row] == sim.energy().elastic,
               "the row at " + std::to_string(sim.time()) + " ps");
        ++rows;
    });
    sim.step(300);
    // A copy goes on to the same bits; a look ends a step; what is written is felt.
    sim.save(file);
    Simulation again = Simulation::resume(file);
    while (!sim.done())
        sim.step(1000);
    while (!again.done())
        again.step(1000);
    expect(rows > 20, "rows");
    expect(sim.work_of_drive().pull_off == reference.number("work_of_drive.pull_off"), "work");
    expect(sim.steps() == again.steps() && sim.force() == again.force() &&
               sim.work_of_drive().pull_off == again.work_of_drive().pull_off,
           "resumed");
    again.set_top_velocity(-1.0);
    const VectorView u = again.u();
    expect(u.x.nx == 32 && u.x.ny == 32, "shape of u");
    u.z(3, 4) += 0.01;
    const double before = u.z(3, 4);
    again.step(1);
    expect(u.z(3, 4) != before && std::abs(again.top_velocity() + 1.0) < 1e-12, "a view");
    expect(code_of([&] { again.set_external({}, {}, {}); }, "[32, 32]") == 2, "shape of a field");
    struct Enough {};
    try {
        again.step(1000000, [] { throw Enough(); });
        expect(false, "a look ends a step");
    } catch (const Enough&) {
    }
    again.step(1);
    u.z(0, 0) = NAN;
    expect(code_of([&] { again.step(1); }, "nan") == 2, "no number");
    expect(code_of([&] { Simulation(Scene::parse("drive.path = [\"zero-load\"]\n")); },
                   "no time") == 2,
           "a scene without time");
}

/// Of all ranks, each with its tile: the numbers are those of one process.
void same_steps_on_ranks(const libasperity::Scene& scene, const libasperity::Result& reference,
                         int ranks) {
    using namespace libasperity;
    Simulation sim(scene);
    const Tile tile = sim.tile();
    expect(tile.nx * tile.ny * static_cast<std::size_t>(ranks) == 32 * 32, "a tile");
    expect(sim.u().z.nx == tile.nx && sim.maps().gap.ny == tile.ny, "views of a tile");
    while (!sim.done())
        sim.step(1000);
    expect(sim.work_of_drive().pull_off == reference.number("work_of_drive.pull_off"), "work");
    expect(code_of([&] { Statics statics(scene); }, "ranks") == 2, "Statics is of one process");
}

/// Led in and out again without time: force balance there, and what was put in was lost.
void led_without_time(const libasperity::Scene& scene) {
    using namespace libasperity;
    Statics statics(scene);
    const double apart = statics.now().mean_height;
    statics.set_mean_height(4.0);
    const Point in = statics.relax();
    expect(in.mean_height == 4.0 && in.energy < 0.0 && in.contact_fraction > 0.0, "led in");
    statics.set_load("100 MPa");
    const double area = 32.0 * 32.0 * 2.6 * 2.6;
    expect(std::abs(statics.relax().force - 100.0 * area / 160217.66208) < 1e-2, "under a load");
    statics.set_mean_height(apart);
    const Point out = statics.relax();
    expect(std::abs(out.energy) < 1e-9, "apart");
    expect(std::abs(out.work - out.dissipated) < 1e-3 * std::abs(in.energy), "what was lost");
    expect(code_of([&] { statics.set_top(0.0); }, "begin another") == 2, "one thing is held");
}

} // namespace

int main(int argc, char** argv) {
    using namespace libasperity;
    Parallel parallel(argc, argv);
    if (argc < 4) return 2;
    const std::string file = argv[1], directory = argv[2];
    const Result reference = Result::load(argv[3]);

    const Scene scene = Scene::read(file);
    if (argc == 5) {
        run(scene, parallel.rank() + 1 == parallel.size() ? "" : directory);
        return 0;
    }
    expect(scene.toml() == Scene::parse(scene.toml(), {}, "again").toml(), "a scene as text");
    expect(Scene::parse(scene.toml(), {"surface.seed=7"}).toml() != scene.toml(), "an override");
    expect(code_of([] { Scene::parse("[surface]\nsites = -3\n"); }, "surface.sites") == 2,
           "a wrong scene is refused");
    expect(code_of([] { Scene::read("/nowhere.toml"); }, "/nowhere.toml") != 0, "no scene");

    if (parallel.size() == 1)
        same_steps(scene, reference, directory + ".h5"), led_without_time(scene);
    else
        same_steps_on_ranks(scene, reference, parallel.size());

    // To the end, with progress.
    int told = 0;
    Options options;
    options.progress = [&](const Progress& now) {
        ++told;
        expect(!now.phase.empty() && now.steps >= 0 && now.fraction <= 1.0, "progress");
    };
    const Result result = run(scene, directory, options);
    expect(told > 0 || parallel.rank() != 0, "the listener of progress was called");
    expect(result.finished() && result.stopped().empty(), "finished");
    same_result(result, reference);
    expect(code_of([&] { run(scene, directory); }, directory) == 2, "no result is overwritten");
    expect(code_of([&] { result.number("nonsense"); }, "nonsense") == 2, "no such number");
    expect(code_of([&] { result.map("zero-load", "nonsense"); }, "nonsense") == 2, "no such map");
    expect(result.unit("binding_energy") == "meV/Å^2", "unit " + result.unit("binding_energy"));
    expect(result.states() == std::vector<std::string>{"zero-load"}, "states");
    expect(result.maps("zero-load").size() == 7, "maps");

    // The heights are those whose statistics the result states; the map's shape is the surface's.
    const Map heights = result.heights();
    expect(heights.ny == heights.nx && heights.values.size() == heights.ny * heights.nx &&
               heights.unit == "Å",
           "shape");
    const double square = std::inner_product(heights.values.begin(), heights.values.end(),
                                             heights.values.begin(), 0.0);
    const double rms = std::sqrt(square / static_cast<double>(heights.values.size()));
    expect(std::abs(rms - result.number("surface.rms")) < 1e-9, "rms height");

    // Stopped at the first question, and resumed: the same bits.
    Options stop;
    stop.stop = [asked = 0]() mutable { return ++asked == 2; };
    const Result part = run(scene, directory + "-stopped", stop);
    expect(!part.finished() && part.stopped() == "signal", "stopped: " + part.stopped());
    Options resume;
    resume.resume = true;
    const Result whole = run(scene, directory + "-stopped", resume);
    expect(whole.finished(), "resumed");
    same_result(whole, reference);
    return failures != 0;
}
