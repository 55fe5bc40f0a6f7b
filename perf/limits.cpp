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

/// One function for each processor level and precision: GFLOP/s of twelve chains x <- x y + z.
#if defined(__x86_64__)
#define ASPERITY_FUSED(NAME, TARGET, REAL, BYTES, INSTRUCTIONS)                                    \
    __attribute__((target(TARGET), noinline)) double NAME() {                                      \
        typedef REAL Register __attribute__((vector_size(BYTES)));                                 \
        constexpr int rounds = 4000, chains = 12;                                                  \
        Register x[chains], y = Register{} + REAL(1), z = Register{};                              \
        for (Register & chain : x)                                                                 \
            chain = y;                                                                             \
        const auto begin = std::chrono::steady_clock::now();                                       \
        for (int r = 0; r < rounds; ++r) {                                                         \
            _Pragma("GCC unroll 12") for (int k = 0; k < chains; ++k) asm volatile(                \
                INSTRUCTIONS : "+v"(x[k]) : "v"(y), "v"(z));                                       \
        }                                                                                          \
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;       \
        return 2e-9 * rounds * chains * (BYTES / sizeof(REAL)) / took.count();                     \
    }
ASPERITY_FUSED(double_v2, "arch=x86-64-v2", double, 16, "mulpd %1, %0\n\taddpd %2, %0")
ASPERITY_FUSED(double_v3, "arch=x86-64-v3", double, 32, "vfmadd213pd %2, %1, %0")
ASPERITY_FUSED(double_v4, "arch=x86-64-v4", double, 64, "vfmadd213pd %2, %1, %0")
ASPERITY_FUSED(float_v2, "arch=x86-64-v2", float, 16, "mulps %1, %0\n\taddps %2, %0")
ASPERITY_FUSED(float_v3, "arch=x86-64-v3", float, 32, "vfmadd213ps %2, %1, %0")
ASPERITY_FUSED(float_v4, "arch=x86-64-v4", float, 64, "vfmadd213ps %2, %1, %0")
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
