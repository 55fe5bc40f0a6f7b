// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/interface/potential_table.hpp"

#include "kernels/pair_potential.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace asperity {

namespace {

constexpr int intervals = 4096;

/// Slope at x[at] of the cubic through the points first to first + 3.
double end_slope(std::span<const double> x, std::span<const double> y, std::size_t first,
                 std::size_t at) {
    double slope = 0.0;
    for (std::size_t i = first; i < first + 4; ++i) {
        double weight = 0.0; // of y[i]: the derivative of Lagrange's polynomial
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

/// The slopes of a cubic spline at its points (continuous second derivative), by elimination.
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

/// The cubic with these values and slopes at the ends of an interval, from its beginning on.
struct Hermite {
    double c[4];
    Hermite(double length, double y0, double s0, double y1, double s1)
        : c{y0, length * s0, 3.0 * (y1 - y0) - length * (2.0 * s0 + s1),
            2.0 * (y0 - y1) + length * (s0 + s1)} {}
    double value(double t) const { return c[0] + t * (c[1] + t * (c[2] + t * c[3])); }
    double slope(double t) const { return c[1] + t * (2.0 * c[2] + 3.0 * t * c[3]); }
};

/// A cubic spline and its values anywhere between its points.
struct Spline {
    std::span<const double> x, y;
    std::vector<double> slope;
    Spline(std::span<const double> at, std::span<const double> values)
        : x(at), y(values), slope(spline_slopes(at, values)) {}
    double operator()(double r) const {
        const auto above = std::upper_bound(x.begin() + 1, x.end() - 1, r);
        const auto i = static_cast<std::size_t>(above - x.begin()) - 1;
        const double length = x[i + 1] - x[i];
        return Hermite(length, y[i], slope[i], y[i + 1], slope[i + 1]).value((r - x[i]) / length);
    }
};

/// Of the spline through all rows where it is negative, relative to the depth of its well: what a
/// spline without every second row misses there, over 16, for the error of a spline goes with the
/// fourth power of the distance of its points.
double spline_error(std::span<const double> x, std::span<const double> y, double depth) {
    std::vector<double> half_x, half_y;
    const std::size_t n = x.size();
    for (std::size_t i = 0; i < n; ++i)
        if (i % 2 == 0 || i == n - 1) half_x.push_back(x[i]), half_y.push_back(y[i]);
    const Spline half(half_x, half_y);
    double largest = 0.0;
    for (std::size_t i = 1; i + 1 < n; i += 2)
        if (y[i] <= 0.0) largest = std::max(largest, std::abs(half(x[i]) - y[i]) / depth);
    return largest / 16.0;
}

/// Largest spline_error(). It is an upper bound where the repulsion is steep: the work of adhesion
/// of Lennard-Jones and Morse tables is then right to 2 %, and with twice as many rows to 0.1 %.
constexpr double largest_spline_error = 0.25;

/// Throws where the curve between the rows is not what they say: where the spline through half of
/// them tells so, or a well lies between them that no row has.
void require_enough_rows(std::span<const double> x, std::span<const double> y, double depth,
                         double deepest) {
    const double error = spline_error(x, y, depth), rows = static_cast<double>(x.size());
    const bool hidden = deepest > (1.0 + largest_spline_error) * depth;
    if (error <= largest_spline_error && !hidden) return;
    // The fourth root is that of a spline that resolves the potential, twice as many where it does
    // not yet.
    const double enough = 2.0 * rows * std::pow(std::max(1.0, error / largest_spline_error), 0.25);
    throw std::invalid_argument(fmt::format(
        "its {} rows are too far apart: the curve through them is {:.3g} eV deep, the lowest row "
        "{:.3g} eV, and without every second row it differs by {:.2g} times that; about {:.0f} "
        "rows with the same relative distances are enough",
        x.size(), deepest, depth, 16.0 * error, std::max(64.0, std::ceil(enough))));
}

/// Where f turns from positive to negative.
template <class F>
double crossing(double low, double high, const F& f) {
    while (true) {
        const double middle = 0.5 * (low + high);
        if (middle == low || middle == high) return middle;
        (f(middle) > 0.0 ? low : high) = middle;
    }
}

} // namespace

PotentialTable::PotentialTable(std::span<const double> distance, std::span<const double> energy) {
    const std::size_t n = distance.size();
    if (n < 8 || energy.size() != n)
        throw std::invalid_argument(
            fmt::format("a table of a potential needs 8 pairs of numbers at least, and it has {}",
                        std::min(n, energy.size())));
    for (std::size_t i = 0; i < n; ++i) {
        if (!std::isfinite(distance[i]) || !std::isfinite(energy[i]))
            throw std::invalid_argument(fmt::format("row {} has what is no number", i + 1));
        if (!(distance[i] > (i ? distance[i - 1] : 0.0)))
            throw std::invalid_argument(
                fmt::format("row {} has the distance {:.6g} Å after {:.6g} Å; distances must be "
                            "above zero and ascend",
                            i + 1, distance[i], i ? distance[i - 1] : 0.0));
    }
    const auto least =
        static_cast<std::size_t>(std::min_element(energy.begin(), energy.end()) - energy.begin());
    const double depth = energy[n - 1] - energy[least];
    if (least == 0 || least == n - 1 || !(energy[least] < 0.0) || !(depth > 0.0))
        throw std::invalid_argument(
            "the table has no well: its lowest energy must be negative and between the ends");
    if (!(energy[0] > -10.0 * energy[least]))
        throw std::invalid_argument(fmt::format(
            "the table begins at {:.6g} Å with {:.6g} eV, less than ten times the depth of its "
            "well, {:.6g} eV: atoms that are pressed together would come closer than its first "
            "row; begin it at a smaller distance",
            distance[0], energy[0], -energy[least]));

    const std::vector<double> slope = spline_slopes(distance, energy);
    last_ = distance[n - 1];
    whole_.first = distance[0];
    whole_.step = (last_ - distance[0]) / intervals;
    whole_.intervals = intervals;
    std::size_t piece = 0;
    const auto at = [&](int k) { // value and slope of the spline at the beginning of interval k
        const double r = k == intervals ? last_ : whole_.first + k * whole_.step;
        while (piece + 2 < n && r > distance[piece + 1])
            ++piece;
        const double length = distance[piece + 1] - distance[piece];
        const Hermite cubic(length, energy[piece], slope[piece], energy[piece + 1],
                            slope[piece + 1]);
        const double t = (r - distance[piece]) / length;
        return std::pair(cubic.value(t), cubic.slope(t) / length);
    };
    auto here = at(0);
    for (int k = 0; k < intervals; ++k) {
        const auto there = at(k + 1);
        const Hermite cubic(whole_.step, here.first, here.second, there.first, there.second);
        cubics_.insert(cubics_.end(), cubic.c, cubic.c + 4);
        here = there;
    }
    whole_.cubics = cubics_.data();
    whole_.cutoff = last_;

    const Pair<Tabulated> pair(whole_);
    double lowest = energy[least];
    for (std::size_t k = 0; k < cubics_.size(); k += 4)
        lowest = std::min(lowest, cubics_[k]);
    require_enough_rows(distance, energy, -energy[least], -lowest);
    Tabulated::Shape& shape = whole_.shape;
    const auto force = [&](double r) { return -r * pair.derivatives(r * r).slope; };
    shape.minimum = crossing(distance[least - 1], distance[least + 1], force);
    shape.depth = -pair.unshifted(shape.minimum * shape.minimum);
    shape.zero =
        crossing(distance[0], shape.minimum, [&](double r) { return pair.unshifted(r * r); });
    // The first place beyond the minimum where the pull is largest, on the grid and then between
    // its points.
    double steepest = shape.minimum;
    while (steepest + whole_.step < last_ && force(steepest + whole_.step) < force(steepest))
        steepest += whole_.step;
    shape.inflection = crossing(std::max(shape.minimum, steepest - whole_.step),
                                steepest + whole_.step, [&](double r) {
                                    const PairDerivatives d = pair.derivatives(r * r);
                                    return d.slope + r * r * d.bend;
                                });
}

Tabulated PotentialTable::potential(double cutoff) const {
    if (!(cutoff > whole_.shape.minimum && cutoff <= last_))
        throw std::invalid_argument(
            fmt::format("a cutoff of {:.6g} Å: the table's well is at {:.6g} Å and its last "
                        "distance {:.6g} Å, and the cutoff must be between",
                        cutoff, whole_.shape.minimum, last_));
    Tabulated cut = whole_;
    cut.cutoff = cutoff;
    cut.shape.shift = Pair<Tabulated>(whole_).unshifted(cutoff * cutoff);
    return cut;
}

} // namespace asperity
