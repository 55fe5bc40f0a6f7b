// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The fast sweeps against the reference in double and mixed precision, forces against energies, and
// the same bits whatever the decomposition. States are rough and displaced at random, some far
// beyond what a run allows. (Motion in mixed precision: stability/motion_limits_test.)
#include "engine/interface/interface.hpp"
#include "engine/interface/interface_stiffness.hpp"
#include "engine/options/sweep_limits.hpp"
#include "kernels/interface_block.hpp"
#include "support/cases.hpp"
#include "support/swept.hpp"
#include "support/threads.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace asperity {
namespace {

using test::Outcome, test::same_bits, test::scattered, test::State, test::sweep;
using test::paper::a, test::paper::r0;

void expect_close(const Outcome& reference, const Outcome& other, const std::string& what) {
    double worst = 0.0;
    for (std::size_t i = 0; i < reference.force[0].size(); ++i) {
        double size = 1e-2; // eV/Å: the pair forces that cancel in a site's sum are of this size
        for (int k = 0; k < 3; ++k)
            size = std::max(size, std::abs(reference.force[k][i]));
        for (int k = 0; k < 3; ++k)
            worst = std::max(worst, std::abs(reference.force[k][i] - other.force[k][i]) / size);
    }
    EXPECT_LT(worst, 1e-12) << what;
    EXPECT_EQ(reference.sums.in_contact, other.sums.in_contact) << what;
    EXPECT_EQ(reference.sums.repulsive, other.sums.repulsive) << what;
    if (reference.sums.closest_r2 < no_pair) {
        EXPECT_NEAR(reference.sums.closest_r2, other.sums.closest_r2,
                    1e-12 * (1.0 + reference.sums.closest_r2))
            << what;
    } else {
        EXPECT_EQ(other.sums.closest_r2, no_pair) << what;
    }
    const double total = std::accumulate(other.force[2].begin(), other.force[2].end(), 0.0);
    EXPECT_NEAR(other.sums.force_z.value(), total, 1e-10 * (1.0 + std::abs(total))) << what;
    const double energy = reference.sums.energy.value();
    EXPECT_NEAR(energy, other.sums.energy.value(), 1e-12 * (10.0 + std::abs(energy))) << what;
}

InterfaceOptions with(InterfaceMethod method, const PairPotential& potential = LennardJones{}) {
    InterfaceOptions o;
    o.potential = potential;
    o.method = method;
    return o;
}

TEST(InterfaceSweep, AgreesWithTheReference) {
    unsigned seed = 1;
    for (int n : {1, 8, 16, 17, 30, 33})
        for (double cutoff : {2.0 * r0, 2.7 * r0, 4.0 * r0})
            // Sideways up to beyond the tables' margin of two spacings; gaps from overlap to out of
            // reach.
            for (double sideways : {0.1, 1.5, 7.0})
                for (double z : {1.0, 6.0, 14.0})
                    for (const PairPotential& potential : test::potentials(cutoff)) {
                        ++seed;
                        const State state(n, sideways, 1.5, seed);
                        const std::string what =
                            "n=" + std::to_string(n) + " cutoff=" + std::to_string(cutoff) +
                            " u=" + std::to_string(sideways) + " z=" + std::to_string(z) +
                            " potential=" + std::to_string(potential.index());
                        const auto swept = [&](const Surface& surface, InterfaceMethod method) {
                            return sweep(surface, state, with(method, potential), z, true);
                        };
                        const Surface same = scattered(n, n * a, 2.0, seed);
                        const Outcome reference = swept(same, InterfaceMethod::reference);
                        expect_close(reference, swept(same, InterfaceMethod::lattice),
                                     "lattice " + what);
                        expect_close(reference, swept(same, InterfaceMethod::rows), "rows " + what);
                        const Surface other =
                            scattered(substrate_sites(n, 1.618), n * a, 2.0, seed);
                        expect_close(swept(other, InterfaceMethod::reference),
                                     swept(other, InterfaceMethod::automatic),
                                     "incommensurate " + what);
                    }
}

TEST(InterfaceSweep, ForceOnlyGivesTheBitsOfTheObservedSweep) {
    const int n = 19;
    const State state(n, 0.8, 1.0, 3);
    for (auto [m, mixed] : {std::pair{19, false}, {31, false}, {19, true}}) {
        const Surface s = scattered(m, n * a, 1.0, 4);
        InterfaceOptions o = with(InterfaceMethod::automatic);
        o.mixed = mixed;
        Outcome quick = sweep(s, state, o, 4.0, false);
        const Outcome full = sweep(s, state, o, 4.0, true);
        EXPECT_EQ(quick.sums.energy.value(), 0.0);
        quick.sums.energy = full.sums.energy;
        quick.sums.in_contact = full.sums.in_contact;
        quick.sums.repulsive = full.sums.repulsive;
        quick.sums.closest_r2 = full.sums.closest_r2;
        EXPECT_TRUE(same_bits(quick, full)) << m;
    }
}

TEST(InterfaceSweep, ForceIsMinusTheGradient) {
    const int n = 10;
    for (int m : {10, 16})
        for (bool tail : {false, true})
            for (auto method :
                 {InterfaceMethod::automatic, InterfaceMethod::reference, InterfaceMethod::rows}) {
                for (const PairPotential& potential : test::potentials()) {
                    if (tail && std::holds_alternative<Tabulated>(potential)) continue;
                    const Surface s = scattered(m, n * a, 0.5, 5);
                    State state(n, 0.6, 0.6, 6);
                    InterfaceOptions o = with(method, potential);
                    o.tail = tail;
                    const Outcome out = sweep(s, state, o, 3.6, true);
                    const double h = 1e-5;
                    for (auto [x, y] : {std::pair{0, 0}, {9, 4}, {5, 9}, {3, 3}})
                        for (int k = 0; k < 3; ++k) {
                            const double kept = state.at(k, x, y);
                            state.at(k, x, y) = kept + h;
                            const double up = sweep(s, state, o, 3.6, true).sums.energy.value();
                            state.at(k, x, y) = kept - h;
                            const double down = sweep(s, state, o, 3.6, true).sums.energy.value();
                            state.at(k, x, y) = kept;
                            const double f = out.force[k][static_cast<std::size_t>(y * n + x)];
                            EXPECT_NEAR(f, -(up - down) / (2.0 * h), 2e-7 * (1.0 + std::abs(f)))
                                << m << ' ' << tail << ' ' << x << ' ' << y << ' ' << k;
                        }
                }
            }
}

TEST(InterfaceStiffness, IsMinusTheSlopeOfTheForce) {
    // Sites do not feel each other: the force changes by -H v at each of them. Differences of
    // forces need a cutoff where their steps are small.
    const int n = 9;
    const Tile tile{0, 0, n, n, n};
    for (const PairPotential& potential : test::potentials(15.5)) {
        Interface interface(scattered(n, n * a, 0.5, 11), tile, a,
                            with(InterfaceMethod::automatic, potential));
        const State state(n, 0.4, 0.3, 12), way(n, 1.0, 1.0, 13);
        const double z = 3.6, h = 5e-4;
        const auto force_at = [&](double step) {
            State moved = state;
            for (int k = 0; k < 3; ++k)
                for (std::size_t i = 0; i < moved.u[k].size(); ++i)
                    moved.u[k][i] += step * way.u[k][i];
            VectorField<double> f(tile, 1);
            const VectorField<double> u = moved.on(tile);
            interface.sweep(u.plane(0), f.plane(0), {.height = z});
            return f;
        };
        const VectorField<double> u = state.on(tile), f = force_at(0.0);
        const VectorField<double> above = force_at(h), below = force_at(-h);
        InterfaceStiffness all(tile, 3, 1e-3), normal(tile, 1, 1e-3);
        interface.set_reference_height(z);
        all.measure(interface, u.plane(0), f.plane(0));
        normal.measure(interface, u.plane(0), f.plane(0));
        SiteField<float> v, up;
        for (int k = 0; k < 3; ++k) {
            v.emplace_back(tile, 1, 0);
            for (int y = 0; y < n; ++y)
                for (int x = 0; x < n; ++x)
                    v.back().plane(0)(x, y) =
                        static_cast<float>(way.u[k][static_cast<std::size_t>(y * n + x)]);
        }
        up.emplace_back(tile, 1, 0);
        for (int y = 0; y < n; ++y)
            for (int x = 0; x < n; ++x)
                up[0].plane(0)(x, y) = 1.0f;
        for (int y = 0; y < n; ++y) {
            float* const row[3] = {v[0].plane(0).line(y), v[1].plane(0).line(y),
                                   v[2].plane(0).line(y)};
            all.apply_row(y, row);
            float* const up_row = up[0].plane(0).line(y);
            normal.apply_row(y, &up_row);
        }
        const auto expect_slope = [&](float product, const Field<double>& high,
                                      const Field<double>& low, int x, int y) {
            const double slope = -(high.plane(0)(x, y) - low.plane(0)(x, y)) / (2.0 * h);
            EXPECT_NEAR(product, slope, 0.05 * (1.0 + std::abs(slope))); // one-sided differences
        };
        double mean = 0.0;
        for (int y = 0; y < n; ++y)
            for (int x = 0; x < n; ++x) {
                expect_slope(v[0].plane(0)(x, y), above.x, below.x, x, y);
                expect_slope(v[1].plane(0)(x, y), above.y, below.y, x, y);
                expect_slope(v[2].plane(0)(x, y), above.z, below.z, x, y);
                mean += std::max(0.0f, up[0].plane(0)(x, y)) / (n * n);
            }
        EXPECT_NEAR(all.mean(interface, u.plane(0), f.plane(0), Communicator()), mean, 1e-6 * mean);
        EXPECT_GT(mean, 0.1);
    }
}

TEST(InterfaceSweep, GivesTheSameBitsOnAnyTilesAndThreads) {
    for (int n : {33, 40}) {
        State state(n, 0.9, 2.0, 11);
        state.at(0, 5, 6) = 8.0; // beyond the margin
        state.at(1, 32, 1) = -6.0;
        for (int m : {n, substrate_sites(n, 1.618)})
            for (auto [tail, mixed] : {std::pair{false, false}, {true, false}, {false, true}}) {
                const Surface s = scattered(m, n * a, 3.0, 12);
                InterfaceOptions o = with(InterfaceMethod::automatic);
                o.tail = tail;
                o.mixed = mixed;
                const Outcome whole = sweep(s, state, o, 9.0, true);
                for (auto [nx, ny] : {std::pair{17, 40}, {40, 16}, {11, 13}, {8, 8}, {3, 1}})
                    EXPECT_TRUE(same_bits(whole, sweep(s, state, o, 9.0, true, nx, ny)))
                        << n << ' ' << m << ' ' << nx << ' ' << ny;
                {
                    const test::Threads two(2);
                    EXPECT_TRUE(same_bits(whole, sweep(s, state, o, 9.0, true)));
                    EXPECT_TRUE(same_bits(whole, sweep(s, state, o, 9.0, true, 21, 14)));
                }
                o.skip = false;
                EXPECT_TRUE(same_bits(whole, sweep(s, state, o, 9.0, true))) << "skip";
            }
    }
}

/// Number of the sites whose blocks a sweep over the box does not skip.
int sites_in_reach(const Surface& surface, const State& state, double z) {
    using namespace ASPERITY_VARIANT;
    const int n = state.n;
    const Tile tile{0, 0, n, n, n};
    const double cutoff = LennardJones{}.cutoff, margin = sideways_margin(a);
    const HeightMap map(surface, tile, n, a, {});
    const ReachTable table(map, tile, a, cutoff + margin, margin, true);
    const VectorField<double> u = state.on(tile);
    InterfaceSites sites{};
    sites.displacement = u.plane(0);
    sites.spacing = a;
    sites.reference_height = z;
    int reached = 0;
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; x += interface_block) {
            const int count = std::min(interface_block, n - x);
            const BlockOfSites block(sites, x, y, count, map.highest(), {}, margin);
            const Reach reach(table.view(), x, y, map.highest(), block, cutoff,
                              LennardJones{}.closest());
            reached += reach.any() ? count : 0;
        }
    return reached;
}

TEST(InterfaceSweep, SkipsWhatIsOutOfReach) {
    const int n = 32;
    const State still(n, 0.0, 0.0, 1);
    Surface s = scattered(n, n * a, 1.0, 2);
    const Tile tile{0, 0, n, n, n};
    for (int m : {n, 52}) {
        if (m != n) s = scattered(m, n * a, 1.0, 2);
        const Interface interface(s, tile, a, {});
        EXPECT_EQ(interface.method(), m == n ? InterfaceMethod::lattice : InterfaceMethod::rows);
        const double z = interface.start_height();
        EXPECT_EQ(sites_in_reach(s, still, z + 1e-9), 0);
        EXPECT_EQ(sweep(s, still, {}, z + 1e-9, true).sums.force_z.value(), 0.0);
        // One high atom: only blocks around it are looked at.
        s.height.assign(s.height.size(), -20.0);
        s.height[static_cast<std::size_t>(m / 2 * m + m / 2)] = 0.0;
        const Outcome tip = sweep(s, still, {}, 10.0, true);
        EXPECT_LT(tip.sums.force_z.value(), 0.0);
        EXPECT_GT(sites_in_reach(s, still, 10.0), 0);
        EXPECT_LT(sites_in_reach(s, still, 10.0), n * n / 4);
    }
}

TEST(InterfaceSweep, ReportsSitesThatAreNoNumbers) {
    const int n = 16;
    State state(n, 0.1, 0.1, 1);
    state.at(0, 3, 3) = std::nan("");
    state.at(2, 9, 4) = HUGE_VAL;
    for (int m : {16, 26}) {
        const Outcome out = sweep(scattered(m, n * a, 0.5, 1), state, {}, 4.0, false);
        EXPECT_TRUE(std::isnan(out.force[2][3 * 16 + 3]));
        EXPECT_TRUE(std::isnan(out.force[2][4 * 16 + 9]));
        EXPECT_TRUE(std::isfinite(out.force[2][3 * 16 + 4]));
    }
}

TEST(InterfaceMapsOfState, HoldContactGapAndPressure) {
    const int n = 9;
    const Surface s = test::flat_surface(n);
    const Tile tile{0, 0, n, n, n};
    Interface interface(s, tile, a, {});
    interface.set_reference_height(3.2);
    const State still(n, 0.0, 0.0, 1);
    const VectorField<double> u = still.on(tile);
    const InterfaceMaps maps = interface.maps(u.plane(0));
    const double nearest = std::sqrt(3.2 * 3.2 + 2.0 * 1.3 * 1.3);
    VectorField<double> f(tile, 1);
    const InterfaceSums sums = interface.sweep(u.plane(0), f.plane(0), {.observe = true});
    EXPECT_EQ(sums.in_contact, n * n);
    for (std::size_t i = 0; i < maps.gap.size(); ++i) {
        EXPECT_EQ(maps.contact[i], 1);
        EXPECT_NEAR(maps.distance[i], nearest, 1e-12);
        EXPECT_NEAR(maps.gap[i], 3.2, 1e-12);
        EXPECT_NEAR(maps.pressure[i], sums.force_z.value() / (n * n) / (a * a) * 160.21766208,
                    1e-9);
    }
    interface.set_reference_height(20.0);
    const InterfaceMaps far = interface.maps(u.plane(0));
    EXPECT_EQ(far.contact[0], 0);
    EXPECT_TRUE(std::isinf(far.distance[0]));
    EXPECT_EQ(far.pressure[0], 0.0);
}

/// A field that a memory keeps is among the maps, with the sites that they are cut to.
TEST(InterfaceMapsOfState, HoldWhatAMemoryKeeps) {
    const int n = 6;
    const Tile tile{0, 0, n, n, n};
    Interface interface(test::flat_surface(n), tile, a, {});
    const std::size_t before = interface.bytes();
    EXPECT_EQ(interface.maps_of_sites(), 0u);
    Field<double>& age = interface.keep("age");
    interface.keep("heat").plane(0)(1, 0) = 5.0; // the first one stays where it is
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x)
            age.plane(0)(x, y) = 10.0 * y + x;
    EXPECT_EQ(interface.bytes(), before + 2 * age.bytes());
    Interface moved = std::move(interface);
    InterfaceMaps maps = moved.maps(VectorField<double>(tile, 1).plane(0));
    maps.crop(2);
    EXPECT_EQ(moved.maps_of_sites(), 2u);
    EXPECT_EQ(maps.of_sites, (std::vector<std::pair<std::string, std::vector<double>>>{
                                 {"age", {0, 1, 10, 11}}, {"heat", {0, 5, 0, 0}}}));
}

TEST(InterfaceOptionsCheck, SaysWhatIsWrong) {
    const Surface s = scattered(8, 8 * a, 0.0, 1);
    const Tile tile{0, 0, 8, 8, 8};
    InterfaceOptions o;
    std::get<LennardJones>(o.potential).cutoff = 300.0;
    EXPECT_THROW(Interface(s, tile, a, o), std::invalid_argument);
    std::get<LennardJones>(o.potential).cutoff = -1.0;
    EXPECT_THROW(Interface(s, tile, a, o), std::invalid_argument);
    std::get<LennardJones>(o.potential).cutoff = 35.0; // some 150 rows of atoms a tenth of a apart
    EXPECT_THROW(Interface(scattered(320, 32 * a, 0.0, 1), {0, 0, 32, 32, 32}, a, o),
                 std::invalid_argument);
    EXPECT_THROW(Interface(scattered(13, 8 * a, 0.0, 1), tile, a, with(InterfaceMethod::lattice)),
                 std::invalid_argument);
}

TEST(InterfaceMaps, TheGapIsBilinearBetweenTheAtomsBelow) {
    // Heights b + c i + d j + e i j, which bilinear interpolation reproduces wherever a site
    // stands: between atoms of the box's inside, i and j in units of their spacing.
    constexpr int n = 10;
    const auto height = [](double i, double j) {
        return 0.3 + 0.05 * i - 0.02 * j + 0.011 * i * j;
    };
    const Surface surface = test::surface_from(n, height);
    const Tile tile{0, 0, n, n, n};
    Interface interface(surface, tile, a, {});
    interface.set_reference_height(4.0);
    const State state(n, 1.9, 0.5, 7);
    const VectorField<double> u = state.on(tile);
    const InterfaceMaps maps = interface.maps(u.plane(0));
    for (int y = 1; y < n - 2; ++y)
        for (int x = 1; x < n - 2; ++x) {
            const auto at = static_cast<std::size_t>(y * n + x);
            const double below = height(x + 0.5 + state.u[0][at] / a, y + 0.5 + state.u[1][at] / a);
            EXPECT_NEAR(maps.gap[at], 4.0 + state.u[2][at] - below, 1e-12) << x << ", " << y;
        }
}

TEST(InterfaceTail, RepulsiveSitesAreCountedWithTheTail) {
    // The tail attracts: with it fewer sites are repelled, and the count is that of the forces.
    InterfaceOptions options;
    std::get<LennardJones>(options.potential).cutoff = 6.0;
    const Surface surface = scattered(16, 16 * a, 0.5, 3);
    const State state(16, 0.3, 0.4, 4);
    const auto repulsive = [](const Outcome& o) {
        return std::count_if(o.force[2].begin(), o.force[2].end(),
                             [](double f) { return f > 0.0; });
    };
    std::int64_t fewer = 0;
    for (const double z : {2.9, 3.0, 3.1, 3.2, 3.3, 3.4}) {
        options.tail = false;
        const std::int64_t without = sweep(surface, state, options, z, true).sums.repulsive;
        options.tail = true;
        const Outcome with = sweep(surface, state, options, z, true);
        EXPECT_EQ(with.sums.repulsive, repulsive(with)) << z;
        const auto& forces = with.force[2];
        EXPECT_NEAR(with.sums.force_z.value(), std::accumulate(forces.begin(), forces.end(), 0.0),
                    1e-9)
            << z;
        fewer += without - with.sums.repulsive;
    }
    EXPECT_GT(fewer, 0) << "no site at which the tail decides";
}

// What to expect of a force in mixed precision: positions are rounded to 1.2e-7 Å (half of
// fixed_quantum) on both sides, and r^2 by three float roundings: about 3e-7 of r^2. Where a pair
// repels, t^7 - t^4 is half of t^7 and takes fourteen times that, 4e-6; five roundings on the way
// to t^7 add 3e-6. So 1e-5 bounds the error in units of a pair's force (7e-6 is the worst seen, on
// any processor level). The pairs of a site pull against each other: the unit is the largest of
// their forces, not the sum. Likewise for energies: t^6 and t^3, of a unit that is the well's depth
// or more.
constexpr double force_bound = 1e-5, energy_bound = 2e-6;

/// The mixed sweep against pair sums in double; returns the worst error of a force.
double expect_mixed_close(const Surface& substrate, const State& state, double z,
                          const PairPotential& potential = LennardJones{}) {
    InterfaceOptions options = with(InterfaceMethod::automatic, potential);
    options.mixed = true;
    const Outcome mixed = sweep(substrate, state, options, z, true);
    options = with(InterfaceMethod::reference, potential);
    const Outcome reference = sweep(substrate, state, options, z, true);
    const Tile tile{0, 0, state.n, state.n, state.n};
    const VectorField<double> u = state.on(tile);
    Interface interface(substrate, tile, a, options);
    interface.set_reference_height(z);
    const InterfaceMaps maps = interface.maps(u.plane(0));
    double worst = 0.0, energies = 1e-3;
    for (std::size_t i = 0; i < maps.distance.size(); ++i) {
        const double r = maps.distance[i];
        // The nearest atom's force; at the minimum of the pair potential, its well's steepest.
        const auto [pair, depth] = std::visit(
            [r](const auto& p) {
                const auto force = [&](double at) {
                    return std::abs(Pair(p).force_over_distance(at * at)) * at;
                };
                return std::pair(force(r) + (r < 6.0 ? 0.958 * force(p.inflection()) : 1e-3),
                                 p.depth());
            },
            potential);
        for (int k = 0; k < 3; ++k)
            if (std::isfinite(r))
                worst = std::max(worst, std::abs(mixed.force[k][i] - reference.force[k][i]) / pair);
            else
                EXPECT_EQ(mixed.force[k][i], 0.0);
        energies += std::isfinite(r) ? depth : 0.0;
    }
    EXPECT_LT(worst, force_bound);
    const double energy = reference.sums.energy.value();
    EXPECT_NEAR(mixed.sums.energy.value(), energy,
                energy_bound * std::max(energies, std::abs(energy)));
    EXPECT_EQ(mixed.sums.in_contact, reference.sums.in_contact);
    EXPECT_EQ(mixed.sums.repulsive, reference.sums.repulsive);
    return worst;
}

TEST(MixedPrecision, ForcesAndEnergiesOfRoughStates) {
    unsigned seed = 1;
    double force = 0.0;
    for (int n : {16, 33})
        for (double sideways : {0.1, 1.5})
            // Flat, rough, and a box as high as a mountain: only differences matter.
            for (auto [amplitude, level, gap] : {std::tuple{0.05, 0.0, 3.1},
                                                 {1.0, 0.0, 4.0},
                                                 {2.0, -4321.0, 5.0},
                                                 {8.0, 9876.5, 10.0}})
                for (const PairPotential& potential : test::potentials()) {
                    if (std::holds_alternative<Tabulated>(potential)) continue;
                    SCOPED_TRACE(std::to_string(n) + " " + std::to_string(amplitude) + " " +
                                 std::to_string(potential.index()));
                    const Surface s = scattered(n, n * a, amplitude, ++seed, level);
                    const State state(n, sideways, 0.5, seed);
                    force = std::max(force, expect_mixed_close(s, state, level + gap, potential));
                }
    EXPECT_GT(force, 1e-9) << "is it mixed at all?";
}

TEST(MixedPrecision, ActsInTheSweepOverALatticeAlone) {
    const int n = 16;
    const State state(n, 0.3, 0.5, 3);
    for (int m : {n, substrate_sites(n, 1.618)})
        for (const PairPotential& potential : test::potentials()) {
            const Surface s = scattered(m, n * a, 1.0, 7);
            InterfaceOptions o = with(InterfaceMethod::automatic, potential);
            const Outcome exact = sweep(s, state, o, 4.0, true);
            o.mixed = true;
            EXPECT_EQ(same_bits(exact, sweep(s, state, o, 4.0, true)),
                      m != n || std::holds_alternative<Tabulated>(potential))
                << m << ' ' << potential.index();
        }
}

TEST(MixedPrecision, LeavesDepthsBeyondTheFixedRangeToTheReference) {
    // A pit 400 Å deep, and sites at its bottom: atoms there are beyond the 250 Å of fixed depth.
    Surface pit = scattered(16, 16 * a, 0.3, 5);
    for (std::size_t i = 0; i < pit.height.size() / 2; ++i)
        pit.height[i] -= 400.0;
    for (double z : {3.0, -100.0, -238.0, -247.0, -300.0, -396.8}) {
        SCOPED_TRACE(z);
        expect_mixed_close(pit, State(16, 0.2, 0.2, 6), z);
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
