// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The axis of a plot: where it begins and ends, where its ticks stand and what is written there.
//
// Ticks stand at 1, 2 or 5 times a power of ten (at powers of ten on a logarithmic axis).
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace asperity::io {

/// The multiples of a round step from low to high (those in between), about `count` of them.
std::vector<double> nice_ticks(double low, double high, int count);

/// The number as it stands at a tick, with as many digits as the step needs.
std::string tick_label(double value, double step);

/// Least and greatest of the values shown.
struct AxisLimits {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();
    /// What is no number does not count, nor what is not positive on a logarithmic axis.
    void take(double v, bool logarithmic);
};

/// One axis: its limits on round numbers unless they are given, and its ticks.
struct PlotAxis {
    double low = 0.0, high = 1.0, step = 1.0;
    bool logarithmic = false;
    std::vector<double> ticks;

    /// count: about so many ticks.
    PlotAxis(AxisLimits data, std::optional<double> given_low, std::optional<double> given_high,
             int count, bool by_decades);

    /// Where a value lies between low (0) and high (1).
    double place(double v) const;
    bool holds(double v) const;
    std::string label(double tick) const;

private:
    void decades(double from, double to, int count);
};

} // namespace asperity::io
