// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "kernels/surface_stiffness.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace asperity {

namespace {

/// Returns a filter c + e (along) + t (across) + d (diagonal) at the phases.
double even(double c, double e, double t, double d, double along, double across) {
    return c + 2.0 * e * along + 2.0 * t * across + 4.0 * d * along * across;
}

/// Returns the matrix of a plane on itself: a of Face::lower, d of Face::upper.
SurfaceMatrix own(const Stencil& s, WavePhase x, WavePhase y) {
    SurfaceMatrix m;
    m.xx = -even(s.own_c, s.own_e, s.own_t, s.own_d, x.cosine, y.cosine);
    m.yy = -even(s.own_c, s.own_e, s.own_t, s.own_d, y.cosine, x.cosine);
    m.zz = -even(s.normal_c, s.normal_e, s.normal_e, s.normal_d, x.cosine, y.cosine);
    m.xy = 4.0 * s.own_xy * x.sine * y.sine;
    m.xz = 2.0 * x.sine * (s.tau_r + 2.0 * s.tau_rd * y.cosine);
    m.yz = 2.0 * y.sine * (s.tau_r + 2.0 * s.tau_rd * x.cosine);
    return m;
}

/// Coupling of a plane (row) with the plane above it (column), symmetric except with z.
struct Coupling {
    double xx, yy, zz, xy;
    double xz, yz; ///< row x or y, column w; with the other sign for row w, column x or y
};

Coupling coupling(const Stencil& s, WavePhase x, WavePhase y) {
    Coupling b;
    b.xx = -even(s.out_c, s.out_e, s.out_t, s.out_d, x.cosine, y.cosine);
    b.yy = -even(s.out_c, s.out_e, s.out_t, s.out_d, y.cosine, x.cosine);
    b.zz =
        -even(s.out_normal_c, s.out_normal_e, s.out_normal_e, s.out_normal_d, x.cosine, y.cosine);
    b.xy = 4.0 * s.out_xy * x.sine * y.sine;
    b.xz = -2.0 * x.sine * (s.out_r + 2.0 * s.out_rd * y.cosine);
    b.yz = -2.0 * y.sine * (s.out_r + 2.0 * s.out_rd * x.cosine);
    return b;
}

/// Returns b m b^T.
SurfaceMatrix sandwich(const Coupling& b, const SurfaceMatrix& m) {
    const double row[3][3] = {{b.xx, b.xy, b.xz}, {b.xy, b.yy, b.yz}, {-b.xz, -b.yz, b.zz}};
    double half[3][3]; // b m
    for (int i = 0; i < 3; ++i) {
        half[i][0] = row[i][0] * m.xx + row[i][1] * m.xy + row[i][2] * m.xz;
        half[i][1] = row[i][0] * m.xy + row[i][1] * m.yy + row[i][2] * m.yz;
        half[i][2] = row[i][0] * m.xz + row[i][1] * m.yz + row[i][2] * m.zz;
    }
    const auto entry = [&](int i, int j) {
        return half[i][0] * row[j][0] + half[i][1] * row[j][1] + half[i][2] * row[j][2];
    };
    return {entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(0, 2), entry(1, 2)};
}

SurfaceMatrix sum(const SurfaceMatrix& a, const SurfaceMatrix& b) {
    return {a.xx + b.xx, a.yy + b.yy, a.zz + b.zz, a.xy + b.xy, a.xz + b.xz, a.yz + b.yz};
}

SurfaceMatrix difference(const SurfaceMatrix& a, const SurfaceMatrix& b) {
    return {a.xx - b.xx, a.yy - b.yy, a.zz - b.zz, a.xy - b.xy, a.xz - b.xz, a.yz - b.yz};
}

/// A real vector on (u_x, u_y, i u_z).
struct SurfaceVector {
    double x = 0.0, y = 0.0, z = 0.0;
};

SurfaceVector operator-(const SurfaceVector& a, const SurfaceVector& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}

double dot(const SurfaceVector& a, const SurfaceVector& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

SurfaceVector product(const SurfaceMatrix& m, const SurfaceVector& v) {
    return {m.xx * v.x + m.xy * v.y + m.xz * v.z, m.xy * v.x + m.yy * v.y + m.yz * v.z,
            m.xz * v.x + m.yz * v.y + m.zz * v.z};
}

/// Returns b v.
SurfaceVector product(const Coupling& b, const SurfaceVector& v) {
    return {b.xx * v.x + b.xy * v.y + b.xz * v.z, b.xy * v.x + b.yy * v.y + b.yz * v.z,
            -b.xz * v.x - b.yz * v.y + b.zz * v.z};
}

/// Returns factor v v^T.
SurfaceMatrix square(const SurfaceVector& v, double factor) {
    return {factor * v.x * v.x, factor * v.y * v.y, factor * v.z * v.z,
            factor * v.x * v.y, factor * v.x * v.z, factor * v.y * v.z};
}

/// The stiffness of a stack of cells, s + p p^T / c: p p^T / c is the resistance of the uppermost
/// cell to a change of its volume beyond that which its springs have.
struct Stack {
    SurfaceMatrix s;
    SurfaceVector p;
    double c = 0.0; ///< 0: the cell's springs have all of its resistance

    SurfaceMatrix whole() const { return c > 0.0 ? sum(s, square(p, 1.0 / c)) : s; }
    /// Returns (d + s + p p^T / c)^-1.
    SurfaceMatrix inverse_with(const SurfaceMatrix& d) const {
        const SurfaceMatrix i = inverse(sum(d, s));
        if (!(c > 0.0)) return i;
        const SurfaceVector along = product(i, p);
        return difference(i, square(along, 1.0 / (c + dot(p, along))));
    }
};

/// Cells of a material, whose resistance to a change of volume is split: kappa up to `most` k is
/// part of the matrices a, b and d, and the rest is kept apart. A cell resists a change of
/// volume by kappa (g.u + h.v)^2 / 2, u and v the displacements of its lower and upper plane. With
/// the whole in the matrices, their differences would lose as many digits as kappa / k has, and at
/// Poisson's ratio 1/2 all.
class Cells {
public:
    Cells(const CellElasticity& e, WavePhase x, WavePhase y) {
        constexpr double most = 64.0; // Poisson's ratio 0.4995
        const CellElasticity part{e.k, std::min(e.kappa, most * e.k)};
        apart_ = e.kappa - part.kappa;
        a_ = own(make_stencil(part, Face::lower), x, y);
        d_ = own(make_stencil(part, Face::upper), x, y);
        b_ = coupling(make_stencil(part, Face::inner), x, y);
        if (!(apart_ > 0.0)) return;
        const auto half = [](WavePhase p) -> WavePhase {
            const double cosine = std::sqrt(0.5 * (1.0 + p.cosine));
            return {cosine, cosine > 0.0 ? 0.5 * p.sine / cosine : 1.0};
        };
        const WavePhase hx = half(x), hy = half(y);
        const double along = 4.0 * hx.sine * hy.cosine, across = 4.0 * hx.cosine * hy.sine,
                     normal = 4.0 * hx.cosine * hy.cosine;
        g_ = {along, across, normal};
        h_ = {along, across, -normal};
    }
    /// Returns the stiffness of a cell whose upper plane is held.
    Stack below_top() const { return {a_, g_, apart_ > 0.0 ? 1.0 / apart_ : 0.0}; }
    /// Returns the stiffness of a cell below a stack.
    Stack below(const Stack& stack) const {
        const SurfaceMatrix i = stack.inverse_with(d_);
        const SurfaceMatrix s = difference(a_, sandwich(b_, i));
        if (!(apart_ > 0.0)) return {s, {}, 0.0};
        const SurfaceVector along = product(i, h_);
        return {s, g_ - product(b_, along), 1.0 / apart_ + dot(h_, along)};
    }

private:
    SurfaceMatrix a_, d_;
    Coupling b_{};
    double apart_ = 0.0; ///< the part of kappa that is kept apart, eV/Å^2
    SurfaceVector g_, h_;
};

double largest(const SurfaceMatrix& m) {
    return std::max({std::abs(m.xx), std::abs(m.yy), std::abs(m.zz), std::abs(m.xy), std::abs(m.xz),
                     std::abs(m.yz)});
}

} // namespace

WavePhase wave_phase(int n, int sites) {
    if (n == 0) return {1.0, 0.0};
    if (2 * n == sites) return {-1.0, 0.0};
    const double phase = 2.0 * std::numbers::pi * n / sites;
    return {std::cos(phase), std::sin(phase)};
}

namespace {

SurfaceMatrix uniform_stiffness(std::span<const CellLayer> layers) {
    const auto in_series = [](double below, double above) {
        return above == 0.0 ? below : below * above / (below + above);
    };
    double shear = 0.0, normal = 0.0; // stiffness of the layers above
    for (std::size_t i = layers.size(); i-- > 0;) {
        // k = mu a, 16 kappa = (lambda - mu) a.
        const CellElasticity& e = layers[i].elasticity;
        shear = in_series(e.k / layers[i].cells, shear);
        normal = in_series((16.0 * e.kappa + 3.0 * e.k) / layers[i].cells, normal);
    }
    return {shear, shear, normal, 0.0, 0.0, 0.0};
}

} // namespace

SurfaceMatrix surface_stiffness(std::span<const CellLayer> layers, WavePhase x, WavePhase y) {
    // (2 sin(p/2))^2 for both directions: (q a)^2 of long waves.
    const double wave2 = 2.0 * (1.0 - x.cosine) + 2.0 * (1.0 - y.cosine);
    if (wave2 == 0.0) return uniform_stiffness(layers);

    // Long waves: exp(-2 q depth) < 1e-20, beyond which only rounding is added. Short ones, which
    // decay at the lattice's own rate: the last cell's share, summed as if the rest decayed as
    // slowly as exp(-2 q a).
    const double wave = std::sqrt(wave2);
    const double enough = 24.0 / wave + 24.0;
    double depth = 0.0; // depth of the lower side of layer i, in cells
    for (const CellLayer& layer : layers)
        depth += layer.cells;
    bool clamped = true; // true if the cell touches the top plane
    Stack stack;
    SurfaceMatrix s;
    for (std::size_t i = layers.size(); i-- > 0;) {
        depth -= layers[i].cells;
        if (!(depth < enough)) continue;
        const Cells material(layers[i].elasticity, x, y);
        const double cells = std::min(enough - depth, static_cast<double>(layers[i].cells));
        for (int cell = 1; cell <= cells || clamped; ++cell) {
            stack = clamped ? material.below_top() : material.below(stack);
            const SurfaceMatrix next = stack.whole();
            const double change = clamped ? largest(next) : largest(difference(next, s));
            clamped = false;
            s = next;
            if (change <= 1e-17 * std::min(1.0, wave) * largest(s)) break;
        }
    }
    return s;
}

} // namespace asperity
