// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Options of Persson's theory.
#pragma once

#include "theory/area_factor.hpp"

#include <optional>

namespace asperity {

using theory::AreaFactor;
/// Spectrum used by the theory: the scene's power law, or the spectrum of the surface that was
/// made.
enum class TheorySpectrum { target, realised };

/// Options of Persson's theory.
struct TheoryOptions {
    std::optional<double> delta_gamma; ///< meV/Å^2; empty: the flat reference
    double beta = 0.45;                ///< correction to the elastic energy
    /// Relation of the true area to the slope; empty: "none" over a wall, "gaussian" over atoms.
    std::optional<AreaFactor> area_factor;
    TheorySpectrum spectrum = TheorySpectrum::target;
    bool clip = true; ///< clip the target spectrum at Nyquist
};

} // namespace asperity
