// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// relax_levels() of support/cases.hpp: all nodes downhill by inertia that is taken away where it
// leads uphill (FIRE: Bitzek et al., Phys. Rev. Lett. 97, 170201 (2006)). Shares the springs and
// the interface with the program, and nothing of how it relaxes.
#include "support/cases.hpp"
#include "support/elastic_operator.hpp"
#include "support/nodes.hpp"

#include <algorithm>
#include <cmath>

namespace asperity::test {

Relaxed relax_levels(const BlockOptions& options, const InterfaceOptions& interface_options,
                     const Surface& surface, double tolerance) {
    const Interface interface(surface, serial_grid(options).tile(0), options.spacing,
                              interface_options);
    SpectralBlock still(options, Communicator());
    const double height = height_of_strongest_attraction(
        still, interface, surface.statistics.lowest, paper_scales().length);
    ElasticOperator lattice(options);
    Block& block = lattice.block();
    Vector u(lattice.size());
    double top = 0.0;
    const std::size_t n = u.size();
    Vector f, v(n + 1); // the top plane's last
    InterfaceSums sums;
    // The top plane weighs as much as a plane of nodes: it moves as the planes below it do.
    const double sites = std::pow(options.sites, 2);
    const auto feel = [&] {
        lattice.set(u, top);
        sums = interface.sweep(block.lowest_layer(), block.interface_force(),
                               {.observe = true, .height = height});
        f = lattice.force();
        f.push_back(lattice.top_force()[2] / sites);
        return largest_of(f);
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
            u[i] += fraction * dt * v[i];
        top += fraction * dt * v[n];
        state.residual = feel();
    }
    state.converged = state.residual <= tolerance;
    ExactSum lowest;
    block.add_lowest_z(lowest);
    state[Term::elastic] = lattice.energy();
    state[Term::interface] = sums.energy.value();
    state.force = sums.force_z.value();
    state.top_force = lattice.top_force()[2];
    state.mean_height = lowest.value() / sites;
    state.in_contact = sums.in_contact;
    state.repulsive = sums.repulsive;
    return numbers_of(state, options, height);
}

} // namespace asperity::test
