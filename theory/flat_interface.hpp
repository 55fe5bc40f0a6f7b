// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Two flat surfaces of atoms at a separation u: the start of the renormalised theory
// (python/asperity/theories/renormalised.py). The substrate atoms around a block site form rings:
// `density` atoms per area of the interface at the lateral distance R. With V(r) the pair energy,
// r² = R² + u², the energy per area is
//     φ(u) = Σ_R density V(r).
// Sites over hollows have rings at R² = (i² + j²) a²/4 with i, j odd; if the two lattices differ,
// every registry occurs and the sums become integrals over R. Units: any consistent set.
#pragma once

#include <functional>
#include <vector>

namespace asperity::theory {

/// Terms of a pair at a distance: V0, V0'/r and (V0'/r)'/r.
struct PairTerms {
    double energy = 0, first = 0, second = 0;
};

/// Pair interaction V(r) = V0(r) - V0(r_c) for r < r_c, zero beyond; with `tail` neither cut nor
/// shifted.
struct PairInteraction {
    std::function<PairTerms(double)> at; ///< terms of V0 at r² [length²]
    double zero = 0;                     ///< distance of V0 = 0 [length]
    double minimum = 0;                  ///< distance of V0' = 0
    double inflection = 0;               ///< distance of V0'' = 0, below which a site is in contact
    double cutoff = 0;                   ///< r_c
    bool tail = false;

    /// Returns the terms of V at r², without the kink at the cutoff.
    [[nodiscard]] PairTerms operator()(double r2) const;
};

/// Two flat surfaces of atoms, described by the rings of atoms around a site.
struct FlatInterface {
    /// A ring of atoms.
    struct Ring {
        double radius, density; ///< R [length], per area of a site [1/length⁴]
    };

    /// Returns the interface of sites over the hollows of a square lattice of spacing a.
    static FlatInterface hollow_sites(const PairInteraction& pair, double a);
    /// Returns the interface of a block of spacing a over a substrate of spacing b, averaged over
    /// all registries.
    static FlatInterface all_registries(const PairInteraction& pair, double a, double b);

    PairInteraction pair;
    std::vector<Ring> rings;
    double spacing = 0;  ///< lattice spacing of the substrate
    double contact = 0;  ///< separation below which a site is in contact
    double furthest = 0; ///< largest distance at which atoms interact

    [[nodiscard]] double energy(double u) const; ///< returns φ(u) [energy/length²]

    /// Returns c of Δγ(s) = Δγ (1 - c s), s the mean square slope: the cost of tilting both
    /// surfaces at the separation u of the minimum of φ, to second order. Sites stay over their
    /// hollows, or, if `sliding`, move to the place with the smallest c. (c = -1/2 would correspond
    /// to the additional area of a slope.)
    [[nodiscard]] double tilt_cost(double u, bool sliding) const;
};

} // namespace asperity::theory
