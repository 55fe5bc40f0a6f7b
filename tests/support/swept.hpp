// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Sweeps of an interface over a whole box of displacements, in one piece or in tiles.
#pragma once

#include "engine/interface/interface.hpp"
#include "support/nodes.hpp"

#include <algorithm>
#include <cstring>
#include <random>
#include <vector>

namespace asperity::test {

/// A whole box of displacements, copied into the fields of a tile.
struct State {
    int n;
    std::vector<double> u[3];

    State(int sites, double sideways, double up, unsigned seed) : n(sites) {
        std::mt19937_64 random(seed);
        std::uniform_real_distribution<double> unit(-1.0, 1.0);
        for (int i = 0; i < n * n; ++i)
            for (int k = 0; k < 3; ++k)
                u[k].push_back((k < 2 ? sideways : up) * unit(random));
    }
    double& at(int k, int x, int y) { return u[k][static_cast<std::size_t>(y * n + x)]; }
    VectorField<double> on(const Tile& tile) const {
        VectorField<double> field(tile, 1);
        Field<double>* component[3] = {&field.x, &field.y, &field.z};
        for (int k = 0; k < 3; ++k)
            for (int y = -halo_width; y < tile.ny + halo_width; ++y)
                for (int x = -halo_width; x < tile.nx + halo_width; ++x)
                    component[k]->plane(0)(x, y) = u[k][static_cast<std::size_t>(
                        periodic(tile.y0 + y, n) * n + periodic(tile.x0 + x, n))];
        return field;
    }
};

struct Outcome {
    std::vector<double> force[3]; // [y * n + x] of the box
    InterfaceSums sums;
};

/// Sweeps the box cut into tiles of at most nx * ny sites.
inline Outcome sweep(const Surface& substrate, const State& state, const InterfaceOptions& options,
                     double z, bool observe, int nx = 1 << 20, int ny = 1 << 20) {
    Outcome out;
    const int n = state.n;
    const double spacing = substrate.length / n;
    for (auto& f : out.force)
        f.assign(static_cast<std::size_t>(n * n), 1e99);
    for (int y0 = 0; y0 < n; y0 += ny)
        for (int x0 = 0; x0 < n; x0 += nx) {
            const Tile tile{x0, y0, std::min(nx, n - x0), std::min(ny, n - y0), n};
            const Interface interface(substrate, tile, spacing, options);
            const VectorField<double> u = state.on(tile);
            VectorField<double> f(tile, 1);
            out.sums.merge(
                interface.sweep(u.plane(0), f.plane(0), {.observe = observe, .height = z}));
            for (int y = 0; y < tile.ny; ++y)
                for (int x = 0; x < tile.nx; ++x)
                    for (std::size_t k = 0; k < 3; ++k)
                        out.force[k][static_cast<std::size_t>((y0 + y) * n + x0 + x)] =
                            *components(f.view(), x, y, 0)[k];
        }
    return out;
}

inline bool same_bits(const Outcome& p, const Outcome& q) {
    for (int k = 0; k < 3; ++k)
        if (std::memcmp(p.force[k].data(), q.force[k].data(), p.force[k].size() * sizeof(double)))
            return false;
    return p.sums.force_z.value() == q.sums.force_z.value() &&
           p.sums.energy.value() == q.sums.energy.value() &&
           p.sums.in_contact == q.sums.in_contact && p.sums.repulsive == q.sums.repulsive &&
           p.sums.closest_r2 == q.sums.closest_r2;
}

} // namespace asperity::test
