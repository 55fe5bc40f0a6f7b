// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/commands/sweep_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace asperity {

namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

double ratio(const SweepPoint& p, double gamma) { return gamma / p.what.delta_gamma; }

double renormalised(const SweepPoint& p, double RenormalisedNumbers::*value) {
    return p.numbers.renormalised && p.numbers.renormalised->numbers
               ? *p.numbers.renormalised->numbers.*value
               : nothing;
}

const std::vector<SweepColumn>& theory_columns() {
    static const char* gamma = "meV/Å^2";
    static const std::vector<SweepColumn> list = {
        {"delta_gamma", gamma, [](const SweepPoint& p) { return p.what.delta_gamma; }},
        {"gamma_eff", gamma, [](const SweepPoint& p) { return p.numbers.gamma_eff; }},
        {"gamma_eff_ratio", "", [](const SweepPoint& p) { return p.numbers.state.gamma_ratio; }},
        {"contact_fraction", "", [](const SweepPoint& p) { return p.numbers.state.area; }},
        {"gamma_full_contact", gamma,
         [](const SweepPoint& p) { return p.numbers.gamma_full_contact; }},
        {"gamma_full_contact_ratio", "",
         [](const SweepPoint& p) { return ratio(p, p.numbers.gamma_full_contact); }},
        {"renormalised.gamma_eff", gamma,
         [](const SweepPoint& p) { return renormalised(p, &RenormalisedNumbers::gamma_eff); }},
        {"renormalised.gamma_eff_ratio", "",
         [](const SweepPoint& p) {
             return renormalised(p, &RenormalisedNumbers::gamma_eff_ratio);
         }},
        {"renormalised.contact_fraction", "",
         [](const SweepPoint& p) {
             return renormalised(p, &RenormalisedNumbers::contact_fraction);
         }},
        {"theta", "", [](const SweepPoint& p) { return p.numbers.theta.value_or(nothing); }},
        {"gamma_eff_ratio_error", "",
         [](const SweepPoint& p) { return p.numbers.state.gamma_ratio_error; }},
        {"contact_fraction_error", "",
         [](const SweepPoint& p) { return p.numbers.state.area_error; }},
    };
    return list;
}

/// What a sweep takes over from every result.json, by its path there.
struct Taken {
    const char* path;
    const char* unit;
    bool over_flat = false;     ///< a ratio to the flat reference stands behind it
    const char* name = nullptr; ///< in the table, where the path is that of a scene's key
};
constexpr Taken taken[] = {
    {"delta_gamma", "meV/Å^2", false},
    {"binding_energy", "meV/Å^2", true},
    {"work_of_adhesion.approach", "meV/Å^2", true},
    {"work_of_adhesion.pull_off", "meV/Å^2", true},
    {"work_of_adhesion.pairwise", "meV/Å^2", true},
    {"contact_fraction", "", false},
    {"pushed_fraction", "", false},
    {"pull_off_force", "eV/Å", false},
    {"jkr.in", "meV/Å^2", true},
    {"jkr.out", "meV/Å^2", true},
    {"jkr.in_averaged", "meV/Å^2", true},
    {"jkr.out_averaged", "meV/Å^2", true},
    {"sphere.maugis_images", "meV/Å^2", true},
    {"contact_radius.zero_load", "Å", false},
    {"contact_radius.pull_off", "Å", false},
    {"hysteresis.loop", "eV", false},
    {"hysteresis.approach", "eV", false},
    {"hysteresis.pull_off", "eV", false},
    {"surface.rms", "Å", false, "realised_rms"},
    {"surface.rms_slope", "", false, "realised_rms_slope"},
    {"energy.residual", "", false},
    {"run.wall_seconds", "s", false},
};

/// The seed's place among the axes does not matter, its value does not tell groups apart.
std::vector<io::JsonValue> without_seeds(const std::vector<SweepAxis>& axes,
                                         const SweepPoint& point) {
    std::vector<io::JsonValue> values;
    for (std::size_t i = 0; i < axes.size(); ++i)
        if (!axes[i].is_seed()) values.push_back(point.values[i]);
    return values;
}

std::string key_of(const std::vector<io::JsonValue>& values) {
    return io::JsonValue(io::JsonValue::Array(values)).dump(-1);
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

double result_number(const SweepPoint& point, const char* path) {
    const io::JsonValue* value = point.outcome.result.find(path);
    return value && value->is_number() ? value->number() : nothing;
}

std::vector<SweepColumn> sweep_columns(const SweepTable& table) {
    if (!table.simulated) return theory_columns();
    std::vector<SweepColumn> columns;
    for (const Taken& t : taken) {
        const auto value = [path = t.path](const SweepPoint& p) { return result_number(p, path); };
        if (std::none_of(table.points.begin(), table.points.end(),
                         [&](const SweepPoint& p) { return std::isfinite(value(p)); }))
            continue;
        columns.push_back({t.name ? t.name : t.path, t.unit, value});
        if (t.over_flat)
            columns.push_back({std::string(t.path) + "_ratio", "", [=](const SweepPoint& p) {
                                   return value(p) / result_number(p, "delta_gamma");
                               }});
    }
    for (SweepColumn column : theory_columns()) {
        column.name = "theory." + column.name;
        columns.push_back(std::move(column));
    }
    return columns;
}

std::string status_of(const SweepPoint& point, bool simulated) {
    if (!simulated) return std::string(theory::name(point.numbers.state.status));
    switch (point.outcome.state) {
    case PointState::finished:
        return "done";
    case PointState::failed:
        return "failed";
    case PointState::waiting:
        break;
    }
    return "waiting";
}

std::vector<SweepGroup> sweep_groups(const std::vector<SweepAxis>& axes,
                                     const std::vector<SweepPoint>& points) {
    std::vector<SweepGroup> groups;
    for (const SweepPoint& point : points) {
        std::vector<io::JsonValue> values = without_seeds(axes, point);
        const std::string key = key_of(values);
        auto at = std::find_if(groups.begin(), groups.end(),
                               [&](const SweepGroup& g) { return key_of(g.values) == key; });
        if (at == groups.end()) at = groups.insert(at, {std::move(values), {}});
        at->points.push_back(&point);
    }
    return groups;
}

Spread spread_of(const SweepGroup& group, const std::function<double(const SweepPoint&)>& value) {
    Spread spread{0, nothing, nothing};
    double sum = 0.0, squares = 0.0;
    for (const SweepPoint* p : group.points)
        if (const double v = value(*p); std::isfinite(v)) {
            ++spread.count;
            sum += v;
        }
    if (spread.count == 0) return spread;
    spread.mean = sum / spread.count;
    if (spread.count < 2) return spread;
    for (const SweepPoint* p : group.points)
        if (const double v = value(*p); std::isfinite(v))
            squares += (v - spread.mean) * (v - spread.mean);
    spread.deviation = std::sqrt(squares / (spread.count - 1));
    return spread;
}

std::string shown(const io::JsonValue& value) {
    if (value.is_text()) return value.text();
    return value.is_number() ? fmt::format("{:.12g}", value.number()) : value.dump(-1);
}

} // namespace asperity
