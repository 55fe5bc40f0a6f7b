// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The cell of elastic_finite.hpp: forces of its springs and its volume on its corners, and its
// energy, for packs of cells.
#pragma once

#include "kernels/cell_geometry.hpp"
#include "kernels/kick.hpp"

#include <numbers>

namespace asperity::ASPERITY_VARIANT::finite {

template <class V>
ASPERITY_INLINE V squared(const Triple<V>& a) {
    return fma(a.x, a.x, fma(a.y, a.y, a.z * a.z));
}

/// Constants of a spring: k, and k r0 of edges and of diagonals.
template <class V>
struct Stiffness {
    V k, k_edge, k_diagonal;
    ASPERITY_INLINE Stiffness(double constant, double edge)
        : k(constant), k_edge(constant * edge), k_diagonal(constant * edge * std::numbers::sqrt2) {}
};

/// Returns the force on the spring's first end, t r with t = k - k r0 / |r|.
template <class V>
ASPERITY_INLINE Triple<V> pull(const Triple<V>& r, V k, V k_rest) {
    const V t = fma(-k_rest, inverse_sqrt(squared(r)), k);
    return {t * r.x, t * r.y, t * r.z};
}

/// The eight corners of V's cells: x and x + 1 (west, east) of four rows, numbered y + 2 z.
template <class V>
struct Corners {
    Triple<V> west[4], east[4];
};
/// Loads the displacements of the lower corners, or of all corners, of the cells whose lower
/// corners begin at `at`.
template <int rows, class V>
ASPERITY_INLINE void load(const VectorVolume<const double>& u, std::ptrdiff_t at,
                          Corners<V>& corner) {
    const auto node = [&](std::ptrdiff_t i) {
        return Triple<V>{V::load(u.x.origin + i), V::load(u.y.origin + i), V::load(u.z.origin + i)};
    };
    ASPERITY_UNROLL(4)
    for (int r = 0; r < rows; ++r) {
        const auto row = at + (r & 1) * u.x.row + (r >> 1) * u.x.plane;
        corner.west[r] = node(row);
        corner.east[r] = node(row + 1);
    }
}

/// Constants of the cells of a level.
template <class V>
struct Cell {
    V edge, inverse_4_edge, pressure; ///< s; 1/(4s); 4 s kappa
    /// Springs inside, and springs in a surface, with half the strength.
    Stiffness<V> inside, surface;

    explicit ASPERITY_INLINE Cell(const LevelCell& c)
        : edge(c.edge), inverse_4_edge(0.25 / c.edge), pressure(4.0 * c.edge * c.elasticity.kappa),
          inside(c.elasticity.k, c.edge), surface(0.5 * c.elasticity.k, c.edge) {}
};

/// Computes the forces of the four springs of a cell in the plane through its lower corners.
template <class V>
ASPERITY_INLINE void pull_in_plane(const Corners<V>& u, const Cell<V>& c, const Stiffness<V>& k,
                                   Corners<V>& f) {
    const V s = c.edge;
    Triple<V> r = u.east[0] - u.west[0]; // along x
    r.x = r.x + s;
    const Triple<V> along_x = pull(r, k.k, k.k_edge);
    r = u.west[1] - u.west[0]; // along y
    r.y = r.y + s;
    const Triple<V> along_y = pull(r, k.k, k.k_edge);
    r = u.east[1] - u.west[0];
    r.x = r.x + s, r.y = r.y + s;
    const Triple<V> diagonal = pull(r, k.k, k.k_diagonal);
    r = u.west[1] - u.east[0];
    r.x = r.x - s, r.y = r.y + s;
    const Triple<V> across = pull(r, k.k, k.k_diagonal);
    f.west[0] = along_x + along_y + diagonal;
    f.east[0] = across - along_x;
    f.west[1] = Triple<V>{-across.x, -across.y, -across.z} - along_y;
    f.east[1] = {-diagonal.x, -diagonal.y, -diagonal.z};
}

/// Adds the forces of the five springs of a cell that lead to the plane above.
template <class V>
ASPERITY_INLINE void pull_upwards(const Corners<V>& u, const Cell<V>& c, Corners<V>& f) {
    const V s = c.edge;
    const Stiffness<V>& k = c.inside;
    Triple<V> r = u.west[2] - u.west[0]; // along z
    r.z = r.z + s;
    const Triple<V> along_z = pull(r, k.k, k.k_edge);
    r = u.east[2] - u.west[0]; // in the face across y
    r.x = r.x + s, r.z = r.z + s;
    const Triple<V> diagonal_x = pull(r, k.k, k.k_diagonal);
    r = u.west[2] - u.east[0];
    r.x = r.x - s, r.z = r.z + s;
    const Triple<V> across_x = pull(r, k.k, k.k_diagonal);
    r = u.west[3] - u.west[0]; // in the face across x
    r.y = r.y + s, r.z = r.z + s;
    const Triple<V> diagonal_y = pull(r, k.k, k.k_diagonal);
    r = u.west[2] - u.west[1];
    r.y = r.y - s, r.z = r.z + s;
    const Triple<V> across_y = pull(r, k.k, k.k_diagonal);
    f.west[0] = f.west[0] + (along_z + diagonal_x + diagonal_y);
    f.east[0] = f.east[0] + across_x;
    f.west[1] = f.west[1] + across_y;
    const Triple<V> down = along_z + across_x + across_y;
    f.west[2] = {-down.x, -down.y, -down.z};
    f.east[2] = {-diagonal_x.x, -diagonal_x.y, -diagonal_x.z};
    f.west[3] = {-diagonal_y.x, -diagonal_y.y, -diagonal_y.z};
    f.east[3] = {V(0.0), V(0.0), V(0.0)};
}

/// Returns a row of F: the derivatives of component i of the displacement along x, y and z,
/// averaged over the cell.
template <class V, class Component>
ASPERITY_INLINE Triple<V> mean_gradient(const Corners<V>& u, const Cell<V>& c,
                                        const Component& component) {
    const auto side = [&](const Triple<V>(&row)[4]) {
        const V low = component(row[0]) + component(row[1]);
        const V high = component(row[2]) + component(row[3]);
        const V north =
            (component(row[1]) - component(row[0])) + (component(row[3]) - component(row[2]));
        return Triple<V>{low + high, north, high - low};
    };
    const Triple<V> west = side(u.west), east = side(u.east);
    return {c.inverse_4_edge * (east.x - west.x), c.inverse_4_edge * (east.y + west.y),
            c.inverse_4_edge * (east.z + west.z)};
}

template <class V>
ASPERITY_INLINE V minor(V a, V b, V c, V d) {
    return fma(a, d, -(b * c));
}

/// Volume change det F - 1 and the cofactors of F, row by row.
template <class V>
struct Volume {
    V theta;
    Triple<V> cofactor[3];
};
template <class V>
ASPERITY_INLINE Volume<V> volume_of(const Corners<V>& u, const Cell<V>& c) {
    Triple<V> a = mean_gradient(u, c, [](const Triple<V>& v) { return v.x; });
    Triple<V> b = mean_gradient(u, c, [](const Triple<V>& v) { return v.y; });
    Triple<V> d = mean_gradient(u, c, [](const Triple<V>& v) { return v.z; });
    const V one(1.0);
    a.x = a.x + one, b.y = b.y + one, d.z = d.z + one;
    const auto cross = [](const Triple<V>& p, const Triple<V>& q) {
        return Triple<V>{minor(p.y, p.z, q.y, q.z), minor(p.z, p.x, q.z, q.x),
                         minor(p.x, p.y, q.x, q.y)};
    };
    const Triple<V> bd = cross(b, d);
    const V det = fma(a.x, bd.x, fma(a.y, bd.y, a.z * bd.z));
    return {det - one, {bd, cross(d, a), cross(a, b)}};
}

/// Adds the force of the mean dilatation to component i of the eight corners.
template <class V, class Component>
ASPERITY_INLINE void add_pressure(V p, const Triple<V>& cofactor, Corners<V>& f,
                                  const Component& component) {
    const V x = p * cofactor.x, y = p * cofactor.y, z = p * cofactor.z;
    const V sum = y + z, difference = y - z;
    const V corner[4] = {-sum, difference, -difference, sum};
    ASPERITY_UNROLL(4)
    for (int row = 0; row < 4; ++row) {
        component(f.west[row]) = component(f.west[row]) + (corner[row] - x);
        component(f.east[row]) = component(f.east[row]) + (corner[row] + x);
    }
}

template <class V>
ASPERITY_INLINE void add_pressure(const Corners<V>& u, const Cell<V>& c, Corners<V>& f) {
    const Volume<V> volume = volume_of(u, c);
    const V p = -(c.pressure * volume.theta);
    add_pressure(p, volume.cofactor[0], f, [](Triple<V>& v) -> V& { return v.x; });
    add_pressure(p, volume.cofactor[1], f, [](Triple<V>& v) -> V& { return v.y; });
    add_pressure(p, volume.cofactor[2], f, [](Triple<V>& v) -> V& { return v.z; });
}

/// Computes the forces on the corners: with `cells` of all springs of the cells, with `dilated`
/// also of the dilatation; otherwise of the springs in the lower plane alone, without reading the
/// upper corners.
template <bool cells, bool dilated, class V>
ASPERITY_INLINE void forces(const Corners<V>& u, const Cell<V>& c, const Stiffness<V>& in_plane,
                            Corners<V>& f) {
    pull_in_plane(u, c, in_plane, f);
    if constexpr (cells) pull_upwards(u, c, f);
    if constexpr (cells && dilated) add_pressure(u, c, f);
}

/// Returns the energy of the cells whose lower corners are V's nodes, eV, by the definition of
/// U_cell.
template <class V>
ASPERITY_INLINE V energy(const VectorVolume<const double>& u, std::ptrdiff_t at,
                         const Cell<V>& cell, const LevelCell& c) {
    Corners<V> corner;
    load<4>(u, at, corner);
    V edges(0.0), diagonals(0.0);
    constexpr CellSprings springs{}; // device code has no constants of other scopes
    ASPERITY_UNROLL(24)
    for (int n = 0; n < 24; ++n) {
        const Spring& spring = springs.spring[n];
        const auto end = [&](int p) { return p & 1 ? corner.east[p >> 1] : corner.west[p >> 1]; };
        Triple<V> r = end(spring.to) - end(spring.from);
        r.x = r.x + V(spring.dx * c.edge);
        r.y = r.y + V(spring.dy * c.edge);
        r.z = r.z + V(spring.dz * c.edge);
        const double unstretched = spring.diagonal ? std::numbers::sqrt2 * c.edge : c.edge;
        const V stretch = sqrt(squared(r)) - V(unstretched);
        V& sum = spring.diagonal ? diagonals : edges;
        sum = fma(stretch, stretch, sum);
    }
    const V theta = volume_of(corner, cell).theta;
    // (lambda - mu) s^3 = 16 s^2 kappa.
    return V(0.125 * c.elasticity.k) * edges + V(0.25 * c.elasticity.k) * diagonals +
           V(8.0 * c.edge * c.edge * c.elasticity.kappa) * (theta * theta);
}

} // namespace asperity::ASPERITY_VARIANT::finite
