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

/// Mean height and force of a smooth sphere, Å and eV/Å.
struct SphereCurve {
    const char *name, *label;
    std::vector<double> height = {}, force = {};
};

/// Fills a curve by a parameter, up to a contact radius and as long as the theory has one.
template <class State>
void follow(SphereCurve& curve, double widest, const std::vector<double>& parameters,
            const State& state) {
    for (const double p : parameters)
        try {
            const theory::PeriodicState s = state(p);
            if (s.contact.radius > widest) continue;
            curve.height.push_back(s.height);
            curve.force.push_back(s.contact.force);
        } catch (const std::exception&) { // beyond what first-order images can say
        }
}

std::vector<double> spaced(double from, double to, int count) {
    std::vector<double> list;
    for (int i = 0; i < count; ++i)
        list.push_back(from + (to - from) * i / (count - 1));
    return list;
}

/// strongest: the largest force that presses the solids together along the path, eV/Å.
std::vector<SphereCurve> sphere_curves(const Scene& scene, const FlatReference& flat,
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
    std::vector<SphereCurve> curves = {
        {"jkr", "smooth sphere, JKR"},
        {"jkr_images", "smooth sphere, JKR with images"},
        {"maugis_images", "smooth sphere, Maugis-Dugdale with images"}};
    follow(curves[0], widest, radii, [&](double a) { return theory::jkr_at_radius(alone, a); });
    follow(curves[1], widest, radii, [&](double a) { return theory::jkr_at_radius(sphere, a); });
    follow(curves[2], widest, ratios,
           [&](double m) { return theory::maugis_at_ratio(sphere, largest_tension(flat), m); });
    return curves;
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

void write_sphere_curves(io::Hdf5File& file, const Scene& scene, const FlatReference& flat) {
    if (!scene.surface.radius) return;
    const std::vector<double> force = file.read<double>("/series/force");
    if (force.size() < 2) return;
    const double strongest = *std::max_element(force.begin(), force.end());
    for (const SphereCurve& curve : sphere_curves(scene, flat, strongest)) {
        if (curve.height.empty()) continue;
        const std::string group = std::string("/curves/") + curve.name;
        file.write<double>(group + "/height", {curve.height.size()}, curve.height);
        file.write_attribute(group + "/height", "unit", "Å");
        file.write<double>(group + "/force", {curve.force.size()}, curve.force);
        file.write_attribute(group + "/force", "unit", "eV/Å");
        file.write_attribute(group, "label", curve.label);
    }
}

} // namespace asperity
