// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Plots as SVG text: lines and points over two axes, without any library.
//
//     Plot plot;
//     plot.x_label = "rms roughness h_{rms} (Å)";       // _{...} is set as a subscript
//     plot.series.push_back({.label = "theory", .x = h, .y = gamma});
//     write_plot("gamma.svg", plot);
//
// Ticks stand at 1, 2 or 5 times a power of ten (at powers of ten on a logarithmic axis); the
// legend goes to a free corner, or above the frame where none is free; colours are those of Okabe
// and Ito, told apart by nearly everybody, and lines differ in their dashes too. A value that is no
// number breaks a line; what lies outside given limits is cut off at the frame. On a logarithmic
// axis, only what is positive is a value.
//
// In a page (plot.id given) the elements carry classes, so that a style sheet can give them the
// colours of a dark page: paper, ink, grid, zero, axis, label, c0 to c6; and the svg element tells
// a script where the frame lies and what its edges stand for (data-frame, data-x, data-y).
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace asperity::io {

struct PlotSeries {
    enum class Style { line, dashed, dotted, points, rings };

    std::string label; ///< empty: not in the legend
    std::vector<double> x;
    std::vector<double> y; ///< as many as x
    Style style = Style::line;
    int colour = -1;                 ///< number in the palette; -1: the place among the series
    std::vector<double> spread = {}; ///< half lengths of error bars on points; may be empty
};

struct Plot {
    std::string title;
    std::string x_label; ///< with its unit
    std::string y_label;
    std::vector<PlotSeries> series;
    /// Limits of the axes; where none is given, they follow from the data.
    std::optional<double> x_low, x_high, y_low, y_high;
    bool x_log = false, y_log = false;
    int width = 640, height = 440; ///< pixels
    std::string id;                ///< unique in a page; empty: a document of its own
};

/// The plot as a self-contained SVG document, or as an element of a page. Throws
/// std::invalid_argument for series of unequal lengths.
std::string plot_svg(const Plot& plot);

/// Its numbers: one pair of columns a series under their labels, series side by side.
std::string plot_csv(const Plot& plot);

/// The plot's text in SVG markup: escaped, with its subscripts.
std::string plot_markup(const std::string& text);

/// A plot of a page as a document of its own, and that in a file, whole or not at all (FileError).
std::string plot_document(Plot plot);
void write_plot(const std::string& path, const Plot& plot);

} // namespace asperity::io
