// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// How long does a node's step take, in cache and out of it, on one core?
#include "decomposition/field.hpp"
#include "kernels/elastic_cell.hpp"

#include <benchmark/benchmark.h>

#include <utility>

using namespace asperity;

namespace {

struct Stack {
    Tile tile;
    int cells;
    VectorField<double> u, next, v, incoming;
    CellElasticity elasticity{0.441, 0.117};

    Stack(int n, int layers)
        : tile{0, 0, n, n, n}, cells(layers), u(tile, layers + 1), next(tile, layers + 1),
          v(tile, layers), incoming(tile, 1) {
        for (int z = 0; z <= layers; ++z)
            for (int y = -2; y < n + 2; ++y)
                for (int x = -2; x < n + 2; ++x)
                    u.view().z(x, y, z) = 1e-3 * ((x * 7 + y * 13 + z * 5) % 11);
    }
};

void advance(benchmark::State& state) {
    const int n = static_cast<int>(state.range(0)), layers = 4, band = 8;
    Stack s(n, layers);
    KickDrift kd;
    kd.kick = 1e-6;
    kd.dt = 1e-3;
    kd.damped = state.range(1) != 0;
    kd.stream = state.range(2) != 0;
    kd.keep = kd.damped ? 0.999 : 1.0;
    const Stencil lower = make_stencil(s.elasticity, Face::lower),
                  inner = make_stencil(s.elasticity, Face::inner);
    KickSums sums;
    for (auto _ : state) {
        for (int y = 0; y < n; y += band)
            for (int z = 0; z < layers; ++z)
                elastic_kernels().advance(std::as_const(s.u).view(), z, z == 0 ? lower : inner, y,
                                          y + band, std::as_const(s.incoming).plane(0), kd,
                                          s.v.view(), s.next.view(), sums);
        std::swap(s.u, s.next);
        benchmark::ClobberMemory();
    }
    const double nodes = static_cast<double>(n) * n * layers;
    state.counters["ns/node"] = benchmark::Counter(
        nodes * 1e-9, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
    // u read, v read and written, u_next written: 12 doubles is the least.
    state.counters["GB/s"] =
        benchmark::Counter(nodes * 96e-9, benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(advance)
    ->ArgNames({"sites", "damped", "stream"})
    ->ArgsProduct({{32, 64, 128, 256, 512}, {0, 1}, {0, 1}});

} // namespace
