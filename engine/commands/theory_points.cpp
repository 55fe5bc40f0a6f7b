// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// `asperity theory-points SCENE`, on one rank: many variations of one scene in one call, for
// programs. The Python package computes its theories with it, and sweeps check their points.
//
// Each line of the input is a JSON array of overrides, ["surface.rms=1", "surface.seed=2"]. Each
// line of the output is a JSON object for the point of the same line, either
//     {"name", "scene", "units", "delta_gamma", "theory": {...}, "flat", "notes": [...], "rough"}
// with the keys and units of result.json, the separation (Å) and the largest tension (GPa) of flat
// on flat, and renormalised_inputs(); or {"problems": [{"where", "what", "why", "fix"}]}.
#include "engine/commands/command_line.hpp"

#include "decomposition/communicator.hpp"
#include "engine/run/run_result.hpp"
#include "engine/theory/rough_interface.hpp"
#include "engine/theory/theory_case.hpp"
#include "engine/units.hpp"
#include "io/error.hpp"
#include "io/json.hpp"
#include "io/quantities.hpp"
#include "io/result.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <fstream>
#include <iostream>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace asperity {

namespace {

using io::Json;

/// Surfaces of several scenes in turn: a surface is generated anew only if more than its rms
/// changes.
class SurfaceCache {
public:
    const Surface& of(const Case& c) {
        Json keys = scene_json(c.scene)["surface"];
        if (c.surface.kind == SurfaceKind::self_affine && !c.surface.counter) keys["rms"] = "any";
        if (const std::string text = io::json_text(keys); !surface_ || text != keys_) {
            surface_ = surface_of(c);
            keys_ = text;
        }
        return *surface_;
    }

private:
    std::optional<Surface> surface_;
    std::string keys_;
};

std::vector<std::string> overrides_of(const std::string& line, const std::string& where) {
    const auto refuse = [&](const std::string& why) {
        return io::SceneError(io::Problem{where, "is no list of overrides", why,
                                          "write one JSON array a line: [\"surface.rms=1\"]"});
    };
    Json list;
    try {
        list = io::parse_json(line, where);
    } catch (const io::Error& error) {
        throw refuse(error.problems().front().why);
    }
    if (!list.is_array()) throw refuse("it is not an array");
    std::vector<std::string> overrides;
    for (const Json& item : list) {
        if (!item.is_string()) throw refuse("an item is not a string");
        overrides.push_back(item.get<std::string>());
    }
    return overrides;
}

/// Returns the columns of theory.h5, whose units and meanings are in io/quantities.
Json profile_json(const TheoryCase& what, const TheoryNumbers& n) {
    using Point = theory::ProfilePoint;
    Json columns = Json::array();
    const auto column = [&](const std::string& name, const auto& value) {
        const io::Quantity* quantity = io::run_quantity("/profile/" + name);
        Json values = Json::array();
        for (const Point& p : n.state.profile)
            values.push_back(value(p));
        columns.push_back({{"name", name},
                           {"unit", quantity->unit},
                           {"meaning", quantity->meaning},
                           {"values", values}});
    };
    const double meV = units::milli_per_unit, gpa = 1.0 / units::gigapascal;
    column("q", [](const Point& p) { return p.q; });
    column("zeta", [](const Point& p) { return p.zeta; });
    column("C", [&](const Point& p) { return what.contact.spectrum(p.q); });
    column("A", [](const Point& p) { return p.area; });
    column("A_real", [](const Point& p) { return p.real_area; });
    column("gamma_eff", [=](const Point& p) { return meV * p.gamma_eff; });
    column("sigma_a", [=](const Point& p) { return gpa * p.detachment_stress; });
    column("U_el", [=](const Point& p) { return meV * p.elastic_energy; });
    column("stress_variance", [=](const Point& p) { return gpa * gpa * p.stress_variance; });
    return columns;
}

/// Returns the notes of a case, and with_surface those of its surface.
std::vector<std::string> notes_on(const Case& c, SurfaceCache& surfaces, bool with_surface) {
    return with_surface ? notes_of(c, surfaces.of(c)) : c.notes;
}

Json point_json(const Case& c, SurfaceCache& surfaces, bool profile) {
    const bool realised = theory_needs_surface(c);
    const TheoryCase what = theory_case(c, realised ? &surfaces.of(c) : nullptr);
    const TheoryNumbers numbers = solve_theory(what);
    io::Result values = scene_result(c.scene);
    if (!what.origin.empty()) values.set("surface.origin", what.origin);
    values.set("delta_gamma", what.flat);
    record_theory(what, numbers, values);
    Json notes = notes_on(c, surfaces, realised);
    for (const std::string& note : what.notes)
        notes.push_back(note);
    if (profile && what.contact.work_of_adhesion > 0.0 && !what.contact.spectrum.smooth()) try {
            const theory::CriticalRoughness end = theory::critical_roughness(what.contact);
            values.set("theory.persson.critical_rms", end.h_rms);
            values.set("theory.persson.critical_rms_full_contact", end.full_contact_h_rms);
        } catch (const std::exception& error) {
            notes.push_back(error.what());
        }
    Json point = values.json();
    point["theory"]["persson"]["gamma_eff_ratio"] = numbers.state.gamma_ratio;
    point["theory"]["persson"]["gamma_eff_ratio_error"] = numbers.state.gamma_ratio_error;
    point["flat"] = {{"separation", c.flat.separation}, {"tension", c.flat.largest_tension}};
    point["notes"] = notes;
    point["rough"] = renormalised_inputs(c, what.contact.spectrum, realised);
    if (profile) point["profile"] = profile_json(what, numbers);
    return point;
}

/// Returns the theory of a point beside a run, which goes on without a theory.
Json simulated_point(const Case& c, SurfaceCache& surfaces, bool profile) {
    std::string why = no_theory(c.scene, c.effects).why;
    try {
        if (why.empty()) return point_json(c, surfaces, profile);
    } catch (const io::SceneError& error) {
        why = error.what();
    }
    io::Result values = scene_result(c.scene);
    values.set("delta_gamma", c.flat.work_of_adhesion);
    values.set("theory.persson.note", why);
    Json point = values.json();
    point["notes"] = notes_on(c, surfaces, c.surface.reads_file());
    return point;
}

struct PointsArguments : Arguments {
    std::string points;    ///< file of the points; "-": standard input; empty: the scene alone
    bool runnable = false; ///< report also the problems that would stop a run (examine())
    /// Output also theory.persson.critical_rms, and "profile": [{"name", "unit", "meaning",
    /// "values"}], the theory at all magnifications.
    bool profile = false;
};

/// Prints the theories of the points. Throws io::FileError if the input cannot be read.
int theory_points(const PointsArguments& what) {
    std::vector<std::string> of_all; // overrides of every point
    const std::string scene = scene_file(what, of_all);
    std::ifstream file;
    std::istringstream alone("[]\n");
    if (!what.points.empty() && what.points != "-") {
        file.open(what.points);
        if (!file)
            throw io::FileError(what.points, "cannot be read",
                                "there is no such file, or it may not be read",
                                "check the path and its permissions");
    }
    std::istream& input = what.points.empty() ? alone : what.points == "-" ? std::cin : file;
    const std::string text = io::read_scene_file(scene);
    SurfaceCache surfaces;
    std::string line;
    for (int number = 1; std::getline(input, line); ++number) {
        std::vector<std::string> overrides = of_all;
        for (std::string& one : overrides_of(line, fmt::format("{}:{}", what.points, number)))
            overrides.push_back(std::move(one));
        Json point;
        try {
            const Case c = read_case_text(text, scene, overrides);
            if (what.runnable) examine(c);
            point = what.runnable ? simulated_point(c, surfaces, what.profile)
                                  : point_json(c, surfaces, what.profile);
            if (what.runnable && (c.surface.reads_file() || !c.digests().empty())) {
                // Present contents of the files.
                const Json now = surface_result(c, surfaces.of(c)).json();
                for (const char* part : {"surface", "interface"})
                    if (now.contains(part)) point[part] = now[part];
            }
        } catch (const io::SceneError& error) {
            point = {{"problems", io::problems_json(error.problems())}};
        }
        fmt::print("{}\n", io::json_text(point));
    }
    return io::exit_code::done;
}

} // namespace

Command theory_points_command() {
    const auto given = std::make_shared<PointsArguments>();
    return {
        .options = {takes::scene(*given),
                    takes::set(*given),
                    {"--points", "FILE",
                     "the variations: a JSON array of overrides a line (-: standard input); a "
                     "line of JSON for each",
                     &given->points},
                    {"--runnable", "", "also check what a run would refuse", &given->runnable},
                    {"--profile", "", "also everything over magnification, and where adhesion ends",
                     &given->profile}},
        .act =
            [given](const Communicator& world) {
                return on_root(world, [&] { return theory_points(*given); });
            },
        .for_programs = true};
}

} // namespace asperity
