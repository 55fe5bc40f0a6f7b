// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// How long does a node's step take, in cache and out of it, and what share of the memory's speed is
// that? The memory's speed is measured in the same run, by a stream triad on as many threads.
#include "engine/block.hpp"

#include <benchmark/benchmark.h>

#include <omp.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <utility>
#include <vector>

using namespace asperity;

namespace {

/// GB/s of a = b + s c on arrays three times the size of a large cache, counted as two reads and
/// one write; best of ten.
double stream_rate(int threads) {
    static std::array<double, 256> known{};
    double& best = known.at(static_cast<std::size_t>(threads));
    if (best > 0.0) return best;
    const Tile tile{0, 0, 1 << 12, 1 << 10, 1 << 12};
    VectorField<double> field(tile, 1);
    const auto plane = field.plane(0);
    for (int repeat = 0; repeat < 10; ++repeat) {
        const auto start = std::chrono::steady_clock::now();
#pragma omp parallel for schedule(static) num_threads(threads)
        for (int y = 0; y < tile.ny; ++y) {
            double* a = plane.x.line(y);
            const double *b = plane.y.line(y), *c = plane.z.line(y);
#pragma omp simd
            for (int x = 0; x < tile.nx; ++x)
                a[x] = b[x] + 1e-9 * c[x];
        }
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
        best = std::max(best, 24e-9 * tile.nx * tile.ny / took.count());
    }
    return best;
}

/// u and v each read and written: 12 doubles a node's step is the least of a pass of one step.
void count(benchmark::State& state, double nodes, int threads) {
    using benchmark::Counter;
    const double rate = static_cast<double>(state.iterations()) * nodes;
    state.counters["ns/node/core"] =
        Counter(rate * 1e-9 / threads, Counter::kIsRate | Counter::kInvert);
    state.counters["GB/s"] = Counter(rate * 96e-9, Counter::kIsRate);
    state.counters["of_stream"] = Counter(rate * 96e-9 / stream_rate(threads), Counter::kIsRate);
    state.counters["stream_GB/s"] = stream_rate(threads);
}

/// Kernels alone: kick and drift of four planes, on one core.
void kick_and_drift(benchmark::State& state) {
    const int n = static_cast<int>(state.range(0)), layers = 4, band = 8;
    const Tile tile{0, 0, n, n, n};
    VectorField<double> u(tile, layers + 1), v(tile, layers), incoming(tile, 1);
    const CellElasticity elasticity{0.441, 0.117};
    const Stencil lower = make_stencil(elasticity, Face::lower),
                  inner = make_stencil(elasticity, Face::inner);
    Kick kick;
    kick.kick = 1e-6;
    kick.damped = state.range(1) != 0;
    kick.keep = kick.damped ? 0.999 : 1.0;
    KickSums sums;
    for (auto _ : state)
        for (int y = 0; y < n; y += band)
            for (int z = 0; z < layers; ++z) {
                const Following next =
                    z + 1 < layers ? Following{z + 1, y} : Following{0, y + band};
                elastic_kernels().kick(std::as_const(u).view(), z, z == 0 ? lower : inner, y,
                                       y + band, std::as_const(incoming).plane(0), kick, next,
                                       v.view(), sums);
                elastic_kernels().drift(std::as_const(v).plane(z), 1e-3, y, y + band, u.plane(z));
            }
    count(state, static_cast<double>(n) * n * layers, 1);
}
BENCHMARK(kick_and_drift)
    ->ArgNames({"sites", "damped"})
    ->ArgsProduct({{32, 64, 128, 256, 512}, {0, 1}})
    ->UseRealTime();

/// The same at finite strain, with and without a dilatation term.
void kick_and_drift_finite(benchmark::State& state) {
    const int n = static_cast<int>(state.range(0)), layers = 4, band = Block::band;
    const Tile tile{0, 0, n, n, n};
    VectorField<double> u(tile, layers + 1), v(tile, layers), forces(tile, 2);
    const FiniteCell cell{2.6, {0.441, state.range(1) != 0 ? 0.117 : 0.0}};
    Kick kick;
    kick.kick = 1e-6;
    KickSums sums;
    for (auto _ : state)
        for (int y = 0; y < n; y += band)
            for (int z = 0; z < layers; ++z) {
                const Patch rows = {0, n, y, y + band};
                const auto lower = forces.plane(z & 1), upper = forces.plane((z + 1) & 1);
                finite_kernels().cells(std::as_const(u).view(), z, cell, rows, lower, rows, upper);
                finite_kernels().kick(lower, z, y, y + band, kick, v.view(), sums);
                elastic_kernels().drift(std::as_const(v).plane(z), 1e-3, y, y + band, u.plane(z));
            }
    count(state, static_cast<double>(n) * n * layers, 1);
}
BENCHMARK(kick_and_drift_finite)
    ->ArgNames({"sites", "dilatation"})
    ->ArgsProduct({{32, 64, 128, 256, 512}, {0, 1}})
    ->UseRealTime();

/// The paper's block: hanging planes, all levels, halos.
void block_step(benchmark::State& state) {
    const int n = static_cast<int>(state.range(0)), threads = static_cast<int>(state.range(1));
    omp_set_num_threads(threads);
    BlockOptions options;
    options.sites = options.thickness = n;
    options.young = 0.48;
    options.atom_mass = 2.04e4;
    const auto levels = plan_levels(options);
    Block block(options, Communicator(), ProcessGrid(1, 0, n, static_cast<int>(levels.size())));
    block.set_uniform(0.0, 1e-4);
    StepPlan plan;
    plan.dt = 10.0;
    plan.damping = state.range(2) != 0 ? 5e-5 : 0.0;
    KickSums sums;
    for (auto _ : state) {
        block.interpolate();
        block.advance(plan, sums);
        block.exchange();
    }
    double nodes = 0.0;
    for (const LevelPlan& level : levels)
        nodes += static_cast<double>(level.sites) * level.sites * level.cells;
    count(state, nodes, threads);
    state.counters["MB"] = 1e-6 * static_cast<double>(block.bytes());
}
BENCHMARK(block_step)
    ->ArgNames({"sites", "threads", "damped"})
    ->ArgsProduct({{128, 256, 512}, {1, 2}, {0, 1}})
    ->UseRealTime();

} // namespace
