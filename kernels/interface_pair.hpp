// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Pairs of the three sweeps over atoms (interface_lattice.cpp, interface_rows.cpp,
// interface_cells.cpp), for packs and for the threads of a device. F is the family of values (Simd,
// Scalar), T the precision of the pairs (double, or float in the lattice sweep on packs).
//
// Without the energy a Lennard-Jones pair takes seven and a half fused multiplications (one for
// r^2, one and a half for t, four for the force, one for its z component), plus those of the
// lateral components. The unit of length of pairs is fixed_quantum for float, Å for double.
#pragma once

#include "kernels/interface_sites.hpp"
#include "kernels/pair_potential.hpp"
#include "kernels/substrates.hpp"
#include "kernels/variant.hpp"

#include <type_traits>

namespace asperity::ASPERITY_VARIANT {

/// Unit of length of pairs, Å.
template <class T>
inline constexpr double length_unit = std::is_same_v<T, float> ? fixed_quantum : 1.0;

/// Constants of the potential P, one copy in every lane.
template <class F, class T, class P>
struct PairTerms {
    using V = typename F::template Of<T>;
    typename P::template Terms<V> potential;
    V r2_floor, r2_cut, shift;
    double force_scale, energy_scale, cutoff, closest, contact_r2;

    explicit PairTerms(const P& p)
        : potential(p, length_unit<T>), r2_floor(squared(p.closest() * p.closest())),
          r2_cut(squared(p.cutoff * p.cutoff)), shift(static_cast<T>(p.shift())),
          force_scale(potential.force_scale), energy_scale(potential.energy_scale),
          cutoff(p.cutoff), closest(p.closest()), contact_r2(p.inflection() * p.inflection()) {}

    /// Returns -V'/r in units of force_scale, zero beyond the cutoff. begun: result of begin();
    /// masked: false omits the comparison with the cutoff, if all of r2 are known to be within it.
    template <bool masked>
    ASPERITY_INLINE V force(V begun, V r2, std::bool_constant<masked>) const {
        // Some potentials use r^2 here; Lennard-Jones does not, and the compiler drops the maximum.
        return potential.force(
            begun, max(r2, r2_floor), [&](V a, V b, V c) __attribute__((always_inline)) {
                if constexpr (masked)
                    return fms_where_less(r2, r2_cut, a, b, c);
                else
                    return fms(a, b, c);
            });
    }
    /// Returns V in units of energy_scale; arguments as for force().
    ASPERITY_INLINE V energy(V begun, V r2) const {
        return select(r2 < r2_cut, potential.energy(begun, max(r2, r2_floor)) - shift, V(T(0)));
    }
    /// Computes the slow part of two pairs at the squared distances a and b. close: distances may
    /// be below closest().
    template <bool close>
    ASPERITY_INLINE void begin(V a, V b, V& of_a, V& of_b) const {
        potential.begin(held<close>(a), held<close>(b), of_a, of_b);
    }
    /// Computes the slow part of one pair.
    template <bool close>
    ASPERITY_INLINE V begin(V a) const {
        return potential.begin(held<close>(a));
    }

    /// Converts a squared distance to Å^2; returns no_pair beyond the cutoff.
    ASPERITY_INLINE double nearest(T r2) const {
        return r2 < r2_cut[0] ? r2 * (length_unit<T> * length_unit<T>) : no_pair;
    }

private:
    template <bool close>
    ASPERITY_INLINE V held(V r2) const {
        return close ? max(r2, r2_floor) : r2;
    }
    static T squared(double in_square_angstrom) {
        return static_cast<T>(in_square_angstrom / (length_unit<T> * length_unit<T>));
    }
};

/// Converts lengths from Å to the unit of length of pairs.
template <class F, class T>
ASPERITY_INLINE typename F::template Of<T> lengths(const double* from) {
    using V = typename F::template Of<T>;
    alignas(64) T lane[V::width];
    for (int i = 0; i < V::width; ++i)
        lane[i] = static_cast<T>(from[i] * (1.0 / length_unit<T>));
    return V::load(lane);
}

/// Heights of sites, relative to those of the same number of atoms.
template <class F, class T>
struct SiteHeight {
    using Atom = double;
    using V = typename F::template Of<double>;
    V z;
    ASPERITY_INLINE explicit SiteHeight(const double* from) : z(V::load(from)) {}
    ASPERITY_INLINE explicit SiteHeight(double same) : z(same) {}
    ASPERITY_INLINE V above(const double* atoms) const { return z - V::load(atoms); }
};
} // namespace asperity::ASPERITY_VARIANT
