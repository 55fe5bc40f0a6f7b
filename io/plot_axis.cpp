// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "io/plot_axis.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace asperity::io {

namespace {

double round_step(double span, int count) {
    const double rough = span / std::max(1, count);
    const double decade = std::pow(10.0, std::floor(std::log10(rough)));
    for (const double m : {1.0, 2.0, 5.0})
        if (rough <= m * decade * (1.0 + 1e-9)) return m * decade;
    return 10.0 * decade;
}

} // namespace

std::vector<double> nice_ticks(double low, double high, int count) {
    std::vector<double> ticks;
    if (!(high > low) || !std::isfinite(high - low)) return ticks;
    const double step = round_step(high - low, count);
    const double first = std::ceil(low / step - 1e-9), last = std::floor(high / step + 1e-9);
    for (double k = first; k <= last; ++k)
        ticks.push_back(k == 0.0 ? 0.0 : k * step);
    return ticks;
}

std::string tick_label(double value, double step) {
    if (value == 0.0) return "0";
    const double size = std::max(std::abs(value), std::abs(step));
    if (size >= 1e6 || size < 1e-4) return fmt::format("{:.4g}", value);
    const int digits = std::max(0, static_cast<int>(std::ceil(-std::log10(step) - 1e-9)));
    const std::string number = fmt::format("{:.{}f}", value, digits);
    return number.front() == '-' ? "−" + number.substr(1) : number;
}

void AxisLimits::take(double v, bool logarithmic) {
    if (!std::isfinite(v) || (logarithmic && v <= 0.0)) return;
    low = std::min(low, v);
    high = std::max(high, v);
}

PlotAxis::PlotAxis(AxisLimits data, std::optional<double> given_low,
                   std::optional<double> given_high, int count, bool by_decades)
    : logarithmic(by_decades) {
    if (logarithmic) {
        if (!(data.low <= data.high)) data = {1.0, 10.0};
        decades(given_low.value_or(data.low), given_high.value_or(data.high), count);
        return;
    }
    if (!(data.low <= data.high)) data = {0.0, 1.0};
    low = given_low.value_or(data.low);
    high = given_high.value_or(data.high);
    if (!(high > low)) { // a single value: some room around it
        const double room = low == 0.0 ? 1.0 : 0.1 * std::abs(low);
        if (!given_low) low -= room;
        high = std::max(high, low) + room;
    }
    step = round_step(high - low, count);
    if (!given_low) low = step * std::floor(low / step + 1e-9);
    if (!given_high) high = step * std::ceil(high / step - 1e-9);
    ticks = nice_ticks(low, high, count);
    if (ticks.size() > 1) step = ticks[1] - ticks[0];
}

/// From decade to decade where there are several, else at 1, 2 and 5.
void PlotAxis::decades(double from, double to, int count) {
    const double first = std::floor(std::log10(from) + 1e-9),
                 last = std::ceil(std::log10(to) - 1e-9);
    const bool few = last - first <= 2.0;
    low = from / 1.3;
    high = to * 1.3;
    const double stride = std::max(1.0, std::ceil((last - first) / count));
    for (double k = first; k <= last; k += few ? 1.0 : stride)
        for (const double m : {1.0, 2.0, 5.0})
            if (const double t = m * std::pow(10.0, k);
                (few || m == 1.0) && t >= 0.999 * low && t <= 1.001 * high)
                ticks.push_back(t);
}

double PlotAxis::place(double v) const {
    return logarithmic ? std::log(v / low) / std::log(high / low) : (v - low) / (high - low);
}

bool PlotAxis::holds(double v) const { return std::isfinite(v) && (!logarithmic || v > 0.0); }

std::string PlotAxis::label(double tick) const {
    if (!logarithmic) return tick_label(tick, step);
    const double power = std::log10(tick);
    if (std::abs(power) <= 3.0) return fmt::format("{:g}", tick);
    return fmt::format("1e{:.0f}", power);
}

} // namespace asperity::io
