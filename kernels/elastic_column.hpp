// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Columns of the small-strain stencil (elastic_cell.hpp), and the energy of its cells, for packs (V
// = Pack<double>) and for the threads of a device (V = Lane<double>).
#pragma once

#include "kernels/cell_geometry.hpp"
#include "kernels/elastic_level.hpp"
#include "kernels/variant.hpp"

namespace asperity::ASPERITY_VARIANT {

/// The stencil's coefficients, copied to every lane. Many coefficients are equal (make_stencil()):
/// inside a level only six differ, which fit into registers.
template <class V, Face face>
struct Weights {
    V own_c, own_e, own_t, own_d, own_n; ///< _n: coefficient of the diagonal neighbours in uz -> Fz
    V out_c, out_e, out_t, out_d, out_n; ///< _n: coefficient of the node itself in uz -> Fz
    V tau_r, tau_rd;

    ASPERITY_INLINE explicit Weights(const Stencil& s)
        : own_c(s.own_c), own_e(s.own_e), own_t(s.own_t), own_d(s.own_d), own_n(s.normal_d),
          out_c(s.out_c), out_e(s.out_e), out_t(s.out_t), out_d(s.out_d), out_n(s.out_normal_c),
          tau_r(s.tau_r), tau_rd(s.tau_rd) {
        if constexpr (face == Face::inner) {
            own_e = out_n;
            own_t = out_c;
            own_d = out_e;
            own_n = out_t;
        }
    }
};

/// Distances from a node to its neighbours, in elements: in its own plane, in the plane above and
/// in the plane below, at y - 1, y and y + 1.
struct Around {
    std::ptrdiff_t own[3], above[3], below[3];

    ASPERITY_INLINE Around(std::ptrdiff_t row, std::ptrdiff_t plane)
        : own{-row, 0, row}, above{plane - row, plane, plane + row}, below{-plane - row, -plane,
                                                                           row - plane} {
#if defined(__x86_64__) && !defined(__CUDACC__)
        // Eight registers for the distances, and one pointer for each component: g++ 12 would keep
        // a pointer for each of the 27 nodes, on the stack.
        asm("" : "+r"(own[0]), "+r"(own[2]), "+r"(above[0]), "+r"(above[1]), "+r"(above[2]));
        asm("" : "+r"(below[0]), "+r"(below[1]), "+r"(below[2]));
#endif
    }
};

/// One displacement component in a pack of columns. P and M (elastic_cell.hpp) are formed after the
/// sums over y.
template <Face face, class V>
class Component {
public:
    /// Sum and difference of the rows at y + 1 and y - 1 of a plane.
    struct Sides {
        V sum, difference;
    };
    /// Sums and differences of the planes above and below, and their P and M.
    struct Outside {
        Sides above, below;
        ASPERITY_INLINE V P_sum() const { return P(above.sum, below.sum); }
        ASPERITY_INLINE V M_sum() const { return M(above.sum, below.sum); }
        ASPERITY_INLINE V P_difference() const { return P(above.difference, below.difference); }
        ASPERITY_INLINE V M_difference() const { return M(above.difference, below.difference); }
    };

    ASPERITY_INLINE Component(const double* at, const Around& around) : at_(at), around_(around) {}

    ASPERITY_INLINE V here() const { return V::load_once(at_); }
    ASPERITY_INLINE V above() const { return lies_above ? node(around_.above[1]) : V(0.0); }
    ASPERITY_INLINE V below() const { return lies_below ? node(around_.below[1]) : V(0.0); }
    ASPERITY_INLINE Sides beside() const { return sides(around_.own); }
    ASPERITY_INLINE Outside outside() const {
        const Sides none = {V(0.0), V(0.0)};
        const Sides above = lies_above ? sides(around_.above) : none;
        return {above, lies_below ? sides(around_.below) : none};
    }
    ASPERITY_INLINE static V P(V above, V below) {
        return !lies_below ? above : !lies_above ? below : above + below;
    }
    ASPERITY_INLINE static V M(V above, V below) {
        return !lies_below ? above : !lies_above ? -below : above - below;
    }

private:
    static constexpr bool lies_above = face != Face::upper, lies_below = face != Face::lower;

    ASPERITY_INLINE V node(std::ptrdiff_t distance) const { return V::load_once(at_ + distance); }
    ASPERITY_INLINE Sides sides(const std::ptrdiff_t (&distance)[3]) const {
        const V north = node(distance[2]), south = node(distance[0]);
        return {north + south, north - south};
    }

    const double* at_;
    const Around& around_;
};

/// Contributions of the columns at x to the force components k = 0, 1, 2 at x, at x - 1 (west) and
/// at x + 1 (east).
template <class V>
struct ColumnParts {
    V here[3], west[3], east[3];

    ASPERITY_INLINE void take_here(int k, V part) { here[k] = part; }
    ASPERITY_INLINE void take_beside(int k, V to_west, V to_east) {
        west[k] = to_west;
        east[k] = to_east;
    }
};

/// Computes the contributions of the columns at ux, uy, uz and passes them to `parts`, which has
/// the interface of ColumnParts.
///
/// The components are processed in the order y, z, x, each displacement is read just before its
/// first use, and each part is passed on as soon as it is complete, so that intermediate values and
/// the six coefficients fit into the sixteen registers of AVX2.
template <Face face, class V, class Taker>
ASPERITY_INLINE void column_parts(const double* ux, const double* uy, const double* uz,
                                  const Around& around, const Weights<V, face>& s, Taker& parts) {
    using C = Component<face, V>;
    // even: the equal part of x - 1 and x + 1; odd: the part of x - 1 with a plus (it sees the
    // column at its +x side) and of x + 1 with a minus.
    const auto beside = [&](int k, V even, V odd) { parts.take_beside(k, even + odd, even - odd); };
    V odd_x, here_y, even_y, here_z, even_z;
    {
        const C u(uy, around);
        const auto own = u.beside();
        const auto out = u.outside();
        odd_x = fma(s.out_d, out.P_difference(), s.own_d * own.difference);
        here_z = s.out_e * out.M_difference();
        even_z = s.out_d * out.M_difference();
        if constexpr (face != Face::inner) {
            here_z = fma(s.tau_r, own.difference, here_z);
            even_z = fma(s.tau_rd, own.difference, even_z);
        }
        const V c = u.here(), P = C::P(u.above(), u.below());
        here_y = fma(s.out_c, P, fma(s.own_e, own.sum, s.own_c * c));
        even_y = fma(s.out_t, P, fma(s.own_d, own.sum, s.own_t * c));
        here_y = fma(s.out_e, out.P_sum(), here_y);
        even_y = fma(s.out_d, out.P_sum(), even_y);
    }
    {
        const C u(uz, around);
        const auto out = u.outside();
        here_y = fma(s.out_e, out.M_difference(), here_y);
        even_y = fma(s.out_d, out.M_difference(), even_y);
        const V above = u.above(), below = u.below();
        odd_x = fma(s.out_e, C::M(above, below), odd_x);
        odd_x = fma(s.out_d, out.M_sum(), odd_x);
        const auto own = u.beside();
        const V c = u.here(), P = C::P(above, below);
        if constexpr (face != Face::inner) {
            odd_x = fma(-s.tau_r, c, odd_x);
            odd_x = fma(-s.tau_rd, own.sum, odd_x);
            here_y = fma(-s.tau_r, own.difference, here_y);
            even_y = fma(-s.tau_rd, own.difference, even_y);
        }
        parts.take_here(1, here_y);
        here_z = fma(s.out_n, P, fma(s.own_t, own.sum, fma(s.own_c, c, here_z)));
        even_z = fma(s.out_e, P, fma(s.own_n, own.sum, fma(s.own_t, c, even_z)));
        parts.take_here(2, fma(s.out_e, out.P_sum(), here_z));
        even_z = fma(s.out_d, out.P_sum(), even_z);
    }
    {
        const C u(ux, around);
        const auto own = u.beside();
        const auto out = u.outside();
        beside(1, even_y, fma(s.out_d, out.P_difference(), s.own_d * own.difference));
        const V above = u.above(), below = u.below(), c = u.here();
        V odd_z = fma(s.out_d, out.M_sum(), s.out_e * C::M(above, below));
        if constexpr (face != Face::inner) {
            odd_z = fma(s.tau_r, c, odd_z);
            odd_z = fma(s.tau_rd, own.sum, odd_z);
        }
        beside(2, even_z, odd_z);
        const V P = C::P(above, below);
        const V here_x = fma(s.out_c, P, fma(s.own_t, own.sum, s.own_c * c));
        const V even_x = fma(s.out_e, P, fma(s.own_d, own.sum, s.own_e * c));
        parts.take_here(0, fma(s.out_t, out.P_sum(), here_x));
        beside(0, fma(s.out_d, out.P_sum(), even_x), odd_x);
    }
}

/// Returns the energy of the cells whose lower corners are a pack of nodes, eV, by the definition
/// of U_cell.
template <class V>
ASPERITY_INLINE V cell_energy(const VectorVolume<const double>& u, std::ptrdiff_t at,
                              CellElasticity e) {
    V cx[8], cy[8], cz[8];
    ASPERITY_UNROLL(8)
    for (int p = 0; p < 8; ++p) {
        const auto q = at + (p & 1) + (p >> 1 & 1) * u.x.row + (p >> 2 & 1) * u.x.plane;
        cx[p] = V::load(u.x.origin + q);
        cy[p] = V::load(u.y.origin + q);
        cz[p] = V::load(u.z.origin + q);
    }
    V edges(0.0), diagonals(0.0), dilatation(0.0);
    constexpr CellSprings springs{}; // device code has no constants of other scopes
    ASPERITY_UNROLL(24)
    for (int n = 0; n < 24; ++n) {
        const Spring& s = springs.spring[n];
        V stretch(0.0);
        if (s.dx) stretch = stretch + V(s.dx) * (cx[s.to] - cx[s.from]);
        if (s.dy) stretch = stretch + V(s.dy) * (cy[s.to] - cy[s.from]);
        if (s.dz) stretch = stretch + V(s.dz) * (cz[s.to] - cz[s.from]);
        if (s.diagonal)
            diagonals = fma(stretch, stretch, diagonals);
        else
            edges = fma(stretch, stretch, edges);
    }
    ASPERITY_UNROLL(8)
    for (int p = 0; p < 8; ++p) {
        dilatation = (p & 1) ? dilatation + cx[p] : dilatation - cx[p];
        dilatation = (p & 2) ? dilatation + cy[p] : dilatation - cy[p];
        dilatation = (p & 4) ? dilatation + cz[p] : dilatation - cz[p];
    }
    // Edges weigh k/4; diagonals k/2 with e.du = stretch / sqrt(2); (lambda-mu) s^3 theta^2 / 2 =
    // kappa/2 (4 s theta)^2.
    return V(0.125 * e.k) * (edges + diagonals) + V(0.5 * e.kappa) * (dilatation * dilatation);
}

} // namespace asperity::ASPERITY_VARIANT
