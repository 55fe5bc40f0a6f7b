// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The page of a sweep: its plots and its table as `asperity sweep` makes them, from sweep.json; and
// what the points' own directories have, one point for all seeds: maps, curves, and pages to go to.
#include "engine/commands/report.hpp"
#include "engine/commands/report_plots.hpp"
#include "engine/commands/stored_sweep.hpp"
#include "engine/commands/sweep_output.hpp"
#include "engine/commands/sweep_plots.hpp"
#include "io/error.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace asperity {

namespace {

namespace fs = std::filesystem;
using Style = io::PlotSeries::Style;

constexpr std::size_t most_points = 24; ///< that are shown one by one
constexpr std::size_t most_curves = 7;  ///< as many as there are colours
constexpr int grey = 6;

/// The point that stands for all seeds: the first one with a result; nullptr if there is none.
const SweepPoint* shown_point(const SweepGroup& group) {
    for (const SweepPoint* p : group.points)
        if (p->outcome.state == PointState::finished && !p->name.empty()) return p;
    return nullptr;
}

/// Its page, made if there is none that is newer than its result.
void keep_page(const StoredRun& run) {
    std::error_code none;
    const auto page = fs::last_write_time(run.path("report.html"), none);
    if (none || page < fs::last_write_time(run.path("result.json"))) write_run_page(run);
}

/// What one sweep adds to the page beside the plots: points that are shown one by one.
struct Points {
    std::vector<io::HtmlPage::Thumbnail> maps;
    std::vector<io::Plot> curves;
    std::vector<std::string> names; ///< of the curves
    std::vector<std::string> links; ///< a page a row of the table
    std::string origin;             ///< of a measured surface: whose it is
};

Points look_at_points(const StoredSweep& sweep, const std::string& directory) {
    Points found;
    const auto groups = sweep_groups(sweep.table.axes, sweep.table.points);
    for (const SweepGroup& group : groups) {
        found.links.emplace_back();
        const SweepPoint* point = shown_point(group);
        if (!point || found.links.size() > most_points) continue;
        const fs::path place = fs::path(sweep.directory) / point->name;
        std::error_code error;
        if (!fs::exists(place / "result.json", error)) continue; // the table was sent alone
        const StoredRun run = read_run(place.string());
        keep_page(run);
        if (found.origin.empty()) found.origin = run.text("surface.origin");
        const std::string link = fs::relative(place / "report.html", directory).generic_string();
        found.links.back() = link;
        for (const StoredState& state : run.states)
            if (state.name == "zero-load")
                for (const io::MapPlot& map : state_maps(run, state))
                    if (map.colours == io::MapPlot::Colours::two)
                        found.maps.push_back({io::map_png(map), point->name, link});
        if (auto curve = separation_plot(run)) {
            found.curves.push_back(std::move(*curve));
            found.names.push_back(point->name);
        }
    }
    return found;
}

/// The force curves of several points in one plot, spread evenly over them.
std::optional<io::Plot> all_curves(const Points& points) {
    const std::size_t n = points.curves.size(), shown = std::min(n, most_curves);
    if (n < 2) return std::nullopt;
    io::Plot all = points.curves.front();
    all.id = "curves";
    all.series.clear();
    for (std::size_t k = 0; k < shown; ++k) {
        const std::size_t i = k * (n - 1) / (shown - 1);
        const io::Plot& one = points.curves[i];
        for (io::PlotSeries s : one.series) {
            const bool out = s.label == "pull-off";
            if (!out && s.label != "approach") continue; // what a smooth sphere does
            s.style = out ? Style::line : Style::dotted;
            s.label = out ? points.names[i] : "";
            s.colour = static_cast<int>(k) % grey;
            all.series.push_back(std::move(s));
        }
        const auto widen = [](std::optional<double>& limit, const std::optional<double>& other,
                              bool up) {
            if (limit && other) limit = up ? std::max(*limit, *other) : std::min(*limit, *other);
        };
        widen(all.x_low, one.x_low, false);
        widen(all.x_high, one.x_high, true);
        widen(all.y_low, one.y_low, false);
        widen(all.y_high, one.y_high, true);
    }
    all.series.push_back({"pull-off", {}, {}, Style::line, grey});
    all.series.push_back({"approach", {}, {}, Style::dotted, grey});
    return all;
}

const char* caption_of(const std::string& plot) {
    if (plot == "gamma")
        return "Binding energy over that of two flat surfaces: theory, and what was simulated. Of "
               "a sphere, γ by JKR from the largest attraction. Bars: standard deviation over the "
               "seeds.";
    if (plot == "area") return "Projected contact area over the nominal area at zero load.";
    if (plot == "radius") return "Radius of a circle as large as the area in contact.";
    if (plot == "pull-off") return "What it takes to pull the block off.";
    if (plot == "hysteresis")
        return "The area of the loop of force against separation: what a cycle of approach and "
               "pull-off turns into heat.";
    return "The full theory, and what it would be if contact were full.";
}

/// Where a quantity has fallen to half, between the points of the plotted axis; seeds averaged.
template <class Value>
std::optional<double> half_way(const SweepTable& table, const std::vector<SweepPoint>& points,
                               const Value& value) {
    std::vector<std::pair<double, double>> curve;
    for (const SweepGroup& group : sweep_groups(table.axes, points))
        if (const Spread s = spread_of(group, value); s.count > 0)
            curve.emplace_back(group.values.front().number(), s.mean);
    std::sort(curve.begin(), curve.end());
    for (std::size_t i = 1; i < curve.size(); ++i) {
        const auto& [x0, y0] = curve[i - 1];
        const auto& [x1, y1] = curve[i];
        if (y0 >= 0.5 && y1 < 0.5) return x0 + (x1 - x0) * (y0 - 0.5) / (y0 - y1);
    }
    return std::nullopt;
}

/// What a sweep over roughness alone comes to.
std::vector<io::KeyNumber> key_numbers(const SweepTable& table) {
    const auto seeds = std::count_if(table.axes.begin(), table.axes.end(),
                                     [](const SweepAxis& axis) { return axis.is_seed(); });
    const auto axis = plotted_axis(table.axes, table.points);
    if (!axis || table.axes[*axis].key != "surface.rms" ||
        static_cast<long>(table.axes.size()) - seeds != 1)
        return {};
    std::vector<io::KeyNumber> list;
    const auto add = [&](const char* name, const auto& simulated, const auto& theory) {
        const auto& curve = table.theory.empty() ? table.points : table.theory;
        const auto found = half_way(table, table.points, simulated),
                   expected = half_way(table, curve, theory);
        if (found)
            list.push_back({fmt::format("{:.2f}", *found), "Å", name,
                            expected ? fmt::format("theory: {:.2f} Å", *expected) : ""});
        else if (expected)
            list.push_back({fmt::format("{:.2f}", *expected), "Å", name, "theory"});
    };
    const auto share = [](const char* path) {
        return [path](const SweepPoint& p) {
            return result_number(p, path) / result_number(p, "delta_gamma");
        };
    };
    const auto gamma = [](const SweepPoint& p) { return p.numbers.state.gamma_ratio; };
    const auto is_curved = [](const SweepPoint& p) {
        return std::isfinite(result_number(p, "contact_radius.zero_load"));
    };
    if (std::any_of(table.points.begin(), table.points.end(), is_curved)) {
        add("rms where γ by JKR, way out, is half of Δγ", share("jkr.out"), gamma);
        return list;
    }
    add("rms where the binding energy is half of Δγ", share("binding_energy"), gamma);
    add(
        "rms where half of the area is in contact",
        [](const SweepPoint& p) { return result_number(p, "contact_fraction"); },
        [](const SweepPoint& p) { return p.numbers.state.area; });
    return list;
}

std::string lead(const std::vector<StoredSweep>& sweeps) {
    std::vector<std::string> parts;
    for (const StoredSweep& sweep : sweeps) {
        std::vector<std::string> axes;
        for (const SweepAxis& axis : sweep.table.axes)
            axes.push_back(
                fmt::format("{} ({} to {})", axis.key, axis.values.front(), axis.values.back()));
        parts.push_back(fmt::format("{}{} points over {}.",
                                    sweeps.size() > 1 ? sweep.table.name + ": " : "",
                                    sweep.table.points.size(), fmt::join(axes, ", ")));
    }
    return fmt::format("{}", fmt::join(parts, " "));
}

void write_table(io::HtmlPage& page, const StoredSweep& sweep, const Points& points, bool several) {
    const SweepText text = sweep_text(sweep.table);
    // A hundred lines tell no more than forty; the CSV files have them all.
    const std::size_t n = text.rows.size(), stride = std::max<std::size_t>(1, (n + 39) / 40);
    std::vector<std::vector<std::string>> rows;
    std::vector<std::string> links;
    for (std::size_t i = 0; i < n; i += stride) {
        rows.push_back(text.rows[i]);
        links.push_back(points.links[i]);
        for (std::string& cell : rows.back())
            cell = minus(cell);
    }
    const std::string& name = sweep.table.name;
    page.section("points-" + file_name(name), several ? "The points of " + name : "All points");
    page.table(text.heads, rows, links);
    if (!text.meaning.empty()) page.paragraph("In the table: " + text.meaning + ".");
    if (stride > 1)
        page.paragraph(fmt::format("Every {}th of {} lines; all are in sweep.csv.", stride, n));
    if (!points.maps.empty()) page.thumbnails(points.maps);
    if (!points.origin.empty()) page.paragraph("Measured surface: " + points.origin + ".");
}

} // namespace

bool holds_sweep(const std::string& directory) {
    std::error_code error;
    const auto there = [&](const fs::path& at) { return fs::exists(at / "sweep.json", error); };
    if (there(directory)) return true;
    if (fs::exists(fs::path(directory) / "result.json", error)) return false;
    for (const auto& entry : fs::directory_iterator(directory, error))
        if (there(entry.path())) return true;
    return false;
}

std::string write_sweep_page(const std::string& directory) {
    const std::vector<StoredSweep> sweeps = read_sweeps(directory);
    ReportFiles files(directory);
    std::vector<SweepTable> tables;
    std::vector<std::string> names;
    for (const StoredSweep& sweep : sweeps) {
        tables.push_back(sweep.table);
        names.push_back(sweep.table.name);
    }
    io::HtmlPage page("Asperity report · sweep", fmt::format("{}", fmt::join(names, ", ")),
                      lead(sweeps));
    std::vector<Points> points;
    for (const StoredSweep& sweep : sweeps) {
        if (const auto numbers = key_numbers(sweep.table); !numbers.empty())
            page.key_numbers(numbers);
        for (const SweepPoint& point : sweep.table.points)
            if (point.outcome.state == PointState::failed)
                page.notice(point.name + " failed", point.outcome.reason);
        for (const std::string& note : sweep.table.notes)
            page.paragraph("Note: " + note + ".");
        points.push_back(look_at_points(sweep, directory));
    }
    std::string note;
    std::vector<Figure> figures;
    for (io::Plot& plot : sweep_plots(tables, note)) {
        plot.width = page_plot_width;
        plot.height = page_plot_height;
        figures.emplace_back(plot, caption_of(plot.id));
    }
    for (const Points& some : points)
        if (auto curves = all_curves(some)) {
            if (points.size() > 1) curves->id += "-" + file_name(names[&some - points.data()]);
            figures.emplace_back(curves, "Force over the mean separation at some of the points: "
                                         "pull-off drawn through, approach dotted.");
        }
    files.section(page, "plots", "Adhesion and contact", figures);
    if (!note.empty()) page.paragraph("Note: " + note + ".");
    for (std::size_t i = 0; i < sweeps.size(); ++i)
        if (!tables[i].points.empty()) write_table(page, sweeps[i], points[i], sweeps.size() > 1);
    for (const StoredSweep& sweep : sweeps)
        if (const io::JsonValue& scene = sweep.table.scene; scene.is_object()) {
            page.section("scene-" + file_name(sweep.table.name),
                         sweeps.size() > 1 ? "The scene " + sweep.table.name
                                           : "The scene that the points vary");
            page.preformatted(io::toml_of(scene));
        }
    page.section("provenance", "Provenance");
    page.table({}, provenance(sweeps.front().json));
    cite(page, sweeps.front().json);
    return write_page(directory, page, files);
}

} // namespace asperity
