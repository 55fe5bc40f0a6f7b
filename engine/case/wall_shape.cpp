// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/case/wall_shape.hpp"

#include "engine/case/cubic_spline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace asperity {

namespace {

constexpr int rows = ShapedWall::rows;
/// Place from which on a shape that fades has no force, and the begin of one that repels.
constexpr double farthest = 32.0, floor_of_repulsion = 0.5;
/// Half the width of the strip in which Dugdale's tension falls to none.
constexpr double drop = 0.1;

} // namespace

WallShape::WallShape(double first, double last, bool repels,
                     const std::function<double(double)>& force)
    : force_(4 * rows), convex_(4 * rows) {
    const double whole = (last - first) / (1.0 + last - first);
    std::vector<double> x(rows), f(rows), slope(rows), energy(rows), falling(rows);
    for (std::size_t k = 0; k < rows; ++k) {
        const double s = whole * static_cast<double>(k) / (rows - 1);
        x[k] = k + 1 < rows ? first + s / (1.0 - s) : last;
        f[k] = k + 1 < rows ? force(x[k]) : 0.0;
    }
    for (std::size_t k = rows - 1; k-- > 0;) {
        const double length = x[k + 1] - x[k];
        slope[k] = (f[k + 1] - f[k]) / length;
        energy[k] = energy[k + 1] + 0.5 * length * (f[k] + f[k + 1]);
        falling[k] = falling[k + 1] - std::min(0.0, slope[k]) * length;
    }
    shape_.first = first;
    shape_.last = last;
    shape_.repels = repels;
    // The least energy: where the force turns from pushing to pulling.
    double least = energy[0];
    shape_.minimum = first;
    for (std::size_t k = 0; repels && k + 1 < rows; ++k)
        if (f[k] > 0.0 && f[k + 1] <= 0.0) {
            const double t = -f[k] / slope[k], here = energy[k] - t * (f[k] + 0.5 * t * slope[k]);
            if (here < least) least = here, shape_.minimum = x[k] + t;
        }
    if (!(least < 0.0)) throw std::invalid_argument("the law does not attract");
    const double factor = -1.0 / least;
    const auto weakest = static_cast<std::size_t>(std::min_element(f.begin(), f.end()) - f.begin());
    shape_.steepest = x[weakest];
    shape_.tension = -factor * f[weakest];
    shape_.fastest = factor * *std::max_element(slope.begin(), slope.end());
    for (std::size_t k = 0; k < rows; ++k) {
        const double row[] = {x[k], factor * f[k], factor * slope[k], factor * energy[k]};
        std::copy(row, row + 4, &force_[4 * k]);
        const double part[] = {x[k], factor * falling[k], factor * std::min(0.0, slope[k]), 0.0};
        std::copy(part, part + 4, &convex_[4 * k]);
    }
}

WallShape WallShape::dugdale() {
    return {0.0, 1.0 + drop, false,
            [](double x) { return -std::clamp((1.0 + drop - x) / (2.0 * drop), 0.0, 1.0); }};
}

WallShape WallShape::power(double n) {
    return {0.0, farthest, false, [n](double x) { return -std::pow(1.0 + x, -n - 1.0); }};
}

WallShape WallShape::nine_three() {
    return {floor_of_repulsion, farthest, true, [](double x) {
                const double third = 1.0 / (x * x * x);
                return third * (third * third - 1.0) / x;
            }};
}

WallShape WallShape::eight_two() {
    return {floor_of_repulsion, farthest, true, [](double x) {
                const double square = 1.0 / (x * x);
                return square * (square * square * square - 1.0) / x;
            }};
}

WallShape::WallShape(std::span<const double> gap, std::span<const double> energy)
    : WallShape([&]() -> WallShape {
          const std::size_t n = gap.size();
          if (n < 8 || energy.size() != n)
              throw std::invalid_argument(
                  fmt::format("a table of a law needs 8 pairs of numbers at least, and it has {}",
                              std::min(n, energy.size())));
          for (std::size_t i = 0; i < n; ++i)
              if (!std::isfinite(gap[i]) || !std::isfinite(energy[i]) ||
                  (i && !(gap[i] > gap[i - 1])))
                  throw std::invalid_argument(fmt::format(
                      "row {} is no pair of numbers, or its gap is not above the one before",
                      i + 1));
          const auto least = static_cast<std::size_t>(
              std::min_element(energy.begin(), energy.end()) - energy.begin());
          const double depth = energy[n - 1] - energy[least];
          if (least == 0 || least == n - 1 || !(depth > 0.0) || !(energy[0] > energy[n - 1]))
              throw std::invalid_argument(
                  "the table has no well and repulsion: its least energy must be between its ends, "
                  "and its first energy above the last");
          const CubicSpline spline(gap, energy);
          const auto slope = [&](double at) {
              const std::size_t i = spline.interval(at);
              const double length = gap[i + 1] - gap[i];
              const Hermite cubic(length, energy[i], spline.slopes()[i], energy[i + 1],
                                  spline.slopes()[i + 1]);
              return cubic.slope((at - gap[i]) / length) / length;
          };
          double steepest = 0.0;
          for (std::size_t i = least; i + 1 < n; ++i)
              steepest = std::max(steepest, (energy[i + 1] - energy[i]) / (gap[i + 1] - gap[i]));
          const double length = depth / steepest;
          WallShape made(gap[0] / length, gap[n - 1] / length, true,
                         [&](double x) { return -slope(x * length); });
          made.length_ = length;
          return made;
      }()) {}

ShapedWall::Shape WallShape::shape() const {
    ShapedWall::Shape shape = shape_;
    shape.force = force_.data();
    shape.convex = convex_.data();
    return shape;
}

} // namespace asperity
