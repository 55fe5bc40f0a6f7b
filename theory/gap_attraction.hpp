// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The attraction between the areas that do not touch, which the paper names as the reason why
// simulation lies above theory at large roughness, and leaves undone:
//     γ_with = γ_eff + ∫_0^∞ P(u) w(u) du,     w(u) = -φ(d0 + u).
//
// The readings. P(u) of an adhesive contact is not part of the theory. What is known is the area
// A/A0; without adhesion it would take p_eq = √(2T) erf⁻¹(A/A0) to press that much surface
// together.
//   jkr     press to A/A0 by p_eq, then take the load off down to p with the area held: how
//   Johnson,
//           Kendall and Roberts build their sphere, here at every magnification (separation.hpp)
//   pressed leave it at p_eq: gaps at equal area, with Eq. (5)'s own assumption that the elastic
//   state is
//           set by the area however it came about; gaps too narrow, an upper estimate
// With Δγ = 0 both are Almqvist et al. exactly; at full contact there is no gap. The attraction is
// added at fixed area and shape: first order, without the area that it would itself pull in.
//
// Past the critical roughness A = 0 and there is nothing to perturb about. There `wall_bound`
// instead presses the surfaces together at whatever p_eq gains the most energy,
//     γ_wall = max over p_eq of [ Δγ A* - U_el + ∫ P w du ],
// the DMT way (contact mechanics without adhesion, energies summed afterwards).
#pragma once

#include "theory/persson.hpp"
#include "theory/separation.hpp"
#include "theory/wall_potential.hpp"

namespace asperity::theory {

enum class WallScale {
    absolute,         ///< φ as the pair potential gives it: right far out
    work_of_adhesion, ///< scaled so that w(0) = Δγ: right at touching
};

enum class GapReading { jkr, pressed };

struct GapOptions {
    WallScale scale = WallScale::absolute;
    GapReading reading = GapReading::jkr;
};

struct GapAttraction {
    double gamma_gap = 0;           ///< ∫ P w du [energy/area]
    double gamma_with = 0;          ///< with the attraction across gaps [energy/area]
    double gamma_with_ratio = 0;    ///< over Δγ; 0 if Δγ = 0
    double area = 0;                ///< A/A0
    double equivalent_pressure = 0; ///< p_eq [stress]; infinite at full contact
    double mean_separation = 0;     ///< ū of P(u) [length]
};

/// For a state solved before. `no_contact` gives zeros: see wall_bound.
[[nodiscard]] GapAttraction gap_attraction(const AdhesiveContact& contact,
                                           const ContactState& state, const WallPotential& wall,
                                           const GapOptions& options = {});

/// The DMT-like state of largest binding at zero load; meant for roughness past the critical one.
[[nodiscard]] GapAttraction wall_bound(const AdhesiveContact& contact, const WallPotential& wall,
                                       const GapOptions& options = {});

/// p_eq: the pressure at which the same surfaces without adhesion have this A/A0 (0 < A/A0 < 1).
[[nodiscard]] double equivalent_pressure(const AdhesiveContact& contact, double area);

} // namespace asperity::theory
