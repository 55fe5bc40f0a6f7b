// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "limits.hpp"

#include "decomposition/field.hpp"
#include "kernels/variant.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <map>
#include <utility>

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

#if defined(__x86_64__)
namespace {

/// What a kernel does to a register.
struct Operations {
    int multiplications; ///< fused with an addition or not
    int additions;
    int roots, divisions;
    int shifts; ///< of the lanes of two registers by one
    int items;  ///< pairs or nodes in each lane
};
// Counted in the kernels' texts. Not counted: the comparison of a masked pair with the cutoff, and
// what a row or a block of sites takes beside its pairs and nodes.
constexpr Operations counted[] = {
    {31, 16, 0, 2, 0, 4}, // interface_site.hpp
    {16, 7, 0, 1, 0, 2},  // interface_row.hpp
    {23, 6, 0, 1, 0, 2},  // interface_cells.cpp
    // elastic_column.hpp, kick.hpp, pack_step.hpp: two nodes, and half of one of the upper plane
    // (44 and 24). 33 of 42 multiplications are fused, with damping 40 of 52.
    {2 * 42 + 22, 2 * 43 + 12, 0, 0, 0, 2},
    {2 * 52 + 22, 2 * 51 + 12, 0, 0, 0, 2},
    // elastic_finite_cell.hpp: nine springs with an inverse root each, which is a root and a
    // division, or five more multiplications where AVX-512 has a first guess of it.
    {69, 96, 9, 9, 12, 1},
    {114, 96, 9, 0, 12, 1},
};

/// Whether an operation of a kind is due in step k of so many, spread evenly.
constexpr bool due(int k, int many, int steps) { return (k + 1) * many / steps > k * many / steps; }

/// One function for each processor level and precision: seconds for a register of a kernel's
/// operations, in chains that depend on themselves alone; slow: its roots and divisions only.
#define ASPERITY_ON(i, variable, text, by)                                                         \
    case i:                                                                                        \
        asm volatile(text : "+v"(variable) : "v"(by));                                             \
        break;
#define ASPERITY_MIX(NAME, TARGET, REAL, BYTES, MULTIPLY, ADD, DIVIDE, ROOT, SHIFT)                \
    template <int kernel, bool slow>                                                               \
    __attribute__((target(TARGET), noinline)) double NAME() {                                      \
        typedef REAL Register __attribute__((vector_size(BYTES)));                                 \
        constexpr Operations n = counted[kernel];                                                  \
        constexpr int fast = n.multiplications + n.additions, rare = n.roots + n.divisions;        \
        constexpr int steps = slow ? (rare > 0 ? rare : 1) : fast, rounds = 400;                   \
        Register one = Register{} + REAL(1), none = Register{}, other;                             \
        Register a = one, b = one, c = one, d = one, e = one, f = one; /* multiplied */            \
        Register v = one, w = one, x = one, y = one, z = one;          /* added to */              \
        asm volatile("" : "+v"(one), "+v"(none));                                                  \
        const auto begin = std::chrono::steady_clock::now();                                       \
        for (int round = 0; round < rounds; ++round) {                                             \
            _Pragma("GCC unroll 256") for (int k = 0; k < steps; ++k) {                            \
                if (due(k, n.roots, steps)) asm volatile(ROOT : "=v"(other) : "v"(one));           \
                if (due(k, n.divisions, steps)) asm volatile(DIVIDE : "=&v"(other) : "v"(one));    \
                if (slow) continue;                                                                \
                if (due(k, n.shifts, steps)) asm volatile(SHIFT : "=&v"(other) : "v"(one));        \
                if (due(k, n.multiplications, steps)) switch (k * n.multiplications / steps % 6) { \
                        ASPERITY_ON(0, a, MULTIPLY, one)                                           \
                        ASPERITY_ON(1, b, MULTIPLY, one)                                           \
                        ASPERITY_ON(2, c, MULTIPLY, one)                                           \
                        ASPERITY_ON(3, d, MULTIPLY, one)                                           \
                        ASPERITY_ON(4, e, MULTIPLY, one)                                           \
                        ASPERITY_ON(5, f, MULTIPLY, one)                                           \
                    }                                                                              \
                if (due(k, n.additions, steps)) switch (k * n.additions / steps % 5) {             \
                        ASPERITY_ON(0, v, ADD, none)                                               \
                        ASPERITY_ON(1, w, ADD, none)                                               \
                        ASPERITY_ON(2, x, ADD, none)                                               \
                        ASPERITY_ON(3, y, ADD, none)                                               \
                        ASPERITY_ON(4, z, ADD, none)                                               \
                    }                                                                              \
            }                                                                                      \
        }                                                                                          \
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;       \
        return slow && rare == 0 ? 0.0 : took.count() / rounds / (BYTES / sizeof(REAL));           \
    }
ASPERITY_MIX(mix_double_v2, "arch=x86-64-v2", double, 16, "mulpd %1, %0", "addpd %1, %0",
             "movapd %1, %0\n\tdivpd %1, %0", "sqrtpd %1, %0", "movapd %1, %0\n\tshufpd $1, %1, %0")
ASPERITY_MIX(mix_double_v3, "arch=x86-64-v3", double, 32, "vmulpd %1, %0, %0", "vaddpd %1, %0, %0",
             "vdivpd %1, %1, %0", "vsqrtpd %1, %0",
             "vperm2f128 $0x21, %1, %1, %0\n\tvshufpd $5, %0, %1, %0")
ASPERITY_MIX(mix_double_v4, "arch=x86-64-v4", double, 64, "vmulpd %1, %0, %0", "vaddpd %1, %0, %0",
             "vdivpd %1, %1, %0", "vrsqrt14pd %1, %0", "valignq $1, %1, %1, %0")
ASPERITY_MIX(mix_float_v2, "arch=x86-64-v2", float, 16, "mulps %1, %0", "addps %1, %0",
             "movaps %1, %0\n\tdivps %1, %0", "sqrtps %1, %0", "")
ASPERITY_MIX(mix_float_v3, "arch=x86-64-v3", float, 32, "vmulps %1, %0, %0", "vaddps %1, %0, %0",
             "vdivps %1, %1, %0", "vsqrtps %1, %0", "")
ASPERITY_MIX(mix_float_v4, "arch=x86-64-v4", float, 64, "vmulps %1, %0, %0", "vaddps %1, %0, %0",
             "vdivps %1, %1, %0", "vrsqrt14ps %1, %0", "")

template <int kernel, bool slow>
double mix(bool single) {
    double best = 1.0;
    for (int trial = 0; trial < 60; ++trial) {
        double took = 0.0;
        switch (processor_level()) {
        case ProcessorLevel::v4:
            took = single ? mix_float_v4<kernel, slow>() : mix_double_v4<kernel, slow>();
            break;
        case ProcessorLevel::v3:
            took = single ? mix_float_v3<kernel, slow>() : mix_double_v3<kernel, slow>();
            break;
        default:
            took = single ? mix_float_v2<kernel, slow>() : mix_double_v2<kernel, slow>();
        }
        best = std::min(best, took / counted[kernel].items);
    }
    return best;
}
template <int kernel>
ArithmeticLimit measure(bool single) {
    return {mix<kernel, false>(single), mix<kernel, true>(single)};
}

} // namespace
#endif

ArithmeticLimit arithmetic_limit([[maybe_unused]] Timed kernel, [[maybe_unused]] bool single) {
#if defined(__x86_64__)
    static std::map<std::pair<Timed, bool>, ArithmeticLimit> known;
    ArithmeticLimit& limit = known[{kernel, single}];
    if (limit.all > 0.0) return limit;
    const bool guess = processor_level() == ProcessorLevel::v4;
    switch (kernel) {
    case Timed::lattice:
        return limit = measure<0>(single);
    case Timed::rows:
        return limit = measure<1>(single);
    case Timed::cells:
        return limit = measure<2>(single);
    case Timed::node:
        return limit = measure<3>(single);
    case Timed::damped:
        return limit = measure<4>(single);
    case Timed::finite:
        return limit = guess ? measure<6>(single) : measure<5>(single);
    }
#endif
    return {0.0, 0.0};
}

} // namespace asperity
