// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/run/run_record.hpp"

#include "engine/run/curve.hpp"
#include "engine/run/states_record.hpp"
#include "engine/run/theory_case.hpp"
#include "engine/scene/accuracy.hpp"
#include "engine/units.hpp"
#include "kernels/variant.hpp"
#include "theory/jkr.hpp"

#include <omp.h>

#include <string>
#include <utility>

namespace asperity {

namespace {

/// { name: { on, why } }
io::JsonValue effects_json(const Effects& effects) {
    io::JsonValue all = io::JsonValue::object();
    for (std::size_t i = 0; i < effect_count; ++i) {
        const auto effect = static_cast<Effect>(i);
        io::JsonValue one = io::JsonValue::object();
        one["on"] = effects.on(effect);
        one["why"] = effects.why(effect);
        all[name(effect)] = std::move(one);
    }
    return all;
}

} // namespace

io::ResultRecord run_record(const Scene& scene, const Surface& surface, const Setup& setup,
                            const Findings& findings, int ranks) {
    io::ResultRecord r;
    r.name = scene.name;
    r.scene = scene_json(scene);
    const auto& s = surface.statistics;
    r.surface = {s.rms, s.rms_slope, s.lowest, s.highest, surface.origin};
    r.delta_gamma = setup.flat.work_of_adhesion;
    r.work_of_adhesion.approach = findings.approach;
    r.work_of_adhesion.pull_off = findings.pull_off;
    if (findings.zero_load) {
        const ZeroLoad& z = *findings.zero_load;
        r.binding_energy = z.binding_energy;
        r.work_of_adhesion.pairwise = z.pairwise;
        r.contact_fraction = z.contact_fraction;
        r.pushed_fraction = z.pushed_fraction;
        r.run.iterations = static_cast<long long>(z.iterations);
        r.extra.emplace_back("binding_energy_uncertainty", z.uncertainty);
        r.extra.emplace_back("zero_load.elastic_energy", z.elastic);
        r.extra.emplace_back("zero_load.mean_height", z.mean_height);
        r.extra.emplace_back("zero_load.residual_force", z.residual);
    }
    if (findings.states) r.extra.emplace_back("states", states_json(*findings.states));
    if (findings.pull_off) r.pull_off_force = findings.attraction_out;
    if (scene.surface.radius) {
        const auto jkr = [&](double f) {
            return units::milli_per_unit *
                   theory::jkr::work_from_pull_off(f, *scene.surface.radius);
        };
        if (findings.approach) r.jkr.in = jkr(findings.attraction_in);
        if (findings.pull_off) r.jkr.out = jkr(findings.attraction_out);
    }
    add_sphere(scene, setup.flat, r);
    if (findings.dissipated) {
        const Dissipation& lost = *findings.dissipated;
        const double area = scene.edge() * scene.edge();
        const double sites = static_cast<double>(scene.surface.sites) * scene.surface.sites;
        io::JsonValue d = io::JsonValue::object();
        d["approach"] = units::milli_per_unit * lost.approach / area;
        d["pull_off"] = units::milli_per_unit * lost.pull_off / area;
        d["energy"] = lost.total();
        io::JsonValue u = io::JsonValue::object();
        if (findings.approach) u["approach"] = findings.approach_uncertainty;
        if (findings.pull_off) u["pull_off"] = findings.pull_off_uncertainty;
        d["uncertainty"] = u;
        r.extra.emplace_back("work_of_adhesion.uncertainty", std::move(u));
        d["events"] = lost.events;
        d["jumps"] = io::JsonValue::array();
        for (const Instability& jump : lost.jumps) {
            io::JsonValue j = io::JsonValue::object();
            j["leg"] = jump.leg == 0.0 ? "approach" : "pull-off";
            j["energy"] = jump.energy;
            j["top"] = jump.top;
            j["mean_height"] = io::JsonValue::Array{jump.height_before, jump.height_after};
            j["force"] = io::JsonValue::Array{jump.force_before, jump.force_after};
            j["contact_fraction"] =
                io::JsonValue::Array{jump.contact_before / sites, jump.contact_after / sites};
            j["site"] =
                io::JsonValue::Array{static_cast<int>(jump.site_x), static_cast<int>(jump.site_y)};
            j["largest_move"] = jump.largest_move;
            j["sites_moved"] = static_cast<long long>(jump.sites_moved);
            d["jumps"].push_back(std::move(j));
        }
        r.extra.emplace_back("dissipated", std::move(d));
    }
    add_theory(scene, surface, setup.flat.work_of_adhesion, r);
    r.extra.emplace_back("run.effects", effects_json(setup.effects));
    r.extra.emplace_back("run.kernels", std::string(name(processor_level())));
    if (scene.choice) r.extra.emplace_back("accuracy", accuracy_json(*scene.choice));
    r.run.ranks = ranks;
    r.run.threads = omp_get_max_threads();
    return r;
}

void add_phases(const Phases& phases, io::ResultRecord& record) {
    for (std::size_t p = 0; p < phase_names.size(); ++p) {
        const PhaseClock& clock = phases[static_cast<Phase>(p)];
        if (clock.calls > 0)
            record.run.phases.push_back({std::string(phase_names[p]), clock.seconds, clock.calls});
    }
}

} // namespace asperity
