// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// How long does a node's step take, in cache and out of it, and what fraction of the memory's speed
// is that? The memory's speed is measured in the same run, by a stream triad on as many threads,
// and the processor's by a loop of fused multiply-adds (limits.hpp).
#include "engine/block/block.hpp"
#include "limits.hpp"

#include <benchmark/benchmark.h>

#include <omp.h>

#include <utility>

using namespace asperity;

namespace {

/// A node's, and its part of the upper plane's: of four planes each fifth (limits.cpp).
double flops(bool damped) {
    const double upper = 24 + 9 + 2 * 35;
    return (damped ? 51 + 12 + 2 * 40 : 43 + 9 + 2 * 33) + upper / 4;
}

/// u and v each read and written: 12 doubles a node's step is the least of a pass of one step.
void count(benchmark::State& state, double nodes, int threads, double flops) {
    using benchmark::Counter;
    const double rate = static_cast<double>(state.iterations()) * nodes;
    state.counters["ns/node/core"] =
        Counter(rate * 1e-9 / threads, Counter::kIsRate | Counter::kInvert);
    state.counters["GB/s"] = Counter(rate * 96e-9, Counter::kIsRate);
    state.counters["of_stream"] = Counter(rate * 96e-9 / stream_rate(threads), Counter::kIsRate);
    state.counters["stream_GB/s"] = stream_rate(threads);
    if (flops == 0.0) return;
    state.counters["GFLOP/s"] = Counter(rate * flops * 1e-9, Counter::kIsRate);
    state.counters["of_fused"] =
        Counter(rate * flops * 1e-9 / (threads * fused_rate(false)), Counter::kIsRate);
    state.counters["fused_GFLOP/s"] = threads * fused_rate(false);
}

/// Kernels alone: kick and drift of four planes, forces on the fifth, on one core.
void advance(benchmark::State& state, CellStrain strain, const LevelCell& cell, bool damped) {
    const int n = static_cast<int>(state.range(0)), layers = 4, band = Block::band;
    const Tile tile{0, 0, n, n, n};
    VectorField<double> u(tile, layers + 1), v(tile, layers), transferred(tile, 1), upper(tile, 1),
        scratch({0, 0, n, band, n}, 2);
    const ElasticLevel level = {layers,
                                u.view(),
                                v.view(),
                                transferred.plane(0),
                                upper.plane(0),
                                make_stencil(cell.elasticity, Face::lower),
                                make_stencil(cell.elasticity, Face::inner),
                                make_stencil(cell.elasticity, Face::upper),
                                cell};
    Kick kick;
    kick.kick = 1e-6;
    kick.damped = damped;
    kick.velocity_factor = kick.damped ? 0.999 : 1.0;
    KickSums sums;
    for (auto _ : state)
        for (int y = 0; y < n; y += band)
            elastic_kernels(strain).advance(level, {kick, kick, kick, layers}, 1e-3,
                                            {y, y + band, 0, n}, scratch.view(), sums);
    const bool small = strain == CellStrain::small;
    count(state, static_cast<double>(n) * n * layers, 1, small ? flops(damped) : 0.0);
    const ArithmeticLimit limit = arithmetic_limit(!small   ? Timed::finite
                                                   : damped ? Timed::damped
                                                            : Timed::node,
                                                   false);
    state.counters["arithmetic"] = limit.all;
    state.counters["slow"] = limit.slow;
}
void kick_and_drift(benchmark::State& state) {
    advance(state, CellStrain::small, {2.6, {0.441, 0.117}}, state.range(1) != 0);
}
BENCHMARK(kick_and_drift)
    ->ArgNames({"sites", "damped"})
    ->ArgsProduct({{32, 64, 128, 256, 512}, {0, 1}})
    ->UseRealTime();

/// The same at finite strain, with and without a dilatation term.
void kick_and_drift_finite(benchmark::State& state) {
    advance(state, CellStrain::finite, {2.6, {0.441, state.range(1) != 0 ? 0.117 : 0.0}}, false);
}
BENCHMARK(kick_and_drift_finite)
    ->ArgNames({"sites", "dilatation"})
    ->ArgsProduct({{32, 64, 128, 256, 512}, {0, 1}})
    ->UseRealTime();

/// Between two levels, on one core: a fine plane of three components follows the coarse one, or
/// hands its forces back. Rates count fine nodes; three doubles are moved for each, and three for
/// each coarse one.
void level_transfer(benchmark::State& state) {
    const int n = static_cast<int>(state.range(0)), half = n / 2;
    VectorField<double> fine({0, 0, n, n, n}, 1), coarse({0, 0, half, half, half}, 1);
    const auto f = fine.plane(0), c = coarse.plane(0);
    const auto seen_f = std::as_const(fine).plane(0), seen_c = std::as_const(coarse).plane(0);
    const TransferKernels& kernels = transfer_kernels();
    const LevelSeam seam;
    for (auto _ : state)
        if (state.range(1) != 0)
            for (int y = 0; y < half; ++y) {
                kernels.restrict_forces(seam, seen_f.x, c.x, y, 0, half);
                kernels.restrict_forces(seam, seen_f.y, c.y, y, 0, half);
                kernels.restrict_forces(seam, seen_f.z, c.z, y, 0, half);
            }
        else
            for (int y = 0; y < n; ++y) {
                kernels.interpolate(seam, seen_c.x, f.x, y, 0);
                kernels.interpolate(seam, seen_c.y, f.y, y, 0);
                kernels.interpolate(seam, seen_c.z, f.z, y, 0);
            }
    using benchmark::Counter;
    const double nodes = static_cast<double>(state.iterations()) * n * n;
    state.counters["ns/node/core"] = Counter(nodes * 1e-9, Counter::kIsRate | Counter::kInvert);
    state.counters["GB/s"] = Counter(nodes * 30e-9, Counter::kIsRate);
    state.counters["of_stream"] = Counter(nodes * 30e-9 / stream_rate(1), Counter::kIsRate);
}
BENCHMARK(level_transfer)
    ->ArgNames({"sites", "up"})
    ->ArgsProduct({{128, 512}, {0, 1}})
    ->UseRealTime();

/// The paper's block: constrained planes, all levels, halos.
void block_step(benchmark::State& state) {
    const int n = static_cast<int>(state.range(0)), threads = static_cast<int>(state.range(1));
    omp_set_num_threads(threads);
    BlockOptions options;
    options.sites = options.thickness = n;
    options.young = 0.48;
    options.atom_mass = 2.04e4;
    const auto levels = level_shapes(options);
    Block block(options, Communicator(), ProcessGrid(1, 0, n, static_cast<int>(levels.size())));
    block.set_uniform(0.0, 1e-4);
    StepParameters plan;
    plan.dt = 10.0;
    plan.damping = state.range(2) != 0 ? 5e-5 : 0.0;
    KickSums sums;
    for (auto _ : state) {
        block.interpolate();
        block.advance(plan, sums);
        block.exchange();
    }
    double nodes = 0.0;
    for (const LevelShape& level : levels)
        nodes += static_cast<double>(level.sites) * level.sites * level.cells;
    count(state, nodes, threads, flops(state.range(2) != 0));
    state.counters["MB"] = 1e-6 * static_cast<double>(block.bytes());
}
BENCHMARK(block_step)
    ->ArgNames({"sites", "threads", "damped"})
    ->ArgsProduct({{128, 256, 512}, {1, 2}, {0, 1}})
    ->UseRealTime();

} // namespace
