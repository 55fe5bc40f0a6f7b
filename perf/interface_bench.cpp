// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// How long does a pair take, and how near is that to the processor's limit? The three sweeps, in
// double and mixed, force only and observed, over a nearly flat interface at the equilibrium
// separation, that over cells on the atoms of the one over rows; and what skipping gains over a
// rough one in partial contact. One thread.
//
//   s/pair         time by pairs within the cutoff, so lanes spent on others show
//   arithmetic     what a force's operations take where none waits for another, and slow: its
//                  divisions alone; both measured in the same run (limits.hpp)
//   GFLOP/s        of a pair's force (the energies of an observed sweep are not counted)
#include "engine/case/potential_table.hpp"
#include "engine/interface/interface.hpp"
#include "engine/scene/surface.hpp"
#include "kernels/variant.hpp"
#include "limits.hpp"

#include <benchmark/benchmark.h>
#include <omp.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <random>
#include <vector>

namespace asperity {
namespace {

constexpr double a = 2.6;
constexpr int n = 128;

/// Of a pair in the force-only lattice sweep: 31 multiplications in four pairs, 13 of them fused
/// with an addition, 16 more additions and two divisions. The other sweeps are counted alike.
constexpr double flops = (31 + 13 + 16 + 2) / 4.0;

Surface nearly_flat(int sites) {
    Surface s;
    s.sites = sites;
    s.length = n * a;
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> height(-0.05, 0.05);
    for (int i = 0; i < sites * sites; ++i)
        s.height.push_back(height(random));
    return s;
}

/// The same, as atoms anywhere.
Surface as_atoms(const Surface& map) {
    Surface s;
    s.sites = n;
    s.length = map.length;
    s.height.assign(static_cast<std::size_t>(n) * n, map.height.front());
    const double b = map.length / map.sites;
    for (int i = 0; i < map.sites * map.sites; ++i) {
        s.atoms.x.push_back(b * (i % map.sites));
        s.atoms.y.push_back(b * (i / map.sites));
        s.atoms.z.push_back(map.height[static_cast<std::size_t>(i)]);
    }
    return s;
}

/// Pairs within the cutoff, of all sites.
double pairs_in_reach(double b, double cutoff, double z) {
    double pairs = 0.0;
    const int most = static_cast<int>(cutoff / b) + 1;
    for (int j = -most; j <= most; ++j)
        for (int i = -most; i <= most; ++i) {
            const double x = (i + 0.5) * b, y = (j + 0.5) * b;
            pairs += x * x + y * y + z * z < cutoff * cutoff;
        }
    return pairs * n * n;
}

/// Sweeps of an undisplaced block at a reference height; returns the processor's seconds for one.
double time_sweeps(benchmark::State& state, const Surface& substrate,
                   const InterfaceOptions& options, double height, bool observe) {
    omp_set_num_threads(1);
    const Tile tile{0, 0, n, n, n};
    const Interface interface(substrate, tile, a, options);
    VectorField<double> u(tile, 1), f(tile, 1);
    const VectorField<double>& seen = u;
    const std::clock_t begin = std::clock();
    for (auto _ : state)
        benchmark::DoNotOptimize(
            interface.sweep(seen.plane(0), f.plane(0), {.observe = observe, .height = height})
                .force_z.bin[0]);
    const double sweep = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC /
                         static_cast<double>(state.iterations());
    state.counters["s/site"] = sweep / (n * n);
    state.SetLabel(name(processor_level()));
    return sweep;
}

/// In contact over a nearly flat substrate of so many sites.
void contact(benchmark::State& state, int sites, bool atoms_anywhere, Timed kernel,
             const PairPotential& potential = LennardJones{}) {
    constexpr double height = 3.11;
    const bool mixed = state.range(0), observe = state.range(1);
    InterfaceOptions options;
    options.potential = potential;
    options.mixed = mixed;
    const double pairs = pairs_in_reach(n * a / sites, cutoff_of(options.potential), height);
    const Surface map = nearly_flat(sites);
    const double pair =
        time_sweeps(state, atoms_anywhere ? as_atoms(map) : map, options, height, observe) / pairs;
    state.counters["s/pair"] = pair;
    const ArithmeticLimit limit = arithmetic_limit(kernel, mixed);
    state.counters["arithmetic"] = limit.all;
    state.counters["slow"] = limit.slow;
    state.counters["GFLOP/s"] = 1e-9 * flops / pair;
    state.counters["of_fused"] = 1e-9 * flops / pair / fused_rate(mixed);
    state.counters["fused_GFLOP/s"] = fused_rate(mixed);
}

void lattice(benchmark::State& state) { contact(state, n, false, Timed::lattice); }
void rows(benchmark::State& state) {
    contact(state, substrate_sites(n, 1.618), false, Timed::rows);
}
void cells(benchmark::State& state) {
    contact(state, substrate_sites(n, 1.618), true, Timed::cells);
}

// Other potentials over the block's lattice; their limits are not those of Lennard-Jones.
void morse(benchmark::State& state) { contact(state, n, false, Timed::lattice, Morse{}); }
void table(benchmark::State& state) {
    static const PotentialTable numbers = [] {
        const Pair<LennardJones> pair{LennardJones{}};
        std::vector<double> r, v;
        for (double at = 1.8; at < 14.0; at += 0.01) {
            r.push_back(at);
            v.push_back(pair.unshifted(at * at));
        }
        return PotentialTable(r, v);
    }();
    contact(state, n, false, Timed::lattice, numbers.potential(LennardJones{}.cutoff));
}

void out_of_reach(benchmark::State& state) { time_sweeps(state, nearly_flat(n), {}, 14.0, false); }

/// Rough on an undisplaced block, the highest atom 4 Å deep in it: a small part is in reach.
void partial_contact(benchmark::State& state) {
    SurfaceOptions rough;
    rough.sites = n;
    rough.length = n * a;
    rough.rms = 9.0;
    const Surface surface = make_surface(rough);
    InterfaceOptions options;
    options.skip = state.range(0);
    const double highest = *std::max_element(surface.height.begin(), surface.height.end());
    time_sweeps(state, surface, options, highest - 4.0, false);
}

const std::vector<std::vector<std::int64_t>> both{{0, 1}, {0, 1}};
BENCHMARK(lattice)->ArgNames({"mixed", "observed"})->ArgsProduct(both);
BENCHMARK(morse)->ArgNames({"mixed", "observed"})->ArgsProduct(both);
const std::vector<std::vector<std::int64_t>> in_double{{0}, {0, 1}};
BENCHMARK(table)->ArgNames({"mixed", "observed"})->ArgsProduct(in_double);
BENCHMARK(rows)->ArgNames({"mixed", "observed"})->ArgsProduct(in_double);
BENCHMARK(cells)->ArgNames({"mixed", "observed"})->ArgsProduct(in_double);
BENCHMARK(out_of_reach);
BENCHMARK(partial_contact)->ArgName("skip")->Arg(0)->Arg(1);

} // namespace
} // namespace asperity

BENCHMARK_MAIN();
