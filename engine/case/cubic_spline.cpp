// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/case/cubic_spline.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace asperity {

namespace {

/// Returns the slope at x[at] of the cubic through the points first to first + 3.
double end_slope(std::span<const double> x, std::span<const double> y, std::size_t first,
                 std::size_t at) {
    double slope = 0.0;
    for (std::size_t i = first; i < first + 4; ++i) {
        double weight = 0.0; // weight of y[i]: derivative of Lagrange's polynomial
        for (std::size_t j = first; j < first + 4; ++j) {
            if (j == i) continue;
            double product = 1.0 / (x[i] - x[j]);
            for (std::size_t k = first; k < first + 4; ++k)
                if (k != i && k != j) product *= (x[at] - x[k]) / (x[i] - x[k]);
            weight += product;
        }
        slope += weight * y[i];
    }
    return slope;
}

/// Computes the slopes of a cubic spline at its points (continuous second derivative), by
/// elimination.
std::vector<double> spline_slopes(std::span<const double> x, std::span<const double> y) {
    const std::size_t n = x.size();
    std::vector<double> slope(n), above(n, 0.0);
    slope[0] = end_slope(x, y, 0, 0);
    const double last = end_slope(x, y, n - 4, n - 1);
    for (std::size_t i = 1; i + 1 < n; ++i) {
        const double left = x[i] - x[i - 1], right = x[i + 1] - x[i];
        const double mean =
            3.0 * (right * (y[i] - y[i - 1]) / left + left * (y[i + 1] - y[i]) / right);
        const double pivot = 2.0 * (left + right) - right * above[i - 1];
        above[i] = left / pivot;
        slope[i] = (mean - right * slope[i - 1]) / pivot;
    }
    slope[n - 1] = last;
    for (std::size_t i = n - 1; i-- > 1;)
        slope[i] -= above[i] * slope[i + 1];
    return slope;
}

/// Returns the distance of point i from the polynomial through other points (numbers from first to
/// last), over the root mean square of that distance for independent errors of one.
double missed(std::span<const double> x, std::span<const double> y, std::size_t i,
              std::size_t first, std::size_t last) {
    double sum = 0.0, squares = 1.0;
    for (std::size_t j = first; j <= last; ++j) {
        if (j == i) continue;
        double weight = 1.0; // Lagrange's, at x[i]
        for (std::size_t k = first; k <= last; ++k)
            if (k != i && k != j) weight *= (x[i] - x[k]) / (x[j] - x[k]);
        sum += weight * y[j];
        squares += weight * weight;
    }
    return std::abs(y[i] - sum) / std::sqrt(squares);
}

} // namespace

CubicSpline::CubicSpline(std::span<const double> x, std::span<const double> y)
    : x_(x), y_(y), slope_(spline_slopes(x, y)) {}

std::size_t CubicSpline::interval(double at) const {
    const auto above = std::upper_bound(x_.begin() + 1, x_.end() - 1, at);
    return static_cast<std::size_t>(above - x_.begin()) - 1;
}

double CubicSpline::operator()(double at) const {
    const std::size_t i = interval(at);
    const double length = x_[i + 1] - x_[i];
    return Hermite(length, y_[i], slope_[i], y_[i + 1], slope_[i + 1]).value((at - x_[i]) / length);
}

std::vector<double> spline_error(std::span<const double> x, std::span<const double> y,
                                 std::span<const double> at) {
    constexpr double safety = 1.5;
    const std::size_t n = x.size();
    const CubicSpline whole(x, y);
    std::vector<double> error(at.size(), 0.0);
    for (const std::size_t first : {0, 1}) {
        std::vector<double> half_x, half_y;
        for (std::size_t i = 0; i < n; ++i)
            if (i % 2 == first || i == 0 || i == n - 1)
                half_x.push_back(x[i]), half_y.push_back(y[i]);
        const CubicSpline half(half_x, half_y);
        for (std::size_t k = 0; k < at.size(); ++k) {
            const std::size_t i = whole.interval(at[k]), j = half.interval(at[k]);
            double length = x[i + 1] - x[i]; // the longest of the interval and its neighbours
            if (i > 0) length = std::max(length, x[i] - x[i - 1]);
            if (i + 2 < n) length = std::max(length, x[i + 2] - x[i + 1]);
            const double ratio = std::pow(length / (half_x[j + 1] - half_x[j]), 4);
            const double scale = ratio < 0.5 ? ratio / (1.0 - ratio) : 1.0;
            error[k] = std::max(error[k], safety * scale * std::abs(half(at[k]) - whole(at[k])));
        }
    }
    return error;
}

std::vector<double> noise(std::span<const double> x, std::span<const double> y) {
    const std::size_t n = x.size();
    std::vector<double> single(n), smooth(n);
    for (std::size_t i = 0; i < n; ++i) {
        double least = HUGE_VAL;
        for (const auto& [below, above] :
             {std::array<std::size_t, 2>{2, 2}, {3, 3}, {0, 6}, {6, 0}})
            if (i >= below && i + above < n)
                least = std::min(least, missed(x, y, i, i - below, i + above));
        single[i] = std::isfinite(least) ? least : 0.0;
    }
    constexpr std::size_t reach = 4;
    for (std::size_t i = 0; i < n; ++i) {
        const std::size_t first = i > reach ? i - reach : 0, last = std::min(n - 1, i + reach);
        double squares = 0.0;
        for (std::size_t k = first; k <= last; ++k)
            squares += single[k] * single[k];
        smooth[i] = std::sqrt(squares / static_cast<double>(last - first + 1));
    }
    return smooth;
}

} // namespace asperity
