// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/commands/cost_knobs.hpp"

#include "engine/setup/setup.hpp"
#include "io/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace asperity {

namespace {

std::string number(double v) { return fmt::format("{:.6g}", v); }

KnobValue value(const std::string& key, double v, const std::string& unit) {
    return {number(v) + (unit.empty() ? "" : " " + unit), {key + "=" + number(v)}, v};
}

/// The scene's own value times each factor.
std::vector<KnobValue> scaled(const std::string& key, double own, const std::string& unit,
                              std::initializer_list<double> factors) {
    std::vector<KnobValue> values;
    for (const double factor : factors)
        values.push_back(value(key, factor * own, unit));
    return values;
}

/// The paths that a scene can be followed on.
struct Ways {
    bool dynamic, legs;
    explicit Ways(const Scene& scene)
        : dynamic(!scene.without_time()),
          legs(scene.has(PathPart::approach) || scene.has(PathPart::pull_off)) {}
};

Knob timestep(const Scene& scene, double limit) {
    Knob knob{"timestep", "time step", {}, {}, false, 2.0, "2 (velocity Verlet)", "timestep"};
    for (const KnobValue& v :
         scaled("drive.timestep", scene.drive.timestep, "fs", {6.0, 5.0, 4.0, 3.0, 2.0, 1.0}))
        if (v.x < 0.9 * limit) knob.values.push_back(v);
    knob.twin = value("drive.timestep", 0.5 * scene.drive.timestep, "fs");
    return knob;
}

double widest_cutoff(const Scene& scene) {
    return std::min(8.0 * scene.interface.r0, 0.5 * scene.edge());
}

/// Without and with the tail behind it.
void cutoffs(const Scene& scene, std::vector<Knob>& knobs) {
    const double r0 = scene.interface.r0, widest = widest_cutoff(scene);
    Knob bare{"cutoff",     "cutoff", {}, {}, true, -4.0, "-4: adhesion of what is beyond",
              "interaction"};
    Knob tail = bare;
    tail.name = "tail";
    tail.about = "cutoff, tail added";
    tail.order.reset();
    tail.expected = "steeper than -4";
    for (const double factor : {2.0, 2.5, 3.0, 4.0, 6.0}) {
        if (factor * r0 >= widest) break;
        KnobValue v = value("interface.cutoff", factor * r0, "Å");
        v.setting.emplace_back("interface.tail=false");
        bare.values.push_back(v);
        v.setting.back() = "interface.tail=true";
        v.label += " + tail";
        if (factor <= 4.0) tail.values.push_back(v);
    }
    bare.twin = value("interface.cutoff", widest, "Å");
    bare.twin->setting.emplace_back("interface.tail=true");
    bare.twin->label += " + tail";
    tail.twin = bare.twin;
    knobs.push_back(bare);
    knobs.push_back(tail);
}

/// exact: the block that leaves out none of the layers.
Knob layers(const std::string& exact) {
    Knob knob{"layers",
              "layers per level",
              {},
              KnobValue{exact, {"block.model=" + exact}, 0.0},
              true,
              -2.0,
              "about -2 (docs/model.md: stiffness of waves)",
              "block"};
    for (const double m : {2.0, 3.0, 4.0, 6.0, 8.0}) {
        KnobValue v = value("block.layers_per_level", m, "a level");
        v.setting.emplace_back("block.model=multiscale");
        knob.values.push_back(v);
    }
    return knob;
}

Knob thickness(const Scene& scene) {
    const int own = scene.block.thickness;
    Knob knob{
        "thickness",  "thickness",           {}, value("block.thickness", 8 * own, "layers"), false,
        std::nullopt, "none: another solid", ""};
    for (const int t : {own / 4, own / 2, own, 2 * own})
        if (t >= 1) knob.values.push_back(value("block.thickness", t, "layers"));
    return knob;
}

Knob precision() {
    return {"precision",
            "pairs in single precision",
            {{"mixed", {"numerics.precision=mixed"}, 0.0}},
            KnobValue{"double", {"numerics.precision=double"}, 0.0},
            true,
            std::nullopt,
            "none: rounding",
            "precision"};
}

Knob velocity(const Scene& scene, const Setting& at_rest) {
    Knob knob{"velocity",
              "velocity",
              {},
              KnobValue{"quasi-static", at_rest, 0.0},
              true,
              1.0,
              "1: drag and waves; state: none",
              "velocity"};
    knob.values = scaled("drive.velocity", scene.drive.velocity, "m/s", {4.0, 2.0, 1.0, 0.5, 0.25});
    return knob;
}

Knob damping(const Scene& scene) {
    Knob knob{"damping",
              "damping",
              {},
              value("drive.damping", 0.125 * scene.drive.damping, "1/ps"),
              false,
              1.0,
              "1 while weak; state: none",
              ""};
    knob.values = scaled("drive.damping", scene.drive.damping, "1/ps", {4.0, 2.0, 1.0, 0.5});
    return knob;
}

/// base: what a scene in time takes to be followed without.
Knob tolerance(const Scene& scene, const Setting& base) {
    Knob knob{"tolerance",
              "force left over",
              {},
              value("drive.tolerance", 0.1 * scene.drive.tolerance, "eV/Å"),
              true,
              std::nullopt,
              "up to 2: a minimum is flat",
              "tolerance"};
    knob.values = scaled("drive.tolerance", scene.drive.tolerance, "eV/Å", {100.0, 10.0, 1.0});
    knob.base = base;
    return knob;
}

Knob step(const Scene& scene, const Setting& base) {
    Knob knob{"step",
              "largest step of the top",
              {},
              value("drive.step", 0.25 * scene.drive.step, "Å"),
              false,
              std::nullopt,
              "none: steps are cut where needed",
              "step"};
    knob.values = scaled("drive.step", scene.drive.step, "Å", {4.0, 2.0, 1.0, 0.5});
    knob.base = base;
    return knob;
}

void refuse(const Scene& scene) {
    io::Problems problems = scene.problems();
    if (scene.numerics.accuracy)
        problems.add("numerics.accuracy", fmt::format("= {:.6g}", *scene.numerics.accuracy),
                     "cost sets each of what accuracy would choose",
                     "leave it out (--set numerics.accuracy=none)");
    if (scene.drive.temperature > 0.0)
        problems.add("drive.temperature", fmt::format("= {:.6g} K", scene.drive.temperature),
                     "differences between runs would be those of their noise",
                     "measure the same scene at 0 K");
    if (scene.drive.max_steps > 0)
        problems.add("drive.max_steps", fmt::format("= {}", scene.drive.max_steps),
                     "runs that are cut off cannot be compared", "leave it out");
    problems.throw_if_any();
}

} // namespace

CostCase cost_case(const Scene& scene) {
    refuse(scene);
    const Setup setup = examine(scene, 1);
    const Ways ways(scene);
    CostCase all;
    // What is exact without time: the lattice's own answer, wave by wave, where there is one.
    const bool spectral = scene.block.strain == Strain::linear;
    const std::string best_block = spectral ? "spectral" : "lattice";
    const std::string exact = "block.model=" + best_block;
    const Setting at_rest = {"drive.mode=quasistatic"};
    const double widest = widest_cutoff(scene);
    all.reference = {exact, "interface.tail=true", "interface.cutoff=" + number(widest),
                     "numerics.precision=double",
                     "drive.tolerance=" + number(0.1 * scene.drive.tolerance)};
    if (ways.legs) {
        all.reference.insert(all.reference.end(), {"drive.mode=quasistatic",
                                                   "drive.step=" + number(0.5 * scene.drive.step)});
    }
    all.reference_text = fmt::format(
        "{} block, {}cutoff {} Å and tail, double precision, tolerance {} eV/Å", best_block,
        ways.legs ? fmt::format("no inertia (velocity to 0), steps of {} Å, ",
                                number(0.5 * scene.drive.step))
                  : "",
        number(widest), number(0.1 * scene.drive.tolerance));

    cutoffs(scene, all.knobs);
    if (scene.block.model != BlockModel::spectral)
        all.knobs.push_back(layers(ways.dynamic ? "lattice" : best_block));
    all.knobs.push_back(thickness(scene));
    all.knobs.push_back(precision());
    if (ways.dynamic) {
        all.knobs.push_back(timestep(scene, setup.longest_timestep));
        all.knobs.push_back(velocity(scene, at_rest));
        if (scene.drive.damping > 0.0)
            all.knobs.push_back(damping(scene));
        else
            all.notes.emplace_back("drive.damping = 0: there is none to vary");
    }
    const Setting still = ways.dynamic ? Setting{"drive.mode=quasistatic", exact} : Setting{};
    all.knobs.push_back(tolerance(scene, still));
    if (ways.legs) all.knobs.push_back(step(scene, still));
    Knob model{"model", "block model and kind of path", {}, {}, false, std::nullopt, "", ""};
    const auto also = [&](const std::string& block, const std::string& label, Setting setting) {
        setting.push_back("block.model=" + block);
        model.values.push_back({block + ", " + label, setting, 0.0});
    };
    if (ways.dynamic) also("lattice", "in time", {});
    for (const std::string block : {"lattice", "multiscale", "spectral"}) {
        // Finite strain has no spectral block, and only that one can leave friction out.
        if (block == "spectral" ? !spectral : scene.interface.frictionless) continue;
        if (ways.legs) also(block, "quasi-static", at_rest);
        also(block, "zero load alone", {"drive.path=zero-load"});
    }
    all.knobs.push_back(std::move(model));

    if (ways.dynamic)
        all.bases.push_back(
            {"in time", {}, {"interaction", "block", "precision", "timestep", "velocity"}});
    if (ways.legs)
        all.bases.push_back({"quasi-static",
                             {"drive.mode=quasistatic", exact},
                             {"interaction", "precision", "tolerance", "step"}});
    all.bases.push_back({"zero load alone",
                         {"drive.path=zero-load", exact},
                         {"interaction", "precision", "tolerance"}});
    return all;
}

} // namespace asperity
