// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Pairs on SIMD registers, as both sweeps of the interface take them (interface_lattice.cpp,
// interface_rows.cpp). T is the precision of the pairs, double or float.
//
// With t = r_m^2 / r^2 and r_m = 2^(1/6) r0 the potential of a pair is
//
//     V = epsilon t^3 (t^3 - 2) - V0(r_c),    -V'/r = (12 epsilon / r_m^2) (t^7 - t^4).
//
// One division serves two pairs (1/a = b / (ab)): the divider works beside the multiplications, as
// far as the processor can look ahead; so the sweeps begin the next pairs before they finish these.
// Without the energy a pair takes one fused multiplication for r^2, one and a half for t, four for
// the force, one for its z component: seven and a half, and what the lateral components take. Pairs
// in float count lengths in fixed_quantum, in double in Å.
#pragma once

#include "kernels/interface_sweep.hpp"
#include "kernels/simd.hpp"

#include <type_traits>

namespace asperity::ASPERITY_VARIANT {

using Real = Pack<double>;

/// Å in the unit of length of pairs.
template <class T>
inline constexpr double length_unit = std::is_same_v<T, float> ? fixed_quantum : 1.0;

/// Constants of the potential, one copy in every lane where it meets the pairs.
template <class T>
struct PairTerms {
    Pack<T> rm2, r2_floor, r2_cut, shift;
    double force_scale, energy_scale, cutoff, floor, contact_r2;

    explicit PairTerms(const LennardJones& lj)
        : rm2(squared(std::cbrt(2.0) * lj.r0 * lj.r0)), r2_floor(squared(lj.r2_floor())),
          r2_cut(squared(lj.r2_cut())),
          shift(static_cast<T>(LennardJones{1.0, lj.r0, lj.cutoff}.shift())),
          force_scale(12.0 * lj.epsilon / (std::cbrt(2.0) * lj.r0 * lj.r0)),
          energy_scale(lj.epsilon), cutoff(lj.cutoff), floor(std::sqrt(lj.r2_floor())),
          contact_r2(lj.contact_distance() * lj.contact_distance()) {}

    /// -V'/r in units of force_scale, from t; zero beyond the cutoff, which may be left out
    /// (false_type) where all of r2 are known to be within it.
    template <bool masked>
    ASPERITY_INLINE Pack<T> force(Pack<T> t, Pack<T> r2, std::bool_constant<masked>) const {
        const Pack<T> t2 = t * t, t3 = t2 * t, t4 = t2 * t2;
        if constexpr (masked)
            return fms_where_less(r2, r2_cut, t4, t3, t4);
        else
            return fms(t4, t3, t4);
    }
    /// V in units of energy_scale.
    ASPERITY_INLINE Pack<T> energy(Pack<T> t, Pack<T> r2) const {
        const Pack<T> t3 = t * t * t;
        return select(r2 < r2_cut, fms(t3, t3, t3 + t3) - shift, Pack<T>(T(0)));
    }
    /// r_m^2 / a and r_m^2 / b by one division.
    template <bool close>
    ASPERITY_INLINE void inverse(Pack<T> a, Pack<T> b, Pack<T>& ta, Pack<T>& tb) const {
        a = held<close>(a);
        b = held<close>(b);
        const Pack<T> both = rm2 / (a * b);
        ta = b * both;
        tb = a * both;
    }

    /// In Å^2. Atoms beyond the cutoff that were looked at all the same are no neighbours.
    ASPERITY_INLINE double nearest(T r2) const {
        return r2 < r2_cut[0] ? r2 * (length_unit<T> * length_unit<T>) : no_pair;
    }

private:
    template <bool close>
    ASPERITY_INLINE Pack<T> held(Pack<T> r2) const {
        return close ? max(r2, r2_floor) : r2;
    }
    static T squared(double in_square_angstrom) {
        return static_cast<T>(in_square_angstrom / (length_unit<T> * length_unit<T>));
    }
};

/// Lengths in Å, in the unit of length of pairs.
template <class T>
ASPERITY_INLINE Pack<T> lengths(const double* from) {
    alignas(64) T lane[Pack<T>::width];
    for (int i = 0; i < Pack<T>::width; ++i)
        lane[i] = static_cast<T>(from[i] * (1.0 / length_unit<T>));
    return Pack<T>::load(lane);
}

/// The heights of a register of sites, to be compared with those of as many atoms.
template <class T>
struct SiteHeight {
    using Atom = double;
    Pack<double> z;
    static PlaneView<const double> of(const SubstrateHeights& h) { return h.height; }
    ASPERITY_INLINE explicit SiteHeight(const double* from) : z(Real::load(from)) {}
    ASPERITY_INLINE explicit SiteHeight(double same) : z(same) {}
    ASPERITY_INLINE Pack<double> above(const double* atoms) const { return z - Real::load(atoms); }
};
template <>
struct SiteHeight<float> {
    using Atom = std::int32_t;
    PackInt32 z;
    static PlaneView<const std::int32_t> of(const SubstrateHeights& h) { return h.fixed; }
    ASPERITY_INLINE explicit SiteHeight(const double* from) {
        alignas(64) std::int32_t fixed[Pack<float>::width];
        for (int i = 0; i < Pack<float>::width; ++i)
            fixed[i] = to_fixed(from[i]);
        z = PackInt32::load(fixed);
    }
    ASPERITY_INLINE explicit SiteHeight(double same) : z(FloatMask{} + to_fixed(same)) {}
    ASPERITY_INLINE Pack<float> above(const std::int32_t* atoms) const {
        return to_float(z - PackInt32::load(atoms));
    }

private:
    ASPERITY_INLINE static std::int32_t to_fixed(double z) {
        constexpr double round_to_integer = 0x1.8p52;
        return static_cast<std::int32_t>((z * (1.0 / fixed_quantum) + round_to_integer) -
                                         round_to_integer);
    }
};

/// All lanes combined, by halving.
template <int half, class Combine>
ASPERITY_INLINE double halve(Real v, Combine combine) {
    v = combine(v, exchange<half>(v));
    if constexpr (half > 1)
        return halve<half / 2>(v, combine);
    else
        return v[0];
}
ASPERITY_INLINE double lowest(Real v) {
    return halve<Real::width / 2>(v, [](Real a, Real b) { return min(a, b); });
}
ASPERITY_INLINE double total(Real v) {
    return halve<Real::width / 2>(v, [](Real a, Real b) { return a + b; });
}

/// Writes a pack as doubles.
ASPERITY_INLINE void store_wide(Pack<double> a, double* to) { a.store(to); }
ASPERITY_INLINE void store_wide(Pack<float> a, double* to) {
    widen_low(a).store(to);
    widen_high(a).store(to + Real::width);
}

/// A sum in double, lane by lane, of terms of type T.
template <class T>
struct WideSum {
    Real low{0.0};
    ASPERITY_INLINE void add(Real term) { low = low + term; }
    ASPERITY_INLINE double over_lanes() const { return total(low); }
};
template <>
struct WideSum<float> {
    Real low{0.0}, high{0.0};
    ASPERITY_INLINE void add(Pack<float> term) {
        low = low + widen_low(term);
        high = high + widen_high(term);
    }
    ASPERITY_INLINE double over_lanes() const { return total(low + high); }
};

} // namespace asperity::ASPERITY_VARIANT
