// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/commands/sweep_plots.hpp"

#include "engine/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

namespace asperity {

namespace {

using Style = io::PlotSeries::Style;
constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t most_curves = 7; // as many as there are colours
constexpr int grey = 6;

/// "surface.rms" and "Å" as an axis' label.
std::string axis_label(const std::string& key) {
    Scene defaults;
    const std::string unit = bind(defaults).find(key)->unit;
    const std::string name = key == "surface.rms"  ? "rms roughness h_{rms}"
                             : key == "drive.load" ? "load"
                                                   : key;
    if (unit.empty()) return name;
    return fmt::format("{} ({})", name, unit == "meV/Å^2" ? "meV/Å²" : unit);
}

/// Groups that differ in the plotted axis only, in the order of x; label: the other axes' values.
struct Curve {
    std::string label;
    std::vector<double> x;
    std::vector<SweepGroup> groups;
};

std::vector<Curve> curves_of(const std::vector<SweepAxis>& axes,
                             const std::vector<SweepPoint>& points, std::size_t plotted) {
    Scene defaults;
    const io::Schema schema = bind(defaults);
    std::size_t x_place = 0; // of the plotted axis among those that are no seeds
    for (std::size_t i = 0; i < plotted; ++i)
        x_place += axes[i].is_seed() ? 0 : 1;
    std::vector<Curve> curves;
    for (SweepGroup& g : sweep_groups(axes, points)) {
        std::string label;
        std::size_t place = 0;
        for (const SweepAxis& axis : axes) {
            if (axis.is_seed()) continue;
            const io::JsonValue& value = g.values[place++];
            if (place - 1 == x_place) continue;
            const std::string unit = schema.find(axis.key)->unit;
            label += fmt::format("{}{} = {}", label.empty() ? "" : ", ",
                                 axis.key.substr(axis.key.find('.') + 1), shown(value));
            if (!unit.empty() && value.is_number()) label += " " + unit;
        }
        auto at = std::find_if(curves.begin(), curves.end(),
                               [&](const Curve& c) { return c.label == label; });
        if (at == curves.end()) at = curves.insert(curves.end(), Curve{label, {}, {}});
        at->groups.push_back(std::move(g));
    }
    for (Curve& c : curves) {
        const auto x = [=](const SweepGroup& g) { return g.values[x_place].number(); };
        std::stable_sort(c.groups.begin(), c.groups.end(),
                         [&](const auto& a, const auto& b) { return x(a) < x(b); });
        for (const SweepGroup& g : c.groups)
            c.x.push_back(x(g));
    }
    return curves;
}

struct Trace {
    std::string label;
    Style style = Style::line;
    int colour = 0; ///< the same in every plot
    std::function<double(const SweepPoint&)> value;
};

bool is_points(Style style) { return style == Style::points || style == Style::rings; }

/// Adds the traces of these curves. Several curves: colours tell them apart, dashes and markers the
/// quantities.
void add_traces(io::Plot& plot, const std::vector<Curve>& curves, const std::vector<Trace>& traces,
                const std::string& prefix, bool name_curves) {
    const bool several = curves.size() > 1;
    for (const Trace& trace : traces) {
        bool any = false;
        for (std::size_t i = 0; i < std::min(curves.size(), most_curves); ++i) {
            io::PlotSeries s;
            const bool first = name_curves && &trace == &traces.front();
            s.label = several ? (first ? curves[i].label : "") : prefix + trace.label;
            s.style = trace.style;
            s.colour = several ? static_cast<int>(i) : trace.colour;
            s.x = curves[i].x;
            for (const SweepGroup& g : curves[i].groups) {
                const Spread spread = spread_of(g, trace.value);
                s.y.push_back(spread.mean);
                if (is_points(s.style)) s.spread.push_back(spread.deviation);
                any = any || spread.count > 0;
            }
            if (!any) continue; // no point has this quantity
            plot.series.push_back(std::move(s));
        }
        if (several && any && !(name_curves && &trace == &traces.front()))
            plot.series.push_back({prefix + trace.label, {}, {}, trace.style, grey});
    }
}

double over(double gamma, double flat) { return gamma / flat; }

/// What the simulations say of γ/Δγ.
std::vector<Trace> simulated_gamma() {
    const auto share = [](const char* path) {
        return [path](const SweepPoint& p) {
            return over(result_number(p, path), result_number(p, "delta_gamma"));
        };
    };
    const auto flat = [=](const char* path) { // of a curved substrate JKR tells, not the area
        return [=](const SweepPoint& p) {
            return std::isfinite(result_number(p, "contact_radius.zero_load")) ? nothing
                                                                               : share(path)(p);
        };
    };
    return {{"approach", Style::points, 0, flat("work_of_adhesion.approach")},
            {"pull-off", Style::rings, 1, flat("work_of_adhesion.pull_off")},
            {"state at zero load", Style::points, 2, flat("binding_energy")},
            {"curved, in", Style::points, 5, share("jkr.in")},
            {"curved, out", Style::rings, 4, share("jkr.out")}};
}

/// Those that some point has a number for, each in a colour that no earlier table has taken.
std::vector<Trace> with_own_colours(std::vector<Trace> traces, const SweepTable& table,
                                    std::vector<int>& used) {
    std::erase_if(traces, [&](const Trace& trace) {
        return std::none_of(table.points.begin(), table.points.end(),
                            [&](const SweepPoint& p) { return std::isfinite(trace.value(p)); });
    });
    const auto taken = [&](int colour) {
        return std::find(used.begin(), used.end(), colour) != used.end();
    };
    for (Trace& trace : traces) {
        for (int tries = 0; taken(trace.colour) && tries < static_cast<int>(most_curves); ++tries)
            trace.colour = (trace.colour + 1) % static_cast<int>(most_curves);
        used.push_back(trace.colour);
    }
    return traces;
}

} // namespace

std::optional<std::size_t> plotted_axis(const std::vector<SweepAxis>& axes,
                                        const std::vector<SweepPoint>& points) {
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < axes.size(); ++i) {
        const bool numbers = std::all_of(points.begin(), points.end(), [i](const SweepPoint& p) {
            return p.values[i].is_number();
        });
        if (numbers && !axes[i].is_seed() &&
            (!best || axes[i].values.size() > axes[*best].values.size()))
            best = i;
    }
    return best;
}

std::vector<io::Plot> sweep_plots(const std::vector<SweepTable>& tables, std::string& note) {
    struct Part {
        const SweepTable* table;
        std::vector<Curve> theory, simulated;
    };
    std::vector<Part> parts;
    std::string key;
    for (const SweepTable& table : tables) {
        const auto axis = plotted_axis(table.axes, table.points);
        if (!axis || (!key.empty() && table.axes[*axis].key != key)) {
            note = !axis ? "no plots: none of the swept keys is a number"
                         : table.name + " is not in the plots: it sweeps another key";
            continue;
        }
        key = table.axes[*axis].key;
        // A sweep without curves of its own: the theory of its points.
        const auto& lines = table.theory.empty() ? table.points : table.theory;
        parts.push_back({&table, curves_of(table.axes, lines, *axis), {}});
        if (table.simulated) parts.back().simulated = curves_of(table.axes, table.points, *axis);
        if (parts.back().theory.size() > most_curves)
            note = fmt::format("the plots show the first {} of {} curves", most_curves,
                               parts.back().theory.size());
    }
    if (parts.empty()) return {};

    const bool simulated = parts.front().table->simulated;
    const int plain = simulated ? grey : 0;
    const Trace theory{"theory", Style::line, plain,
                       [](const SweepPoint& p) { return p.numbers.state.gamma_ratio; }};
    const Trace full{"assuming full contact", Style::dashed, 2, [](const SweepPoint& p) {
                         return over(p.numbers.gamma_full_contact, p.what.delta_gamma);
                     }};
    const auto other = [](const char* label, double RenormalisedNumbers::*value) {
        return Trace{label, Style::dotted, 1, [value](const SweepPoint& p) {
                         return p.numbers.renormalised && p.numbers.renormalised->numbers
                                    ? *p.numbers.renormalised->numbers.*value
                                    : nothing;
                     }};
    };
    const Trace renormalised = other("renormalised theory", &RenormalisedNumbers::gamma_eff_ratio);
    const Trace renormalised_area =
        other("renormalised theory", &RenormalisedNumbers::contact_fraction);
    const Trace area{"theory", Style::line, plain,
                     [](const SweepPoint& p) { return p.numbers.state.area; }};
    const auto found = [](const char* label, Style style, int colour, const char* path,
                          double unit = 1.0) {
        return Trace{label, style, colour,
                     [=](const SweepPoint& p) { return result_number(p, path) / unit; }};
    };
    // Of a sphere the radius tells, not the share of the box.
    const Trace flat_area{"state at zero load", Style::points, 2, [](const SweepPoint& p) {
                              return std::isfinite(result_number(p, "contact_radius.zero_load"))
                                         ? nothing
                                         : result_number(p, "contact_fraction");
                          }};

    std::vector<io::Plot> plots;
    const auto add = [&](const char* id, const std::string& title, const std::string& y_label,
                         const std::vector<Trace>& lines, const std::vector<Trace>& points) {
        io::Plot plot;
        std::vector<int> used;
        for (const Trace& trace : lines)
            used.push_back(trace.colour);
        bool drawn = !simulated;
        for (const Part& part : parts) {
            if (&part == &parts.front()) add_traces(plot, part.theory, lines, "", true);
            const std::size_t before = plot.series.size();
            add_traces(plot, part.simulated, with_own_colours(points, *part.table, used),
                       parts.size() > 1 ? part.table->name + ": " : "", lines.empty());
            drawn = drawn || plot.series.size() > before;
        }
        if (!drawn) return;
        plot.id = id;
        plot.title = title;
        plot.x_label = axis_label(key);
        plot.y_label = y_label;
        if (plot.series.size() == 1) plot.series.front().label.clear();
        double lowest = 0.0; // of the theory itself: full contact may go far below zero
        double highest = lines.empty() ? 0.0 : 1.0;
        for (const io::PlotSeries& s : plot.series)
            for (const double y : s.y) {
                if (s.style != Style::dashed && std::isfinite(y)) lowest = std::min(lowest, y);
                if (std::isfinite(y)) highest = std::max(highest, y);
            }
        if (key == "surface.rms") plot.x_low = 0.0;
        plot.y_low = lowest == 0.0 ? 0.0 : 1.05 * lowest;
        if (!lines.empty() && highest <= 1.02) plot.y_high = 1.02;
        plots.push_back(std::move(plot));
    };
    const std::string binding = "γ_{eff} / Δγ", contact = "A / A_{0}";
    if (!simulated) {
        add("gamma", "Binding energy, theory", binding, {theory, renormalised, full}, {});
        add("area", "Contact area, theory", contact, {area, renormalised_area}, {});
        add("full-contact", "Binding energy, theory and full contact", binding, {theory, full}, {});
        return plots;
    }
    add("gamma", "Binding energy", binding, {theory, renormalised}, simulated_gamma());
    add("area", "Contact area", contact, {area}, {flat_area});
    add("radius", "Contact radius", "√(contact area / π) (Å)", {},
        {found("at zero load", Style::points, 2, "contact_radius.zero_load"),
         found("at the pull-off force", Style::rings, 1, "contact_radius.pull_off")});
    add("pull-off", "Pull-off force", "largest attraction on the way out (nN)", {},
        {found("pull-off", Style::rings, 1, "pull_off_force", units::nanonewton)});
    add("hysteresis", "Energy lost in the cycle", "∮ F dz (eV)", {},
        {found("hysteresis loop", Style::points, 3, "hysteresis.loop")});
    return plots;
}

} // namespace asperity
