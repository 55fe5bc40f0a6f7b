// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "limits.hpp"

#include "decomposition/field.hpp"
#include "kernels/variant.hpp"

#include <algorithm>
#include <array>
#include <chrono>

namespace asperity {

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

/// One function for each processor level and precision: GFLOP/s of ten chains x <- x y + z. STEP(i)
/// is the text of the instructions for chain i; y is operand 10, z is 11.
#if defined(__x86_64__)
#define ASPERITY_FUSED(NAME, TARGET, REAL, BYTES, STEP)                                            \
    __attribute__((target(TARGET), noinline)) double NAME() {                                      \
        typedef REAL Register __attribute__((vector_size(BYTES)));                                 \
        constexpr int rounds = 4000, chains = 10;                                                  \
        Register y = Register{} + REAL(1), z = Register{};                                         \
        Register a = y, b = y, c = y, d = y, e = y, f = y, g = y, h = y, i = y, j = y;             \
        const auto begin = std::chrono::steady_clock::now();                                       \
        for (int r = 0; r < rounds; ++r)                                                           \
            asm volatile(STEP(0) STEP(1) STEP(2) STEP(3) STEP(4) STEP(5) STEP(6) STEP(7) STEP(8)   \
                             STEP(9)                                                               \
                         : "+v"(a), "+v"(b), "+v"(c), "+v"(d), "+v"(e), "+v"(f), "+v"(g), "+v"(h), \
                           "+v"(i), "+v"(j)                                                        \
                         : "v"(y), "v"(z));                                                        \
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;       \
        return 2e-9 * rounds * chains * (BYTES / sizeof(REAL)) / took.count();                     \
    }
#define ASPERITY_FUSED_PD(i) "vfmadd213pd %11, %10, %" #i "\n\t"
#define ASPERITY_FUSED_PS(i) "vfmadd213ps %11, %10, %" #i "\n\t"
#define ASPERITY_APART_PD(i) "mulpd %10, %" #i "\n\taddpd %11, %" #i "\n\t"
#define ASPERITY_APART_PS(i) "mulps %10, %" #i "\n\taddps %11, %" #i "\n\t"
ASPERITY_FUSED(double_v2, "arch=x86-64-v2", double, 16, ASPERITY_APART_PD)
ASPERITY_FUSED(double_v3, "arch=x86-64-v3", double, 32, ASPERITY_FUSED_PD)
ASPERITY_FUSED(double_v4, "arch=x86-64-v4", double, 64, ASPERITY_FUSED_PD)
ASPERITY_FUSED(float_v2, "arch=x86-64-v2", float, 16, ASPERITY_APART_PS)
ASPERITY_FUSED(float_v3, "arch=x86-64-v3", float, 32, ASPERITY_FUSED_PS)
ASPERITY_FUSED(float_v4, "arch=x86-64-v4", float, 64, ASPERITY_FUSED_PS)
#endif

double fused_rate(bool single) {
    static std::array<double, 2> known{};
    double& best = known.at(single);
#if defined(__x86_64__)
    for (int trial = best > 0.0 ? 200 : 0; trial < 200; ++trial) {
        const ProcessorLevel level = processor_level();
        best = std::max(best, level == ProcessorLevel::v4   ? (single ? float_v4() : double_v4())
                              : level == ProcessorLevel::v3 ? (single ? float_v3() : double_v3())
                                                            : (single ? float_v2() : double_v2()));
    }
#endif
    return best;
}

} // namespace asperity
