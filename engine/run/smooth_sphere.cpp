// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/run/smooth_sphere.hpp"

#include "engine/run/theory_case.hpp"
#include "engine/units.hpp"
#include "io/run_h5.hpp"
#include "theory/half_space.hpp"
#include "theory/periodic_sphere.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <numbers>
#include <utility>

namespace asperity {

namespace {

theory::PeriodicSphere smooth_sphere(const Case& c) {
    const Scene& scene = c.scene;
    return {{*scene.surface.radius,
             theory::contact_modulus(scene.block.young * units::gigapascal, scene.block.poisson),
             c.flat.work_of_adhesion / units::milli_per_unit},
            scene.edge(),
            c.flat.separation};
}

/// The same of the work of adhesion (meV/Å²) and at the separation that roughness leaves.
theory::PeriodicSphere roughened(theory::PeriodicSphere sphere, double gamma, double separation) {
    sphere.sphere.work_of_adhesion = gamma / units::milli_per_unit;
    sphere.separation = separation;
    return sphere;
}

double largest_tension(const Case& c) { return c.flat.largest_tension * units::gigapascal; }

/// States at these parameters, as far as the theory has them and no wider than this radius.
template <class State>
SphereCurve curve(const char* name, const std::string& label, double widest,
                  const std::vector<double>& parameters, const State& state) {
    SphereCurve curve{name, label, {}, {}};
    for (const double p : parameters)
        try {
            const theory::PeriodicState s = state(p);
            if (s.contact.radius > widest) continue;
            curve.height.push_back(s.height);
            curve.force.push_back(s.contact.force);
        } catch (const std::exception&) { // beyond what first-order images describe
        }
    return curve;
}

std::vector<double> spaced(double from, double to, int count) {
    std::vector<double> list;
    for (int i = 0; i < count; ++i)
        list.push_back(from + (to - from) * i / (count - 1));
    return list;
}

} // namespace

std::vector<SphereCurve> sphere_curves(const Case& c,
                                       const std::optional<RenormalisedNumbers>& rough,
                                       double largest_force) {
    const theory::PeriodicSphere sphere = smooth_sphere(c);
    theory::PeriodicSphere alone = sphere;
    alone.period *= 1e6;
    double widest = 0.0;
    for (const double a : spaced(0.0, 0.5 * sphere.period, 2000))
        if (theory::jkr::at_radius(sphere.sphere, a).force <
            1.1 * std::max(0.0, largest_force) + 1e-9)
            widest = a;
    const std::vector<double> radii = spaced(1e-3 * widest, widest, 300);
    std::vector<double> ratios;
    for (const double x : spaced(-9.0, 5.0, 400))
        ratios.push_back(1.0 + std::exp(x));
    const std::string whose = "smooth sphere, ";
    std::vector<SphereCurve> curves = {
        curve("jkr", whose + "JKR", widest, radii,
              [&](double a) { return theory::jkr_at_radius(alone, a); }),
        curve("jkr_images", whose + "JKR with images", widest, radii,
              [&](double a) { return theory::jkr_at_radius(sphere, a); }),
        curve("maugis_images", whose + "Maugis-Dugdale with images", widest, ratios,
              [&](double m) { return theory::maugis_at_ratio(sphere, largest_tension(c), m); })};
    if (rough) {
        const theory::PeriodicSphere left =
            roughened(sphere, rough->gamma_eff, rough->separation.value_or(c.flat.separation));
        curves.push_back(
            curve("renormalised", "theory: Maugis-Dugdale with images and the renormalised law",
                  widest, ratios, [&](double m) {
                      return theory::maugis_at_ratio(left, rough->tension * units::gigapascal, m);
                  }));
    }
    return curves;
}

std::optional<RenormalisedNumbers> rough_sphere(const Case& c, const Surface& surface) {
    const Scene& scene = c.scene;
    if (!scene.surface.radius || !scene.theory.renormalised || !(surface.statistics.rms > 0.0))
        return std::nullopt;
    try {
        const TheoryCase what = theory_case(c, &surface);
        auto numbers = solve_renormalised(*what.renormalised).numbers;
        return numbers && numbers->gamma_eff > 0.0 ? numbers : std::nullopt;
    } catch (const std::exception&) { // theory.note of the result has the reason
        return std::nullopt;
    }
}

void add_sphere(const Case& c, io::Result& result) {
    const Scene& scene = c.scene;
    if (!scene.surface.radius) return;
    if (const auto fraction = result.number("contact_fraction"))
        result.set("contact_radius.zero_load",
                   scene.edge() * std::sqrt(*fraction / std::numbers::pi));
    const double R = *scene.surface.radius;
    const auto as_work = [&](double force) {
        return units::milli_per_unit * theory::jkr::work_from_pull_off(force, R);
    };
    const bool pressed = c.starts_with(Segment::zero_load) && scene.drive.load != 0.0;
    if (const auto binding = result.number("binding_energy"); binding && !pressed) {
        const double energy = *binding / units::milli_per_unit * scene.edge() * scene.edge();
        const double modulus =
            theory::contact_modulus(scene.block.young * units::gigapascal, scene.block.poisson);
        result.set("jkr.zero_load", units::milli_per_unit *
                                        theory::jkr::work_from_binding_energy(energy, R, modulus));
    }
    try {
        const theory::PeriodicSphere sphere = smooth_sphere(c);
        const double stress = largest_tension(c);
        result.set("sphere.jkr", as_work(theory::jkr::pull_off(sphere.sphere).force));
        result.set("sphere.maugis_parameter", theory::maugis_parameter(sphere.sphere, stress));
        result.set("sphere.jkr_images", as_work(theory::jkr_pull_off(sphere).contact.force));
        result.set("sphere.maugis_images",
                   as_work(theory::maugis_pull_off(sphere, stress).contact.force));
        const auto gamma = result.number("theory.renormalised.gamma_eff");
        const auto tension = result.number("theory.renormalised.tension");
        if (!gamma || !tension || !(*gamma > 0.0 && *tension > 0.0)) return;
        const theory::PeriodicSphere rough = roughened(sphere, *gamma, c.flat.separation);
        const double left = *tension * units::gigapascal;
        result.set("sphere.renormalised_parameter", theory::maugis_parameter(rough.sphere, left));
        result.set("sphere.renormalised",
                   as_work(theory::maugis_pull_off(rough, left).contact.force));
    } catch (const std::exception& error) { // a contact as wide as the box
        result.set("sphere.note", error.what());
    }
}

void write_sphere_curves(io::Hdf5File& file, const Case& c,
                         const std::optional<RenormalisedNumbers>& rough) {
    if (!c.scene.surface.radius || !(c.flat.work_of_adhesion > 0.0)) return;
    const std::vector<double> force = file.read<double>("/series/force");
    if (force.size() < 2) return;
    const double largest = *std::max_element(force.begin(), force.end());
    for (const SphereCurve& curve : sphere_curves(c, rough, largest)) {
        if (curve.height.empty()) continue;
        const std::string group = "/curves/" + curve.name;
        io::write_described(file, group + "/height", {curve.height.size()}, curve.height);
        io::write_described(file, group + "/force", {curve.force.size()}, curve.force);
        file.write_attribute(group, "label", curve.label);
    }
}

} // namespace asperity
