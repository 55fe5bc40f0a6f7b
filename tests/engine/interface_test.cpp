// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The fast sweeps against the reference, forces against energies, and the same bits whatever the
// decomposition. States are rough and displaced at random, some far beyond what a run allows.
#include "engine/interface/interface.hpp"
#include "engine/interface/interface_stiffness.hpp"
#include "support/cases.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <random>
#include <string>

namespace asperity {
namespace {

constexpr double a = 2.6;
constexpr double r0 = 3.28;

// Boxes of a few sites: threads would only wait for each other, but where they are what is tested.
[[maybe_unused]] const bool one_thread = (omp_set_num_threads(1), true);

Surface rough(int sites, double length, double amplitude, unsigned seed) {
    Surface s;
    s.sites = sites;
    s.length = length;
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> height(-amplitude, amplitude);
    for (int i = 0; i < sites * sites; ++i)
        s.height.push_back(height(random));
    return s;
}

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
Outcome sweep(const Surface& substrate, const State& state, const InterfaceOptions& options,
              double z, bool observe, int nx = 1 << 20, int ny = 1 << 20) {
    Outcome out;
    const int n = state.n;
    for (auto& f : out.force)
        f.assign(static_cast<std::size_t>(n * n), 1e99);
    for (int y0 = 0; y0 < n; y0 += ny)
        for (int x0 = 0; x0 < n; x0 += nx) {
            const Tile tile{x0, y0, std::min(nx, n - x0), std::min(ny, n - y0), n};
            const Interface interface(substrate, tile, a, options);
            const VectorField<double> u = state.on(tile);
            VectorField<double> f(tile, 1);
            out.sums.merge(interface.sweep(u.plane(0), f.plane(0), z, {.observe = observe}));
            for (int y = 0; y < tile.ny; ++y)
                for (int x = 0; x < tile.nx; ++x) {
                    const auto i = static_cast<std::size_t>((y0 + y) * n + x0 + x);
                    out.force[0][i] = f.x.plane(0)(x, y);
                    out.force[1][i] = f.y.plane(0)(x, y);
                    out.force[2][i] = f.z.plane(0)(x, y);
                }
        }
    return out;
}

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
    const double energy = reference.sums.energy.value();
    EXPECT_NEAR(energy, other.sums.energy.value(), 1e-12 * (10.0 + std::abs(energy))) << what;
}

bool same_bits(const Outcome& p, const Outcome& q) {
    for (int k = 0; k < 3; ++k)
        if (std::memcmp(p.force[k].data(), q.force[k].data(), p.force[k].size() * sizeof(double)))
            return false;
    return p.sums.force_z.value() == q.sums.force_z.value() &&
           p.sums.energy.value() == q.sums.energy.value() &&
           p.sums.in_contact == q.sums.in_contact && p.sums.repulsive == q.sums.repulsive &&
           p.sums.closest_r2 == q.sums.closest_r2;
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
                        const Surface same = rough(n, n * a, 2.0, seed);
                        const Outcome reference = swept(same, InterfaceMethod::reference);
                        expect_close(reference, swept(same, InterfaceMethod::lattice),
                                     "lattice " + what);
                        expect_close(reference, swept(same, InterfaceMethod::rows), "rows " + what);
                        const Surface other = rough(substrate_sites(n, 1.618), n * a, 2.0, seed);
                        expect_close(swept(other, InterfaceMethod::reference),
                                     swept(other, InterfaceMethod::automatic),
                                     "incommensurate " + what);
                    }
}

TEST(InterfaceSweep, MixedAgreesWithDoubleForEveryPotential) {
    const int n = 24;
    const State state(n, 0.5, 1.0, 3);
    for (const PairPotential& potential : test::potentials())
        for (int m : {24, 38}) {
            const Surface surface = rough(m, n * a, 1.5, 8);
            InterfaceOptions options = with(InterfaceMethod::automatic, potential);
            const Outcome exact = sweep(surface, state, options, 4.5, true);
            options.mixed = true;
            const Outcome mixed = sweep(surface, state, options, 4.5, true);
            double most = 0.0, largest = 0.0;
            for (int k = 0; k < 3; ++k)
                for (std::size_t i = 0; i < exact.force[k].size(); ++i) {
                    most = std::max(most, std::abs(exact.force[k][i] - mixed.force[k][i]));
                    largest = std::max(largest, std::abs(exact.force[k][i]));
                }
            EXPECT_LT(most, 1e-5 * largest) << potential.index() << " " << m;
            EXPECT_GT(most, 0.0);
            EXPECT_NEAR(exact.sums.energy.value(), mixed.sums.energy.value(),
                        1e-6 * std::abs(exact.sums.energy.value()) + 1e-4);
        }
}

TEST(InterfaceSweep, ForceOnlyGivesTheBitsOfTheObservedSweep) {
    const int n = 19;
    const State state(n, 0.8, 1.0, 3);
    for (auto [m, mixed] : {std::pair{19, false}, {31, false}, {19, true}, {31, true}}) {
        const Surface s = rough(m, n * a, 1.0, 4);
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
                    const Surface s = rough(m, n * a, 0.5, 5);
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
        const Interface interface(rough(n, n * a, 0.5, 11), tile, a,
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
            interface.sweep(u.plane(0), f.plane(0), z, {});
            return f;
        };
        const VectorField<double> u = state.on(tile), f = force_at(0.0);
        const VectorField<double> above = force_at(h), below = force_at(-h);
        InterfaceStiffness all(tile, 3), normal(tile, 1);
        all.measure(interface, u.plane(0), f.plane(0), z);
        normal.measure(interface, u.plane(0), f.plane(0), z);
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
        all.apply(v);
        normal.apply(up);
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
        EXPECT_NEAR(all.mean(interface, u.plane(0), f.plane(0), z, Communicator()), mean,
                    1e-6 * mean);
        EXPECT_GT(mean, 0.1);
    }
}

TEST(InterfaceSweep, TotalForceIsMinusTheGradientOfARigidShift) {
    // Newton's third law: what pushes the block sideways or up pushes the substrate back.
    const int n = 12;
    const Surface s = rough(n, n * a, 0.8, 7);
    State state(n, 0.3, 0.3, 8);
    const InterfaceOptions o = with(InterfaceMethod::automatic);
    const Outcome out = sweep(s, state, o, 4.0, true);
    for (int k = 0; k < 3; ++k) {
        double total = 0.0;
        for (double f : out.force[k])
            total += f;
        if (k == 2) {
            EXPECT_NEAR(total, out.sums.force_z.value(), 1e-10);
        }
        const double h = 1e-6;
        double energy[2];
        for (int side : {0, 1}) {
            State moved = state;
            for (double& u : moved.u[k])
                u += side ? h : -h;
            energy[side] = sweep(s, moved, o, 4.0, true).sums.energy.value();
        }
        // Up to the small steps of the force at the cutoff.
        EXPECT_NEAR(total, -(energy[1] - energy[0]) / (2.0 * h), 1e-3) << k;
    }
}

TEST(InterfaceSweep, IsTheSameOnAShiftedLattice) {
    // A displacement by whole spacings over a substrate moved along: the same forces.
    const int n = 14;
    const Surface s = rough(n, n * a, 1.0, 9);
    Surface moved = s;
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x)
            moved.height[static_cast<std::size_t>(periodic(y - 1, n) * n + periodic(x + 1, n))] =
                s.height[static_cast<std::size_t>(y * n + x)];
    const State state(n, 0.4, 0.5, 10);
    State shifted = state;
    for (double& u : shifted.u[0])
        u += a;
    for (double& u : shifted.u[1])
        u -= a;
    for (auto method : {InterfaceMethod::lattice, InterfaceMethod::rows})
        expect_close(sweep(s, state, with(method), 3.5, true),
                     sweep(moved, shifted, with(method), 3.5, true), "shifted");
}

TEST(InterfaceSweep, GivesTheSameBitsOnAnyTilesAndThreads) {
    for (int n : {33, 40}) {
        State state(n, 0.9, 2.0, 11);
        state.at(0, 5, 6) = 8.0; // beyond the margin
        state.at(1, 32, 1) = -6.0;
        for (int m : {n, substrate_sites(n, 1.618)})
            for (auto [tail, mixed] : {std::pair{false, false}, {true, false}, {false, true}}) {
                const Surface s = rough(m, n * a, 3.0, 12);
                InterfaceOptions o = with(InterfaceMethod::automatic);
                o.tail = tail;
                o.mixed = mixed;
                const Outcome whole = sweep(s, state, o, 9.0, true);
                for (auto [nx, ny] : {std::pair{17, 40}, {40, 16}, {11, 13}, {8, 8}, {3, 1}})
                    EXPECT_TRUE(same_bits(whole, sweep(s, state, o, 9.0, true, nx, ny)))
                        << n << ' ' << m << ' ' << nx << ' ' << ny;
                omp_set_num_threads(2);
                EXPECT_TRUE(same_bits(whole, sweep(s, state, o, 9.0, true)));
                EXPECT_TRUE(same_bits(whole, sweep(s, state, o, 9.0, true, 21, 14)));
                omp_set_num_threads(1);
                o.skip = false;
                EXPECT_TRUE(same_bits(whole, sweep(s, state, o, 9.0, true))) << "skip";
            }
    }
}

TEST(InterfaceSweep, SkipsWhatIsOutOfReach) {
    const int n = 32;
    const State still(n, 0.0, 0.0, 1);
    Surface s = rough(n, n * a, 1.0, 2);
    const Tile tile{0, 0, n, n, n};
    for (int m : {n, 52}) {
        if (m != n) s = rough(m, n * a, 1.0, 2);
        const Interface interface(s, tile, a, {});
        EXPECT_EQ(interface.method(), m == n ? InterfaceMethod::lattice : InterfaceMethod::rows);
        const double z = interface.start_height();
        EXPECT_EQ(sweep(s, still, {}, z + 1e-9, true).sums.in_reach, 0);
        EXPECT_EQ(sweep(s, still, {}, z + 1e-9, true).sums.force_z.value(), 0.0);
        // One high atom: only blocks around it are looked at.
        s.height.assign(s.height.size(), -20.0);
        s.height[static_cast<std::size_t>(m / 2 * m + m / 2)] = 0.0;
        const Outcome tip = sweep(s, still, {}, 10.0, true);
        EXPECT_LT(tip.sums.force_z.value(), 0.0);
        EXPECT_LT(tip.sums.in_reach, n * n / 4);
    }
}

TEST(InterfaceSweep, ReportsSitesThatAreNoNumbers) {
    const int n = 16;
    State state(n, 0.1, 0.1, 1);
    state.at(0, 3, 3) = std::nan("");
    state.at(2, 9, 4) = std::numeric_limits<double>::infinity();
    for (int m : {16, 26}) {
        const Outcome out = sweep(rough(m, n * a, 0.5, 1), state, {}, 4.0, false);
        EXPECT_TRUE(std::isnan(out.force[2][3 * 16 + 3]));
        EXPECT_TRUE(std::isnan(out.force[2][4 * 16 + 9]));
        EXPECT_TRUE(std::isfinite(out.force[2][3 * 16 + 4]));
    }
}

TEST(InterfaceMapsOfState, HoldContactGapAndPressure) {
    const int n = 9;
    Surface s = rough(n, n * a, 0.0, 1);
    const Tile tile{0, 0, n, n, n};
    const Interface interface(s, tile, a, {});
    const State still(n, 0.0, 0.0, 1);
    const VectorField<double> u = still.on(tile);
    const InterfaceMaps maps = interface.maps(u.plane(0), 3.2);
    const double nearest = std::sqrt(3.2 * 3.2 + 2.0 * 1.3 * 1.3);
    VectorField<double> f(tile, 1);
    const InterfaceSums sums = interface.sweep(u.plane(0), f.plane(0), 3.2, {.observe = true});
    EXPECT_EQ(sums.in_contact, n * n);
    for (std::size_t i = 0; i < maps.gap.size(); ++i) {
        EXPECT_EQ(maps.contact[i], 1);
        EXPECT_NEAR(maps.distance[i], nearest, 1e-12);
        EXPECT_NEAR(maps.gap[i], 3.2, 1e-12);
        EXPECT_NEAR(maps.pressure[i], sums.force_z.value() / (n * n) / (a * a) * 160.21766208,
                    1e-9);
    }
    const InterfaceMaps far = interface.maps(u.plane(0), 20.0);
    EXPECT_EQ(far.contact[0], 0);
    EXPECT_TRUE(std::isinf(far.distance[0]));
    EXPECT_EQ(far.pressure[0], 0.0);
}

TEST(InterfaceOptionsCheck, SaysWhatIsWrong) {
    const Surface s = rough(8, 8 * a, 0.0, 1);
    const Tile tile{0, 0, 8, 8, 8};
    InterfaceOptions o;
    std::get<LennardJones>(o.potential).cutoff = 300.0;
    EXPECT_THROW(Interface(s, tile, a, o), std::invalid_argument);
    std::get<LennardJones>(o.potential).cutoff = -1.0;
    EXPECT_THROW(Interface(s, tile, a, o), std::invalid_argument);
    std::get<LennardJones>(o.potential).cutoff = 35.0; // some 150 rows of atoms a tenth of a apart
    EXPECT_THROW(Interface(rough(320, 32 * a, 0.0, 1), {0, 0, 32, 32, 32}, a, o),
                 std::invalid_argument);
    EXPECT_THROW(Interface(rough(13, 8 * a, 0.0, 1), tile, a, with(InterfaceMethod::lattice)),
                 std::invalid_argument);
}

TEST(InterfaceMaps, TheGapIsBilinearBetweenTheAtomsBelow) {
    // Heights b + c i + d j + e i j, which bilinear interpolation reproduces wherever a site
    // stands: between atoms of the box's inside, i and j in units of their spacing.
    constexpr int n = 10;
    const auto height = [](double i, double j) {
        return 0.3 + 0.05 * i - 0.02 * j + 0.011 * i * j;
    };
    Surface surface;
    surface.sites = n;
    surface.length = n * a;
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i)
            surface.height.push_back(height(i, j));
    const Tile tile{0, 0, n, n, n};
    const Interface interface(surface, tile, a, {});
    const State state(n, 1.9, 0.5, 7);
    const VectorField<double> u = state.on(tile);
    const InterfaceMaps maps = interface.maps(u.plane(0), 4.0);
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
    const Surface surface = rough(16, 16 * a, 0.5, 3);
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

} // namespace
} // namespace asperity
