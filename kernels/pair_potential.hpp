// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The pair potentials of the interface (docs/explanation/model.md):
//
//     V(r) = V0(r) - V0(r_c)  for r < r_c,   0 beyond.
//
// The force is the derivative of V: the energy is continuous at the cutoff, and the force has the
// small step V0'(r_c). Distances below closest() are replaced by closest(), so that overlapping
// atoms at a start give a large finite force, which the guard of the time step detects.
//
// A potential is a struct P of numbers (lennard_jones.hpp, morse.hpp, tabulated.hpp) in the list
// PairPotential below, with the members
//   name, parameters()    keys of scenes, in addition to the cutoff
//   zero(), minimum(), inflection()   distances of V0 = 0, V0' = 0, V0'' = 0, Å. A site is in
//                         contact with an atom that is nearer than the inflection
//   depth(), closest()    eV, Å
//   shift()               V0(r_c), in units of Terms::energy_scale
//   has_tail              true if Terms have a moment(): for the tail and for a smeared wall
//   Terms<V>              the formulas for values of type V (number.hpp): begin() computes the slow
//                         part for one r^2 or two; force() is -V0'/r in units of force_scale, and
//                         leaves its last operation, a b - c, to the caller, who may mask it;
//                         energy() is V0 in units of energy_scale; bend() is (V0'/r)'/r in units of
//                         force_scale; moment() the integral of V0 r dr from r to infinity, in
//                         units of energy_scale and square lengths. All but begin() take the result
//                         of begin(), and r^2.
//
// Units: Å, eV.
#pragma once

#include "kernels/lennard_jones.hpp"
#include "kernels/morse.hpp"
#include "kernels/tabulated.hpp"

#include <numbers>
#include <variant>

namespace asperity {

using PairPotential = std::variant<LennardJones, Morse, Tabulated>;

/// V0 and its derivatives at a distance; V0'' = slope + r^2 bend.
struct PairDerivatives {
    double energy; ///< V0, eV
    double slope;  ///< V0'/r, eV/Å^2
    double bend;   ///< (V0'/r)'/r, eV/Å^4
};

/// A potential for single pairs of plain numbers, with the formulas of the sweeps.
template <class P>
struct Pair {
    typename P::template Terms<double> terms;
    double cutoff, closest, shift;

    explicit Pair(const P& p)
        : terms(p, 1.0), cutoff(p.cutoff), closest(p.closest()),
          shift(terms.energy_scale * p.shift()) {}

    /// Returns V0 without a cutoff, eV.
    ASPERITY_INLINE double unshifted(double r2) const {
        const double at = held(r2);
        return terms.energy_scale * terms.energy(terms.begin(at), at);
    }
    /// Returns the integral of V0 r dr from r to infinity, eV Å^2.
    ASPERITY_INLINE double moment(double r2) const {
        return terms.energy_scale * terms.moment(terms.begin(r2), r2);
    }
    /// Returns V, eV.
    ASPERITY_INLINE double energy(double r2) const {
        return r2 < cutoff * cutoff ? unshifted(r2) - shift : 0.0;
    }
    /// Returns -V'/r, eV/Å^2, whose product with the distance vector is the force.
    ASPERITY_INLINE double force_over_distance(double r2) const {
        return r2 < cutoff * cutoff ? -derivatives(r2).slope : 0.0;
    }
    /// Returns V0 and its derivatives without a cutoff.
    ASPERITY_INLINE PairDerivatives derivatives(double r2) const {
        const double at = held(r2), begun = terms.begin(at);
        const double force =
            terms.force(begun, at, [](double a, double b, double c) { return fms(a, b, c); });
        return {terms.energy_scale * terms.energy(begun, at), -terms.force_scale * force,
                terms.force_scale * terms.bend(begun, at)};
    }

private:
    ASPERITY_INLINE double held(double r2) const { return max(r2, closest * closest); }
};

/// Continuum correction for the pairs beyond the cutoff (scene: interface.tail).
///
/// Beyond the cutoff a site at height g over the substrate's local mean plane interacts with a
/// plane of n atoms per area; within the cutoff the shift of the potential is removed. With c =
/// max(r_c, |g|):
///
///     U(g) = 2 pi n int_c^infinity V0(r) r dr  +  pi n (r_c^2 - g^2)_+ V0(r_c)
///
/// -dU/dg = 2 pi n g V0(c) is the force of the plane's atoms beyond the cutoff: continuous at g =
/// r_c.
template <class P>
struct Tail {
    Pair<P> pair;
    double plane; ///< 2 pi n, 1/Å^2

    /// Makes the correction for a plane. density: n, atoms per Å^2.
    Tail(const P& p, double density) : pair(p), plane(2.0 * std::numbers::pi * density) {}

    /// Returns the energy U of a site, eV. gap: g, Å.
    ASPERITY_INLINE double energy(double gap) const {
        const double inside = max(pair.cutoff * pair.cutoff - gap * gap, 0.0);
        return plane * (pair.moment(beyond(gap)) + 0.5 * inside * pair.shift);
    }
    /// Returns the force -dU/dg on a site, eV/Å. gap: g, Å.
    ASPERITY_INLINE double force(double gap) const {
        return plane * gap * pair.unshifted(beyond(gap));
    }

private:
    /// Returns c^2.
    ASPERITY_INLINE double beyond(double gap) const {
        return max(gap * gap, pair.cutoff * pair.cutoff);
    }
};

// Properties of any potential, Å.
inline double cutoff_of(const PairPotential& potential) {
    return std::visit([](const auto& p) { return p.cutoff; }, potential);
}
inline double closest_of(const PairPotential& potential) {
    return std::visit([](const auto& p) { return p.closest(); }, potential);
}
inline double zero_of(const PairPotential& potential) {
    return std::visit([](const auto& p) { return p.zero(); }, potential);
}
inline double minimum_of(const PairPotential& potential) {
    return std::visit([](const auto& p) { return p.minimum(); }, potential);
}
/// Returns the distance below which a site is in contact with an atom.
inline double contact_distance(const PairPotential& potential) {
    return std::visit([](const auto& p) { return p.inflection(); }, potential);
}

} // namespace asperity
