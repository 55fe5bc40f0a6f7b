// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/run/curve.hpp"

#include "engine/units.hpp"
#include "io/hdf5_file.hpp"
#include "theory/half_space.hpp"
#include "theory/periodic_sphere.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <numbers>
#include <utility>

namespace asperity {

namespace {

using Style = io::PlotSeries::Style;

theory::PeriodicSphere smooth_sphere(const Scene& scene, const FlatReference& flat) {
    return {{*scene.surface.radius,
             theory::contact_modulus(scene.block.young * units::gigapascal, scene.block.poisson),
             flat.work_of_adhesion / units::milli_per_unit},
            scene.edge(),
            flat.separation};
}

double largest_tension(const FlatReference& flat) {
    return flat.largest_tension * units::gigapascal;
}

/// A curve by a parameter, up to a contact radius and as long as the theory has one.
template <class State>
io::PlotSeries curve(const std::string& label, Style style, int colour, double widest,
                     const std::vector<double>& parameters, const State& state) {
    io::PlotSeries series{.label = label, .x = {}, .y = {}, .style = style, .colour = colour};
    for (const double p : parameters)
        try {
            const theory::PeriodicState s = state(p);
            if (s.contact.radius > widest) continue;
            series.x.push_back(s.height);
            series.y.push_back(s.contact.force / units::nanonewton);
        } catch (const std::exception&) { // beyond what first-order images can say
        }
    return series;
}

std::vector<double> spaced(double from, double to, int count) {
    std::vector<double> list;
    for (int i = 0; i < count; ++i)
        list.push_back(from + (to - from) * i / (count - 1));
    return list;
}

void add_sphere_curves(io::Plot& plot, const Scene& scene, const FlatReference& flat,
                       double strongest) {
    const theory::PeriodicSphere sphere = smooth_sphere(scene, flat);
    theory::PeriodicSphere alone = sphere;
    alone.period *= 1e6;
    // As far into the contact as the run went.
    double widest = 0.0;
    for (const double a : spaced(0.0, 0.5 * sphere.period, 2000))
        if (theory::jkr::at_radius(sphere.sphere, a).force < 1.1 * std::max(0.0, strongest) + 1e-9)
            widest = a;
    const std::vector<double> radii = spaced(1e-3 * widest, widest, 300);
    std::vector<double> ratios;
    for (const double x : spaced(-9.0, 5.0, 400))
        ratios.push_back(1.0 + std::exp(x));
    const std::string whose = scene.surface.rms > 0.0 ? "smooth sphere, " : "";
    plot.series.push_back(curve(whose + "JKR", Style::dotted, 6, widest, radii,
                                [&](double a) { return theory::jkr_at_radius(alone, a); }));
    plot.series.push_back(curve(whose + "JKR with images", Style::dashed, 4, widest, radii,
                                [&](double a) { return theory::jkr_at_radius(sphere, a); }));
    plot.series.push_back(
        curve(whose + "Maugis-Dugdale with images", Style::line, 4, widest, ratios,
              [&](double m) { return theory::maugis_at_ratio(sphere, largest_tension(flat), m); }));
}

/// The largest attraction of a running mean over 2 ps, eV/Å; nothing if rows are too rare for one.
std::optional<double> attraction_averaged(const PathSeries& path, std::size_t from,
                                          std::size_t to) {
    constexpr double window = 2.0; // ps
    if (path.time.empty() || to - from < 2) return std::nullopt;
    const double spacing = path.time[from + 1] - path.time[from];
    const auto rows = static_cast<std::size_t>(std::lround(window / spacing));
    if (rows < 4 || to - from < rows) return std::nullopt;
    double sum = 0.0, strongest = 0.0;
    for (std::size_t i = from; i < to; ++i) {
        sum += path.force[i];
        if (i >= from + rows) sum -= path.force[i - rows];
        if (i + 1 >= from + rows) strongest = std::max(strongest, -sum / static_cast<double>(rows));
    }
    return strongest;
}

} // namespace

double force_unit(const Scene& scene) {
    return scene.surface.radius ? units::nanonewton
                                : scene.edge() * scene.edge() * units::gigapascal;
}

std::string force_label(const Scene& scene) {
    return scene.surface.radius ? "force F (nN)" : "mean stress F/A_{0} (GPa)";
}

PathSeries read_path(const std::string& file) {
    const io::Hdf5File run(file, io::Hdf5File::Mode::read);
    const auto column = [&](const char* name) {
        return run.read<double>(std::string("/series/") + name);
    };
    return {.leg = column("leg"),
            .time = run.exists("/series/time") ? column("time") : std::vector<double>{},
            .height = column("mean_height"),
            .force = column("force"),
            .contact_fraction = column("contact_fraction")};
}

void add_path(const PathSeries& path, const Scene& scene, io::ResultRecord& record) {
    const std::size_t rows = path.leg.size();
    const std::size_t turn = static_cast<std::size_t>(
        std::find(path.leg.begin(), path.leg.end(), 1.0) - path.leg.begin());
    if (turn == 0 || turn >= rows) return; // no cycle
    const auto& work = record.work_of_adhesion;
    if (!work.approach || !work.pull_off) return; // not to its end
    const double area = scene.edge() * scene.edge() / units::milli_per_unit;
    record.extra.emplace_back("hysteresis.loop", (*work.pull_off - *work.approach) * area);
    if (const auto state = record.binding_energy) {
        record.extra.emplace_back("hysteresis.approach", (*state - *work.approach) * area);
        record.extra.emplace_back("hysteresis.pull_off", (*work.pull_off - *state) * area);
    }
    if (!scene.surface.radius) return;
    const auto strongest =
        std::min_element(path.force.begin() + static_cast<std::ptrdiff_t>(turn), path.force.end());
    const double fraction =
        path.contact_fraction[static_cast<std::size_t>(strongest - path.force.begin())];
    record.extra.emplace_back("contact_radius.pull_off",
                              scene.edge() * std::sqrt(fraction / std::numbers::pi));
    const auto averaged = [&](std::size_t from, std::size_t to, const char* name) {
        if (const auto force = attraction_averaged(path, from, to))
            record.extra.emplace_back(
                name, units::milli_per_unit *
                          theory::jkr::work_from_pull_off(*force, *scene.surface.radius));
    };
    averaged(0, turn, "jkr.in_averaged");
    averaged(turn, rows, "jkr.out_averaged");
}

void add_sphere(const Scene& scene, const FlatReference& flat, io::ResultRecord& record) {
    if (!scene.surface.radius) return;
    if (record.contact_fraction)
        record.extra.emplace_back("contact_radius.zero_load",
                                  scene.edge() *
                                      std::sqrt(*record.contact_fraction / std::numbers::pi));
    const auto as_work = [&](double force) {
        return units::milli_per_unit *
               theory::jkr::work_from_pull_off(force, *scene.surface.radius);
    };
    try {
        const theory::PeriodicSphere sphere = smooth_sphere(scene, flat);
        const double stress = largest_tension(flat);
        record.extra.emplace_back("sphere.jkr",
                                  as_work(theory::jkr::pull_off(sphere.sphere).force));
        record.extra.emplace_back("sphere.maugis_parameter",
                                  theory::maugis_parameter(sphere.sphere, stress));
        record.extra.emplace_back("sphere.jkr_images",
                                  as_work(theory::jkr_pull_off(sphere).contact.force));
        record.extra.emplace_back("sphere.maugis_images",
                                  as_work(theory::maugis_pull_off(sphere, stress).contact.force));
    } catch (const std::exception& error) { // a contact as wide as the box
        record.extra.emplace_back("sphere.note", std::string(error.what()));
    }
}

std::optional<io::Plot> force_curve(const PathSeries& path, const Scene& scene,
                                    const FlatReference& flat) {
    if (path.leg.size() < 2) return std::nullopt;
    const bool curved = scene.surface.radius.has_value();
    io::Plot plot;
    plot.title = "Force and separation";
    plot.x_label = curved ? "mean height above the apex (Å)" : "mean separation (Å)";
    plot.y_label = force_label(scene);
    const double unit = force_unit(scene);
    double low = 1e300, high = -1e300;
    io::PlotSeries in{.label = "approach", .x = {}, .y = {}, .colour = 0},
        out{.label = "pull-off", .x = {}, .y = {}, .colour = 1};
    const auto [least, greatest] = std::minmax_element(path.force.begin(), path.force.end());
    for (std::size_t i = 0; i < path.leg.size(); ++i) {
        io::PlotSeries& series = path.leg[i] == 0.0 ? in : out;
        series.x.push_back(path.height[i]);
        series.y.push_back(path.force[i] / unit);
        if (std::abs(path.force[i]) <= -1e-3 * *least) continue; // out of reach: not worth room
        low = std::min(low, path.height[i]);
        high = std::max(high, path.height[i]);
    }
    if (curved) add_sphere_curves(plot, scene, flat, *greatest);
    for (io::PlotSeries* series : {&in, &out})
        if (!series->x.empty()) plot.series.push_back(std::move(*series));
    if (curved) { // the run has the say, not curves beside it that go much deeper
        const double room = 0.08 * (*greatest - *least);
        double deepest = *least / unit;
        for (const io::PlotSeries& s : plot.series)
            for (const double y : s.y)
                if (y > 1.5 * *least / unit) deepest = std::min(deepest, y);
        plot.y_low = deepest - room / unit;
        plot.y_high = (*greatest + room) / unit;
    }
    if (high > low) {
        const double room = 0.04 * (high - low);
        plot.x_low = low - room;
        plot.x_high = high + room;
    }
    return plot;
}

void write_curve(const std::string& directory, const PathSeries& path, const Scene& scene,
                 const FlatReference& flat) {
    std::optional<io::Plot> plot = force_curve(path, scene, flat);
    if (!plot) return;
    plot->title = scene.title();
    io::write_plot(directory + "/curve.svg", *plot);
}

} // namespace asperity
