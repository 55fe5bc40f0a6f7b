// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/run/run_result.hpp"

#include "engine/case/spacing_limits.hpp"
#include "engine/device/device_block.hpp"
#include "engine/run/series.hpp"
#include "engine/theory/theory_case.hpp"
#include "engine/units.hpp"
#include "kernels/variant.hpp"
#include "theory/capped_pressure.hpp"
#include "theory/jkr.hpp"

#include "io/json.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

namespace asperity {

namespace {

void add_surface(const Surface& surface, io::Result& result) {
    const SurfaceStatistics& s = surface.statistics;
    result.set("surface.rms", s.rms);
    result.set("surface.rms_slope", s.rms_slope);
    result.set("surface.min", s.lowest);
    result.set("surface.max", s.highest);
    if (surface.atoms.size() > 0)
        result.set("surface.atoms", static_cast<long long>(surface.atoms.size()));
    if (!surface.origin.empty()) result.set("surface.origin", surface.origin);
    if (surface.file_digest)
        result.set("surface.file_digest", io::digest_text(*surface.file_digest));
    if (!surface.pair) return;
    const SurfacePair& pair = *surface.pair;
    result.set("surface.own.rms", pair.own.rms);
    result.set("surface.own.rms_slope", pair.own.rms_slope);
    result.set("surface.counter.rms", pair.counter.rms);
    result.set("surface.counter.rms_slope", pair.counter.rms_slope);
    result.set("surface.counter.file_digest", io::digest_text(pair.digest));
    result.set("surface.correlation", pair.correlation);
    result.set("surface.band_overlap", pair.band_overlap);
}

void add_zero_load(const ZeroLoad& z, io::Result& result) {
    result.set("binding_energy", z.binding_energy);
    result.set("binding_energy_uncertainty", z.uncertainty);
    result.set("pair_binding_energy", z.pairwise);
    result.set("contact_fraction", z.contact_fraction);
    if (z.contact_area) result.set("contact_area", *z.contact_area);
    result.set("repulsive_fraction", z.repulsive_fraction);
    result.set("relaxed.elastic_energy", z.elastic);
    result.set("relaxed.mean_height", z.mean_height);
    result.set("relaxed.residual_force", z.residual);
    result.set("run.iterations", static_cast<long long>(z.iterations));
}

void add_path(const PathResults& results, const Case& c, io::Result& result) {
    const std::optional<double> radius = c.radius();
    const SegmentResults *in = results.last(Segment::approach),
                         *out = results.last(Segment::pull_off);
    const auto set = [&](const SegmentResults* s, std::string_view way) {
        if (!s) return;
        for (const io::EnergyTerm& row : io::energy_terms) {
            if (!s->energies[row.term] || is_heat(row, c.effects)) continue;
            result.set(io::Key::of("", row, way), s->energies[row.term]);
            if (s->uncertainty)
                result.set(io::Key::of("", row, ".uncertainty" + std::string(way)), s->uncertainty);
        }
        result.set(io::Key::composed("stored" + std::string(way)), s->stored);
    };
    set(in, ".approach");
    set(out, ".pull_off");
    for (const io::EnergyTerm& row : io::energy_terms)
        if (row.is_loss()) result.set(io::Key::of("", row, ".cycle"), results.in_cycle[row.term]);
    if (in) result.set("approach_force", in->attraction);
    if (out) result.set("pull_off_force", out->attraction);
    if (c.in_newtons()) {
        if (in) result.set("instrument.approach_force", in->attraction / units::nanonewton);
        if (out) result.set("instrument.pull_off_force", out->attraction / units::nanonewton);
    }
    if (radius && c.edge_pinning > 1.05 && out) result.set("jkr.edge_pinning", c.edge_pinning);
    if (!radius || !c.effects.one_modulus()) return; // JKR is of one modulus
    const auto as_work = [&](double force) {
        return units::milli_per_unit * theory::jkr::work_from_pull_off(force, *radius);
    };
    if (in) result.set("jkr.approach", as_work(in->attraction));
    if (out) result.set("jkr.pull_off", as_work(out->attraction));
}

/// Share of a number that is its error by the spacing: of contact_sites_error() beside the area in
/// contact, and of the excess of Case::edge_pinning over 1, which counts more if the tension of the
/// law ends suddenly; as measured (docs/reports/mesh.md).
struct MeshRule {
    io::Key number, error;
    double edges, pinning, sudden;
};
constexpr MeshRule mesh_rules[] = {
    {"contact_area", "contact_area_uncertainty", 1.0, 0.3, 0.5},
    {"binding_energy", "mesh_error.binding_energy", 0.1, 0.2, 0.1},
    {"work_of_drive.approach", "mesh_error.work_of_drive.approach", 0.1, 0.2, 0.9},
    {"work_of_drive.pull_off", "mesh_error.work_of_drive.pull_off", 0.12, 0.3, 0.9},
    {"approach_force", "mesh_error.approach_force", 0.5, 0.3, 0.7},
    {"pull_off_force", "mesh_error.pull_off_force", 0.5, 0.45, 1.2}};

/// Returns the relative error of a number by the spacing. counted, area: shares of the sites in
/// contact and of the area. Returns nothing without edges, where single rows hold them, or for a
/// surface that yields.
std::optional<double> mesh_error(const MeshRule& rule, const Case& c, double counted, double area) {
    if (!(counted > area) || !(area > 0.0)) return {};
    if (c.edge_pinning > largest_edge_pinning || c.effects.yielding) return {};
    const double edges = (counted - area) * c.sites() / excess_of_edge;
    const double of_edges = contact_sites_error(edges) / (area * c.sites());
    const double held =
        (tension_ends_suddenly(c) ? rule.sudden : rule.pinning) * (c.edge_pinning - 1.0);
    return std::hypot(rule.edges * of_edges, held);
}

/// Adds the errors by the spacing of a continuum over a wall, with edges of contacts of the state
/// at zero load.
void add_mesh_errors(const Case& c, io::Result& result) {
    const auto counted = result.number("contact_fraction"), area = result.number("contact_area");
    if (!counted || !area) return;
    for (const MeshRule& rule : mesh_rules) {
        const auto value = result.number(rule.number);
        // Waves of a lattice are too soft: no rule tells the errors of its numbers.
        const bool of_lattice = !c.simulation.block.continuum;
        if (!value || (of_lattice && rule.number.name != "contact_area")) continue;
        if (const auto error = mesh_error(rule, c, *counted, *area))
            result.set(rule.error, std::abs(*value) * *error);
    }
}

/// Adds the results of a curved scene at zero load: contact radius, and binding energy by JKR.
void add_sphere(const Case& c, io::Result& result) {
    const std::optional<double> radius = c.radius();
    if (!radius) return;
    auto area = result.number("contact_area");
    if (!area) area = result.number("contact_fraction");
    if (area) {
        const double contact = c.edge() * std::sqrt(*area / std::numbers::pi);
        result.set("contact_radius.relaxed", contact);
        result.set("instrument.contact_radius", 0.1 * contact);
        if (const auto error = result.number("contact_area_uncertainty")) {
            const double of_radius = 0.5 * contact * *error / *area;
            result.set("contact_radius.uncertainty.relaxed", of_radius);
            result.set("instrument.contact_radius_uncertainty", 0.1 * of_radius);
        }
    }
    const bool pressed = c.starts_with(Segment::relax) && c.simulation.drive.load_force != 0.0;
    const auto binding = result.number("binding_energy");
    if (!binding || pressed || !c.effects.one_modulus()) return;
    const double energy = *binding / units::milli_per_unit * c.area();
    const double modulus = c.simulation.block.contact_modulus();
    result.set("jkr.relaxed", units::milli_per_unit *
                                  theory::jkr::work_from_binding_energy(energy, *radius, modulus));
}

/// Adds the means of slide i after its running-in.
void add_steady(const SteadySlide& s, const Case& c, std::size_t i, io::Result& result) {
    result.set("segments[].steady", i, s.steady);
    result.set("segments[].running_in", i, s.running_in);
    result.set("segments[].steady_friction", i, s.friction);
    result.set("segments[].steady_friction_error", i, s.friction_error);
    if (s.mesh_error > 0.0) result.set("segments[].steady_friction_mesh_error", i, s.mesh_error);
    const double megapascal = 1.0 / (c.area() * units::megapascal);
    result.set("segments[].friction_stress", i, s.friction * megapascal);
    result.set("segments[].steady_pressure", i, s.load * megapascal);
    if (s.load > 0.0) {
        result.set("segments[].friction_coefficient", i, s.friction / s.load);
        result.set("segments[].friction_coefficient_error", i, s.friction_error / s.load);
    }
    result.set("segments[].steady_contact_fraction", i, s.in_contact / c.sites());
    result.set("segments[].steady_contact_fraction_error", i, s.in_contact_error / c.sites());
    result.set("segments[].steady_contact_area", i, s.area / c.sites());
    result.set("segments[].steady_contact_area_uncertainty", i, s.area_error / c.sites());
    result.set("segments[].steady_mean_height", i, s.mean_height);
    for (const io::EnergyTerm& row : io::energy_terms)
        if (row.is_loss() && c.effects.has(row.effect))
            result.set(io::Key::of("segments[].steady_", row), i, s.losses[row.term]);
}

void add_segments(const PathResults& results, const Case& c, io::Result& result) {
    result.set_list("segments[]");
    for (std::size_t i = 0; i < results.segments.size(); ++i) {
        const SegmentResults& s = results.segments[i];
        const auto given = [&](io::Key key, const std::optional<double>& value) {
            if (value) result.set(key, i, *value);
        };
        result.set("segments[].segment", i, static_cast<long long>(s.number));
        result.set("segments[].name", i, c.path()[s.number].text);
        for (const io::EnergyTerm& row : io::energy_terms)
            if (s.energies[row.term])
                result.set(io::Key::of("segments[].", row), i, *s.energies[row.term]);
        given("segments[].stored", s.stored);
        given("segments[].work_of_settling", s.settling);
        given("segments[].uncertainty", s.uncertainty);
        result.set("segments[].largest_attraction", i, s.attraction);
        given("segments[].friction", s.lateral_mean);
        given("segments[].largest_friction", s.lateral_most);
        if (s.steady) add_steady(*s.steady, c, i, result);
        result.set("segments[].pressure", i, s.force / (c.area() * units::megapascal));
        if (c.in_newtons()) result.set("segments[].force", i, s.force / units::nanonewton);
        if (s.scatter) {
            result.set("segments[].pressure_scatter", i,
                       *s.scatter / (c.area() * units::megapascal));
            result.set("segments[].pressure_averaged_over", i,
                       c.simulation.drive.average_over / units::picosecond);
        }
        result.set("segments[].mean_height", i, s.mean_height);
        result.set("segments[].top_displacement", i, s.top);
        result.set("segments[].contact_fraction", i, c.fraction(s.in_contact));
        if (s.area) {
            const double area = *s.area / c.sites();
            result.set("segments[].contact_area", i, area);
            if (const auto error = mesh_error(mesh_rules[0], c, c.fraction(s.in_contact), area))
                result.set("segments[].contact_area_uncertainty", i, area * *error);
        }
        if (c.effects.yielding) {
            result.set("segments[].yielding_fraction", i, c.fraction(s.yielding.at_hardness));
            result.set("segments[].mean_set", i, s.yielding.mean_set);
            result.set("segments[].largest_set", i, s.yielding.largest_set);
        }
        if (c.effects.sliding)
            result.set("segments[].slide", i, std::vector{s.slide[0], s.slide[1]});
    }
}

/// Adds Persson's theory with a cap, beside the segment that ends under the largest pressure, or
/// the reason why it does not apply.
void add_capped_theory(const Case& c, const Surface& surface, const PathResults& results,
                       io::Result& result) {
    const InterfaceOptions& interface = c.simulation.interface;
    const double pressure = most_pressed(results).force / c.area();
    const char* why = c.effects.free_edges || c.radius() ? "the theory is of endless flat contacts"
                      : interface.maps[SiteMapOf::hardness] ? "the theory is of one hardness"
                      : !c.effects.one_modulus()            ? "the theory is of one modulus"
                      : pressure < 0.0 || pressure >= interface.mean_hardness()
                          ? "no segment ends under a pressure below the hardness"
                          : nullptr;
    if (why) {
        result.set("theory.capped.note", why);
        return;
    }
    const double stress = 0.5 * c.simulation.block.contact_modulus() * surface.statistics.rms_slope;
    const theory::CappedContact contact =
        theory::capped_contact(pressure, interface.mean_hardness(), stress * stress);
    result.set("theory.capped.pressure", pressure / units::megapascal);
    result.set("theory.capped.contact_fraction", contact.area());
    result.set("theory.capped.yielding_fraction", contact.yielding);
}

/// Adds what a surface that yields was, and has become at the end of the last segment.
void add_yielding(const Case& c, const Surface& surface, const PathResults& results,
                  io::Result& result) {
    const auto& map = c.simulation.interface.maps[SiteMapOf::hardness];
    const double softest =
        map ? map->least : c.simulation.interface.mean_hardness() / units::gigapascal;
    result.set("yielding.tension_over_hardness", c.largest_tension / softest);
    if (results.segments.empty()) return;
    long long most = 0;
    for (const SegmentResults& s : results.segments)
        most = std::max(most, s.yielding.at_hardness);
    result.set("yielding.largest_fraction", c.fraction(most));
    add_capped_theory(c, surface, results, result);
    result.set("yielding.rms_before", results.unyielded_rms);
    result.set("yielding.rms_after", results.segments.back().yielded_rms);
    result.set("yielding.slope_before", results.unyielded_slope);
    result.set("yielding.slope_after", results.segments.back().yielded_slope);
}

void add_dissipation(const PathResults& results, const Case& c, io::Result& result) {
    const Dissipation& lost = *results.dissipated;
    result.set("dissipated.energy", lost.total);
    result.set("dissipated.events", lost.events);
    if (c.effects.branches) result.set("dissipated.not_followed", lost.not_followed);
    result.set_list("dissipated.jumps[]");
    for (std::size_t i = 0; i < lost.jumps.size(); ++i) {
        const Instability& jump = lost.jumps[i];
        const auto both = [](double before, double after) { return std::vector{before, after}; };
        result.set("dissipated.jumps[].segment", i, static_cast<long long>(jump.segment));
        result.set("dissipated.jumps[].energy", i, jump.energy);
        result.set("dissipated.jumps[].top_displacement", i, jump.top);
        if (c.effects.sliding)
            result.set("dissipated.jumps[].slide", i, std::vector{jump.slide[0], jump.slide[1]});
        result.set("dissipated.jumps[].mean_height", i,
                   both(jump.height_before, jump.height_after));
        result.set("dissipated.jumps[].force", i, both(jump.force_before, jump.force_after));
        result.set("dissipated.jumps[].contact_fraction", i,
                   both(c.fraction(jump.contact_before), c.fraction(jump.contact_after)));
        result.set(
            "dissipated.jumps[].site", i,
            std::vector{static_cast<long long>(jump.site_x), static_cast<long long>(jump.site_y)});
        result.set("dissipated.jumps[].largest_move", i, jump.largest_move);
        result.set("dissipated.jumps[].sites_moved", i, static_cast<long long>(jump.sites_moved));
    }
}

void add_effects(const Effects& effects, io::Result& result) {
    for (const auto& [name, effect] : effects.list()) {
        result.set("run.effects.*.on", name, effect.on);
        result.set("run.effects.*.why", name, effect.why);
    }
}

} // namespace

const SegmentResults& most_pressed(const PathResults& results) {
    return *std::max_element(
        results.segments.begin(), results.segments.end(),
        [](const SegmentResults& a, const SegmentResults& b) { return a.force < b.force; });
}

io::Result scene_result(const Scene& scene) {
    io::Result result;
    if (!scene.name.empty()) result.set("name", scene.name);
    result.set_scene(scene_json(scene), scene_units(scene));
    return result;
}

io::Result surface_result(const Case& c, const Surface& surface) {
    io::Result result = scene_result(c.scene);
    add_surface(surface, result);
    if (!c.scene.fit.file.empty()) result.set("block.prony_file", c.scene.fit.file);
    if (c.scene.fit.rms_error) result.set("block.prony_error", *c.scene.fit.rms_error);
    for (const auto& [key, digest] : c.digests())
        result.set(io::Key::composed(key + "_digest"), io::digest_text(digest));
    for (const auto& map : c.simulation.interface.site_maps()) {
        const std::string key = "interface." + map->name;
        result.set(io::Key::composed(key + "_least"), map->least);
        result.set(io::Key::composed(key + "_largest"), map->largest);
    }
    if (c.table_error) result.set("interface.table_error", *c.table_error);
    return result;
}

io::Result run_result(const Case& c, const Surface& surface, const PathResults& results) {
    io::Result result = surface_result(c, surface);
    result.set("delta_gamma", c.flat.work_of_adhesion);
    if (c.box_jumps()) result.set("box.softness", c.softness);
    result.set("box.flat_loss", c.flat_loss());
    add_path(results, c, result);
    if (results.zero_load) add_zero_load(*results.zero_load, result);
    add_mesh_errors(c, result);
    if (!results.segments.empty()) add_segments(results, c, result);
    if (results.dissipated) add_dissipation(results, c, result);
    if (c.effects.yielding) add_yielding(c, surface, results, result);
    add_theory(c, surface, result);
    add_sphere(c, result);
    if (c.in_newtons() && results.dissipated)
        result.set("instrument.energy_lost", results.dissipated->total / units::attojoule);
    if (results.edge_distance) result.set("instrument.edge_distance", 0.1 * *results.edge_distance);
    const auto& wall = c.simulation.interface.wall;
    const auto has_range = []<class Law>(const Law&) { return ScaledBySite<Law>; };
    if (!wall || !std::visit(has_range, *wall)) // pairs of atoms, or smeared ones
        result.set("interface.cutoff", cutoff_of(c.simulation.interface.potential));
    result.set("run.ranks", c.ranks);
    result.set("run.threads", omp_get_max_threads());
    result.set("run.kernels", std::string(name(processor_level())));
    add_effects(c.effects, result);
    return result;
}

std::string physics_of(const Case& c, const Surface& surface) {
    const Scene& scene = c.scene;
    const io::Json all = scene_json(scene);
    io::Json part = io::Json::object();
    for (const char* section : {"surface", "block", "interface", "drive"})
        if (all.contains(section)) part[section] = all[section];
    part["drive"]["max_steps"] = 0;
    part["output"]["fields"] = c.maps.pull_off; // keeps a layer in the checkpoint
    // A resumed run takes maps whose time is past as written.
    part["output"]["delayed"] = io::Json::array();
    for (const auto& [delay, name] : c.maps.after_approach)
        part["output"]["delayed"].push_back(name);
    if (c.radius()) part["output"]["series"] = c.output.series; // averaged over time
    part["output"]["velocities"] = c.output.trajectory && c.output.velocities;
    if (surface.file_digest) part["surface"]["content_of_file"] = *surface.file_digest;
    if (surface.pair) part["surface"]["content_of_counter"] = surface.pair->digest;
    for (const auto& [key, digest] : c.digests()) {
        const std::size_t dot = key.find('.');
        part[key.substr(0, dot)]["content_of_" + key.substr(dot + 1)] = digest;
    }
    return io::json_text(part);
}

void add_steps(const Path& path, const std::optional<StepRecord>& failed, io::Result& result) {
    const Case& c = path.scene_case();
    const StepRecord& now = failed ? *failed : path.now();
    if (path.phases()) add_phases(*path.phases(), result);
    if (c.effects.dynamic) result.set("run.device", describe_device(c.simulation.device));
    result.set("run.steps", failed ? failed->step : path.steps());
    if (const auto iterations = path.iterations()) result.set("run.iterations", *iterations);
    if (path.steps() > 0 || now.observed) {
        result.set("energy.kinetic", now[Term::kinetic]); // zero at rest
        for (const SeriesColumn& column : series_columns())
            if (!column.result.empty() && column.is_in(c.effects))
                result.set(io::Key::composed(column.result), column.value(path, now));
    } else if (const std::optional<ZeroLoad>& z = path.results().zero_load) {
        const double area = c.area() / units::milli_per_unit;
        result.set("energy.kinetic", 0.0);
        result.set("energy.elastic", z->elastic * area);
        result.set("energy.interface", -z->pairwise * area);
    }
}

void add_phases(const Phases& phases, io::Result& result) {
    for (std::size_t p = 0; p < phase_names.size(); ++p) {
        const PhaseClock& clock = phases[static_cast<Phase>(p)];
        if (clock.calls == 0) continue;
        result.set("run.phases.*.seconds", phase_names[p], clock.seconds);
        result.set("run.phases.*.calls", phase_names[p], clock.calls);
    }
}

} // namespace asperity
