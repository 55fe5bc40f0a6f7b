// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The renormalised theory of adhesive contact: what roughness leaves of the potential of two flat
// surfaces (derivation, assumptions and comparison with simulations: docs/explanation/theory.md).
//
// φ(u) is the energy per area at the mean separation u. Roughness is taken in shells of wavevectors
// from the finest to the coarsest. A shell of height variance dh² = 2π q C(q) dq is answered by the
// block with the wave that minimises the energy to second order, and what is left is a new φ:
//     dφ/dh² = ½ [ S + 2D - (S + D)² / (S + φ″) ],
//     dχ/dh² = ½ [ (S + D) / (S + φ″) ]² χ″,       χ: any area observable, and V of each ring R
//     D_q(u) = Σ_R V_uu (1 - J0(qR)) - gain,       zero for a wall
//     gain   = max over |v| <= uq of κ v - ½ K v², κ = Σ_R V_Ru J1(qR), K = S_xx + φ_tt
// S: stiffness of the block's surface for a wave; without friction 1 / (S⁻¹)_zz and no gain, with
// it S_zz - S_xz² / (S_xx + max(φ_tt, 0)). At the end, at the load p,
//     p = -φ′(u),  γ_eff = -φ(u),  contact fraction = χ(u),  largest tension = max φ′.
//
// Numerics: unknowns on a grid in u that is fine around the minimum of the flat φ and widens
// outwards; two implicit stages a step (order 2, L-stable); each stage by Newton's method on a
// tridiagonal system. The right side is concave in φ″ and continued by its tangent below φ″ = -S,
// so Newton's method converges from anywhere. Steps and grid are halved together and extrapolated
// until the error, the distance between the last two extrapolations, meets the tolerance.
//
// Units: any consistent set.
#pragma once

#include <optional>
#include <vector>

#include "theory/flat_interface.hpp"
#include "theory/spectrum.hpp"

namespace asperity::theory {

/// Stiffness of the block's surface for a wave along x, averaged over directions: pressure over
/// displacement [stress/length].
struct WaveStiffness {
    double q = 0;       ///< [1/length]
    double zz = 0;      ///< normal
    double xx = 0;      ///< along the wave
    double xz = 0;      ///< |coupling| of the two; a normal pressure pulls sites towards it
    double free_zz = 0; ///< 1 / (S⁻¹)_zz: normal, without lateral tractions
};

/// S(q) by a table, ascending in q; S/q is interpolated linearly and constant beyond the ends.
class StiffnessTable {
public:
    explicit StiffnessTable(std::vector<WaveStiffness> waves);
    /// Half-space: free_zz = E* q/2, xz/zz = (1-2ν) / (2(1-ν)).
    static StiffnessTable half_space(double contact_modulus, double poisson_ratio);
    [[nodiscard]] WaveStiffness operator()(double q) const;

private:
    std::vector<WaveStiffness> waves_; // divided by q
};

struct RoughInterface {
    Spectrum spectrum;
    FlatInterface flat;
    StiffnessTable stiffness;
    bool friction = true;  ///< sites follow lateral forces (a wall has none)
    double pressure = 0;   ///< p, positive pressing [stress]
    bool ensemble = false; ///< the spectrum is that of an ensemble and not of one surface's waves
};

struct RenormalisedOptions {
    double tolerance = 1e-4;  ///< on γ_eff/Δγ and on the contact fraction
    double useful = 1e-2;     ///< no answer if one of these errors is larger on the finest grid
    int max_refinement = 3;   ///< halvings beyond the first two grids
    double most_work = 3.5e8; ///< no grid of more values (shells, points, observables, iterations)
    int steps = 14;           ///< of the coarsest grid in ln q; others follow the rms
    double spacing =
        0.125; ///< of the coarsest grid at the minimum, over its distance to inflection
};

/// Within these 19 of 20 simulated surfaces lie (calibrated; docs/explanation/theory.md has how).
/// With N waves of equal variance (Spectrum::waves), s the rms slope, T and F the state's tilt_cost
/// and stiffening, A its contact fraction:
///     γ_eff/Δγ: √[ (m (1 - γ_eff/Δγ)/√N)² + (3.2 s² T)² + (1.2 F)² ],      m = 0.5, ensemble 1.5
///     A:        √[ (m (1 - γ_eff/Δγ)/√N)² + (1.6 s²)² A (1 - A) ],         m = 0.8, ensemble 1.1
/// T, F and the second term of A are those of atoms; a wall has none of them. Each has the
/// numerical error added.
struct ExpectedError {
    double gamma_ratio = 0, contact = 0;
};

struct RenormalisedState {
    double gamma_eff = 0;                            ///< -φ(u) [energy/area]
    double gamma_ratio = 0;                          ///< over -min φ of the flat interface
    double contact_fraction = 0;                     ///< χ(u)
    double separation = 0;                           ///< u, of the mean planes [length]
    double tension = 0;                              ///< max φ′ [stress]
    double gamma_ratio_error = 0, contact_error = 0; ///< estimated, see above
    bool converged = true;                           ///< both errors within the tolerance
    /// Of γ_eff/Δγ, to first order in each: what tilt has cost before sites slide, and what lateral
    /// forces have cost by a stiffer block. Zero for a wall.
    double tilt_cost = 0, stiffening = 0;
    std::optional<ExpectedError> expected; ///< none under a pressure
};

/// InvalidInput for what makes no sense; NoSolution for a pull beyond the tension that is borne,
/// for errors above `useful`, and for slopes at which more than the work of adhesion would come
/// out.
[[nodiscard]] RenormalisedState solve(const RoughInterface& rough,
                                      const RenormalisedOptions& options = {});

/// φ and χ after all roughness, on one grid (`refinement` halvings), for plots and tests.
struct RenormalisedPotential {
    std::vector<double> separation, energy, contact;
};
[[nodiscard]] RenormalisedPotential renormalised_potential(const RoughInterface& rough,
                                                           int refinement,
                                                           const RenormalisedOptions& options = {});

} // namespace asperity::theory
