// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Plots, maps and pictures: what is drawn is what was given.
#include "io/html_page.hpp"
#include "io/map_plot.hpp"
#include "io/plot.hpp"
#include "io/plot_axis.hpp"
#include "io/png.hpp"

#include <cmath>
#include <cstdlib>
#include <limits>
#include <regex>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace asperity::io {
namespace {

std::size_t count(const std::string& text, const std::string& what) {
    std::size_t n = 0;
    for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += what.size())
        ++n;
    return n;
}

/// "x y" pairs of the first curve.
std::vector<std::pair<double, double>> curve(const std::string& svg) {
    std::smatch found;
    std::vector<std::pair<double, double>> points;
    if (!std::regex_search(svg, found, std::regex("<path d=\"([^\"]*)\"[^>]*data-label")))
        return {};
    const std::string path = found[1];
    const std::regex pair("[ML]([-0-9.]+) ([-0-9.]+)");
    for (std::sregex_iterator at(path.begin(), path.end(), pair), end; at != end; ++at)
        points.emplace_back(std::stod((*at)[1]), std::stod((*at)[2]));
    return points;
}

/// Every tag is closed, in order, and no stray <, & stands in the text.
bool well_formed(const std::string& text) {
    std::vector<std::string> open;
    for (std::size_t at = 0; at < text.size(); ++at) {
        if (text[at] == '&' && text.compare(at, 5, "&amp;") != 0 &&
            text.compare(at, 4, "&lt;") != 0 && text.compare(at, 4, "&gt;") != 0 &&
            text.compare(at, 6, "&quot;") != 0)
            return false;
        if (text[at] != '<') continue;
        const std::size_t end = text.find('>', at);
        if (end == std::string::npos) return false;
        const std::string tag = text.substr(at + 1, end - at - 1);
        at = end;
        if (tag.starts_with("?") || tag.ends_with("/")) continue;
        const std::string name = tag.substr(0, tag.find_first_of(" \n"));
        if (count(tag, "\"") % 2 != 0) return false;
        if (!name.starts_with("/")) {
            open.push_back(name);
        } else {
            if (open.empty() || "/" + open.back() != name) return false;
            open.pop_back();
        }
    }
    return open.empty();
}

TEST(Plot, IsWellFormed) {
    Plot plot;
    plot.title = "a < b & \"c\"";
    plot.x_label = "h_{rms} (Å)";
    plot.y_label = "γ_{eff} / Δγ";
    const double nan = std::nan("");
    plot.series.push_back({.label = "broken", .x = {0, 1, 2, 3, 4}, .y = {1, 2, nan, 3, 4}});
    plot.series.push_back(
        {.label = "points", .x = {0, 1}, .y = {1e30, -1e30}, .style = PlotSeries::Style::points});
    plot.y_low = 0.0;
    plot.y_high = 5.0;
    const std::string svg = plot_svg(plot);
    EXPECT_TRUE(well_formed(svg)) << svg;
    EXPECT_TRUE(svg.starts_with("<?xml"));
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_EQ(svg.find("inf"), std::string::npos);
    EXPECT_NE(svg.find("a &lt; b &amp; &quot;c&quot;"), std::string::npos);
    EXPECT_EQ(count(svg, "<circle"), 3u); // two points and the legend's
    const std::size_t path = svg.find("<path d=\"M");
    ASSERT_NE(path, std::string::npos);
    EXPECT_EQ(count(svg.substr(path, svg.find('"', path + 9) - path), "M"), 2u); // a gap at NaN
    plot.series.clear();
    EXPECT_TRUE(well_formed(plot_svg(plot)));
    plot.series.push_back({.label = "uneven", .x = {0, 1}, .y = {1}});
    EXPECT_THROW(plot_svg(plot), std::invalid_argument);
}

TEST(Plot, TicksStandAtRoundNumbers) {
    const auto labels = [](double low, double high, int n) {
        std::vector<std::string> list;
        const std::vector<double> ticks = nice_ticks(low, high, n);
        for (const double t : ticks)
            list.push_back(tick_label(t, ticks.at(1) - ticks.at(0)));
        return list;
    };
    EXPECT_EQ(labels(0, 1, 6), (std::vector<std::string>{"0", "0.2", "0.4", "0.6", "0.8", "1.0"}));
    EXPECT_EQ(labels(-9, 11, 4), (std::vector<std::string>{"−5", "0", "5", "10"}));
    EXPECT_EQ(labels(0, 0.003, 3), (std::vector<std::string>{"0", "0.001", "0.002", "0.003"}));
    EXPECT_TRUE(nice_ticks(1, 1, 5).empty());
}

TEST(Plot, LogarithmicAxesMakePowersStraight) {
    Plot plot;
    plot.x_log = plot.y_log = true;
    PlotSeries s{"", {}, {}, PlotSeries::Style::line, -1};
    for (const double x : {0.01, 0.1, 1.0, 10.0, 100.0}) {
        s.x.push_back(x);
        s.y.push_back(7.0 / (x * x));
    }
    s.x.push_back(3.0);
    s.y.push_back(-1.0); // no value on such an axis
    plot.series.push_back(s);
    const auto points = curve(plot_svg(plot));
    ASSERT_EQ(points.size(), 5u);
    for (std::size_t i = 1; i < 5; ++i) {
        EXPECT_NEAR(points[i].first - points[i - 1].first, points[1].first - points[0].first, 0.02);
        EXPECT_NEAR(points[i].second - points[i - 1].second, points[1].second - points[0].second,
                    0.02);
    }
}

TEST(Plot, TheFrameTellsWhatAPointIs) {
    Plot plot;
    plot.id = "p";
    plot.series.push_back({"a", {0.0, 2.0, 3.7}, {1.0, 5.0, -2.5}, PlotSeries::Style::line, -1});
    const std::string svg = plot_svg(plot);
    std::smatch f, x, y;
    ASSERT_TRUE(
        std::regex_search(svg, f, std::regex("data-frame=\"(\\S+) (\\S+) (\\S+) (\\S+)\"")));
    ASSERT_TRUE(std::regex_search(svg, x, std::regex("data-x=\"(\\S+) (\\S+) linear\"")));
    ASSERT_TRUE(std::regex_search(svg, y, std::regex("data-y=\"(\\S+) (\\S+) linear\"")));
    const auto number = [](const std::smatch& m, int i) { return std::stod(m[i]); };
    const auto points = curve(svg);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double u = (points[i].first - number(f, 1)) / (number(f, 3) - number(f, 1));
        const double v = (number(f, 4) - points[i].second) / (number(f, 4) - number(f, 2));
        EXPECT_NEAR(number(x, 1) + u * (number(x, 2) - number(x, 1)), plot.series[0].x[i], 2e-3);
        EXPECT_NEAR(number(y, 1) + v * (number(y, 2) - number(y, 1)), plot.series[0].y[i], 6e-3);
    }
    EXPECT_EQ(count(svg, "<?xml"), 0u);
    EXPECT_EQ(count(svg, "id=\"p-frame\""), 1u);
}

/// The legend's box and the curve's samples.
bool legend_covers(const std::string& svg) {
    std::smatch m;
    EXPECT_TRUE(std::regex_search(
        svg, m,
        std::regex(
            "<rect x=\"(\\S+)\" y=\"(\\S+)\" width=\"(\\S+)\" height=\"(\\S+)\"[^>]*legend")));
    for (const auto& [u, v] : curve(svg))
        if (u > std::stod(m[1]) && u < std::stod(m[1]) + std::stod(m[3]) && v > std::stod(m[2]) &&
            v < std::stod(m[2]) + std::stod(m[4]))
            return true;
    return false;
}

TEST(Plot, TheLegendCoversNothing) {
    Plot free; // a corner is free
    free.series.push_back({"a line", {0.0, 1.0}, {0.0, 1.0}, PlotSeries::Style::line, -1});
    EXPECT_FALSE(legend_covers(plot_svg(free)));
    EXPECT_EQ(count(plot_svg(free), "height=\"440\""), 2u);
    Plot full; // no corner is free: it goes above, and the drawing grows
    full.series.push_back({"a curve", {}, {}, PlotSeries::Style::line, -1});
    for (int i = 0; i <= 400; ++i) {
        full.series[0].x.push_back(i);
        full.series[0].y.push_back(i % 2);
    }
    EXPECT_FALSE(legend_covers(plot_svg(full)));
    EXPECT_EQ(count(plot_svg(full), "height=\"468\""), 2u);
}

TEST(Plot, DrawsNoMoreOfALineThanCanBeSeen) {
    Plot plot;
    plot.series.push_back({"noise", {}, {}, PlotSeries::Style::line, -1});
    for (int i = 0; i < 100000; ++i) {
        plot.series[0].x.push_back(i);
        plot.series[0].y.push_back(i == 12345 ? 9.0 : i == 54321 ? -7.0 : std::sin(0.7 * i));
    }
    const std::string svg = plot_svg(plot);
    std::smatch frame, y;
    ASSERT_TRUE(
        std::regex_search(svg, frame, std::regex("data-frame=\"\\S+ (\\S+) \\S+ (\\S+)\"")));
    ASSERT_TRUE(std::regex_search(svg, y, std::regex("data-y=\"(\\S+) (\\S+) linear\"")));
    const double top = std::stod(frame[1]), bottom = std::stod(frame[2]);
    const double low = std::stod(y[1]), high = std::stod(y[2]);
    // curve() would match this long path with a recursion.
    const std::size_t from = svg.find("<path d=\"M") + 9;
    const std::string path = svg.substr(from, svg.find('"', from) - from);
    EXPECT_LT(count(path, "L"), 6000u);
    double greatest = -1e9, least = 1e9;
    for (std::size_t at = path.find(' '); at != std::string::npos; at = path.find(' ', at + 1)) {
        const double v =
            low + (bottom - std::stod(path.substr(at))) / (bottom - top) * (high - low);
        greatest = std::max(greatest, v);
        least = std::min(least, v);
    }
    EXPECT_NEAR(greatest, 9.0, 0.01);
    EXPECT_NEAR(least, -7.0, 0.01);
    EXPECT_EQ(count(plot_csv(plot), "\n"), 100001u); // the numbers are all there
}

TEST(Plot, NumbersAsText) {
    Plot plot;
    plot.x_label = "h_{rms} (Å)";
    plot.y_label = "γ";
    plot.series.push_back({"a \"b\"", {1.0, 2.0}, {0.5, std::nan("")}, PlotSeries::Style::line, 0});
    plot.series.push_back({"c", {3.0}, {4.0}, PlotSeries::Style::line, 0});
    EXPECT_EQ(plot_csv(plot), "\"h_rms (Å)\",\"a \"\"b\"\": γ\",\"h_rms (Å)\",\"c: γ\"\n"
                              "1,0.5,3,4\n2,,,\n");
}

TEST(Png, BytesAndText) {
    EXPECT_EQ(base64(""), "");
    EXPECT_EQ(base64("f"), "Zg=="); // RFC 4648, section 10
    EXPECT_EQ(base64("fo"), "Zm8=");
    EXPECT_EQ(base64("foo"), "Zm9v");
    EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
    const std::vector<Rgb> colours = {{0, 0, 0}, {255, 0, 0}};
    const std::vector<std::uint8_t> pixels = {0, 1, 1, 0, 0, 0};
    const std::string png = png_of(pixels, 3, 2, colours);
    EXPECT_EQ(png.substr(1, 3), "PNG");
    EXPECT_EQ(png[19], 3); // width and height stand in the head
    EXPECT_EQ(png[23], 2);
    const std::string drawn = png_of_svg("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"30\" "
                                         "height=\"20\"><rect width=\"9\" height=\"9\"/></svg>",
                                         2.0);
    EXPECT_EQ(drawn[19], 60);
    EXPECT_EQ(drawn[23], 40);
    EXPECT_ANY_THROW(png_of_svg("this is no drawing", 1.0));
    EXPECT_ANY_THROW(png_of({}, 3, 2, colours));
}

/// Relative luminance, of which perceived lightness is a monotone function.
double luminance(const Rgb& c) {
    const auto linear = [](double v) {
        return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
    };
    return 0.2126 * linear(c[0] / 255.0) + 0.7152 * linear(c[1] / 255.0) +
           0.0722 * linear(c[2] / 255.0);
}

TEST(MapPlot, LightnessTellsTheOrder) {
    const auto rising = palette(MapPlot::Colours::rising);
    for (std::size_t i = 1; i < 255; ++i)
        EXPECT_GT(luminance(rising[i]) + 2e-3, luminance(rising[i - 1])) << i;
    EXPECT_GT(luminance(rising[254]), 10.0 * luminance(rising[0]));
    const auto both = palette(MapPlot::Colours::diverging);
    for (std::size_t i = 1; i < 128; ++i) { // towards the middle it gets lighter on either side
        EXPECT_GT(luminance(both[i]) + 2e-3, luminance(both[i - 1])) << i;
        EXPECT_GT(luminance(both[254 - i]) + 2e-3, luminance(both[255 - i])) << i;
    }
    EXPECT_GT(both[0][2], both[0][0]);     // blue pulls
    EXPECT_GT(both[254][0], both[254][2]); // orange pushes
}

TEST(MapPlot, ScaleBarAndColourBar) {
    MapPlot map;
    map.title = "gap <of> all";
    map.unit = "Å";
    map.sites = 4;
    map.edge = 330.0;
    for (int i = 0; i < 16; ++i)
        map.values.push_back(i);
    map.values[3] = std::numeric_limits<double>::infinity();
    const std::string svg = map_svg(map);
    EXPECT_EQ(count(svg, "10 nm"), 1u); // the largest round length up to a third of the edge
    EXPECT_EQ(count(svg, "gap &lt;of&gt; all (Å)"), 1u);
    EXPECT_EQ(count(svg, "<image"), 2u); // the map and its bar
    EXPECT_EQ(count(svg, "http://www.w3.org/2000/svg"), count(svg, "http"));
    EXPECT_EQ(map_csv(map), "0,1,2,\n4,5,6,7\n8,9,10,11\n12,13,14,15\n");
    map.colours = MapPlot::Colours::two;
    map.low_word = "apart";
    map.high_word = "in contact";
    EXPECT_EQ(count(map_svg(map), "in contact"), 1u);
    map.values.assign(16, 0.0); // nothing to tell apart: still a picture
    map.colours = MapPlot::Colours::diverging;
    EXPECT_EQ(count(map_svg(map), "nan"), 0u);
}

TEST(HtmlPage, EscapesAndNeedsNothing) {
    HtmlPage page("kicker", "a < b & \"c\"", "lead");
    page.section("one", "γ_{eff}");
    page.paragraph("<script>alert(1)</script> 5 meV/Å²");
    page.notice("failed", "line one\nline <two>");
    page.table({"x", "y"}, {{"1", "<2>"}});
    page.preformatted("[surface]\nfile = \"</pre>\"");
    const std::string text = page.text();
    EXPECT_EQ(count(text, "alert(1)"), 1u);
    EXPECT_EQ(count(text, "<script>"), 1u); // its own
    EXPECT_EQ(count(text, "&lt;/pre&gt;"), 1u);
    EXPECT_EQ(count(text, "γ<sub>eff</sub>"), 2u); // heading and contents
    EXPECT_EQ(count(text, "<title>a &lt; b &amp; &quot;c&quot; · kicker</title>"), 1u);
    for (const char* outside : {"src=", "@import", "url(http", "<link rel=\"stylesheet\""})
        EXPECT_EQ(count(text, outside), 0u) << outside;
}

} // namespace
} // namespace asperity::io
