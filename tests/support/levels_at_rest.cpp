// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "support/levels_at_rest.hpp"

#include "engine/equilibrium/zero_load.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace asperity::test {

namespace {

/// All displacements that move, as one list of numbers; the top plane's last.
std::vector<double*> displacements_of(Block& block) {
    std::vector<double*> list;
    for (const Block::Level& level : block.levels())
        for (int plane = 0; plane < level.shape.cells; ++plane) {
            const auto u = block.fields(level).u.plane(plane);
            for (const PlaneView<double>& c : {u.x, u.y, u.z})
                for (int y = 0; y < c.ny; ++y)
                    for (int x = 0; x < c.nx; ++x)
                        list.push_back(&c(x, y));
        }
    return list;
}

} // namespace

LevelsAtRest::LevelsAtRest(const BlockOptions& options)
    : block(options, Communicator(), serial_grid(options)) {}

RelaxedState LevelsAtRest::relax(const Interface& interface, double reference_height,
                                 const Constraint& constraint, double tolerance) {
    std::vector<VectorField<double>> forces;
    for (const Block::Level& level : block.levels())
        forces.emplace_back(level.tile, level.shape.cells);
    const std::vector<double*> u = displacements_of(block);
    const std::size_t n = u.size();
    std::vector<double> f(n + 1), v(n + 1);
    if (constraint.is_top()) block.set_top(constraint.value);
    block.exchange();
    InterfaceSums sums;
    const auto top_force = [&] {
        ExactSum sum;
        block.add_top_force(sum);
        return sum.value();
    };
    // The top plane weighs as much as a plane of nodes: it moves as the planes below it do.
    const double sites = std::pow(block.options().sites, 2);
    const auto feel = [&] {
        block.interpolate();
        sums = interface.sweep(block.lowest_layer(), block.interface_force(), reference_height,
                               {.observe = true});
        block.forces(forces);
        std::size_t i = 0;
        for (const Block::Level& level : block.levels())
            for (int plane = 0; plane < level.shape.cells; ++plane) {
                const auto at = forces[static_cast<std::size_t>(level.shape.level)].plane(plane);
                for (const PlaneView<double>& c : {at.x, at.y, at.z})
                    for (int y = 0; y < c.ny; ++y)
                        for (int x = 0; x < c.nx; ++x)
                            f[i++] = c(x, y);
            }
        f[n] = constraint.is_top() ? 0.0 : (top_force() - constraint.load()) / sites;
        return std::max(std::abs(*std::max_element(f.begin(), f.end())),
                        std::abs(*std::min_element(f.begin(), f.end())));
    };
    RelaxedState state;
    double dt = 0.3, alpha = 0.1; // masses of 1
    int downhill = 0;
    for (state.residual = feel(); state.residual > tolerance && state.iterations < 200000;
         ++state.iterations) {
        double power = 0.0, ff = 0.0, vv = 0.0;
        for (std::size_t i = 0; i <= n; ++i)
            power += f[i] * v[i], ff += f[i] * f[i], vv += v[i] * v[i];
        if (power > 0.0) {
            const double turn = alpha * std::sqrt(vv / ff);
            for (std::size_t i = 0; i <= n; ++i)
                v[i] = (1.0 - alpha) * v[i] + turn * f[i];
            if (++downhill > 5) dt = std::min(1.1 * dt, 0.6), alpha *= 0.99;
        } else {
            std::fill(v.begin(), v.end(), 0.0);
            dt *= 0.5, alpha = 0.1, downhill = 0;
        }
        double furthest = 0.0;
        for (std::size_t i = 0; i <= n; ++i) {
            v[i] += dt * f[i];
            furthest = std::max(furthest, dt * std::abs(v[i]));
        }
        const double fraction = std::min(1.0, 0.1 / furthest); // no node further than 0.1 Å
        for (std::size_t i = 0; i < n; ++i)
            *u[i] += fraction * dt * v[i];
        block.set_top(block.top() + fraction * dt * v[n]);
        block.exchange();
        state.residual = feel();
    }
    state.converged = state.residual <= tolerance;
    ExactSum elastic, height;
    block.add_elastic_energy(elastic);
    block.add_lowest_z(height);
    state.elastic_energy = elastic.value();
    state.interface_energy = sums.energy.value();
    state.force = sums.force_z.value();
    state.top_force = top_force();
    state.mean_height = height.value() / sites;
    state.in_contact = sums.in_contact;
    state.repulsive = sums.repulsive;
    return state;
}

Relaxed relax_levels(const BlockOptions& options, const InterfaceOptions& interface_options,
                     const Surface& surface, double tolerance, double load) {
    const Interface interface(surface, serial_grid(options).tile(0), options.spacing,
                              interface_options);
    SpectralBlock still(options, Communicator());
    const double height =
        height_of_strongest_attraction(still, interface, surface.statistics.lowest);
    return numbers_of(
        LevelsAtRest(options).relax(interface, height, Constraint::load(load), tolerance), options,
        height);
}

} // namespace asperity::test
