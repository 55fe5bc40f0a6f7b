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
    SurfaceMatrix s;
    for (std::size_t i = layers.size(); i-- > 0;) {
        depth -= layers[i].cells;
        if (!(depth < enough)) continue;
        const CellElasticity& elasticity = layers[i].elasticity;
        const SurfaceMatrix a = own(make_stencil(elasticity, Face::lower), x, y);
        const SurfaceMatrix d = own(make_stencil(elasticity, Face::upper), x, y);
        const Coupling b = coupling(make_stencil(elasticity, Face::inner), x, y);
        const double cells = std::min(enough - depth, static_cast<double>(layers[i].cells));
        for (int cell = 1; cell <= cells || clamped; ++cell) {
            const SurfaceMatrix next = clamped ? a : difference(a, sandwich(b, inverse(sum(d, s))));
            const double change = clamped ? largest(a) : largest(difference(next, s));
            clamped = false;
            s = next;
            if (change <= 1e-17 * std::min(1.0, wave) * largest(s)) break;
        }
    }
    return s;
}

} // namespace asperity
