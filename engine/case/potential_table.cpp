// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/case/potential_table.hpp"

#include "engine/case/cubic_spline.hpp"
#include "kernels/pair_potential.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace asperity {

namespace {

constexpr int intervals = 4096;
/// Repulsion beyond the well that counts, over the largest attraction: the default of
/// drive.tolerance, below which forces are taken as none.
constexpr double smallest_repulsion = 2.5e-4;

/// Finds the place where f turns from positive to negative.
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

    const CubicSpline spline(distance, energy);
    const std::vector<double>& slope = spline.slopes();
    rows_ = n;
    last_ = distance[n - 1];
    uncut_.first = distance[0];
    uncut_.step = (last_ - distance[0]) / intervals;
    uncut_.intervals = intervals;
    std::size_t piece = 0;
    const auto at = [&](int k) { // value and slope of the spline at the beginning of interval k
        const double r = k == intervals ? last_ : uncut_.first + k * uncut_.step;
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
        const Hermite cubic(uncut_.step, here.first, here.second, there.first, there.second);
        cubics_.insert(cubics_.end(), cubic.c, cubic.c + 4);
        here = there;
    }
    uncut_.cubics = cubics_.data();
    uncut_.cutoff = last_;

    const Pair<Tabulated> pair(uncut_);
    Tabulated::Shape& shape = uncut_.shape;
    const auto force = [&](double r) { return -r * pair.derivatives(r * r).slope; };
    shape.minimum = crossing(distance[least - 1], distance[least + 1], force);
    shape.depth = -pair.unshifted(shape.minimum * shape.minimum);
    shape.zero =
        crossing(distance[0], shape.minimum, [&](double r) { return pair.unshifted(r * r); });
    // The first place beyond the minimum where the pull is largest, on the grid and then between
    // its points.
    double steepest = shape.minimum;
    while (steepest + uncut_.step < last_ && force(steepest + uncut_.step) < force(steepest))
        steepest += uncut_.step;
    shape.inflection = crossing(std::max(shape.minimum, steepest - uncut_.step),
                                steepest + uncut_.step, [&](double r) {
                                    const PairDerivatives d = pair.derivatives(r * r);
                                    return d.slope + r * r * d.bend;
                                });
    find_errors(distance, energy);
}

/// Computes the errors at the ends of the intervals of equal length, with straight lines between.
void PotentialTable::find_errors(std::span<const double> distance, std::span<const double> energy) {
    std::vector<double> at(intervals + 1);
    for (int k = 0; k <= intervals; ++k)
        at[static_cast<std::size_t>(k)] = std::min(uncut_.first + k * uncut_.step, last_);
    const auto keep = [&](std::span<const double> value, std::vector<double>& cubics) {
        cubics.assign(4 * intervals, 0.0);
        for (std::size_t k = 0; k < intervals; ++k) {
            cubics[4 * k] = value[k];
            cubics[4 * k + 1] = value[k + 1] - value[k];
        }
    };
    keep(asperity::spline_error(distance, energy, at), spline_error_);
    constexpr double deviations = 4.0; // errors of single rows may add up
    const std::vector<double> rms = asperity::noise(distance, energy);
    std::vector<double> between(at.size());
    std::size_t row = 0;
    for (std::size_t k = 0; k < at.size(); ++k) {
        while (row + 2 < distance.size() && at[k] > distance[row + 1])
            ++row;
        const double part = (at[k] - distance[row]) / (distance[row + 1] - distance[row]);
        between[k] = deviations * std::lerp(rms[row], rms[row + 1], std::clamp(part, 0.0, 1.0));
    }
    keep(between, noise_);
}

Tabulated PotentialTable::of_errors(const std::vector<double>& cubics, double cutoff) const {
    Tabulated errors = uncut_;
    errors.cubics = cubics.data();
    errors.cutoff = cutoff;
    errors.shape.shift = 0.0;
    // The shift at the cutoff is as wrong as the energy there.
    errors.shape.shift = -Pair<Tabulated>(errors).unshifted(cutoff * cutoff);
    return errors;
}

PotentialTable::Repulsion PotentialTable::repulsion(double cutoff) const {
    const Pair<Tabulated> pair(uncut_);
    const auto force = [&](double r) { return -r * pair.derivatives(r * r).slope; };
    const double attraction = -force(uncut_.shape.inflection);
    Repulsion found;
    double lowest = pair.unshifted(cutoff * cutoff);
    for (double r = cutoff; r > uncut_.shape.minimum; r -= uncut_.step) {
        const double energy = pair.unshifted(r * r);
        found.barrier = std::max(found.barrier, energy - lowest);
        lowest = std::min(lowest, energy);
        if (force(r) > smallest_repulsion * attraction) {
            found.nearest = r;
            if (!found.farthest) found.farthest = r;
            found.noise = std::max(found.noise, Pair<Tabulated>(noise(cutoff)).unshifted(r * r));
        }
    }
    return found;
}

Tabulated PotentialTable::potential(double cutoff) const {
    if (!(cutoff > uncut_.shape.minimum && cutoff <= last_))
        throw std::invalid_argument(
            fmt::format("a cutoff of {:.6g} Å: the table's well is at {:.6g} Å and its last "
                        "distance {:.6g} Å, and the cutoff must be between",
                        cutoff, uncut_.shape.minimum, last_));
    Tabulated cut = uncut_;
    cut.cutoff = cutoff;
    cut.shape.shift = Pair<Tabulated>(uncut_).unshifted(cutoff * cutoff);
    return cut;
}

} // namespace asperity
