// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Every lane of a pack's operation has the bits of the same operation on one number (lane.hpp), and
// shuffles move lanes where their comments say. Here for the registers of this file's compilation:
// SSE2, or NEON with its fused operations.
#include "kernels/lane.hpp"
#include "kernels/simd.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <random>
#include <type_traits>

using namespace asperity;
using namespace asperity::ASPERITY_VARIANT;

namespace {

#if defined(__FMA__) || defined(__aarch64__)
constexpr bool fused_here = true;
#else
constexpr bool fused_here = false;
#endif

template <class T>
class Packs : public testing::Test {
public:
    static constexpr int width = Pack<T>::width;

    /// Numbers of all magnitudes and both signs.
    Pack<T> any() {
        T values[width];
        for (T& v : values)
            v = static_cast<T>(std::ldexp(1.0 + mantissa(random), power(random)) *
                               (random() % 2 ? 1 : -1));
        return Pack<T>::load(values);
    }
    /// pack's lanes against one(lane).
    template <class One>
    void same(Pack<T> pack, const One& one) {
        for (int i = 0; i < width; ++i) {
            const T lane = pack[i], expected = one(i);
            EXPECT_EQ(std::memcmp(&lane, &expected, sizeof(T)), 0)
                << "lane " << i << ": " << lane << ", not " << expected;
        }
    }

private:
    std::mt19937 random{7};
    std::uniform_real_distribution<double> mantissa{0.0, 1.0};
    std::uniform_int_distribution<int> power{-9, 9};
};
using Types = testing::Types<double, float>;
TYPED_TEST_SUITE(Packs, Types);

} // namespace

TYPED_TEST(Packs, OperationsHaveTheBitsOfOneNumber) {
    using T = TypeParam;
    using L = Lane<T>;
    for (int n = 0; n < 200; ++n) {
        const Pack<T> a = this->any(), b = this->any(), c = this->any();
        const auto one = [](T v) { return L(v); };
        this->same(a + b, [&](int i) { return (one(a[i]) + one(b[i])).r; });
        this->same(a * b, [&](int i) { return (one(a[i]) * one(b[i])).r; });
        this->same(a / b, [&](int i) { return (one(a[i]) / one(b[i])).r; });
        this->same(min(a, b), [&](int i) { return min(one(a[i]), one(b[i])).r; });
        this->same(max(a, b), [&](int i) { return max(one(a[i]), one(b[i])).r; });
        this->same(select(a < b, a, c),
                   [&](int i) { return select(a[i] < b[i], one(a[i]), one(c[i])).r; });
        if (fused_here) {
            this->same(fma(a, b, c), [&](int i) { return fma(one(a[i]), one(b[i]), one(c[i])).r; });
            this->same(fms(a, b, c), [&](int i) { return fms(one(a[i]), one(b[i]), one(c[i])).r; });
        } else {
            this->same(fma(a, b, c), [&](int i) { return (one(a[i]) * one(b[i]) + one(c[i])).r; });
            this->same(fms(a, b, c), [&](int i) { return (one(a[i]) * one(b[i]) - one(c[i])).r; });
        }
        if constexpr (std::is_same_v<T, double>) {
            const Pack<T> positive = a * a;
            this->same(sqrt(positive), [&](int i) { return std::sqrt(positive[i]); });
            this->same(inverse_sqrt(positive), [&](int i) { return 1.0 / std::sqrt(positive[i]); });
        }
    }
}

TYPED_TEST(Packs, ShufflesMoveLanes) {
    using T = TypeParam;
    constexpr int w = Pack<T>::width;
    const Pack<T> a = this->any(), b = this->any();
    const auto both = [&](int i) { return i < w ? a[i] : b[i - w]; };
    this->same(shift_left(a, b), [&](int i) { return both(i + 1); });
    this->same(shift_right(a, b), [&](int i) { return both(w - 1 + i); });
    this->same(evens(a, b), [&](int i) { return both(2 * i); });
    this->same(odds(a, b), [&](int i) { return both(2 * i + 1); });
    this->same(interleave_low(evens(a, b), odds(a, b)), [&](int i) { return a[i]; });
    this->same(interleave_high(evens(a, b), odds(a, b)), [&](int i) { return b[i]; });
    if constexpr (std::is_same_v<T, double>)
        this->same(exchange<1>(a), [&](int i) { return a[i ^ 1]; });
}
