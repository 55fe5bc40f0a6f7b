// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Columns of the small-strain stencil (elastic_cell.hpp), and the energy of its cells: one text for
// packs (V = Pack<double>) and for the threads of a device (V = Lane<double>).
#pragma once

#include "kernels/cell_geometry.hpp"
#include "kernels/elastic_level.hpp"
#include "kernels/variant.hpp"

namespace asperity::ASPERITY_VARIANT {

/// One displacement component in a pack of columns: at each of the planes below, at and above the
/// node, the node's own row and the sum and difference of the rows around it, already combined over
/// z.
template <class V>
struct Rows {
    V c, sum, difference; ///< y = 0; y = 1 plus y = -1; y = 1 minus y = -1

    ASPERITY_INLINE static Rows load(const double* p, std::ptrdiff_t row) {
        const V north = V::load_once(p + row), south = V::load_once(p - row);
        return {V::load_once(p), north + south, north - south};
    }
    ASPERITY_INLINE friend Rows operator+(const Rows& a, const Rows& b) {
        return {a.c + b.c, a.sum + b.sum, a.difference + b.difference};
    }
    ASPERITY_INLINE friend Rows operator-(const Rows& a, const Rows& b) {
        return {a.c - b.c, a.sum - b.sum, a.difference - b.difference};
    }
};

template <class V>
struct Column {
    Rows<V> own, P, M;
};

/// The stencil's coefficients, a copy in every lane. Many are equal (make_stencil): inside a level
/// six numbers are left, which stay in registers.
template <class V, Face face>
struct Weights {
    V own_c, own_e, own_t, own_d, own_n; ///< _n: of the diagonal neighbours in uz -> Fz
    V out_c, out_e, out_t, out_d, out_n; ///< _n: of the node itself in uz -> Fz
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

template <Face face, class V>
ASPERITY_INLINE Column<V> load_column(const double* p, std::ptrdiff_t row, std::ptrdiff_t plane) {
    const Rows<V> own = Rows<V>::load(p, row);
    if constexpr (face == Face::lower) {
        const Rows<V> up = Rows<V>::load(p + plane, row);
        return {own, up, up};
    } else if constexpr (face == Face::upper) {
        const Rows<V> down = Rows<V>::load(p - plane, row);
        return {own, down, {-down.c, -down.sum, -down.difference}};
    } else {
        const Rows<V> up = Rows<V>::load(p + plane, row), down = Rows<V>::load(p - plane, row);
        return {own, up + down, up - down};
    }
}

/// What the columns at x give to one force component at x, at x - 1 and at x + 1.
template <class V>
struct Parts {
    V here, west, east;
};
template <class V>
struct ColumnParts {
    Parts<V> x, y, z;
};

/// even: the part that x - 1 and x + 1 get alike; odd: the part that x - 1 gets with a plus (it
/// sees the column at its +x side) and x + 1 with a minus.
template <class V>
ASPERITY_INLINE Parts<V> parts(V here, V even, V odd) {
    return {here, even + odd, even - odd};
}

template <Face face, class V>
ASPERITY_INLINE ColumnParts<V> column_parts(const VectorVolume<const double>& u, std::ptrdiff_t at,
                                            const Weights<V, face>& s) {
    const auto row = u.x.row, plane = u.x.plane;
    V cx, ex, ox, cy, ey, oy, cz, ez, oz; // centre, even and odd parts of the three components
    {
        const Column<V> a = load_column<face, V>(u.x.origin + at, row, plane);
        cx = s.own_c * a.own.c;
        cx = fma(s.own_t, a.own.sum, cx);
        cx = fma(s.out_c, a.P.c, cx);
        cx = fma(s.out_t, a.P.sum, cx);
        ex = s.own_e * a.own.c;
        ex = fma(s.own_d, a.own.sum, ex);
        ex = fma(s.out_e, a.P.c, ex);
        ex = fma(s.out_d, a.P.sum, ex);
        oy = s.own_d * a.own.difference;
        oy = fma(s.out_d, a.P.difference, oy);
        oz = s.out_e * a.M.c;
        oz = fma(s.out_d, a.M.sum, oz);
        if constexpr (face != Face::inner) {
            oz = fma(s.tau_r, a.own.c, oz);
            oz = fma(s.tau_rd, a.own.sum, oz);
        }
    }
    {
        const Column<V> a = load_column<face, V>(u.y.origin + at, row, plane);
        cy = s.own_c * a.own.c;
        cy = fma(s.own_e, a.own.sum, cy);
        cy = fma(s.out_c, a.P.c, cy);
        cy = fma(s.out_e, a.P.sum, cy);
        ey = s.own_t * a.own.c;
        ey = fma(s.own_d, a.own.sum, ey);
        ey = fma(s.out_t, a.P.c, ey);
        ey = fma(s.out_d, a.P.sum, ey);
        ox = s.own_d * a.own.difference;
        ox = fma(s.out_d, a.P.difference, ox);
        cz = s.out_e * a.M.difference;
        ez = s.out_d * a.M.difference;
        if constexpr (face != Face::inner) {
            cz = fma(s.tau_r, a.own.difference, cz);
            ez = fma(s.tau_rd, a.own.difference, ez);
        }
    }
    {
        const Column<V> a = load_column<face, V>(u.z.origin + at, row, plane);
        cz = fma(s.own_c, a.own.c, cz);
        cz = fma(s.own_t, a.own.sum, cz);
        cz = fma(s.out_n, a.P.c, cz);
        cz = fma(s.out_e, a.P.sum, cz);
        ez = fma(s.own_t, a.own.c, ez);
        ez = fma(s.own_n, a.own.sum, ez);
        ez = fma(s.out_e, a.P.c, ez);
        ez = fma(s.out_d, a.P.sum, ez);
        ox = fma(s.out_e, a.M.c, ox);
        ox = fma(s.out_d, a.M.sum, ox);
        cy = fma(s.out_e, a.M.difference, cy);
        ey = fma(s.out_d, a.M.difference, ey);
        if constexpr (face != Face::inner) {
            ox = fma(-s.tau_r, a.own.c, ox);
            ox = fma(-s.tau_rd, a.own.sum, ox);
            cy = fma(-s.tau_r, a.own.difference, cy);
            ey = fma(-s.tau_rd, a.own.difference, ey);
        }
    }
    return {parts(cx, ex, ox), parts(cy, ey, oy), parts(cz, ez, oz)};
}

/// Energy of the cells whose lower corners are a pack of nodes, straight from the definition.
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
