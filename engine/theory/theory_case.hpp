// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Persson's theory of a scene: converts the scene to a contact that theory/ solves, and the
// solution to `theory` in result.json. Used by `asperity theory`, by every point of a sweep and by
// every run.
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

/// A scene as input of theory/ (Å, eV).
struct TheoryCase {
    theory::AdhesiveContact contact;
    double flat = 0.0;              ///< flat reference of the interface, meV/Å^2
    double delta_gamma = 0.0;       ///< the Δγ used, meV/Å^2
    std::optional<double> q0;       ///< roll-off wavevector, 1/Å; empty for a measured map
    std::optional<double> radius;   ///< radius of the spherical cap, Å
    std::vector<std::string> notes; ///< sentences on clipping and omissions
    std::string origin;             ///< author of a measured surface, if its file names one
};

/// Returns true if the theory of this scene uses the spectrum of the surface instead of the target
/// spectrum.
bool theory_needs_surface(const Case& c);

/// Returns the input of the theory for a case. surface: surface of the case, if it has been made
/// already, at any rms (its spectrum is rescaled). Throws io::SceneError for mistakes in the scene,
/// and if no theory applies.
TheoryCase theory_case(const Case& c, const Surface* surface = nullptr);

/// Results of the theory. Energies in meV/Å^2.
struct TheoryNumbers {
    theory::ContactState state;
    double h_rms = 0.0, rms_slope = 0.0; ///< solved spectrum: Å, -
    double gamma_eff = 0.0;
    double gamma_full_contact = 0.0;
    std::optional<double> theta; ///< E* h^2 q0 / Δγ
    /// JKR pull-off force of a curved scene with γ_eff, eV/Å.
    std::optional<double> jkr_pull_off_force;
};
/// Solves the theory. Throws io::SceneError if the theory has no solution for the scene.
TheoryNumbers solve_theory(const TheoryCase& what);

/// Fills in `theory` of a result.
void record_theory(const TheoryCase& what, const TheoryNumbers& numbers, io::Result& result);

/// Fills in `theory` of a run's result. An error of the theory does not fail the run; its message
/// becomes theory.persson.note.
void add_theory(const Case& c, const Surface& surface, io::Result& result);

} // namespace asperity
