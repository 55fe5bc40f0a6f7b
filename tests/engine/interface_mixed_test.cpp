// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Mixed precision against the reference loop in double: forces of each site, energies, states at
// zero load. (Motion: stability/motion_limits_test.)
//
// What to expect of a force: positions are rounded to 1.2e-7 Å (half of fixed_quantum) on both
// sides, and r^2 by three float roundings: about 3e-7 of r^2. Where a pair repels, t^7 - t^4 is
// half of t^7 and takes fourteen times that, 4e-6; five roundings on the way to t^7 add 3e-6. So
// 1e-5 bounds the error in units of a pair's force (7e-6 is the worst seen, on any processor
// level). The pairs of a site pull against each other: the unit is the largest of their forces, not
// the sum.
#include "support/cases.hpp"
#include "support/levels_at_rest.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <tuple>
#include <utility>

namespace asperity {
namespace {

constexpr double a = 2.6;
constexpr double force_bound = 1e-5;
/// Likewise for energies: t^6 and t^3, of a unit that is the well's depth or more.
constexpr double energy_bound = 2e-6;

[[maybe_unused]] const bool one_thread = (omp_set_num_threads(1), true);

Surface rough(int sites, double length, double amplitude, double level, unsigned seed) {
    Surface s;
    s.sites = sites;
    s.length = length;
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> height(-amplitude, amplitude);
    for (int i = 0; i < sites * sites; ++i)
        s.height.push_back(level + height(random));
    return s;
}

struct Compared {
    double force =
        0.0; ///< worst error of a component, of the nearest pair's force and the scale below
    double energy = 0.0; ///< error of the total, of the sum of the sizes of the sites' energies
    bool same_counts = true;
};

/// The mixed sweep against pair sums in double, on one tile of n * n sites.
Compared compare(const Surface& substrate, int n, double z, double sideways, double up,
                 unsigned seed) {
    const Tile tile{0, 0, n, n, n};
    InterfaceOptions options;
    options.mixed = true;
    const Interface mixed(substrate, tile, a, options);
    options.method = InterfaceMethod::reference;
    const Interface reference(substrate, tile, a, options);
    VectorField<double> u(tile, 1), f(tile, 1), g(tile, 1);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
            u.x.plane(0)(x, y) = sideways * unit(random);
            u.y.plane(0)(x, y) = sideways * unit(random);
            u.z.plane(0)(x, y) = up * unit(random);
        }
    const auto seen = std::as_const(u).plane(0);
    const InterfaceSums sums = mixed.sweep(seen, f.plane(0), z, {.observe = true});
    const InterfaceSums expected = reference.sweep(seen, g.plane(0), z, {.observe = true});
    const InterfaceMaps maps = reference.maps(seen, z);
    Compared c;
    double energies = 1e-3;
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
            const auto i = static_cast<std::size_t>(y * n + x);
            // The nearest atom's force; at the minimum of the pair potential, its well's steepest.
            const double r2 = maps.distance[i] * maps.distance[i];
            double pair = 0.0;
            if (std::isfinite(r2))
                pair =
                    std::abs(
                        Pair(std::get<LennardJones>(options.potential)).force_over_distance(r2)) *
                        maps.distance[i] +
                    (r2 < 36.0 ? 0.07 : 1e-3);
            for (auto [mine, theirs] : {std::pair{f.x.plane(0)(x, y), g.x.plane(0)(x, y)},
                                        {f.y.plane(0)(x, y), g.y.plane(0)(x, y)},
                                        {f.z.plane(0)(x, y), g.z.plane(0)(x, y)}}) {
                if (pair == 0.0)
                    EXPECT_EQ(mine, 0.0);
                else
                    c.force = std::max(c.force, std::abs(mine - theirs) / pair);
            }
            energies +=
                std::get<LennardJones>(options.potential).epsilon * (std::isfinite(r2) ? 1.0 : 0.0);
        }
    c.energy = std::abs(sums.energy.value() - expected.energy.value()) /
               std::max(energies, std::abs(expected.energy.value()));
    c.same_counts = sums.in_contact == expected.in_contact && sums.repulsive == expected.repulsive;
    return c;
}

TEST(MixedPrecision, ForcesAndEnergiesOfRoughStates) {
    unsigned seed = 1;
    double force = 0.0, energy = 0.0;
    for (int n : {16, 33})
        for (int atoms : {n, substrate_sites(n, 1.618)})
            for (double sideways : {0.1, 1.5})
                // Flat, rough, and a box as high as a mountain: only differences matter.
                for (auto [amplitude, level, gap] : {std::tuple{0.05, 0.0, 3.1},
                                                     {1.0, 0.0, 4.0},
                                                     {2.0, -4321.0, 5.0},
                                                     {8.0, 9876.5, 10.0}}) {
                    const Surface s = rough(atoms, n * a, amplitude, level, ++seed);
                    const Compared c = compare(s, n, level + gap, sideways, 0.5, seed);
                    force = std::max(force, c.force);
                    energy = std::max(energy, c.energy);
                    EXPECT_LT(c.force, force_bound) << n << ' ' << atoms << ' ' << amplitude;
                    EXPECT_LT(c.energy, energy_bound) << n << ' ' << atoms << ' ' << amplitude;
                    EXPECT_TRUE(c.same_counts);
                }
    EXPECT_GT(force, 1e-9) << "is it mixed at all?";
}

TEST(MixedPrecision, LeavesDepthsBeyondTheFixedRangeToTheReference) {
    // A pit 400 Å deep, and sites at its bottom: atoms there are beyond the 250 Å of fixed depth.
    for (int atoms : {16, 26}) {
        Surface pit = rough(atoms, 16 * a, 0.3, 0.0, 5);
        for (std::size_t i = 0; i < pit.height.size() / 2; ++i)
            pit.height[i] -= 400.0;
        for (double z : {3.0, -100.0, -238.0, -247.0, -300.0, -396.8}) {
            const Compared c = compare(pit, 16, z, 0.2, 0.2, 6);
            EXPECT_LT(c.force, force_bound) << z;
            EXPECT_TRUE(c.same_counts) << z;
        }
    }
}

TEST(MixedPrecision, BindsLikeDouble) {
    for (auto [map, sites, thickness] :
         {std::tuple{"n8_b_rms1.0", 8, 6}, {"c2_N16_T8_rms1.5", 16, 8}}) {
        InterfaceOptions interface = test::paper_interface();
        const BlockOptions block = test::paper_block(sites, thickness, 0);
        const Surface surface = test::reference_surface(map);
        const auto relaxed = [&] { return test::relax_levels(block, interface, surface, 1e-5); };
        const test::Relaxed exact = relaxed();
        interface.mixed = true;
        const test::Relaxed mixed = relaxed();
        EXPECT_NEAR(mixed.binding_energy / exact.binding_energy, 1.0, 1e-6) << map;
        EXPECT_NEAR(mixed.mean_height, exact.mean_height, 1e-4) << map;
    }
}

} // namespace
} // namespace asperity
