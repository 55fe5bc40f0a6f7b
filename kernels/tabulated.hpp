// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A tabulated potential: cubics over equal intervals of r, with V0 and V0' continuous. The
// coefficients belong to a PotentialTable (engine/case/potential_table.hpp), which makes them from
// a file.
#pragma once

#include "kernels/number.hpp"

namespace asperity {

/// View of a tabulated potential, and its formulas (pair_potential.hpp).
struct Tabulated {
    /// Coefficients of V0 = c0 + x (c1 + x (c2 + x c3)), eV: [4 n + k] in interval n, x from 0 to 1
    /// along it.
    const double* cubics = nullptr;
    int intervals = 0;
    double first = 0.0;  ///< beginning of the table, Å
    double step = 1.0;   ///< length of an interval, Å
    double cutoff = 0.0; ///< cutoff within the table, Å
    /// Characteristic energies and distances.
    struct Shape {
        double depth = 0.0;                                 ///< eV
        double zero = 0.0, minimum = 0.0, inflection = 0.0; ///< Å
        double shift = 0.0;                                 ///< V0 at the cutoff, eV
    } shape;

    static constexpr const char* name = "table";
    static constexpr bool has_tail = false;
    template <class Self, class Visit>
    static void parameters(Self&, Visit) {}

    double zero() const { return shape.zero; }
    double minimum() const { return shape.minimum; }
    double inflection() const { return shape.inflection; }
    ASPERITY_INLINE double depth() const { return shape.depth; }
    ASPERITY_INLINE double closest() const { return first; }
    double shift() const { return shape.shift; }

    /// Formulas for values of type V. unit: unit of length, Å.
    template <class V>
    struct Terms {
        const double* table;
        V begin_at, per_length, last;
        double force_scale, energy_scale = 1.0;

        Terms(const Tabulated& p, double unit)
            : table(p.cubics), begin_at(same<V>(p.first / unit)),
              per_length(same<V>(unit / p.step)), last(same<V>(p.intervals - 1.0)),
              force_scale(1.0 / (p.step * unit)) {}

        /// Returns 1/r.
        ASPERITY_INLINE V begin(V r2) const { return same<V>(1.0) / sqrt(r2); }
        ASPERITY_INLINE void begin(V a, V b, V& oa, V& ob) const {
            const V ra = sqrt(a), rb = sqrt(b), both = same<V>(1.0) / (ra * rb);
            oa = rb * both;
            ob = ra * both;
        }
        template <class Difference>
        ASPERITY_INLINE V force(V o, V r2, Difference difference) const {
            const Cubic c(*this, o, r2);
            const V slope = fma(c.x, fma(same<V>(3.0) * c.x, c.of[3], c.of[2] + c.of[2]), c.of[1]);
            return difference(-slope, o, same<V>(0.0));
        }
        ASPERITY_INLINE V energy(V o, V r2) const {
            const Cubic c(*this, o, r2);
            return fma(c.x, fma(c.x, fma(c.x, c.of[3], c.of[2]), c.of[1]), c.of[0]);
        }
        ASPERITY_INLINE V bend(V o, V r2) const {
            const Cubic c(*this, o, r2);
            const V slope = fma(c.x, fma(same<V>(3.0) * c.x, c.of[3], c.of[2] + c.of[2]), c.of[1]);
            const V curve = fma(same<V>(6.0) * c.x, c.of[3], c.of[2] + c.of[2]);
            return (curve * per_length - slope * o) * (o * o);
        }

    private:
        struct Cubic {
            V of[4], x;
            ASPERITY_INLINE Cubic(const Terms& t, V o, V r2) {
                const V at = (r2 * o - t.begin_at) * t.per_length;
                // An argument that is not a number gives the last interval.
                const V n = max(min(nearest_whole(at - same<V>(0.5)), t.last), same<V>(0.0));
                x = at - n;
                gather_four(t.table, n, of);
            }
        };
    };
};

} // namespace asperity
