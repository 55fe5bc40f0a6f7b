// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Persson's theory of a scene: from the keys of the scene to a contact that theory/ can solve, and
// from the solution to `theory` in result.json, for `asperity theory`, every point of a sweep and
// the `theory` of every run.
//
// Choices and their sources:
//   C(q)   target: the scene's power law, clipped at the grid's Nyquist wavevector like the surface
//          (theory.clip). realised: the ring averages of the surface made, each ring's variance
//          kept, so that the rms is that of the map. A measured map has no target: always realised.
//   Δγ     "flat": flat on flat with this scene's potential, cutoff and lattices; or the number.
//   E*     E/(1-ν²): the substrate is rigid.
//   p      drive.load, positive pressing.
#pragma once

#include "engine/case/case.hpp"
#include "engine/scene/surface.hpp"
#include "io/result.hpp"
#include "theory/persson.hpp"

#include <optional>
#include <string>
#include <vector>

namespace asperity {

/// The scene in the terms of theory/ (Å, eV).
struct TheoryCase {
    theory::AdhesiveContact contact;
    double flat = 0.0;              ///< flat reference of the interface, meV/Å^2
    double delta_gamma = 0.0;       ///< the Δγ used, meV/Å^2
    std::optional<double> q0;       ///< roll-off wavevector, 1/Å; a measured map has none
    std::optional<double> radius;   ///< radius of the spherical cap, Å
    std::vector<std::string> notes; ///< sentences on clipping and omissions
    std::string origin;             ///< owner of a measured surface, if its file names one
};

/// Returns true if the theory of this scene uses the surface itself, not the target spectrum.
bool theory_needs_surface(const Case& c);

/// Returns the contact of a scene. surface: the case's, if it has been made already (at any rms:
/// its spectrum is scaled to that of the scene). Throws io::SceneError, also if no theory applies.
TheoryCase theory_case(const Case& c, const Surface* surface = nullptr);

/// Results of the theory. Energies in meV/Å^2.
struct TheoryNumbers {
    theory::ContactState state;
    double h_rms = 0.0, rms_slope = 0.0; ///< solved spectrum: Å, -
    double gamma_eff = 0.0;
    double gamma_full_contact = 0.0;
    std::optional<double> theta; ///< E* h^2 q0 / Δγ
    /// JKR pull-off force of the curved scene with γ_eff, eV/Å
    std::optional<double> jkr_pull_off_force;
};
/// Solves the theory. Throws io::SceneError if the theory cannot work with the scene.
TheoryNumbers solve_theory(const TheoryCase& what);

/// Fills in `theory` of a result.
void record_theory(const TheoryCase& what, const TheoryNumbers& numbers, io::Result& result);

/// Fills in `theory` of a result of a run, which the theory must never make fail: an error becomes
/// theory.persson.note.
void add_theory(const Case& c, const Surface& surface, io::Result& result);

} // namespace asperity
