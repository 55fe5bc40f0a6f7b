// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The Lennard-Jones potential (12-6). With t = r_m^2 / r^2 and r_m = 2^(1/6) r0:
//
//     V0 = 4 epsilon [(r0/r)^12 - (r0/r)^6] = epsilon t^3 (t^3 - 2)
//     -V0'/r = (12 epsilon / r_m^2) (t^7 - t^4)
//     (V0'/r)'/r = (24 epsilon / r_m^4) (7 t^8 - 4 t^5)
//
// One division serves two pairs (1/a = b / (ab)). Processors execute divisions in parallel with
// independent multiplications, so that the sweeps begin the next pairs before they finish the
// present ones. Without the energy a pair takes one and a half multiplications for t and four for
// the force.
#pragma once

#include "kernels/number.hpp"

#include <cmath>

namespace asperity {

/// Parameters and formulas of the potential (pair_potential.hpp).
struct LennardJones {
    double epsilon = 0.1;  ///< depth, eV
    double r0 = 3.28;      ///< zero crossing, Å
    double cutoff = 13.12; ///< cutoff, Å

    static constexpr const char* name = "lennard-jones";
    static constexpr bool has_tail = true;
    /// Calls visit(name, unit, value, meaning) for every parameter except the cutoff.
    template <class Self, class Visit>
    static void parameters(Self& self, Visit visit) {
        visit("epsilon", "eV", self.epsilon, "depth of the Lennard-Jones well");
        visit("r0", "Å", self.r0, "distance of zero Lennard-Jones energy");
    }

    double zero() const { return r0; }
    double minimum() const { return std::pow(2.0, 1.0 / 6.0) * r0; }
    double inflection() const { return std::pow(26.0 / 7.0, 1.0 / 6.0) * r0; }
    ASPERITY_INLINE double depth() const { return epsilon; }
    /// Returns the distance below which the force is constant, Å; the repulsion there is 10^7
    /// epsilon.
    ASPERITY_INLINE double closest() const { return 0.3 * r0; }
    /// Returns V0(cutoff)/epsilon, computed from the ratio r0/cutoff, which is usually a power of
    /// two.
    double shift() const {
        const double s2 = r0 * r0 / (cutoff * cutoff), s6 = s2 * s2 * s2;
        return 4.0 * s6 * (s6 - 1.0);
    }

    /// Formulas for values of type V. unit: unit of length, Å.
    template <class V>
    struct Terms {
        V rm2;
        double force_scale, energy_scale;

        Terms(const LennardJones& p, double unit)
            : rm2(same<V>(std::cbrt(2.0) * p.r0 * p.r0 / (unit * unit))),
              force_scale(12.0 * p.epsilon / (std::cbrt(2.0) * p.r0 * p.r0)),
              energy_scale(p.epsilon) {}

        ASPERITY_INLINE V begin(V r2) const { return rm2 / r2; }
        ASPERITY_INLINE void begin(V a, V b, V& ta, V& tb) const {
            const V both = rm2 / (a * b);
            ta = b * both;
            tb = a * both;
        }
        template <class Difference>
        ASPERITY_INLINE V force(V t, V, Difference difference) const {
            const V t2 = t * t, t3 = t2 * t, t4 = t2 * t2;
            return difference(t4, t3, t4);
        }
        ASPERITY_INLINE V energy(V t, V) const {
            const V t3 = t * t * t;
            return fms(t3, t3, t3 + t3);
        }
        ASPERITY_INLINE V bend(V t, V) const {
            const V t2 = t * t, t5 = t2 * t2 * t;
            return (same<V>(2.0) / rm2) * t5 * (same<V>(7.0) * (t2 * t) - same<V>(4.0));
        }
        ASPERITY_INLINE V moment(V t, V) const {
            const V t2 = t * t;
            return rm2 * t2 * (same<V>(0.1) * (t2 * t) - same<V>(0.5));
        }
    };
};

} // namespace asperity
