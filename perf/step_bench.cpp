// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// How long does a step of a scene take, and where does the time go? Steps of the program's own
// Simulation, on the ranks and threads it is started with, in one of two places:
//
//   contact   a nearly flat substrate (rms 0.3 Å) at the equilibrium separation: every site has all
//             of its pairs, the dearest a step gets
//   away      beyond the interaction range of the substrate: the block alone
//
//     [mpirun -n RANKS] build/release/perf/step_bench contact|away SECONDS [section.key=value ...]
//
// Prints JSON: the fastest of many short stretches of steps, its time by phase (of rank 0, seconds
// a step; waiting for other ranks is in exchange, sums, and advance where a level is gathered),
// what the most loaded rank holds and sends, and the record of the sixth step, bitwise identical on
// any ranks.
#include "engine/case/case.hpp"
#include "engine/dynamics/simulation.hpp"
#include "engine/scene/scene.hpp"

#include <nlohmann/json.hpp>
#include <omp.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <string_view>
#include <vector>

using namespace asperity;

namespace {

using Clock = std::chrono::steady_clock;
using Times = std::array<double, phase_names.size()>;

Times times(const Phases& phases) {
    Times t;
    for (std::size_t i = 0; i < t.size(); ++i)
        t[i] = phases[static_cast<Phase>(i)].seconds;
    return t;
}

nlohmann::json measure(const Communicator& ranks, bool contact, double seconds,
                       const std::vector<std::string>& settings) {
    const Scene scene = read_scene_text("[surface]\nrms = 0.3\n", "step_bench", settings);
    const Case setup = resolve(scene, ranks.size());
    const Surface surface = surface_of(resolve(scene));
    const ProcessGrid grid(ranks.size(), ranks.rank(), scene.surface.sites,
                           static_cast<int>(setup.levels.size()));
    Simulation simulation(setup.simulation, surface, ranks, grid);
    const TopMotion down{.z = -setup.simulation.drive.velocity};
    simulation.start(contact ? setup.flat.separation : simulation.interface().start_height() + 1.0,
                     down.z);

    // Every rank takes the slowest rank's time, so all agree on what is the fastest.
    const auto stretch = [&](int steps) {
        ranks.barrier();
        const auto start = Clock::now();
        for (int n = 0; n < steps; ++n)
            simulation.step(down, false);
        const std::chrono::duration<double> took = Clock::now() - start;
        return ranks.max(took.count()) / steps;
    };
    stretch(2);
    const double about = stretch(3);
    const StepRecord seen = simulation.step(down, true); // the sixth, whatever the clock says
    const int steps = std::clamp(static_cast<int>(0.02 / about), 1, 200);
    const int stretches = std::clamp(static_cast<int>(seconds / (about * steps)), 3, 5000);
    double best = 1e300;
    Times phases{};
    for (int n = 0; n < stretches; ++n) {
        const Times before = times(simulation.phases());
        const double step = stretch(steps);
        if (step >= best) continue;
        best = step;
        const Times after = times(simulation.phases());
        for (std::size_t i = 0; i < phases.size(); ++i)
            phases[i] = (after[i] - before[i]) / steps;
    }

    double nodes = 0.0;
    for (const auto& level : simulation.block().levels())
        nodes += static_cast<double>(level.tile.nx) * level.tile.ny * level.shape.cells;
    nlohmann::json by_phase;
    for (std::size_t i = 0; i < phases.size(); ++i)
        if (phases[i] > 0.0) by_phase[phase_names[i]] = phases[i];
    return {{"place", contact ? "contact" : "away"},
            {"sites", scene.surface.sites},
            {"precision", setup.simulation.interface.mixed ? "mixed" : "double"},
            {"ranks", ranks.size()},
            {"threads", omp_get_max_threads()},
            {"steps", steps * stretches},
            {"sixth_step",
             {seen.mean_height, seen.force, seen.top_force, seen[Term::interface],
              seen[Term::elastic], seen[Term::kinetic], seen.closest}},
            {"seconds", best},
            {"phases", by_phase},
            {"nodes", ranks.max(nodes)},
            {"halo_bytes", ranks.max(static_cast<double>(simulation.block().halo_bytes()))},
            {"block_bytes", ranks.max(static_cast<double>(simulation.block().bytes()))}};
}

} // namespace

int main(int argc, char** argv) {
    ParallelSession session(argc, argv);
    const Communicator& ranks = session.world();
    const std::string_view place = argc > 1 ? argv[1] : "";
    const double seconds = argc > 2 ? std::atof(argv[2]) : 0.0;
    if ((place != "contact" && place != "away") || !(seconds > 0.0)) {
        if (ranks.root())
            std::fprintf(stderr,
                         "usage: step_bench contact|away SECONDS [section.key=value ...]\n");
        return 2;
    }
    try {
        const auto result = measure(ranks, place == "contact", seconds, {argv + 3, argv + argc});
        if (ranks.root()) std::printf("%s\n", result.dump(1).c_str());
        return 0;
    } catch (const std::exception& error) {
        if (ranks.root()) std::fprintf(stderr, "step_bench: %s\n", error.what());
        return 2;
    }
}
