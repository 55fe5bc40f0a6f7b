// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Scenes that can be computed and whose results mean little: notes, which stop nothing.
#include "engine/case/resolving.hpp"

#include "engine/case/contact_estimate.hpp"
#include "theory/spectrum.hpp"

#include "engine/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

namespace asperity {

namespace {

constexpr double steepest = 0.6; ///< rms slope
constexpr double highest = 0.1;  ///< rms height over the edge of the box
constexpr double fastest = 50.0; ///< m/s
constexpr double one_state =
    0.5; ///< rms slope up to which a slow approach ends in the relaxed state
constexpr double usable_part = 0.545; ///< usable part of the stability limit of a flat contact

/// Returns the rms slope of the spectrum of a self-affine surface.
double slope_of_spectrum(const Scene::Surface& s, double edge) {
    const double nyquist = 0.5 * s.sites;
    const double end = std::min(s.q_max.value_or(nyquist), nyquist);
    const double rolloff = std::clamp(s.rolloff, 1.0, end), unit = 2.0 * std::numbers::pi / edge;
    if (!(s.rms > 0.0 && end > 1.0)) return 0.0;
    return theory::Spectrum::self_affine({.q_L = unit,
                                          .q0 = rolloff * unit,
                                          .q1 = end * unit,
                                          .hurst = s.hurst,
                                          .h_rms = s.rms})
        .rms_slope();
}

} // namespace

double usable_timestep(double limit) { return usable_part * limit; }

std::vector<std::string> notes_on_roughness(double rms, double slope, double edge) {
    std::vector<std::string> notes;
    if (slope > steepest)
        notes.push_back(fmt::format("the rms slope is {:.2f}: above {} linear elasticity and the "
                                    "theories do not hold",
                                    slope, steepest));
    if (rms > highest * edge)
        notes.push_back(
            fmt::format("the rms height of {:.4g} Å is above a tenth of the box ({:.4g} "
                        "Å): the result is that of one hill, not of a rough surface; "
                        "take more sites or a smaller rms",
                        rms, edge));
    return notes;
}

std::vector<std::string> notes_on_validity(const Case& c) {
    const Scene& scene = c.scene;
    std::vector<std::string> notes;
    if (scene.surface.kind == SurfaceKind::self_affine) {
        const double slope = slope_of_spectrum(scene.surface, scene.edge());
        notes = notes_on_roughness(scene.surface.rms, slope, scene.edge());
        // Measured on soft blocks: docs/explanation/relaxation.md.
        const bool sideways =
            scene.interface.kind != InterfaceKind::wall && !scene.interface.frictionless;
        const BlockOptions& block = c.simulation.block; // slopes are those of its short waves
        const double young = block.young / units::gigapascal / block.contact_modulus() *
                             contact_modulus_at(block, std::numbers::pi / block.spacing);
        const bool soft = young * slope < 2.0 * c.largest_tension;
        if (c.starts_with(Segment::relax) && sideways && soft && slope > one_state)
            notes.push_back(fmt::format(
                "on slopes as steep as these (rms {:.2f}) a soft block has several states, and a "
                "slow approach may end in another one than the segment \"relax\": "
                "drive.mode = \"quasistatic\" with an approach finds that one, asperity states "
                "lists more",
                slope));
    }
    if (!c.effects.dynamic) return notes;
    if (scene.drive.velocity > fastest)
        notes.push_back(
            fmt::format("drive.velocity = {:.4g} m/s is above {:.4g} m/s: the sound that the drive "
                        "makes changes works and losses more than adhesion does",
                        scene.drive.velocity, fastest));
    const double usable = usable_timestep(c.longest_timestep);
    if (scene.drive.timestep > usable)
        notes.push_back(fmt::format("drive.timestep = {:.4g} fs is above {:.2g} fs, the longest "
                                    "that is usable: pressed sites vibrate faster than those of a "
                                    "flat contact, which is unstable from {:.3g} fs on",
                                    scene.drive.timestep, usable, c.longest_timestep));
    return notes;
}

} // namespace asperity
