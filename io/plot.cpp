// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "io/plot.hpp"

#include "io/markup.hpp"
#include "io/plot_axis.hpp"
#include "io/result.hpp"
#include "io/table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

namespace asperity::io {

namespace {

/// Okabe and Ito, without the yellow that vanishes on white.
constexpr std::array<const char*, 7> palette = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                                "#E69F00", "#56B4E9", "#4D4D4D"};
constexpr double font = 13.0;        // pixels
constexpr double letter = 0.56;      // mean width of one, in font sizes
constexpr double legend_line = 20.0; // pixels
constexpr double sample = 30.0;      // length of the line shown in the legend

/// "h_{rms} (Å)" with its subscripts.
std::string marked_up(const std::string& text) {
    std::string out;
    std::size_t at = 0;
    bool lowered = false; // the baseline is still that of a subscript
    const auto body = [&](const std::string& part) {
        if (part.empty()) return;
        out +=
            lowered ? "<tspan dy=\"-4\">" + escape_markup(part) + "</tspan>" : escape_markup(part);
        lowered = false;
    };
    for (;;) {
        const std::size_t open = text.find("_{", at);
        const std::size_t close = open == std::string::npos ? open : text.find('}', open);
        if (close == std::string::npos) {
            body(text.substr(at));
            return out;
        }
        body(text.substr(at, open - at));
        out += fmt::format("<tspan dy=\"{}\" font-size=\"{}\">{}</tspan>", lowered ? 0 : 4,
                           font - 3, escape_markup(text.substr(open + 2, close - open - 2)));
        lowered = true;
        at = close + 1;
    }
}

/// Without the marks, for titles and widths.
std::string plain(std::string text) {
    for (std::size_t open; (open = text.find("_{")) != std::string::npos;) {
        const std::size_t close = text.find('}', open);
        if (close == std::string::npos) break;
        text.erase(close, 1);
        text.replace(open, 2, "_");
    }
    return text;
}

class Drawing {
public:
    explicit Drawing(const Plot& plot)
        : plot_(plot),
          x_(limits(&PlotSeries::x, plot.x_log), plot.x_low, plot.x_high, 8, plot.x_log),
          y_(limits(&PlotSeries::y, plot.y_log), plot.y_low, plot.y_high, 6, plot.y_log) {
        int widest = 0;
        for (const double t : y_.ticks)
            widest = std::max(widest, visible_width(y_.label(t)));
        left_ = 44.0 + letter * font * widest;
        right_ = plot.width - 22.0;
        top_ = plot.title.empty() ? 20.0 : 44.0;
        bottom_ = plot.height - 58.0;
        place_legend();
        height_ = bottom_ + 58.0;
    }

    std::string svg() {
        const bool alone = plot_.id.empty();
        const std::string frame = alone ? "frame" : plot_.id + "-frame";
        out_ = alone ? "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" : "";
        out_ += fmt::format(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" "
            "viewBox=\"0 0 {0} {1}\" font-family=\"Helvetica, Arial, 'DejaVu Sans', sans-serif\" "
            "font-size=\"{2}\" fill=\"#222222\" class=\"plot ink\" role=\"img\" "
            "data-frame=\"{3:.1f} {4:.1f} {5:.1f} {6:.1f}\" data-x=\"{7:.9g} {8:.9g} {9}\" "
            "data-y=\"{10:.9g} {11:.9g} {12}\">\n",
            plot_.width, height_, font, left_, top_, right_, bottom_, x_.low, x_.high,
            x_.logarithmic ? "log" : "linear", y_.low, y_.high, y_.logarithmic ? "log" : "linear");
        out_ +=
            fmt::format("<title>{3}</title>\n"
                        "<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\" class=\"paper\"/>\n",
                        plot_.width, height_, font,
                        escape_markup(plain(plot_.title.empty() ? plot_.y_label : plot_.title)));
        axes();
        out_ += fmt::format("<clipPath id=\"{}\"><rect x=\"{:.1f}\" y=\"{:.1f}\" "
                            "width=\"{:.1f}\" height=\"{:.1f}\"/></clipPath>\n",
                            frame, left_ - 1, top_ - 1, right_ - left_ + 2, bottom_ - top_ + 2);
        out_ += fmt::format("<g clip-path=\"url(#{})\" fill=\"none\" stroke-width=\"2\" "
                            "stroke-linejoin=\"round\">\n",
                            frame);
        for (std::size_t i = 0; i < plot_.series.size(); ++i)
            series(plot_.series[i], colour(i));
        out_ += "</g>\n";
        legend();
        return out_ + "</svg>\n";
    }

private:
    AxisLimits limits(std::vector<double> PlotSeries::*member, bool logarithmic) const {
        AxisLimits all;
        for (const PlotSeries& s : plot_.series) {
            if (s.x.size() != s.y.size())
                throw std::invalid_argument(
                    fmt::format("plot: series \"{}\" has {} x and {} y values; give as many of "
                                "the one as of the other",
                                s.label, s.x.size(), s.y.size()));
            for (const double v : s.*member)
                all.take(v, logarithmic);
            if (member == &PlotSeries::y)
                for (std::size_t i = 0; i < std::min(s.spread.size(), s.y.size()); ++i)
                    if (std::isfinite(s.spread[i])) {
                        all.take(s.y[i] - s.spread[i], logarithmic);
                        all.take(s.y[i] + s.spread[i], logarithmic);
                    }
        }
        return all;
    }

    double px(double x) const { return left_ + x_.place(x) * (right_ - left_); }
    double py(double y) const {
        // Far outside the frame any place will do; viewers dislike enormous coordinates.
        const double v = bottom_ - y_.place(y) * (bottom_ - top_);
        return std::clamp(v, -10.0 * plot_.height, 11.0 * plot_.height);
    }
    bool holds(const PlotSeries& s, std::size_t i) const {
        return x_.holds(s.x[i]) && y_.holds(s.y[i]);
    }
    std::size_t colour(std::size_t i) const {
        const int own = plot_.series[i].colour;
        return (own < 0 ? i : static_cast<std::size_t>(own)) % palette.size();
    }

    void line(double x1, double y1, double x2, double y2, const char* stroke, const char* role) {
        out_ += fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" "
                            "stroke=\"{}\" class=\"{}\"/>\n",
                            x1, y1, x2, y2, stroke, role);
    }
    void text(double x, double y, const char* anchor, const std::string& body,
              const std::string& more = "") {
        out_ += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" "
                            "xml:space=\"preserve\"{}>{}</text>\n",
                            x, y, anchor, more, body);
    }

    void axes() {
        for (const double t : y_.ticks)
            line(left_, py(t), right_, py(t), t == 0.0 ? "#b0b0b0" : "#e6e6e6",
                 t == 0.0 ? "zero" : "grid");
        for (const double t : x_.ticks)
            line(px(t), bottom_, px(t), bottom_ + 5.0, "#444444", "axis");
        for (const double t : y_.ticks)
            line(left_ - 5.0, py(t), left_, py(t), "#444444", "axis");
        line(left_, bottom_, right_, bottom_, "#444444", "axis");
        line(left_, top_, left_, bottom_, "#444444", "axis");
        for (const double t : x_.ticks)
            text(px(t), bottom_ + 20.0, "middle", x_.label(t));
        for (const double t : y_.ticks)
            text(left_ - 9.0, py(t) + 4.5, "end", y_.label(t));
        const double middle = 0.5 * (top_ + bottom_);
        text(0.5 * (left_ + right_), height_ - 16.0, "middle", marked_up(plot_.x_label));
        text(18.0, middle, "middle", marked_up(plot_.y_label),
             fmt::format(" transform=\"rotate(-90 18 {:.1f})\"", middle));
        if (!plot_.title.empty())
            text(left_, 24.0, "start", marked_up(plot_.title), " font-weight=\"bold\"");
    }

    static std::string dashes(PlotSeries::Style style) {
        if (style == PlotSeries::Style::dashed) return " stroke-dasharray=\"8 5\"";
        if (style == PlotSeries::Style::dotted)
            return " stroke-dasharray=\"1 5\" stroke-linecap=\"round\"";
        return "";
    }

    static bool is_marker(PlotSeries::Style style) {
        return style == PlotSeries::Style::points || style == PlotSeries::Style::rings;
    }

    /// The pointer reads what a marker is of; the legend's own are no data.
    void marker(double x, double y, const PlotSeries& s, std::size_t tint, bool in_legend) {
        const bool ring = s.style == PlotSeries::Style::rings;
        const std::string more =
            in_legend ? " sample\""
                      : fmt::format("\" data-label=\"{}\"", escape_markup(plain(s.label)));
        out_ +=
            fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"4\" fill=\"{}\" "
                        "stroke=\"{}\" stroke-width=\"{}\" class=\"{}{}{}/>\n",
                        x, y, ring ? "#ffffff" : palette[tint], ring ? palette[tint] : "#ffffff",
                        ring ? 1.8 : 1.0, ring ? 'c' : 'f', tint, more);
    }

    /// Of neighbours within half a pixel across, the first, least, greatest and last are drawn: no
    /// more can be seen.
    std::string line_path(const PlotSeries& s) const {
        std::string path;
        bool drawing = false;
        for (std::size_t i = 0; i < s.x.size(); ++i) {
            if (!holds(s, i)) {
                drawing = false;
                continue;
            }
            const std::size_t first = i;
            std::size_t least = i, greatest = i;
            while (i + 1 < s.x.size() && holds(s, i + 1) &&
                   std::abs(px(s.x[i + 1]) - px(s.x[first])) < 0.5) {
                ++i;
                if (s.y[i] < s.y[least]) least = i;
                if (s.y[i] > s.y[greatest]) greatest = i;
            }
            for (const std::size_t k : std::set{first, least, greatest, i}) {
                path += fmt::format("{}{:.2f} {:.2f}", drawing ? "L" : "M", px(s.x[k]), py(s.y[k]));
                drawing = true;
            }
        }
        return path;
    }

    void series(const PlotSeries& s, std::size_t tint) {
        if (is_marker(s.style)) {
            for (std::size_t i = 0; i < s.x.size(); ++i) {
                if (!holds(s, i)) continue;
                if (i < s.spread.size() && s.spread[i] > 0.0) {
                    const double x = px(s.x[i]), low = py(s.y[i] - s.spread[i]),
                                 high = py(s.y[i] + s.spread[i]);
                    out_ +=
                        fmt::format("<path d=\"M{:.2f} {:.2f}V{:.2f}M{:.2f} {:.2f}h8M{:.2f} "
                                    "{:.2f}h8\" stroke=\"{}\" stroke-width=\"1.2\" "
                                    "class=\"c{}\"/>\n",
                                    x, low, high, x - 4.0, low, x - 4.0, high, palette[tint], tint);
                }
                marker(px(s.x[i]), py(s.y[i]), s, tint, false);
            }
            return;
        }
        const std::string path = line_path(s);
        if (!path.empty())
            out_ += fmt::format(
                "<path d=\"{}\" stroke=\"{}\" class=\"c{}\" data-label=\"{}\"{}/>\n", path,
                palette[tint], tint, escape_markup(plain(s.label)), dashes(s.style));
    }

    /// Whether a curve passes through the box: its samples, and its lines every few pixels.
    bool hides(double x, double y, double w, double h) const {
        const auto inside = [&](double u, double v) {
            return u > x - 4.0 && u < x + w + 4.0 && v > y - 4.0 && v < y + h + 4.0;
        };
        for (const PlotSeries& s : plot_.series)
            for (std::size_t i = 0; i < s.x.size(); ++i) {
                if (!holds(s, i)) continue;
                const double u = px(s.x[i]), v = py(s.y[i]);
                if (inside(u, v)) return true;
                if (s.style == PlotSeries::Style::points || i == 0 || !holds(s, i - 1)) continue;
                const double du = px(s.x[i - 1]) - u, dv = py(s.y[i - 1]) - v;
                const int parts = static_cast<int>(std::min(std::hypot(du, dv), 2e4) / 6.0);
                for (int k = 1; k <= parts; ++k)
                    if (const double f = static_cast<double>(k) / (parts + 1);
                        inside(u + f * du, v + f * dv))
                        return true;
            }
        return false;
    }

    /// A free corner of the frame, or room above it.
    void place_legend() {
        int lines = 0, widest = 0;
        for (const PlotSeries& s : plot_.series)
            if (!s.label.empty()) {
                ++lines;
                widest = std::max(widest, visible_width(plain(s.label)));
            }
        legend_h_ = lines == 0 ? 0.0 : legend_line * lines + 8.0;
        if (lines == 0) return;
        legend_w_ = sample + 24.0 + 1.1 * letter * font * widest;
        for (const double v : {top_ + 6.0, bottom_ - legend_h_ - 6.0})
            for (const double u : {right_ - legend_w_ - 6.0, left_ + 8.0})
                if (!hides(u, v, legend_w_, legend_h_)) {
                    legend_x_ = u;
                    legend_y_ = v;
                    return;
                }
        legend_x_ = left_;
        legend_y_ = top_ - 6.0;
        top_ += legend_h_;
        bottom_ += legend_h_;
    }

    void legend() {
        if (legend_h_ == 0.0) return;
        out_ += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" "
                            "fill=\"#ffffff\" fill-opacity=\"0.85\" stroke=\"#d0d0d0\" "
                            "class=\"legend\"/>\n",
                            legend_x_, legend_y_, legend_w_, legend_h_);
        double at = legend_y_ + 4.0 + 0.5 * legend_line;
        for (std::size_t i = 0; i < plot_.series.size(); ++i) {
            const PlotSeries& s = plot_.series[i];
            if (s.label.empty()) continue;
            const std::size_t tint = colour(i);
            if (is_marker(s.style))
                marker(legend_x_ + 8.0 + 0.5 * sample, at, s, tint, true);
            else
                out_ +=
                    fmt::format("<path d=\"M{:.1f} {:.1f}h{}\" stroke=\"{}\" "
                                "stroke-width=\"2\" class=\"c{} sample\"{}/>\n",
                                legend_x_ + 8.0, at, sample, palette[tint], tint, dashes(s.style));
            text(legend_x_ + sample + 16.0, at + 4.5, "start", marked_up(s.label));
            at += legend_line;
        }
    }

    const Plot& plot_;
    PlotAxis x_, y_;
    double left_ = 0.0, right_ = 0.0, top_ = 0.0, bottom_ = 0.0;
    double height_ = 0.0; ///< of the drawing
    double legend_x_ = 0.0, legend_y_ = 0.0, legend_w_ = 0.0, legend_h_ = 0.0;
    std::string out_;
};

} // namespace

std::string plot_svg(const Plot& plot) { return Drawing(plot).svg(); }

std::string plot_csv(const Plot& plot) {
    const auto name = [](std::string text) { // CSV wants quotes doubled
        for (std::size_t at = 0; (at = text.find('"', at)) != std::string::npos; at += 2)
            text.insert(at, 1, '"');
        return "\"" + text + "\"";
    };
    std::string out;
    std::size_t rows = 0;
    for (const PlotSeries& s : plot.series) {
        const std::string y = plain(s.label.empty() ? plot.y_label : s.label + ": " + plot.y_label);
        out += fmt::format("{}{},{}", out.empty() ? "" : ",", name(plain(plot.x_label)), name(y));
        rows = std::max(rows, s.x.size());
    }
    out += '\n';
    const auto number = [](double v) {
        return std::isfinite(v) ? fmt::format("{:.9g}", v) : std::string();
    };
    for (std::size_t i = 0; i < rows; ++i) {
        for (std::size_t k = 0; k < plot.series.size(); ++k) {
            const PlotSeries& s = plot.series[k];
            out += k == 0 ? "" : ",";
            out += i < s.x.size() ? number(s.x[i]) + "," + number(s.y[i]) : ",";
        }
        out += '\n';
    }
    return out;
}

std::string plot_markup(const std::string& text) { return marked_up(text); }

std::string plot_document(Plot plot) {
    plot.id.clear();
    return plot_svg(plot);
}

void write_plot(const std::string& path, const Plot& plot) {
    write_whole(path, plot_document(plot));
}

} // namespace asperity::io
