// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/theory/theory_case.hpp"

#include "engine/theory/rough_interface.hpp"
#include "engine/units.hpp"
#include "io/error.hpp"
#include "theory/error.hpp"
#include "theory/jkr.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace asperity {

namespace {

using theory::Spectrum;

/// Calls f and turns errors of theory/ into errors of the scene.
template <class F>
auto with_scene_errors(const F& work) {
    try {
        return work();
    } catch (const theory::InvalidInput& error) {
        throw io::SceneError(io::Problem{
            "theory", error.what(), "the scene's keys lead there",
            "look at [surface] (rms, rolloff, q_max), [block] (young, poisson) and [theory]"});
    }
}

/// Returns the power law of the scene, from q_L up to q1 or to the limit of the grid.
Spectrum target_of(const Case& c, TheoryCase& out) {
    const SurfaceOptions& s = c.surface;
    const double q_L = 2.0 * std::numbers::pi / s.length;
    const double nyquist = 0.5 * s.sites;
    double cutoff = s.cutoff;
    if (c.theory.clip && cutoff > nyquist) {
        out.notes.push_back(fmt::format("the spectrum ends at Nyquist, q1 = {:.6g} q_L, like the "
                                        "surface (theory.clip = false: at {:.6g} q_L)",
                                        nyquist, cutoff));
        cutoff = nyquist;
    }
    const double rolloff = std::clamp(s.rolloff, 1.0, cutoff);
    out.q0 = rolloff * q_L;
    if (!(cutoff > 1.0))
        throw io::SceneError(io::Problem{
            c.scene.positions.where("surface.q_max"),
            fmt::format("surface.q_max = {:.6g} leaves the theory no roughness", cutoff),
            "it needs a band of wavevectors from q_L to q1 > q_L",
            "give a larger q_max, more sites, or kind = \"flat\""});
    return Spectrum::self_affine(
        {.q_L = q_L, .q0 = rolloff * q_L, .q1 = cutoff * q_L, .hurst = s.hurst, .h_rms = s.rms});
}

/// Returns ring averages of the map: bin k holds the waves between (k - 1/2) and (k + 1/2) q_L. The
/// first ring starts at q_L, the longest wave there is, and the last ends at Nyquist; each ring has
/// a C with the variance of its waves.
Spectrum realised_of(const Case& c, const Surface& surface, TheoryCase& out) {
    out.origin = surface.origin;
    const auto& bins = surface.statistics.spectrum;
    const double q_unit = 2.0 * std::numbers::pi / surface.length;
    const double nyquist = 0.5 * surface.sites;
    std::vector<double> edges = {q_unit}, C;
    double variance = 0.0;
    for (const SpectrumBin& bin : bins) {
        const double k = std::round(bin.q / q_unit);
        const double upper = std::min(k + 0.5, nyquist) * q_unit;
        const double power = bin.realised * bin.modes * q_unit * q_unit;
        variance += power;
        const double area = std::numbers::pi * (upper * upper - edges.back() * edges.back());
        if (!(area > 0.0)) continue;
        C.push_back(power / area);
        edges.push_back(upper);
    }
    const double rms = surface.statistics.rms;
    if (C.empty() || !(variance > 0.0))
        throw io::SceneError(
            io::Problem{c.scene.positions.where("theory.spectrum"),
                        "theory.spectrum = \"realised\" finds no roughness in the surface",
                        fmt::format("its rms is {:.4g} Å on {} sites", rms, surface.sites),
                        "give a rough surface of at least 4 sites, or kind = \"flat\""});
    out.notes.push_back("the spectrum is that of the surface itself (ring averages)");
    if (const double lost = 1.0 - variance / (rms * rms); lost > 1e-3)
        out.notes.push_back(fmt::format("{:.2g} % of the height variance lies beyond Nyquist, in "
                                        "the corners of the grid, and is not in the theory",
                                        100.0 * lost));
    const bool scaled =
        !c.surface.counter && (c.surface.kind == SurfaceKind::self_affine || c.surface.rms > 0.0);
    Spectrum spectrum = Spectrum::rings(edges, C);
    if (!scaled) return spectrum;
    return spectrum.with_rms_height(c.surface.rms * std::sqrt(variance) / rms);
}

Spectrum spectrum_of(const Case& c, const Surface* surface, TheoryCase& out) {
    const SurfaceOptions& s = c.surface;
    const double q_L = 2.0 * std::numbers::pi / s.length;
    const bool measured = s.kind == SurfaceKind::file || s.counter;
    if (!measured && (s.kind == SurfaceKind::flat || s.rms == 0.0))
        return Spectrum::self_affine(
            {.q_L = q_L, .q0 = q_L, .q1 = 2.0 * q_L, .hurst = 0.8, .h_rms = 0.0});
    if (!theory_needs_surface(c)) return target_of(c, out);
    if (measured && c.theory.spectrum == TheorySpectrum::target)
        out.notes.push_back("a measured map has no target spectrum");
    if (!measured) out.q0 = std::max(1.0, s.rolloff) * q_L;
    if (surface) return realised_of(c, *surface, out);
    return realised_of(c, surface_of(c), out);
}

/// Returns the area factor of the scene. A wall acts on the gap below each site, and so on the
/// projected area.
AreaFactor area_factor_of(const Case& c) {
    const bool wall = c.simulation.interface.wall.has_value();
    return c.theory.area_factor.value_or(wall ? AreaFactor::none : AreaFactor::gaussian);
}

} // namespace

bool theory_needs_surface(const Case& c) {
    const SurfaceOptions& s = c.surface;
    return s.kind == SurfaceKind::file || s.counter ||
           (s.kind == SurfaceKind::self_affine && s.rms > 0.0 &&
            c.theory.spectrum == TheorySpectrum::realised);
}

TheoryCase theory_case(const Case& c, const Surface* surface) {
    if (const NoTheory none = no_theory(c.scene, c.effects); !none.why.empty())
        throw io::SceneError(io::Problem{c.scene.positions.where(none.key),
                                         "no theory applies to this scene", none.why, none.fix});
    TheoryCase out;
    out.flat = c.flat.work_of_adhesion;
    out.delta_gamma = c.theory.delta_gamma.value_or(out.flat);
    out.radius = c.radius();
    with_scene_errors([&] {
        out.contact.spectrum = spectrum_of(c, surface, out);
        out.contact.contact_modulus = c.simulation.block.contact_modulus();
        out.contact.work_of_adhesion = out.delta_gamma / units::milli_per_unit;
        out.contact.pressure = c.simulation.drive.load_force / c.area();
        out.contact.beta = c.theory.beta;
        out.contact.area_factor = area_factor_of(c);
        if (out.contact.area_factor == AreaFactor::lattice && !c.simulation.interface.wall)
            out.contact.tilt_cost =
                flat_interface(c).tilt_cost(c.flat.separation, c.effects.lateral);
        theory::check(out.contact);
    });
    return out;
}

TheoryNumbers solve_theory(const TheoryCase& what) {
    return with_scene_errors([&] {
        TheoryNumbers n;
        const auto& c = what.contact;
        n.h_rms = c.spectrum.rms_height();
        n.rms_slope = c.spectrum.rms_slope();
        n.state = theory::solve(c);
        n.gamma_eff = units::milli_per_unit * n.state.gamma_eff;
        n.gamma_full_contact = units::milli_per_unit * theory::full_contact(c).gamma;
        if (what.q0 && c.work_of_adhesion > 0.0)
            n.theta = c.contact_modulus * n.h_rms * n.h_rms * *what.q0 / c.work_of_adhesion;
        if (what.radius)
            n.jkr_pull_off_force =
                theory::jkr::pull_off_force(std::max(0.0, n.state.gamma_eff), *what.radius);
        return n;
    });
}

void record_theory(const TheoryCase& what, const TheoryNumbers& n, io::Result& result) {
    result.set("theory.persson.gamma_eff", n.gamma_eff);
    result.set("theory.persson.contact_fraction", n.state.area);
    result.set("theory.persson.gamma_full_contact", n.gamma_full_contact);
    result.set("theory.persson.delta_gamma", what.delta_gamma);
    result.set("theory.persson.gamma_eff_error", n.state.gamma_ratio_error * what.delta_gamma);
    result.set("theory.persson.contact_fraction_error", n.state.area_error);
    result.set("theory.persson.elastic_energy", units::milli_per_unit * n.state.elastic_energy);
    result.set("theory.persson.h_rms", n.h_rms);
    result.set("theory.persson.rms_slope", n.rms_slope);
    result.set("theory.persson.theta", n.theta);
    result.set("theory.persson.jkr_pull_off_force", n.jkr_pull_off_force);
    result.set("theory.persson.area_factor", std::string(theory::name(what.contact.area_factor)));
    result.set("theory.persson.status", std::string(theory::name(n.state.status)));
    result.set("theory.persson.converged", n.state.converged);
}

void add_theory(const Case& c, const Surface& surface, io::Result& result) {
    if (const std::string why = no_theory(c.scene, c.effects).why; !why.empty()) {
        result.set("theory.persson.note", why);
        return;
    }
    try {
        const TheoryCase what = theory_case(c, &surface);
        record_theory(what, solve_theory(what), result);
    } catch (const std::exception& error) {
        result.set("theory.persson.note", error.what());
    }
}

} // namespace asperity
