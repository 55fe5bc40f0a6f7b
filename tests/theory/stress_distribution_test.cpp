// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The distribution of the stress below boundaries with known solutions. The elastic energy is zero
// and the area factor one, so that b² = g0 E* q/A; q is chosen for the area of the solution, and
// the march must find both.
#include "theory/stress_distribution.hpp"

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

namespace asperity::theory {
namespace {

double normal_below(double x) { return 0.5 * std::erfc(-x / std::numbers::sqrt2); }

/// A boundary b and the area left, as functions of the variance T.
struct Solution {
    std::function<double(double)> boundary, area;
};

AdhesiveContact contact_under(double pressure) {
    AdhesiveContact c;
    c.contact_modulus = 1;
    c.pressure = pressure;
    return c;
}

StressStep step_at(const Solution& s, double T) {
    return {std::pow(s.boundary(T), 2) * s.area(T), T, 0, 1};
}

/// Returns steps from T0 to T1 that are equidistant in ln T.
std::vector<StressStep> steps_of(const Solution& s, double T0, double T1, double spacing) {
    const int n = static_cast<int>(std::ceil(std::log(T1 / T0) / spacing));
    std::vector<StressStep> steps;
    for (int i = 0; i <= n; ++i)
        steps.push_back(step_at(s, T0 * std::pow(T1 / T0, static_cast<double>(i) / n)));
    return steps;
}

/// Returns the solution for b = 1 + v T and a normal distribution about p, by reflection.
Solution in_uniform_motion(double v, double p) {
    return {[=](double T) { return 1 + v * T; },
            [=](double T) {
                const double z0 = 1 + p, moved = v * T, width = std::sqrt(T);
                return normal_below((z0 + moved) / width) -
                       std::exp(-2 * v * z0) * normal_below((moved - z0) / width);
            }};
}

TEST(StressDistribution, BoundariesInUniformMotionFollowTheReflection) {
    for (const auto& [v, p, T] :
         {std::array{0.0, 0.0, 30.0}, std::array{1.0, 0.0, 10.0}, std::array{-0.3, 0.0, 2.0},
          std::array{0.2, 0.7, 10.0}, std::array{0.2, -0.6, 10.0}}) {
        const Solution s = in_uniform_motion(v, p);
        const auto error = [&, v = v, p = p, T = T](double spacing, int nodes) {
            const auto steps = steps_of(s, 1e-3, T, spacing);
            const StressPath path = stress_path(contact_under(p), steps, 1, nodes);
            double largest = 0;
            for (std::size_t i = 0; i < steps.size(); ++i)
                largest = std::max(largest, std::abs(path.area[i] - s.area(steps[i].T)));
            return largest;
        };
        SCOPED_TRACE(testing::Message() << "v = " << v << ", p = " << p);
        const double error_of_steps = error(0.08, 16);
        EXPECT_LT(error_of_steps, 1.5e-4);
        EXPECT_NEAR(error_of_steps / error(0.02, 16), 16, 2); // second order
        const double error_of_nodes = error(0.005, 2);
        EXPECT_LT(error_of_nodes, 1.5e-3);
        EXPECT_GT(error_of_nodes / error(0.005, 4), 16); // fourth order
    }
}

TEST(StressDistribution, AreaIsKeptInAGapAndOutOfReach) {
    // The boundary stands at 1 up to T = 1, then at 20 for good: what is left spreads, and meets
    // the new boundary much later.
    const auto left = [](double stress) { // P at T = 1
        const auto normal = [](double x) {
            return std::exp(-x * x / 2) / std::sqrt(2 * std::numbers::pi);
        };
        return normal(stress) - normal(stress + 2);
    };
    const Solution far = {[](double) { return 20.0; },
                          [=](double T) {
                              double sum = 0;
                              constexpr double d = 1e-3;
                              for (double x = -1 + d / 2; x < 9; x += d)
                                  sum += d * left(x) *
                                         (T > 1 ? std::erf((20 + x) / std::sqrt(2 * (T - 1))) : 1);
                              return sum;
                          }};
    auto steps = steps_of(in_uniform_motion(0, 0), 1e-3, 1, 0.04);
    const std::size_t gap = steps.size();
    for (const StressStep& step : steps_of(far, 1, 1000, 0.04))
        steps.push_back(step);
    const StressPath path = stress_path(contact_under(0), steps, 1, 16);
    EXPECT_EQ(path.area[gap], path.area[gap - 1]);
    for (std::size_t i = gap; i < steps.size(); ++i)
        EXPECT_NEAR(path.area[i], far.area(steps[i].T), 2e-5) << steps[i].T;
    EXPECT_LT(path.area.back(), 0.5 * path.area[gap]);
}

} // namespace
} // namespace asperity::theory
