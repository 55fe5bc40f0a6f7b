// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/run/plan_rates.hpp"

#include "engine/equilibrium/zero_load.hpp"
#include "kernels/variant.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

namespace asperity {

namespace {

using Clock = std::chrono::steady_clock;
double since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// A smaller piece of the scene: a part of its surface, and as many layers as a piece of that width
/// needs.
struct Piece {
    SimulationOptions options;
    Surface surface;
};

Piece cut_out(const Scene& scene, const Setup& setup, const Surface& surface) {
    Piece piece;
    piece.options = setup.simulation;
    piece.options.device = {}; // rates are the processor's
    BlockOptions& block = piece.options.block;
    const int needed = static_cast<int>(
        std::ceil(2.0 * setup.simulation.interface.pairs().cutoff / block.spacing));
    int sites = 128;
    while (sites < needed)
        sites *= 2;
    block.sites = std::min(block.sites, sites);
    block.thickness = std::min(block.thickness, setup.effects.on(Effect::coarse_levels) ? 128 : 16);
    piece.surface = surface;
    piece.surface.sites = substrate_sites(block.sites, scene.surface.lattice_ratio);
    piece.surface.length = block.sites * block.spacing;
    piece.surface.height.clear();
    for (int y = 0; y < piece.surface.sites; ++y)
        for (int x = 0; x < piece.surface.sites; ++x)
            piece.surface.height.push_back(
                surface.height[static_cast<std::size_t>(periodic(y, surface.sites)) *
                                   static_cast<std::size_t>(surface.sites) +
                               static_cast<std::size_t>(periodic(x, surface.sites))]);
    // Atoms of the piece; those nearer to its far sides than to each other would coincide there.
    constexpr double apart = 0.5;
    piece.surface.atoms = {};
    const double length = piece.surface.length;
    const double end = block.sites < scene.surface.sites ? length - apart : length;
    for (std::size_t i = 0; i < surface.atoms.size(); ++i) {
        if (surface.atoms.x[i] >= end || surface.atoms.y[i] >= end) continue;
        piece.surface.atoms.x.push_back(surface.atoms.x[i]);
        piece.surface.atoms.y.push_back(surface.atoms.y[i]);
        piece.surface.atoms.z.push_back(surface.atoms.z[i]);
        if (!surface.atoms.type.empty()) piece.surface.atoms.type.push_back(surface.atoms.type[i]);
    }
    return piece;
}

ProcessGrid one_rank(const BlockOptions& block) {
    return ProcessGrid(1, 0, block.sites, static_cast<int>(level_shapes(block).size()));
}

/// Repeats work for about this long; the shortest time.
template <class Work>
double shortest(double seconds, const Work& work) {
    double best = 1e300;
    const auto start = Clock::now();
    for (int n = 0; n < 3 || since(start) < seconds; ++n) {
        const auto begin = Clock::now();
        work();
        best = std::min(best, since(begin));
    }
    return best;
}

/// Sweeps of a lowest layer that follows the surface at this separation, and of one out of reach.
void measure_sweeps(const Interface& interface, const Piece& piece, double separation,
                    Rates& rates) {
    const BlockOptions& block = piece.options.block;
    const Tile tile = one_rank(block).tile(0);
    VectorField<double> layer(tile, 1), force(tile, 1);
    const double sites = static_cast<double>(block.sites) * block.sites;
    const auto sweep = [&](double height) {
        interface.sweep(layer.plane(0), force.plane(0), height, false);
    };
    rates.far = shortest(0.02, [&] { sweep(interface.start_height()); }) / sites;
    const int n = piece.surface.sites;
    for (int y = 0; y < tile.ny; ++y)
        for (int x = 0; x < tile.nx; ++x)
            layer.plane(0).z(x, y) =
                piece.surface.height[static_cast<std::size_t>(y * n / tile.ny) *
                                         static_cast<std::size_t>(n) +
                                     static_cast<std::size_t>(x * n / tile.nx)];
    rates.near = shortest(0.05, [&] { sweep(separation); }) / sites;
}

void measure_steps(const Piece& piece, Rates& rates) {
    const Communicator alone;
    const ProcessGrid grid = one_rank(piece.options.block);
    const double sites = static_cast<double>(piece.options.block.sites) * piece.options.block.sites;
    const auto begin = Clock::now();
    Simulation simulation(piece.options, piece.surface, alone, grid);
    simulation.start(simulation.interface().start_height());
    rates.making = since(begin) / sites;
    const auto spent = [&](Phase p) { return simulation.phases()[p].seconds; };
    simulation.step(false);
    const double nodes = nodes_of(level_shapes(piece.options.block));
    // The shortest of some steps, phase by phase.
    const std::array phases = {Phase::advance,  Phase::thermostat, Phase::interpolate,
                               Phase::exchange, Phase::sums,       Phase::observe};
    std::array<double, phases.size()> best;
    best.fill(1e300);
    double absorption = 1e300; // of those steps that have one
    const double plain = shortest(0.06, [&] {
        const double absorbed = spent(Phase::absorb);
        std::array<double, phases.size()> before;
        for (std::size_t i = 0; i < phases.size(); ++i)
            before[i] = spent(phases[i]);
        simulation.step(false);
        for (std::size_t i = 0; i < phases.size(); ++i)
            best[i] = std::min(best[i], spent(phases[i]) - before[i]);
        if (spent(Phase::absorb) > absorbed)
            absorption = std::min(absorption, spent(Phase::absorb) - absorbed);
    });
    rates.node = best[0] / nodes;
    rates.noise = best[1] / nodes;
    rates.hanging = best[2] / sites;
    rates.rest = (best[3] + best[4] + best[5]) / sites;
    if (piece.options.block.absorption_span > 0.0)
        rates.absorption =
            absorption * piece.options.dt / piece.options.block.absorption_span / sites;
    const double observed = shortest(0.04, [&] { simulation.step(true); });
    rates.observation = std::max(0.0, observed - plain) / nodes;
}

/// What forces at finite strain take more than those at small strain.
void measure_strain(const Piece& piece, Rates& rates) {
    const auto forces_take = [&](bool finite) {
        BlockOptions options = piece.options.block;
        options.finite_strain = finite;
        Block block(options, Communicator(), one_rank(options));
        std::vector<VectorField<double>> out;
        double nodes = 0.0;
        for (const Block::Level& level : block.levels()) {
            out.emplace_back(level.tile, level.shape.cells);
            nodes += static_cast<double>(level.tile.nx) * level.tile.ny * level.shape.cells;
        }
        return shortest(0.04, [&] { block.forces(out); }) / nodes;
    };
    rates.finite = std::max(0.0, forces_take(true) - forces_take(false));
}

/// The first iterations of a relaxation of the piece.
void measure_relaxation(const Scene& scene, const Setup& setup, const Piece& piece, Rates& rates) {
    SpectralBlock block(piece.options.block, Communicator(), scene.interface.frictionless);
    InterfaceOptions interface_options = piece.options.interface;
    interface_options.single_too = !interface_options.mixed;
    const Interface interface(piece.surface, block.tile(), piece.options.block.spacing,
                              interface_options);
    const double height = height_of_strongest_attraction(
        block, interface,
        *std::min_element(piece.surface.height.begin(), piece.surface.height.end()));
    RelaxOptions options;
    options.site_stiffness = setup.site_stiffness;
    options.max_iterations = 10;
    options.tolerance = 1e-300;
    Phases phases;
    const double sites = static_cast<double>(block.tile().nx) * block.tile().ny;
    const auto begin = Clock::now();
    const RelaxedState reached = relax(block, interface, height, {}, options, phases);
    rates.iteration = since(begin) / static_cast<double>(std::max(1ll, reached.iterations)) / sites;
}

} // namespace

double nodes_of(const std::vector<LevelShape>& levels) {
    double nodes = 0.0;
    for (const LevelShape& l : levels)
        nodes += static_cast<double>(l.sites) * l.sites * l.cells;
    return nodes;
}

Rates measure_rates(const Scene& scene, const Setup& setup, const Surface& surface) {
    const auto on = [&](Effect e) { return setup.effects.on(e); };
    Rates rates;
    const Piece piece = cut_out(scene, setup, surface);
    const auto measuring = Clock::now();
    const Interface interface(piece.surface, one_rank(piece.options.block).tile(0),
                              piece.options.block.spacing, piece.options.interface);
    const double piece_sites =
        static_cast<double>(piece.options.block.sites) * piece.options.block.sites;
    rates.making = since(measuring) / piece_sites;
    measure_sweeps(interface, piece, setup.flat.separation, rates);
    if (on(Effect::tail)) {
        InterfaceOptions without = piece.options.interface;
        without.tail = false;
        Rates bare;
        measure_sweeps(Interface(piece.surface, one_rank(piece.options.block).tile(0),
                                 piece.options.block.spacing, without),
                       piece, setup.flat.separation, bare);
        rates.tail = std::max(0.0, rates.near - bare.near);
        rates.near = bare.near;
        rates.far = bare.far;
    }
    if (on(Effect::finite_strain)) measure_strain(piece, rates);
    if (on(Effect::inertia)) measure_steps(piece, rates);
    if (on(Effect::relaxation)) measure_relaxation(scene, setup, piece, rates);
    rates.origin = fmt::format("rates measured now in {:.1f} s on a piece of {} x {} sites with {} "
                               "thread{}, kernels for {}",
                               since(measuring), piece.options.block.sites,
                               piece.options.block.sites, omp_get_max_threads(),
                               omp_get_max_threads() == 1 ? "" : "s", name(processor_level()));
    return rates;
}

} // namespace asperity
