// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The Morse potential (P. M. Morse, Phys. Rev. 34, 57 (1929)). With e = exp(-a (r - r_min)):
//
//     V0 = D (e^2 - 2 e)
//     -V0'/r = 2 D a (e^2 - e) / r
//     (V0'/r)'/r = 2 D a [a (2 e^2 - e) r + (e^2 - e)] / r^3
#pragma once

#include "kernels/number.hpp"

#include <cmath>

namespace asperity {

/// Parameters and formulas of the potential (pair_potential.hpp). The defaults have depth,
/// curvature and place of the minimum of the default Lennard-Jones potential.
struct Morse {
    double D = 0.1;        ///< depth, eV
    double a = 1.63;       ///< inverse width, 1/Å
    double r_min = 3.6816; ///< place of the minimum, Å
    double cutoff = 13.12; ///< cutoff, Å

    static constexpr const char* name = "morse";
    static constexpr bool has_tail = true;
    template <class Self, class Visit>
    static void parameters(Self& self, Visit visit) {
        visit("D", "eV", self.D, "depth of the Morse well");
        visit("a", "1/Å", self.a,
              "inverse width of the Morse potential D (exp(-2 a (r - r_min)) - 2 exp(-a (r - "
              "r_min)))");
        visit("r_min", "Å", self.r_min, "distance of the Morse minimum");
    }

    double zero() const { return r_min - std::log(2.0) / a; }
    double minimum() const { return r_min; }
    double inflection() const { return r_min + std::log(2.0) / a; }
    ASPERITY_INLINE double depth() const { return D; }
    /// Returns the distance that replaces smaller ones, Å; V0 itself is finite down to r = 0.
    ASPERITY_INLINE double closest() const { return 0.1 * r_min; }
    double shift() const {
        const double e = std::exp(-a * (cutoff - r_min));
        return e * e - 2.0 * e;
    }

    /// Formulas for values of type V. unit: unit of length, Å.
    template <class V>
    struct Terms {
        V rate, at_rest;
        double force_scale, energy_scale;

        Terms(const Morse& p, double unit)
            : rate(same<V>(p.a * unit)), at_rest(same<V>(p.r_min / unit)),
              force_scale(2.0 * p.D * p.a / unit), energy_scale(p.D) {}

        /// Returns 1/r.
        ASPERITY_INLINE V begin(V r2) const { return same<V>(1.0) / sqrt(r2); }
        ASPERITY_INLINE void begin(V r2, V s2, V& of_r, V& of_s) const {
            const V r = sqrt(r2), s = sqrt(s2), both = same<V>(1.0) / (r * s);
            of_r = s * both;
            of_s = r * both;
        }
        template <class Difference>
        ASPERITY_INLINE V force(V o, V r2, Difference difference) const {
            const V e = decay(o, r2), eo = e * o;
            return difference(eo, e, eo);
        }
        ASPERITY_INLINE V energy(V o, V r2) const {
            const V e = decay(o, r2);
            return fms(e, e, e + e);
        }
        ASPERITY_INLINE V bend(V o, V r2) const {
            const V e = decay(o, r2), e2 = e * e;
            return (rate * (e2 + e2 - e) * (r2 * o) + (e2 - e)) * (o * o * o);
        }
        ASPERITY_INLINE V moment(V o, V r2) const {
            const V e = decay(o, r2), r = r2 * o, length = same<V>(1.0) / rate;
            const V square = e * length * (same<V>(0.5) * r + same<V>(0.25) * length);
            return e * (square - same<V>(2.0) * length * (r + length));
        }

    private:
        ASPERITY_INLINE V decay(V o, V r2) const { return exponential(rate * (at_rest - r2 * o)); }
    };
};

} // namespace asperity
