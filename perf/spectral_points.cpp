// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What does a point of a quasi-static path cost? From the relaxed state the top plane, held, is
// moved by a little, and the spectral block relaxed again from where it was.
//
//     spectral_points SITES RMS [frictionless]
#include "engine/equilibrium/equilibrium.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <chrono>
#include <string>

using namespace asperity;

int main(int argc, char** argv) {
    const std::string sites = argc > 1 ? argv[1] : "128", rms = argc > 2 ? argv[2] : "3";
    const bool frictionless = argc > 3 && std::string(argv[3]) == "frictionless";
    const Scene scene = read_scene_text(
        "[block]\nmodel = \"spectral\"\n[drive]\npath = [\"zero-load\"]\n", "spectral_points",
        {"surface.sites=" + sites, "surface.rms=" + rms,
         std::string("interface.frictionless=") + (frictionless ? "true" : "false")});
    const Communicator ranks;
    const Setup setup = make_setup(scene, ranks.size());
    const Surface surface = scene_surface(scene);
    const ProcessGrid grid = make_grid(scene, setup, ranks.size(), ranks.rank());
    Interface interface(surface, grid.tile(0), scene.surface.spacing, setup.simulation.interface);
    const auto block = make_equilibrium(scene, setup, ranks, grid);
    const double height =
        height_of_strongest_attraction(*block, interface, surface.statistics.lowest, ranks);
    RelaxOptions options;
    options.tolerance = 1e-4;
    options.site_stiffness = 2.2;
    Phases phases;
    const auto relaxed = [&](const std::string& what, const Constraint& constraint) {
        const auto start = std::chrono::steady_clock::now();
        const RelaxedState s = block->relax(interface, height, constraint, options, phases);
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
        fmt::print("{:24} {:4} iterations {:7.3f} s, {:.8f} meV/Å², contact {}{}\n", what,
                   s.iterations, took.count(),
                   -1e3 * (s.interface_energy + s.elastic_energy) / (scene.edge() * scene.edge()),
                   s.in_contact, s.converged ? "" : "  NOT CONVERGED");
    };
    relaxed("zero load", Constraint::load(0.0));
    double top = block->top();
    for (double move : {0.02, 0.05, 0.1, 0.25, -0.02, -0.1, -0.25, 0.1, 0.25, 0.25, 0.25})
        relaxed(fmt::format("top moved by {:+.2f} Å", move), Constraint::top(top += move));
    rusage use{};
    getrusage(RUSAGE_SELF, &use);
    fmt::print("peak memory {:.0f} MB\n", static_cast<double>(use.ru_maxrss) / 1024.0);
    return 0;
}
