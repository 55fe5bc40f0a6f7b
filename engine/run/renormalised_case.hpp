// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The renormalised theory (theory/renormalised.hpp) of a scene: its interface, the exact stiffness
// of its lattice, and `theory.renormalised` of result.json.
#pragma once

#include "engine/setup/case.hpp"
#include "io/result.hpp"
#include "theory/renormalised.hpp"

#include <optional>
#include <string>

namespace asperity {

/// A pair potential in the terms of theory/.
theory::PairInteraction pair_interaction(const PairPotential& potential, bool tail);

/// The flat interface of the scene.
theory::FlatInterface flat_interface(const Case& c);

/// S(q) of the scene's lattice up to Nyquist, per area, averaged over directions.
theory::StiffnessTable lattice_stiffness(const Case& c);

/// The scene in the terms of theory/ (Å, eV), or why the theory cannot take it.
struct RenormalisedCase {
    std::optional<theory::RoughInterface> rough;
    std::string note;
};
/// realised: the spectrum is that of the surface itself.
RenormalisedCase renormalised_case(const Case& c, const theory::Spectrum& spectrum, bool realised);

/// Energies in meV/Å^2, lengths in Å, stress in GPa.
struct RenormalisedNumbers {
    double gamma_eff = 0.0, gamma_eff_error = 0.0;
    double gamma_eff_ratio = 0.0; ///< over the flat reference of the same interface
    double contact_fraction = 0.0, contact_fraction_error = 0.0;
    /// Of the theory (theory::ExpectedError); none under a load.
    std::optional<double> gamma_eff_expected_error, contact_fraction_expected_error;
    std::optional<double> separation; ///< of the mean planes; none where nothing binds
    double tension = 0.0;             ///< the largest that the rough interface bears
};

/// What the theory says, or why it says nothing.
struct RenormalisedResult {
    std::optional<RenormalisedNumbers> numbers;
    std::string note;
};
RenormalisedResult solve_renormalised(const RenormalisedCase& what);

/// Fills in `theory.renormalised`.
void record_renormalised(const RenormalisedResult& renormalised, io::Result& result);

} // namespace asperity
