// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "io/map_plot.hpp"

#include "io/plot.hpp"
#include "io/plot_axis.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace asperity::io {

namespace {

/// Lightness, green to red, blue to yellow (B. Ottosson, Oklab).
using Oklab = std::array<double, 3>;

Rgb rgb(const Oklab& c) {
    const double l = std::pow(c[0] + 0.3963377774 * c[1] + 0.2158037573 * c[2], 3),
                 m = std::pow(c[0] - 0.1055613458 * c[1] - 0.0638541728 * c[2], 3),
                 s = std::pow(c[0] - 0.0894841775 * c[1] - 1.2914855480 * c[2], 3);
    const std::array<double, 3> linear = {4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
                                          -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
                                          -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s};
    Rgb out;
    for (std::size_t i = 0; i < 3; ++i) {
        const double v = std::clamp(linear[i], 0.0, 1.0);
        const double shown = v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1.0 / 2.4) - 0.055;
        out[i] = static_cast<std::uint8_t>(std::lround(255.0 * shown));
    }
    return out;
}

constexpr double side = 440.0;  // of the map, pixels
constexpr double margin = 14.0; // around it
constexpr double bar_width = 16.0;
constexpr double grey_level = 0.62;

/// 1, 2 or 5 times a power of ten, at most a third of the edge.
double bar_length(double edge) {
    const double most = edge / 3.0, decade = std::pow(10.0, std::floor(std::log10(most)));
    for (const double m : {5.0, 2.0})
        if (m * decade <= most) return m * decade;
    return decade;
}

std::string length_text(double angstrom) {
    return angstrom >= 10.0 ? fmt::format("{:g} nm", 0.1 * angstrom)
                            : fmt::format("{:g} Å", angstrom);
}

struct Scale {
    double low = 0.0, high = 1.0;
};

Scale scale_of(const MapPlot& map) {
    if (map.colours == MapPlot::Colours::two) return {0.0, 1.0};
    std::vector<double> sorted;
    for (const double v : map.values)
        if (std::isfinite(v)) sorted.push_back(v);
    if (sorted.empty()) return {};
    std::sort(sorted.begin(), sorted.end());
    const std::size_t cut = sorted.size() / 200;
    Scale s = {map.low.value_or(sorted[cut]), map.high.value_or(sorted[sorted.size() - 1 - cut])};
    if (map.colours == MapPlot::Colours::diverging) {
        s.high = std::max(std::abs(s.low), std::abs(s.high));
        s.low = -s.high;
    }
    if (!(s.high > s.low)) s.high = s.low + std::max(1e-6, 1e-6 * std::abs(s.low));
    return s;
}

/// Pixels from the top: y grows upwards. Number 255 is no number. repeat: pixels to a value, where
/// the viewer would smear them.
std::string picture(const MapPlot& map, const Scale& scale, int repeat) {
    const auto n = static_cast<std::size_t>(map.sites), k = static_cast<std::size_t>(repeat);
    std::vector<Rgb> colours = palette(map.colours);
    colours[255] = rgb({grey_level, 0.0, 0.0});
    std::vector<std::uint8_t> pixels;
    pixels.reserve(n * n * k * k);
    for (std::size_t row = 0; row < n * k; ++row)
        for (std::size_t column = 0; column < n * k; ++column) {
            const double v = map.values[(n - 1 - row / k) * n + column / k];
            const double place = std::clamp((v - scale.low) / (scale.high - scale.low), 0.0, 1.0);
            pixels.push_back(std::isfinite(v)
                                 ? static_cast<std::uint8_t>(std::lround(254.0 * place))
                                 : std::uint8_t{255});
        }
    return png_of(pixels, map.sites * repeat, map.sites * repeat, colours);
}

std::string image(double x, double y, double w, double h, const std::string& png) {
    return fmt::format("<image x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" "
                       "preserveAspectRatio=\"none\" "
                       "href=\"data:image/png;base64,{}\"/>\n",
                       x, y, w, h, base64(png));
}

std::string text(double x, double y, const char* anchor, const std::string& body,
                 const char* more = "") {
    return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\"{}>{}</text>\n", x, y,
                       anchor, more, plot_markup(body));
}

/// A swatch and its word, for maps of two colours.
std::string swatch(double x, double y, const Rgb& c, const std::string& word) {
    return fmt::format("<rect x=\"{}\" y=\"{}\" width=\"14\" height=\"14\" fill=\"#{:02x}{:02x}"
                       "{:02x}\" stroke=\"#444444\" stroke-width=\"0.5\" class=\"axis\"/>\n",
                       x, y, c[0], c[1], c[2]) +
           text(x + 20.0, y + 11.5, "start", word);
}

std::string colour_bar(const MapPlot& map, const Scale& scale, double x, double y) {
    std::vector<std::uint8_t> column(255);
    for (std::size_t i = 0; i < column.size(); ++i)
        column[i] = static_cast<std::uint8_t>(254 - i);
    std::string out = image(x, y, bar_width, side, png_of(column, 1, 255, palette(map.colours)));
    out += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" "
                       "stroke=\"#444444\" stroke-width=\"0.7\" class=\"axis\"/>\n",
                       x, y, bar_width, side);
    const auto ticks = nice_ticks(scale.low, scale.high, 6);
    const double step = ticks.size() > 1 ? ticks[1] - ticks[0] : scale.high - scale.low;
    for (const double t : ticks) {
        const double at = y + side * (scale.high - t) / (scale.high - scale.low);
        out += fmt::format("<line x1=\"{0}\" y1=\"{2:.1f}\" x2=\"{1}\" y2=\"{2:.1f}\" "
                           "stroke=\"#444444\" class=\"axis\"/>\n",
                           x + bar_width, x + bar_width + 4.0, at);
        out += text(x + bar_width + 8.0, at + 4.5, "start", tick_label(t, step));
    }
    return out;
}

} // namespace

std::vector<Rgb> palette(MapPlot::Colours colours) {
    // Stations in Oklab; lightness is even between them.
    static const std::vector<Oklab> rising = {{0.24, -0.01, -0.09},
                                              {0.42, -0.03, -0.115},
                                              {0.60, -0.085, -0.02},
                                              {0.78, -0.09, 0.10},
                                              {0.95, -0.03, 0.14}};
    static const std::vector<Oklab> diverging = {{0.36, -0.03, -0.13},
                                                 {0.66, -0.045, -0.10},
                                                 {0.97, 0.0, 0.0},
                                                 {0.72, 0.08, 0.12},
                                                 {0.42, 0.11, 0.085}};
    static const std::vector<Oklab> two = {{0.93, -0.005, -0.012}, {0.42, -0.04, -0.115}};
    const std::vector<Oklab>& stations = colours == MapPlot::Colours::rising      ? rising
                                         : colours == MapPlot::Colours::diverging ? diverging
                                                                                  : two;
    std::vector<Rgb> list(256);
    for (std::size_t i = 0; i < list.size(); ++i) {
        const double at = std::min(1.0, static_cast<double>(i) / 254.0) *
                          static_cast<double>(stations.size() - 1);
        const std::size_t k = std::min(static_cast<std::size_t>(at), stations.size() - 2);
        const double f = at - static_cast<double>(k);
        Oklab c;
        for (std::size_t j = 0; j < 3; ++j)
            c[j] = (1.0 - f) * stations[k][j] + f * stations[k + 1][j];
        list[i] = rgb(c);
    }
    return list;
}

std::string map_svg(const MapPlot& map) {
    const bool two = map.colours == MapPlot::Colours::two;
    const double top = 40.0, right = margin + side;
    const double width = right + 90.0, height = top + side + 44.0;
    const Scale scale = scale_of(map);
    std::string out = map.id.empty() ? "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" : "";
    out += fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} "
        "{1}\" font-family=\"Helvetica, Arial, 'DejaVu Sans', sans-serif\" font-size=\"13\" "
        "fill=\"#222222\" class=\"map ink\" role=\"img\">\n<title>{2}</title>\n"
        "<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\" class=\"paper\"/>\n",
        width, height, plot_markup(map.title));
    out += text(margin, 24.0, "start", map.title + (map.unit.empty() ? "" : " (" + map.unit + ")"),
                " font-weight=\"bold\"");
    // A page tells the browser to keep pixels apart (image-rendering); other viewers smear them.
    const int repeat = map.id.empty() ? static_cast<int>(std::ceil(2.0 * side / map.sites)) : 1;
    out += image(margin, top, side, side, picture(map, scale, repeat));
    if (two) {
        const auto colours = palette(map.colours);
        out += swatch(margin + 0.5 * side + 20.0, top + side + 14.0, colours[0], map.low_word);
        out += swatch(margin + 0.5 * side + 120.0, top + side + 14.0, colours[254], map.high_word);
    } else {
        out += colour_bar(map, scale, right + 14.0, top);
    }
    // How long is that?
    const double length = bar_length(map.edge), bar = side * length / map.edge;
    const double y = top + side + 20.0;
    out += fmt::format("<path d=\"M{0:.1f} {1}v-4v8v-4h{2:.1f}v-4v8\" fill=\"none\" "
                       "stroke=\"#444444\" stroke-width=\"1.5\" class=\"axis\"/>\n",
                       margin, y, bar);
    out += text(margin + bar + 10.0, y + 4.5, "start", length_text(length));
    return out + "</svg>\n";
}

std::string map_png(const MapPlot& map) { return picture(map, scale_of(map), 1); }

std::string map_document(MapPlot map) {
    map.id.clear();
    return map_svg(map);
}

std::string map_csv(const MapPlot& map) {
    std::string out;
    const auto n = static_cast<std::size_t>(map.sites);
    for (std::size_t i = 0; i < n * n; ++i) {
        if (std::isfinite(map.values[i]))
            fmt::format_to(std::back_inserter(out), "{:.6g}", map.values[i]);
        out += (i + 1) % n == 0 ? '\n' : ',';
    }
    return out;
}

} // namespace asperity::io
