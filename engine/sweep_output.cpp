// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/sweep_output.hpp"

#include "engine/units.hpp"
#include "io/build_info.hpp"
#include "io/plot.hpp"
#include "io/result.hpp"
#include "io/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <utility>

namespace asperity {

namespace {

/// A column of numbers: the name in the CSV, and where it is.
struct Column {
    std::string name;
    std::function<double(const SweepPoint&)> value;
};

double ratio(const SweepPoint& p, double gamma) { return gamma / p.what.delta_gamma; }

const std::vector<Column>& columns() {
    static const std::vector<Column> list = {
        {"delta_gamma", [](const SweepPoint& p) { return p.what.delta_gamma; }},
        {"gamma_eff", [](const SweepPoint& p) { return p.numbers.gamma_eff; }},
        {"gamma_eff_ratio", [](const SweepPoint& p) { return p.numbers.state.gamma_ratio; }},
        {"contact_fraction", [](const SweepPoint& p) { return p.numbers.state.area; }},
        {"gamma_full_contact", [](const SweepPoint& p) { return p.numbers.gamma_full_contact; }},
        {"gamma_full_contact_ratio",
         [](const SweepPoint& p) { return ratio(p, p.numbers.gamma_full_contact); }},
        {"gamma_eff_with_gaps", [](const SweepPoint& p) { return p.numbers.gamma_eff_with_gaps; }},
        {"gamma_eff_with_gaps_ratio",
         [](const SweepPoint& p) { return ratio(p, p.numbers.gamma_eff_with_gaps); }},
        {"theta",
         [](const SweepPoint& p) {
             return p.numbers.theta.value_or(std::numeric_limits<double>::quiet_NaN());
         }},
        {"gamma_eff_ratio_error",
         [](const SweepPoint& p) { return p.numbers.state.gamma_ratio_error; }},
        {"contact_fraction_error", [](const SweepPoint& p) { return p.numbers.state.area_error; }},
    };
    return list;
}

std::string status_of(const SweepPoint& p) {
    return std::string(theory::name(p.numbers.state.status));
}

std::string shown(const io::JsonValue& value) {
    if (value.is_text()) return value.text();
    return value.is_number() ? fmt::format("{:.12g}", value.number()) : value.dump(-1);
}

std::string csv_field(const std::string& text) {
    if (text.find_first_of(",\"\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text)
        quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
}

/// "surface.rms" and "Å" as an axis' label.
std::string axis_label(const std::string& key, const std::string& unit) {
    const std::string name = key == "surface.rms"  ? "rms roughness h_{rms}"
                             : key == "drive.load" ? "load"
                                                   : key;
    if (unit.empty()) return name;
    return fmt::format("{} ({})", name, unit == "meV/Å^2" ? "meV/Å²" : unit);
}

/// The first axis whose values are numbers; of several, the one with the most values.
std::optional<std::size_t> plotted_axis(const SweepTable& table) {
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < table.axes.size(); ++i) {
        const bool numbers =
            std::all_of(table.points.begin(), table.points.end(),
                        [i](const SweepPoint& p) { return p.values[i].is_number(); });
        if (numbers && (!best || table.axes[i].values.size() > table.axes[*best].values.size()))
            best = i;
    }
    return best;
}

/// Points that differ in the plotted axis only, in the order of x; label: the other axes' values.
struct Curve {
    std::string label;
    std::vector<double> x;
    std::vector<const SweepPoint*> points;
};

std::vector<Curve> curves_of(const SweepTable& table, std::size_t axis) {
    Scene defaults;
    const io::Schema schema = bind(defaults);
    std::vector<Curve> curves;
    for (const SweepPoint& p : table.points) {
        std::string label;
        for (std::size_t i = 0; i < table.axes.size(); ++i)
            if (i != axis) {
                const std::string& key = table.axes[i].key;
                const std::string unit = schema.find(key)->unit;
                label += fmt::format("{}{} = {}", label.empty() ? "" : ", ",
                                     key.substr(key.find('.') + 1), shown(p.values[i]));
                if (!unit.empty() && p.values[i].is_number()) label += " " + unit;
            }
        auto at = std::find_if(curves.begin(), curves.end(),
                               [&](const Curve& c) { return c.label == label; });
        if (at == curves.end()) at = curves.insert(curves.end(), Curve{label, {}, {}});
        at->points.push_back(&p);
    }
    for (Curve& c : curves) {
        const auto x = [axis](const SweepPoint* p) { return p->values[axis].number(); };
        std::stable_sort(c.points.begin(), c.points.end(),
                         [&](const auto* a, const auto* b) { return x(a) < x(b); });
        for (const SweepPoint* p : c.points)
            c.x.push_back(x(p));
    }
    return curves;
}

using Style = io::PlotSeries::Style;
struct Trace {
    std::string label;
    Style style = Style::line;
    int colour = 0; ///< the same in every plot
    std::function<double(const SweepPoint&)> value;
};

constexpr std::size_t most_curves = 7; // as many as there are colours

io::Plot plot_of(const std::vector<Curve>& curves, const std::vector<Trace>& traces) {
    io::Plot plot;
    const bool several = curves.size() > 1;
    for (std::size_t t = 0; t < traces.size(); ++t) {
        const Trace& trace = traces[t];
        for (std::size_t i = 0; i < std::min(curves.size(), most_curves); ++i) {
            io::PlotSeries s;
            s.label = several ? (t == 0 ? curves[i].label : "") : trace.label;
            s.style = trace.style;
            s.colour = several ? static_cast<int>(i) : trace.colour;
            s.x = curves[i].x;
            for (const SweepPoint* p : curves[i].points)
                s.y.push_back(trace.value(*p));
            plot.series.push_back(std::move(s));
        }
        constexpr int grey = 6; // several curves: colours tell them apart, dashes the quantities
        if (several && t > 0) plot.series.push_back({trace.label, {}, {}, trace.style, grey});
    }
    if (traces.size() == 1 && !several) plot.series.front().label.clear();
    return plot;
}

/// The plots that the grid allows; their paths, and what kept others out.
std::vector<std::string> write_plots(const std::string& directory, const SweepTable& table,
                                     std::string& note) {
    const auto axis = plotted_axis(table);
    if (!axis) {
        note = "no plots: none of the swept keys is a number";
        return {};
    }
    const std::vector<Curve> curves = curves_of(table, *axis);
    if (curves.size() > most_curves)
        note = fmt::format("the plots show the first {} of {} curves", most_curves, curves.size());
    Scene defaults;
    const io::Schema schema = bind(defaults);
    const std::string x_label =
        axis_label(table.axes[*axis].key, schema.find(table.axes[*axis].key)->unit);

    const Trace theory{"theory", Style::line, 0,
                       [](const SweepPoint& p) { return p.numbers.state.gamma_ratio; }};
    const Trace full{"assuming full contact", Style::dashed, 2,
                     [](const SweepPoint& p) { return ratio(p, p.numbers.gamma_full_contact); }};
    // Where there is no contact the first-order extension says nothing.
    const Trace gaps{"with attraction across gaps", Style::dotted, 1, [](const SweepPoint& p) {
                         return p.numbers.state.status == theory::Status::no_contact
                                    ? std::numeric_limits<double>::quiet_NaN()
                                    : ratio(p, p.numbers.gamma_eff_with_gaps);
                     }};
    const Trace area{"contact area", Style::line, 0,
                     [](const SweepPoint& p) { return p.numbers.state.area; }};
    std::vector<std::string> written;
    const auto write = [&](const char* file, const std::string& title, const std::string& y_label,
                           const std::vector<Trace>& traces) {
        io::Plot plot = plot_of(curves, traces);
        plot.title = title;
        plot.x_label = x_label;
        plot.y_label = y_label;
        double lowest = 0.0; // of the theory itself: full contact may go far below zero
        double highest = 1.0;
        for (const io::PlotSeries& s : plot.series)
            for (const double y : s.y) {
                if (s.style != Style::dashed && std::isfinite(y)) lowest = std::min(lowest, y);
                if (std::isfinite(y)) highest = std::max(highest, y);
            }
        if (table.axes[*axis].key == "surface.rms") plot.x_low = 0.0;
        plot.y_low = lowest == 0.0 ? 0.0 : 1.05 * lowest;
        if (highest <= 1.02) plot.y_high = 1.02;
        const std::string path = (std::filesystem::path(directory) / file).string();
        io::write_plot(path, plot);
        written.push_back(path);
    };
    const std::string binding = "γ_{eff} / Δγ";
    write("gamma.svg", "Binding energy, theory", binding, {theory, gaps, full});
    write("area.svg", "Contact area, theory", "A / A_{0}", {area});
    write("full-contact.svg", "Binding energy, theory and full contact", binding, {theory, full});
    return written;
}

void print_table(const SweepTable& table) {
    std::vector<std::string> heads;
    for (const SweepAxis& axis : table.axes)
        heads.push_back(axis.key);
    for (const char* head : {"γ_eff, meV/Å²", "γ_eff/Δγ", "A/A0", "full contact", "with gaps", ""})
        heads.emplace_back(head);
    io::Table text(heads);
    // A hundred lines tell no more than twenty; the files have them all.
    const std::size_t n = table.points.size(), stride = std::max<std::size_t>(1, (n + 19) / 25);
    for (std::size_t i = 0; i < n; ++i) {
        if (i % stride != 0 && i + 1 != n) continue;
        const SweepPoint& p = table.points[i];
        std::vector<std::string> row;
        for (const io::JsonValue& value : p.values)
            row.push_back(shown(value));
        row.push_back(fmt::format("{:.3f}", p.numbers.gamma_eff));
        row.push_back(fmt::format("{:.5f}", p.numbers.state.gamma_ratio));
        row.push_back(fmt::format("{:.5f}", p.numbers.state.area));
        row.push_back(fmt::format("{:.5f}", ratio(p, p.numbers.gamma_full_contact)));
        row.push_back(fmt::format("{:.5f}", ratio(p, p.numbers.gamma_eff_with_gaps)));
        row.push_back(status_of(p));
        text.row(row);
    }
    text.print(stdout);
    if (stride > 1) fmt::print("  (every {}th of {} points; all are in the files)\n", stride, n);
}

} // namespace

SweepPoint::SweepPoint(const Scene& scene, const std::vector<SweepAxis>& axes, TheoryCase w,
                       TheoryNumbers n)
    : what(std::move(w)), numbers(std::move(n)) {
    const io::JsonValue all = scene_json(scene);
    for (const SweepAxis& axis : axes) {
        const io::JsonValue* value = all.find(axis.key);
        values.push_back(value ? *value : io::JsonValue());
    }
    numbers.state.profile = {}; // a point of a sweep keeps its numbers only
    what.contact.spectrum = {};
}

std::string sweep_csv(const SweepTable& table) {
    std::string text;
    for (const SweepAxis& axis : table.axes)
        text += csv_field(axis.key) + ",";
    for (const Column& column : columns())
        text += column.name + ",";
    text += "status\n";
    for (const SweepPoint& p : table.points) {
        for (const io::JsonValue& value : p.values)
            text += csv_field(shown(value)) + ",";
        for (const Column& column : columns()) {
            const double v = column.value(p);
            text += std::isfinite(v) ? fmt::format("{:.10g},", v) : std::string(",");
        }
        text += status_of(p) + "\n";
    }
    return text;
}

io::JsonValue sweep_json(const SweepTable& table) {
    io::JsonValue root = io::JsonValue::object();
    root["scene"] = table.scene;
    io::JsonValue axes = io::JsonValue::array();
    for (const SweepAxis& axis : table.axes)
        axes.push_back(axis.key);
    root["axes"] = std::move(axes);
    io::JsonValue points = io::JsonValue::array();
    for (const SweepPoint& p : table.points) {
        io::JsonValue point = io::JsonValue::object();
        point["set"] = io::JsonValue::object();
        for (std::size_t i = 0; i < table.axes.size(); ++i)
            point["set"][table.axes[i].key] = p.values[i];
        io::ResultRecord record;
        record.delta_gamma = p.what.flat;
        record_theory(p.what, p.numbers, record);
        const io::JsonValue result = io::result_json(record);
        point["delta_gamma"] = *result.find("delta_gamma");
        point["theory"] = *result.find("theory");
        points.push_back(std::move(point));
    }
    root["points"] = std::move(points);
    if (!table.notes.empty()) {
        io::JsonValue notes = io::JsonValue::array();
        for (const std::string& note : table.notes)
            notes.push_back(note);
        root["notes"] = std::move(notes);
    }
    const io::BuildInfo build = io::build_info();
    root["run"]["wall_seconds"] = table.seconds;
    root["run"]["version"] = build.version;
    root["run"]["git"] = build.git;
    root["run"]["compiler"] = build.compiler;
    root["run"]["flags"] = build.flags;
    return root;
}

void write_sweep(const std::string& directory, const SweepTable& table) {
    namespace fs = std::filesystem;
    std::string note;
    std::vector<std::string> written = write_plots(directory, table, note);
    const std::string csv = (fs::path(directory) / "sweep.csv").string(),
                      json = (fs::path(directory) / "sweep.json").string();
    io::write_whole(csv, sweep_csv(table));
    io::write_whole(json, sweep_json(table).dump() + "\n"); // last: it marks the sweep as there
    written.insert(written.begin(), {csv, json});

    print_table(table);
    for (const std::string& said : table.notes)
        fmt::print("note: {}\n", said);
    if (!note.empty()) fmt::print("note: {}\n", note);
    fmt::print("{} points in {:.2f} s; written:\n", table.points.size(), table.seconds);
    for (const std::string& path : written)
        fmt::print("  {}\n", path);
}

} // namespace asperity
