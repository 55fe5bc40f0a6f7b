// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/commands/report_plots.hpp"

#include "engine/run/curve.hpp"
#include "engine/run/theory_case.hpp"
#include "engine/setup/setup.hpp"
#include "engine/units.hpp"
#include "io/error.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <functional>

#include <fmt/format.h>

namespace asperity {

namespace {

using Style = io::PlotSeries::Style;

constexpr int width = 520,
              height_of_plots = 372; // in the page: two side by side, or one on a phone
// Places in the palette, the same in every plot.
constexpr int blue = 0, red = 1, green = 2, pink = 3, grey = 6;

io::Plot empty_plot(const std::string& id, const std::string& title, const std::string& x_label,
                    const std::string& y_label) {
    io::Plot plot;
    plot.id = id;
    plot.title = title;
    plot.x_label = x_label;
    plot.y_label = y_label;
    plot.width = page_plot_width;
    plot.height = page_plot_height;
    return plot;
}

const std::vector<double>* column(const StoredRun& run, const std::string& name) {
    const auto it = run.series.find(name);
    return it == run.series.end() || it->second.size() < 2 ? nullptr : &it->second;
}

using Value = std::function<double(std::size_t)>;

/// One curve a leg of the path: on the way in and on the way out.
void add_legs(io::Plot& plot, const StoredRun& run, const std::string& name, const Value& x,
              const Value& y, Style style, const std::vector<int>& colours) {
    const std::vector<double>& leg = *column(run, "leg");
    for (int l = 0; l < 2; ++l) {
        io::PlotSeries s;
        s.label = (l == 0 ? "approach" : "pull-off") + (name.empty() ? "" : ", " + name);
        s.style = style;
        s.colour = colours[static_cast<std::size_t>(l)];
        for (std::size_t i = 0; i < leg.size(); ++i)
            if (static_cast<int>(leg[i]) == l) {
                s.x.push_back(x(i));
                s.y.push_back(y(i));
            }
        if (s.x.size() < 2) continue;
        plot.series.push_back(std::move(s));
    }
}

/// Along the path: time, or the points of a path without time.
const std::vector<double>* along(const StoredRun& run, std::string& label) {
    const auto* time = column(run, "time");
    label = time ? "time (ps)" : "point of the path";
    return time ? time : column(run, "step");
}

} // namespace

std::optional<io::Plot> separation_plot(const StoredRun& run) {
    const auto *leg = column(run, "leg"), *height = column(run, "mean_height"),
               *force = column(run, "force"), *contact = column(run, "contact_fraction");
    if (!leg || !height || !force || !contact || !run.scene) return std::nullopt;
    std::optional<io::Plot> plot;
    try {
        plot = force_curve({*leg, {}, *height, *force, *contact}, *run.scene,
                           make_setup(*run.scene, 1).flat);
    } catch (const io::Error&) { // a scene that this version refuses
        return std::nullopt;
    }
    plot->id = "separation";
    plot->width = page_plot_width;
    plot->height = page_plot_height;
    return plot;
}

std::optional<io::Plot> loading_plot(const StoredRun& run) {
    // With the mean height held, the top plane follows: the plot above again.
    if (run.scene && run.scene->drive.hold == Hold::mean_height) return std::nullopt;
    // What the top plane feels from the block is minus what it does to it: the same sign as the
    // force of the substrate at rest.
    const auto *top = column(run, "top"), *force = column(run, "top_force");
    if (!top || !force || !column(run, "leg") || !run.scene) return std::nullopt;
    const double unit = force_unit(*run.scene);
    io::Plot plot = empty_plot("loading", "Force and displacement of the top plane",
                               "displacement of the top plane (Å)", force_label(*run.scene));
    add_legs(
        plot, run, "", [top](std::size_t i) { return (*top)[i]; },
        [=](std::size_t i) { return (*force)[i] / unit; }, Style::line, {blue, red});
    if (plot.series.empty()) return std::nullopt;
    return plot;
}

std::optional<io::Plot> energy_plot(const StoredRun& run) {
    std::string axis;
    const auto* time = along(run, axis);
    if (!time || run.edge() == 0.0) return std::nullopt;
    io::Plot plot = empty_plot("energy", "Energies", axis,
                               run.curved() ? "energy (eV)" : "energy per area (meV/Å²)");
    const double unit = run.curved() ? 1.0 : units::milli_per_unit / (run.edge() * run.edge());
    const auto add = [&](const char* name, const char* label, int colour, Style style) {
        const auto* values = column(run, name);
        if (!values) return;
        io::PlotSeries s{label, *time, *values, style, colour};
        for (double& v : s.y)
            v *= unit;
        plot.series.push_back(std::move(s));
    };
    add("interface_energy", "interface", blue, Style::line);
    add("elastic_energy", "elastic", red, Style::line);
    add("kinetic_energy", "kinetic", green, Style::line);
    add("work", "work done", grey, Style::dashed);
    add("damped", "damped", pink, Style::dotted);
    if (plot.series.empty()) return std::nullopt;
    return plot;
}

std::optional<io::Plot> balance_plot(const StoredRun& run) {
    const auto *time = column(run, "time"), *residual = column(run, "residual");
    if (!time || !residual) return std::nullopt;
    io::Plot plot =
        empty_plot("balance", "Energy balance", "time (ps)", "residual (1e-6 of the largest term)");
    io::PlotSeries s{"", *time, *residual, Style::line, blue};
    for (double& v : s.y)
        v *= 1e6;
    plot.series.push_back(std::move(s));
    return plot;
}

std::optional<io::Plot> contact_plot(const StoredRun& run) {
    const auto *top = column(run, "top"), *contact = column(run, "contact_fraction"),
               *pushed = column(run, "pushed_fraction"), *leg = column(run, "leg");
    if (!top || !contact || !pushed || !leg) return std::nullopt;
    io::Plot plot = empty_plot("contact", "Contact over the path",
                               "displacement of the top plane (Å)", "fraction of the sites");
    const auto x = [top](std::size_t i) { return (*top)[i]; };
    add_legs(plot, run, "in contact", x, [contact](std::size_t i) { return (*contact)[i]; },
             Style::line, {blue, red});
    add_legs(plot, run, "pushed", x, [pushed](std::size_t i) { return (*pushed)[i]; },
             Style::dotted, {blue, red});
    plot.y_low = 0.0;
    if (plot.series.empty()) return std::nullopt;
    return plot;
}

namespace {

/// As run.h5 holds it, since the map that it was made from need not be there any more; of a sphere,
/// whose heights hold the cap, made again.
Surface surface_of(const StoredRun& run, const Scene& scene) {
    if (scene.surface.radius || run.height.empty()) return scene_surface(scene);
    SurfaceOptions options;
    options.kind = SurfaceKind::file;
    options.sites = run.substrate_sites;
    options.length = scene.edge();
    options.rms = 0.0;
    return surface_from_heights(options, run.height, run.substrate_sites, run.substrate_sites);
}

} // namespace

std::optional<io::Plot> roughness_plot(const StoredRun& run) {
    const double flat = run.number("delta_gamma").value_or(0.0);
    const double rms = run.number("surface.rms").value_or(run.number("theory.h_rms").value_or(0.0));
    if (!(flat > 0.0) || !(rms > 0.0)) return std::nullopt;
    io::Plot plot = empty_plot("roughness", "Binding energy and roughness",
                               "rms roughness h_{rms} (Å)", "γ_{eff} / Δγ");
    plot.x_low = 0.0;
    const auto point = [&](const char* key, const char* label, int colour) {
        if (const auto gamma = run.number(key))
            plot.series.push_back({label, {rms}, {*gamma / flat}, Style::points, colour});
    };
    io::PlotSeries contact{"theory", {}, {}, Style::line, grey};
    io::PlotSeries renormalised{"renormalised theory", {}, {}, Style::dotted, grey};
    if (run.scene && run.scene->surface.kind != SurfaceKind::flat) try {
            Scene scene = *run.scene;
            std::optional<Surface> surface;
            if (theory_needs_surface(scene)) surface = surface_of(run, scene);
            scene.surface.rms_given = true; // a measured map is scaled as well
            constexpr int points = 32;
            for (int i = 1; i <= points; ++i) {
                scene.surface.rms = 1.8 * rms * i / points;
                const TheoryCase what = theory_case(scene, surface ? &*surface : nullptr, flat);
                const TheoryNumbers n = solve_theory(what);
                contact.x.push_back(scene.surface.rms);
                contact.y.push_back(n.state.gamma_ratio);
                renormalised.x.push_back(scene.surface.rms);
                renormalised.y.push_back(n.renormalised && n.renormalised->numbers
                                             ? n.renormalised->numbers->gamma_eff_ratio
                                             : std::nan(""));
            }
        } catch (const std::exception&) { // a theory that does not fit the scene: no curve
        }
    for (io::PlotSeries* s : {&contact, &renormalised})
        if (!s->x.empty()) plot.series.push_back(*s);
    if (run.curved()) {
        point("jkr.in_averaged", "approach, by JKR", blue);
        point("jkr.out", "pull-off, by JKR", red);
    } else {
        point("work_of_adhesion.approach", "approach", blue);
        point("work_of_adhesion.pull_off", "pull-off", red);
        point("binding_energy", "state at zero load", green);
    }
    if (plot.series.empty()) return std::nullopt;
    double lowest = 0.0;
    for (const io::PlotSeries& s : plot.series)
        for (const double y : s.y)
            if (y < lowest) lowest = y;
    plot.y_low = 1.1 * lowest;
    return plot;
}

std::optional<io::Plot> spectrum_plot(const StoredRun& run) {
    if (run.spectrum_q.empty()) return std::nullopt;
    io::Plot plot =
        empty_plot("spectrum", "Roughness spectrum", "wavevector q (1/Å)", "C(q) (Å^{4})");
    plot.y_label = "C(q) (Å⁴)";
    plot.x_log = plot.y_log = true;
    plot.series.push_back({"realised", run.spectrum_q, run.spectrum, Style::line, blue});
    const bool asked = std::any_of(run.spectrum_target.begin(), run.spectrum_target.end(),
                                   [](double c) { return c > 0.0; });
    if (asked)
        plot.series.push_back({"target", run.spectrum_q, run.spectrum_target, Style::dashed, red});
    for (std::size_t i = 0; i < run.spectrum.size(); ++i)
        if (run.spectrum[i] > 0.0) return plot;
    return std::nullopt; // flat
}

namespace {

/// Density over the bins between edges, as steps. Empty bins are renormalised in the line.
io::PlotSeries steps(const std::vector<double>& edges, const std::vector<double>& density) {
    io::PlotSeries s{"", {}, {}, Style::line, blue};
    for (std::size_t i = 0; i < density.size(); ++i)
        for (const std::size_t edge : {i, i + 1}) {
            s.x.push_back(edges[edge]);
            s.y.push_back(density[i]);
        }
    return s;
}

} // namespace

std::optional<io::Plot> gap_plot(const StoredState& state) {
    if (state.gap_edges.size() != state.gap_density.size() + 1) return std::nullopt;
    io::Plot plot = empty_plot("gaps-" + file_name(state.name), "Distribution of gaps", "gap u (Å)",
                               "P(u) (1/Å)");
    plot.series.push_back(steps(state.gap_edges, state.gap_density));
    plot.y_log = true;
    return plot;
}

std::optional<io::Plot> pressure_plot(const StoredState& state) {
    if (!state.has("pressure")) return std::nullopt;
    // A site out of reach feels exactly nothing, and a peak at zero would say no more than that.
    std::vector<double> felt;
    for (const double p : state.maps.at("pressure"))
        if (std::isfinite(p) && p != 0.0) felt.push_back(p);
    if (felt.size() < 100) return std::nullopt;
    const auto [least, greatest] = std::minmax_element(felt.begin(), felt.end());
    constexpr std::size_t bins = 80;
    const double low = *least, bin = (*greatest - low) / bins;
    if (!(bin > 0.0)) return std::nullopt;
    std::vector<double> edges, density(bins);
    for (std::size_t i = 0; i <= bins; ++i)
        edges.push_back(low + static_cast<double>(i) * bin);
    const double share = 1.0 / (bin * static_cast<double>(state.maps.at("pressure").size()));
    for (const double p : felt)
        density[std::min(bins - 1, static_cast<std::size_t>((p - low) / bin))] += share;
    io::Plot plot = empty_plot("pressures-" + file_name(state.name), "Distribution of pressure",
                               "pressure p (GPa), positive pushes", "P(p) (1/GPa)");
    plot.series.push_back(steps(edges, density));
    plot.y_log = true;
    return plot;
}

std::string file_name(const std::string& state) {
    std::string name = state;
    for (char& c : name)
        if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-' && c != '.') c = '-';
    return name;
}

std::optional<io::MapPlot> height_map(const StoredRun& run) {
    if (run.height.empty() || run.edge() == 0.0) return std::nullopt;
    io::MapPlot map;
    map.id = "height";
    map.title = "Height of the substrate";
    map.unit = "Å";
    map.sites = run.substrate_sites;
    map.values = run.height;
    map.edge = run.edge();
    return map;
}

std::vector<io::MapPlot> state_maps(const StoredRun& run, const StoredState& state) {
    std::vector<io::MapPlot> list;
    const auto add = [&](const char* name, const char* title, const char* unit,
                         io::MapPlot::Colours colours) {
        if (!state.has(name)) return;
        io::MapPlot map;
        map.id = fmt::format("{}-{}", name, file_name(state.name));
        map.title = title;
        map.unit = unit;
        map.sites = state.sites;
        map.values = state.maps.at(name);
        map.edge = run.edge();
        map.colours = colours;
        map.low_word = "apart";
        map.high_word = "in contact";
        // Around a sphere the gap grows without an end; beyond the cutoff it matters to nobody.
        if (run.curved() && map.id.starts_with("gap")) map.high = run.scene->interface.cutoff;
        list.push_back(std::move(map));
    };
    add("gap", "Gap", "Å", io::MapPlot::Colours::rising);
    add("pressure", "Pressure, positive pushes", "GPa", io::MapPlot::Colours::diverging);
    add("contact", "Contact", "", io::MapPlot::Colours::two);
    return list;
}

} // namespace asperity
