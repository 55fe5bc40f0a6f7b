// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The laws that every pair potential obeys, whatever its form; and that its formulas give the same
// for numbers, registers and lanes.
#include "kernels/interface_pair.hpp"
#include "kernels/lane.hpp"
#include "kernels/simd.hpp"

#include "engine/case/potential_table.hpp"
#include "support/message.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

namespace asperity {
namespace {

const LennardJones lennard_jones{};

/// Lennard-Jones at `points` distances from 1.8 to 14 Å.
std::shared_ptr<const PotentialTable> gold_table(int points) {
    std::vector<double> r, v;
    for (int i = 0; i < points; ++i) {
        r.push_back(1.8 + 12.2 * i / (points - 1));
        const double s6 = std::pow(3.28 / r.back(), 6);
        v.push_back(0.4 * s6 * (s6 - 1.0));
    }
    return std::make_shared<PotentialTable>(r, v);
}

/// Of each kind.
struct Potentials {
    std::shared_ptr<const PotentialTable> table = gold_table(600);
    std::vector<PairPotential> all = {lennard_jones, LennardJones{0.03, 2.6, 7.0}, Morse{},
                                      Morse{0.4, 1.1, 2.9, 9.0}, table->potential(13.12)};
};

template <class Test>
void for_each(Test test) {
    const Potentials potentials;
    for (const PairPotential& any : potentials.all)
        std::visit(
            [&](const auto& p) {
                SCOPED_TRACE(p.name);
                test(p);
            },
            any);
}

TEST(PairPotential, ForceIsMinusTheGradientAndBendItsOwn) {
    for_each([](const auto& p) {
        const Pair pair(p);
        for (double r = 0.75 * p.zero(); r < p.cutoff; r += 0.0371) {
            const double h = 1e-5;
            const auto energy = [&](double at) { return pair.energy(at * at); };
            const auto slope = [&](double at) { return pair.derivatives(at * at).slope; };
            const double force = -(energy(r + h) - energy(r - h)) / (2.0 * h);
            const double bend = (slope(r + h) - slope(r - h)) / (2.0 * h) / r;
            if (r + h >= p.cutoff) continue;
            EXPECT_NEAR(pair.force_over_distance(r * r) * r, force, 1e-7 * (1.0 + std::abs(force)));
            // The second derivative of a table jumps between its cubics.
            const bool table = std::is_same_v<std::decay_t<decltype(p)>, Tabulated>;
            EXPECT_NEAR(pair.derivatives(r * r).bend, bend,
                        (table ? 1e-3 : 1e-7) * (1.0 + std::abs(bend)))
                << r;
        }
    });
}

TEST(PairPotential, EndsAtItsCutoffWithoutAJumpOfTheEnergy) {
    for_each([](const auto& p) {
        const Pair pair(p);
        const double cut = p.cutoff;
        EXPECT_NEAR(pair.energy(cut * cut * (1.0 - 1e-12)), 0.0, 1e-12);
        EXPECT_EQ(pair.energy(cut * cut), 0.0);
        EXPECT_EQ(pair.force_over_distance(cut * cut * 1.0001), 0.0);
    });
}

TEST(PairPotential, IsZeroFlatAndStraightWhereItSaysSo) {
    for_each([](const auto& p) {
        const Pair pair(p);
        const auto at = [&](double r) { return pair.derivatives(r * r); };
        EXPECT_NEAR(at(p.zero()).energy, 0.0, 1e-13);
        EXPECT_NEAR(at(p.minimum()).slope, 0.0, 1e-12);
        EXPECT_NEAR(at(p.minimum()).energy, -p.depth(), 1e-12);
        const double there = p.inflection();
        const auto second = [&](double r) { return at(r).slope + r * r * at(r).bend; };
        EXPECT_GT(second(0.999 * there), 0.0);
        EXPECT_LT(second(1.001 * there), 0.0);
        EXPECT_LT(p.zero(), p.minimum());
        EXPECT_LT(p.minimum(), there);
    });
}

TEST(PairPotential, IsHeldOnTop) {
    for_each([](const auto& p) {
        const Pair pair(p);
        EXPECT_TRUE(std::isfinite(pair.energy(0.0)));
        EXPECT_EQ(pair.energy(0.0), pair.energy(p.closest() * p.closest()));
        EXPECT_GT(pair.force_over_distance(0.0), 0.0);
        EXPECT_LT(p.closest(), 0.6 * p.zero());
    });
}

/// int V0 r dr from r on, by Simpson's rule in 1/r.
TEST(PairPotential, MomentIsTheIntegral) {
    for_each([]<class P>(const P& p) {
        if constexpr (P::has_tail) {
            const Pair pair(p);
            for (double r : {0.9 * p.zero(), p.minimum(), 6.0, 13.0}) {
                const int n = 20000;
                double sum = 0.0;
                for (int k = 1; k <= n; ++k) {
                    const double x = k / (n * r), at = 1.0 / x;
                    const double weight = k == n ? 1.0 : k % 2 ? 4.0 : 2.0;
                    sum += weight * pair.unshifted(at * at) * at * at * at;
                }
                EXPECT_NEAR(pair.moment(r * r), sum / (3.0 * n * r), 1e-8);
            }
        }
    });
}

/// A register and a lane give what a number gives: to rounding in double, to the precision of its
/// lengths in single.
template <class F, class T, class P>
void agree(const P& p, double tolerance) {
    using V = typename F::template Of<T>;
    const portable::PairTerms<F, T, P> terms(p);
    const Pair pair(p);
    const double unit = portable::length_unit<T>;
    for (double r = 0.7 * p.zero(); r < 1.1 * p.cutoff; r += 0.0511) {
        const double r2 = r * r;
        if (std::abs(r - p.cutoff) < 1e-5) continue;
        const V first(static_cast<T>(r2 / (unit * unit)));
        const V second(static_cast<T>(1.21 * r2 / (unit * unit)));
        V begun, other;
        terms.template begin<false>(first, second, begun, other);
        const double scale = p.depth() + std::abs(pair.energy(r2));
        EXPECT_NEAR(terms.energy_scale * static_cast<double>(terms.energy(begun, first)[0]),
                    pair.energy(r2), tolerance * scale)
            << r;
        const double force =
            terms.force_scale * static_cast<double>(terms.force(begun, first, std::true_type{})[0]);
        EXPECT_NEAR(force, pair.force_over_distance(r2),
                    10.0 * tolerance * (scale + std::abs(force)))
            << r;
    }
}
template <class F, class T>
void agree_with_numbers(double tolerance) {
    for_each([&]<class P>(const P& p) {
        if constexpr (std::is_same_v<T, double> || !std::is_same_v<P, Tabulated>)
            agree<F, T>(p, tolerance);
    });
}
TEST(PairPotential, IsTheSameForNumbersRegistersAndLanes) {
    using portable::Scalar, portable::Simd;
    agree_with_numbers<Simd, double>(1e-14);
    agree_with_numbers<Scalar, double>(1e-14);
    agree_with_numbers<Simd, float>(5e-6);
}

TEST(Exponential, IsGoodToTwoUnitsOfTheLastPlace) {
    for (double x = -690.0; x < 690.0; x += 0.3137)
        EXPECT_NEAR(exponential(x) / std::exp(x), 1.0, 5e-16) << x;
    using portable::Lane, portable::Pack;
    for (float x = -79.0f; x < 79.0f; x += 0.137f) {
        EXPECT_NEAR(exponential(Lane<float>(x)).r / std::exp(x), 1.0f, 2.5e-7f) << x;
        EXPECT_NEAR(exponential(Pack<float>(x))[1] / std::exp(x), 1.0f, 2.5e-7f) << x;
    }
    EXPECT_TRUE(std::isnan(exponential(std::nan(""))));
    EXPECT_EQ(exponential(0.0), 1.0);
    EXPECT_LT(exponential(-1e9), 1e-300);
}

/// Numbers of Lennard-Jones in, Lennard-Jones out; the error of a spline falls as h^4.
TEST(PotentialTable, IsTheFunctionItWasMadeOf) {
    const auto error = [](int points) {
        const auto table = gold_table(points);
        const Pair made(table->potential(13.12));
        const Pair exact(lennard_jones);
        double most = 0.0;
        for (double r = 2.7; r < 13.1; r += 0.00713)
            most = std::max(most, std::abs(made.energy(r * r) - exact.energy(r * r)));
        return most;
    };
    EXPECT_LT(error(1200), 1e-7); // h^4 V''''/384 at 2.7 Å: 7e-8
    EXPECT_NEAR(std::log2(error(150) / error(300)), 4.0, 0.5);
    const auto table = gold_table(1200);
    const Tabulated p = table->potential(13.12);
    EXPECT_NEAR(p.minimum(), lennard_jones.minimum(), 1e-6);
    EXPECT_NEAR(p.inflection(), lennard_jones.inflection(), 1e-4);
    EXPECT_NEAR(p.zero(), lennard_jones.zero(), 1e-8);
    EXPECT_NEAR(p.depth(), lennard_jones.depth(), 1e-9);
}

TEST(PotentialTable, RefusesWhatIsNoPotential) {
    using Numbers = std::vector<double>;
    const auto refused = [](const Numbers& r, const Numbers& v) {
        return test::message_of<std::invalid_argument>([&] { const PotentialTable table(r, v); });
    };
    Numbers r, v;
    for (int i = 0; i < 40; ++i) {
        r.push_back(2.0 + 0.25 * i);
        v.push_back(Pair(lennard_jones).unshifted(r.back() * r.back()));
    }
    EXPECT_EQ(refused(r, v), "");
    EXPECT_NE(refused({2, 3, 4}, {1, -1, 0}).find("8 pairs"), std::string::npos);
    Numbers other = r;
    std::swap(other[3], other[4]);
    EXPECT_NE(refused(other, v).find("row 5"), std::string::npos);
    other = v;
    other[7] = std::nan("");
    EXPECT_NE(refused(r, other).find("row 8"), std::string::npos);
    EXPECT_NE(refused(r, Numbers(40, 1.0)).find("no well"), std::string::npos);
    // Begins where two atoms could still pass each other.
    EXPECT_NE(refused({r.begin() + 5, r.end()}, {v.begin() + 5, v.end()}).find("begins at"),
              std::string::npos);
    const PotentialTable table(r, v);
    EXPECT_THROW((void)table.potential(12.0), std::invalid_argument);
    EXPECT_THROW((void)table.potential(3.0), std::invalid_argument);
    EXPECT_EQ(table.potential(11.75).cutoff, 11.75);
}

} // namespace
} // namespace asperity
