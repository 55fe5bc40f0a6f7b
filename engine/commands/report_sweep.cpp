// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The page of a sweep, from sweep.json: each point has the keys that were set and, in the names of
// result.json, what was found there by theory and simulation.
#include "engine/commands/report.hpp"

#include "io/error.hpp"
#include "io/table.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace asperity {

namespace {

namespace fs = std::filesystem;
using io::JsonValue;
using Style = io::PlotSeries::Style;

constexpr std::size_t most_curves = 7;

/// Names like "surface.rms" are whole in a point, not paths.
std::optional<double> member(const JsonValue* object, const std::string& name) {
    if (object && object->is_object())
        for (const auto& [key, value] : object->members())
            if (key == name && value.is_number()) return value.number();
    return std::nullopt;
}

/// What the theory says of the point, or what its simulation found.
std::optional<double> number(const JsonValue& point, const std::string& key) {
    if (const auto found = member(point.find("result"), key)) return found;
    const JsonValue* value = point.find(key);
    if (!value || !value->is_number()) return std::nullopt;
    return value->number();
}

/// One quantity of the points: where it is, and how it is drawn.
struct Trace {
    const char* label;
    const char* key;
    Style style;
    int colour;
};
const std::vector<Trace> energies = {
    {"theory", "theory.gamma_eff", Style::line, 6},
    {"theory with gaps", "theory.gamma_eff_with_gaps", Style::dotted, 6},
    {"theory, full contact", "theory.gamma_full_contact", Style::dashed, 6},
    {"state at zero load", "binding_energy", Style::points, 2},
    {"approach", "work_of_adhesion.approach", Style::points, 0},
    {"pull-off", "work_of_adhesion.pull_off", Style::points, 1}};
const std::vector<Trace> areas = {{"theory", "theory.contact_fraction", Style::line, 6},
                                  {"simulation", "contact_fraction", Style::points, 2}};

/// What theory and simulation are divided by: each has a Δγ of its own.
double divisor(const JsonValue& point, const std::string& key) {
    const auto flat = number(point, "delta_gamma");
    const auto theory = number(point, "theory.delta_gamma");
    return (key.starts_with("theory.") && theory ? theory : flat).value_or(std::nan(""));
}

class SweepPlots {
public:
    explicit SweepPlots(const JsonValue& sweep) {
        for (const JsonValue& point : sweep.find("points")->items())
            if (point.find("set") && point.find("set")->is_object()) points_.push_back(&point);
        for (const JsonValue* point : points_)
            for (const auto& [key, value] : point->find("set")->members())
                if (value.is_number()) {
                    values_[key].insert(value.number());
                    if (x_.empty() || values_[key].size() > values_[x_].size()) x_ = key;
                }
    }

    bool any() const { return !x_.empty(); }
    const std::string& axis() const { return x_; }
    const std::vector<const JsonValue*>& points() const { return points_; }

    std::optional<io::Plot> plot(const std::string& id, const std::string& title,
                                 const std::string& y_label, const std::vector<Trace>& traces,
                                 bool over_flat) const {
        io::Plot plot;
        plot.id = id;
        plot.title = title;
        plot.x_label = x_ == "surface.rms"  ? "rms roughness h_{rms} (Å)"
                       : x_ == "drive.load" ? "load (MPa)"
                                            : x_;
        plot.y_label = y_label;
        plot.width = 520;
        plot.height = 400;
        const std::vector<std::string> groups = group_names();
        for (const Trace& trace : traces)
            for (std::size_t g = 0; g < std::min(groups.size(), most_curves); ++g) {
                io::PlotSeries s;
                s.label = trace.label;
                s.style = trace.style;
                s.colour = trace.colour;
                if (groups.size() > 1) {
                    s.label += ", " + groups[g];
                    s.colour = static_cast<int>(g);
                }
                fill(s, trace, groups[g], over_flat);
                if (!s.x.empty()) plot.series.push_back(std::move(s));
            }
        if (plot.series.empty()) return std::nullopt;
        plot.y_low = 0.0;
        return plot;
    }

private:
    /// The swept keys that tell curves apart, with their values; seeds are spread, not curves.
    std::string group_of(const JsonValue& point) const {
        std::string name;
        for (const auto& [key, value] : point.find("set")->members())
            if (key != x_ && key != "surface.seed")
                name += fmt::format("{}{} = {}", name.empty() ? "" : ", ",
                                    key.substr(key.find('.') + 1),
                                    value.is_text() ? value.text() : value.dump(-1));
        return name;
    }
    std::vector<std::string> group_names() const {
        std::vector<std::string> names;
        for (const JsonValue* point : points_)
            if (const std::string g = group_of(*point);
                std::find(names.begin(), names.end(), g) == names.end())
                names.push_back(g);
        return names;
    }

    void fill(io::PlotSeries& s, const Trace& trace, const std::string& group,
              bool over_flat) const {
        std::vector<std::pair<double, double>> pairs;
        for (const JsonValue* point : points_) {
            const auto x = member(point->find("set"), x_), y = number(*point, trace.key);
            if (!x || !y || group_of(*point) != group) continue;
            pairs.emplace_back(*x, over_flat ? *y / divisor(*point, trace.key) : *y);
        }
        std::stable_sort(pairs.begin(), pairs.end(),
                         [](const auto& a, const auto& b) { return a.first < b.first; });
        for (const auto& [x, y] : pairs) {
            s.x.push_back(x);
            s.y.push_back(y);
        }
    }

    std::vector<const JsonValue*> points_;
    std::map<std::string, std::set<double>> values_;
    std::string x_; ///< the key of numbers with the most values
};

void write_table(io::HtmlPage& page, const SweepPlots& plots) {
    std::vector<Trace> shown;
    for (const auto* list : {&energies, &areas})
        for (const Trace& trace : *list)
            if (std::any_of(plots.points().begin(), plots.points().end(),
                            [&](const JsonValue* p) { return number(*p, trace.key); }))
                shown.push_back(trace);
    std::vector<std::string> heads;
    for (const auto& [key, value] : plots.points().front()->find("set")->members())
        heads.push_back(key);
    for (const Trace& trace : shown)
        heads.push_back(std::string(trace.key).find("contact_fraction") != std::string::npos
                            ? std::string("A/A_{0}, ") + trace.label
                            : std::string("γ/Δγ, ") + trace.label);
    // A hundred lines tell no more than forty; the CSV files have them all.
    const std::size_t n = plots.points().size(), stride = std::max<std::size_t>(1, (n + 39) / 40);
    std::vector<std::vector<std::string>> rows;
    for (std::size_t i = 0; i < n; i += stride) {
        const JsonValue& point = *plots.points()[i];
        std::vector<std::string> row;
        for (const auto& [key, value] : point.find("set")->members())
            row.push_back(value.is_number() ? fmt::format("{:.6g}", value.number())
                          : value.is_text() ? value.text()
                                            : value.dump(-1));
        for (const Trace& trace : shown) {
            const auto value = number(point, trace.key);
            const bool area = std::string(trace.key).find("contact_fraction") != std::string::npos;
            row.push_back(value ? minus(fmt::format(
                                      "{:.4f}", area ? *value : *value / divisor(point, trace.key)))
                                : "");
        }
        rows.push_back(std::move(row));
    }
    page.section("points", "All points");
    page.table(heads, rows);
    if (stride > 1)
        page.paragraph(fmt::format("Every {}th of {} points; all are in sweep.csv.", stride, n));
}

} // namespace

io::HtmlPage sweep_page(const std::string& directory, ReportFiles& files) {
    const std::string path = (fs::path(directory) / "sweep.json").string();
    const JsonValue sweep = JsonValue::parse(read_text(path), path);
    if (!sweep.find("points") || !sweep.find("points")->is_array())
        throw io::FileError(path, "is no sweep", "it has no list of points",
                            "run the sweep again into another directory");
    const SweepPlots plots(sweep);
    std::vector<std::string> axes;
    if (const JsonValue* list = sweep.find("axes"); list && list->is_array())
        for (const JsonValue& axis : list->items())
            if (axis.is_text()) axes.push_back(axis.text());
    io::HtmlPage page(
        "Asperity report · sweep", fs::absolute(directory).lexically_normal().filename().string(),
        fmt::format("{} points over {}.", plots.points().size(), fmt::join(axes, ", ")));
    if (const JsonValue* notes = sweep.find("notes"); notes && notes->is_array())
        for (const JsonValue& note : notes->items())
            if (note.is_text()) page.paragraph("Note: " + note.text());
    page.section("plots", "Binding energy and contact");
    page.begin_columns("figures");
    if (plots.any()) {
        if (const auto plot = plots.plot("gamma", "Binding energy", "γ_{eff} / Δγ", energies, true))
            files.add(page, *plot,
                      "Binding energy over that of two flat surfaces: theory, and what was "
                      "simulated. With gaps: with the attraction between areas that do not touch.");
        if (const auto plot = plots.plot("area", "Contact area", "A / A_{0}", areas, false))
            files.add(page, *plot, "Projected contact area over the nominal area at zero load.");
    }
    page.end_columns();
    if (!plots.any())
        page.paragraph("None of the swept keys is a number: there is nothing to plot.");
    if (!plots.points().empty()) write_table(page, plots);
    if (const JsonValue* scene = sweep.find("scene"); scene && scene->is_object()) {
        page.section("scene", "The scene that the points vary");
        page.preformatted(io::toml_of(*scene));
    }
    page.section("provenance", "Provenance");
    page.table({}, provenance(sweep));
    cite(page, sweep);
    return page;
}

} // namespace asperity
