// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Plots as SVG text: lines and points over two linear axes, without any library.
//
//     Plot plot;
//     plot.x_label = "rms roughness h_{rms} (Å)";       // _{...} is set as a subscript
//     plot.series.push_back({.label = "theory", .x = h, .y = gamma});
//     write_plot("gamma.svg", plot);
//
// Ticks stand at 1, 2 or 5 times a power of ten; the legend goes to the corner where it hides the
// least; colours are those of Okabe and Ito, told apart by nearly everybody, and lines differ in
// their dashes too. A value that is no number breaks a line; what lies outside given limits is cut
// off at the frame.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace asperity::io {

struct PlotSeries {
    enum class Style { line, dashed, dotted, points };

    std::string label; ///< empty: not in the legend
    std::vector<double> x;
    std::vector<double> y; ///< as many as x
    Style style = Style::line;
    int colour = -1; ///< number in the palette; -1: the place among the series
};

struct Plot {
    std::string title;
    std::string x_label; ///< with its unit
    std::string y_label;
    std::vector<PlotSeries> series;
    /// Limits of the axes; where none is given, they follow from the data.
    std::optional<double> x_low, x_high, y_low, y_high;
    int width = 640, height = 440; ///< pixels
};

/// The multiples of a round step from low to high (those in between), about `count` of them.
std::vector<double> nice_ticks(double low, double high, int count);

/// The number as it stands at a tick, with as many digits as the step needs.
std::string tick_label(double value, double step);

/// The plot as a self-contained SVG document. Throws std::invalid_argument for series of unequal
/// lengths.
std::string plot_svg(const Plot& plot);

/// The same into a file, whole or not at all. Throws FileError.
void write_plot(const std::string& path, const Plot& plot);

} // namespace asperity::io
