// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// How long does a pair take? The lattice sweep and the cell list over a nearly flat interface at
// the equilibrium separation, one thread. Counter "s/pair" divides by the pairs within the cutoff,
// so lanes spent on pairs beyond it show.
#include "engine/interface.hpp"
#include "kernels/variant.hpp"

#include <benchmark/benchmark.h>
#include <omp.h>

#include <cmath>
#include <random>

namespace asperity {
namespace {

constexpr double a = 2.6;
constexpr int n = 128;

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

void sweep(benchmark::State& state, int sites, double height, bool observe) {
    omp_set_num_threads(1);
    const Tile tile{0, 0, n, n, n};
    const Interface interface(nearly_flat(sites), tile, a, {});
    VectorField<double> u(tile, 1), f(tile, 1);
    const VectorField<double>& seen = u;
    for (auto _ : state)
        benchmark::DoNotOptimize(
            interface.sweep(seen.plane(0), f.plane(0), height, observe).force_z.bin[0]);
    const double pairs =
        pairs_in_reach(n * a / sites, interface.options().potential.cutoff, height);
    if (pairs > 0.0) {
        const auto swept = static_cast<double>(state.iterations()) * pairs;
        state.counters["pairs/s"] = benchmark::Counter(swept, benchmark::Counter::kIsRate);
        state.counters["s/pair"] =
            benchmark::Counter(swept, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
    }
    state.counters["s/site"] =
        benchmark::Counter(static_cast<double>(state.iterations()) * n * n,
                           benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
    state.SetLabel(name(processor_level()));
}

void lattice(benchmark::State& state) { sweep(state, n, 3.11, false); }
void lattice_observed(benchmark::State& state) { sweep(state, n, 3.11, true); }
void lattice_out_of_reach(benchmark::State& state) { sweep(state, n, 14.0, false); }
void cell_list(benchmark::State& state) { sweep(state, substrate_sites(n, 1.618), 3.11, false); }
void cell_list_observed(benchmark::State& state) {
    sweep(state, substrate_sites(n, 1.618), 3.11, true);
}

BENCHMARK(lattice);
BENCHMARK(lattice_observed);
BENCHMARK(lattice_out_of_reach);
BENCHMARK(cell_list);
BENCHMARK(cell_list_observed);

} // namespace
} // namespace asperity

BENCHMARK_MAIN();
