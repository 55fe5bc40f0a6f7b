// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Two flat surfaces at a separation u: the start of the renormalised theory (renormalised.hpp).
//
// Atoms. A block site sees the substrate atoms in rings: `density` atoms per area of the interface
// at the lateral distance R. With V(r) the pair energy, r² = R² + u², the energy per area is
//     φ(u) = Σ_R density V(r),
// and what waves of displacement need is, ring by ring, V, ∂²V/∂R∂u and half the lateral Laplacian
// ½ (V_RR + V_R/R). Sites over hollows have rings at R² = (i² + j²) a²/4 with i, j odd; where the
// two lattices differ every registry occurs and the sums become integrals over R.
//
// Wall. The energy is a function of the gap below each site: one ring at R = 0.
//
// Units: any consistent set.
#pragma once

#include <functional>
#include <vector>

namespace asperity::theory {

/// A pair at a distance: V0, V0'/r and (V0'/r)'/r.
struct PairTerms {
    double energy = 0, first = 0, second = 0;
};

/// V(r) = V0(r) - V0(r_c) for r < r_c, zero beyond; with `tail` neither cut nor shifted.
struct PairInteraction {
    std::function<PairTerms(double)> at; ///< of r² [length²]
    double zero = 0;                     ///< V0 = 0 [length]
    double minimum = 0;                  ///< V0' = 0
    double inflection = 0;               ///< V0'' = 0: nearer is contact
    double cutoff = 0;                   ///< r_c
    bool tail = false;
};

class FlatInterface {
public:
    /// What one ring gives at a separation, per area.
    struct Terms {
        double energy = 0;   ///< V [energy/length²]
        double bend = 0;     ///< ∂²V/∂u² [energy/length⁴]; not the kink at a cutoff
        double tilt = 0;     ///< ∂²V/∂R∂u [energy/length⁴]
        double sideways = 0; ///< ½ (V_RR + V_R/R) [energy/length⁴]
    };

    /// Sites over the hollows of a square lattice of spacing a.
    static FlatInterface hollow_sites(const PairInteraction& pair, double a);
    /// Block of spacing a over a substrate of spacing b, averaged over all registries.
    static FlatInterface all_registries(const PairInteraction& pair, double a, double b);
    /// A law of the gap: energy per area, zero beyond `reach`, repulsive at `closest`. A site
    /// is in contact below `contact`.
    static FlatInterface wall(std::function<double(double)> energy, double closest, double reach,
                              double contact);

    [[nodiscard]] const std::vector<double>& rings() const { return radii_; } ///< R [length]
    [[nodiscard]] bool has_atoms() const { return !wall_; }
    [[nodiscard]] Terms terms(int ring, double u) const;
    [[nodiscard]] double energy(double u) const; ///< φ(u) [energy/length²]

    /// Δγ = -min φ, where it is, and where φ″ = 0 beyond it: the largest tension.
    [[nodiscard]] double work_of_adhesion() const { return depth_; }
    [[nodiscard]] double separation() const { return separation_; }
    [[nodiscard]] double inflection() const { return inflection_; }
    [[nodiscard]] double largest_tension() const { return tension_; } ///< φ′ there [stress]
    [[nodiscard]] double closest() const { return closest_; } ///< smallest u worth looking at
    [[nodiscard]] double reach() const { return reach_; }     ///< φ = 0 beyond

    /// Fraction of sites in contact at the separation u of a surface whose slopes are Gaussian with
    /// the mean square `slope_variance`: over atoms, the nearest of the four corners below a site
    /// is closer by (a/2)(|∂h/∂x| + |∂h/∂y|) than on the flat.
    [[nodiscard]] double contact(double u, double slope_variance) const;

    /// c of Δγ(s) = Δγ (1 - c s), s the mean square slope: what tilting both surfaces costs at the
    /// minimum of φ, to second order. Sites stay over their hollows, or slide to where c is least;
    /// then c = -1/2 would be the area that a slope adds. 0 for a wall.
    [[nodiscard]] double tilt_cost(bool sliding) const;

private:
    FlatInterface() = default;
    /// Once there are rings up to the cutoff: the tail, of so many atoms for each area, and all
    /// else. sideways2: mean square distance of a site from the nearest atom, along the surface.
    void complete(double per_area, double sideways2);
    void find_minimum();

    std::vector<double> radii_, densities_;
    PairTerms pair(double r2) const;

    PairInteraction pair_;
    double shift_ = 0; ///< V0(r_c)
    std::function<double(double)> wall_;
    double closest_ = 0, reach_ = 0, contact_ = 0, spacing_ = 0;
    double depth_ = 0, separation_ = 0, inflection_ = 0, tension_ = 0;
};

} // namespace asperity::theory
