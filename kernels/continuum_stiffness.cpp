// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "kernels/continuum_stiffness.hpp"

#include <cmath>

namespace asperity {

namespace {

/// q h from which the upper surface of a layer is not felt at the lower one, to 1e-16.
constexpr double thick = 40.0;

/// A symmetric matrix on (U, w), and the number across the wave.
struct PlaneMatrix {
    double along = 0.0, normal = 0.0, coupling = 0.0;
    double across = 0.0;
};

PlaneMatrix inverse(const PlaneMatrix& m) {
    const double det = m.along * m.normal - m.coupling * m.coupling;
    return {m.normal / det, m.along / det, -m.coupling / det, 1.0 / m.across};
}

PlaneMatrix sum(const PlaneMatrix& a, const PlaneMatrix& b) {
    return {a.along + b.along, a.normal + b.normal, a.coupling + b.coupling, a.across + b.across};
}

/// A layer below others: a, p^-1 and t of the head of the header.
struct LayerMatrices {
    PlaneMatrix clamped, free;
    double t_along = 0.0, t_normal = 0.0, t_along_normal = 0.0, t_normal_along = 0.0;
    double t_across = 0.0;
};

/// Returns sinh x - x.
double sinh_less_x(double x) {
    if (x > 0.5) return std::sinh(x) - x;
    const double y = x * x;
    return x * y / 6.0 *
           (1.0 +
            y / 20.0 * (1.0 + y / 42.0 * (1.0 + y / 72.0 * (1.0 + y / 110.0 * (1.0 + y / 156.0)))));
}

/// Returns x cosh x - sinh x.
double x_cosh_less_sinh(double x) {
    if (x > 0.5) return x * std::cosh(x) - std::sinh(x);
    const double y = x * x;
    return x * y / 3.0 *
           (1.0 +
            y / 10.0 * (1.0 + y / 28.0 * (1.0 + y / 54.0 * (1.0 + y / 88.0 * (1.0 + y / 130.0)))));
}

LayerMatrices matrices(const SolidLayer& layer, double q) {
    const double mu_q = layer.shear_modulus * q, nu = layer.poisson, x = q * layer.thickness;
    const double k = 3.0 - 4.0 * nu, c = 1.0 - 2.0 * nu;
    LayerMatrices m;
    if (x > thick) {
        m.clamped.along = m.clamped.normal = 4.0 * (1.0 - nu) * mu_q / k;
        m.clamped.coupling = -2.0 * c * mu_q / k;
        m.clamped.across = mu_q;
        m.free = m.clamped;
        return m;
    }
    const double sinh = std::sinh(x), cosh = std::cosh(x), sinh2 = sinh * sinh;
    const double less = sinh_less_x(x), half_less = 0.5 * sinh_less_x(2.0 * x);
    const double k_less = 2.0 * c * sinh; // (k - 1) sinh X
    const double a = 4.0 * (1.0 - nu) * mu_q / ((k_less + less) * (k * sinh + x));
    m.clamped.along = a * (k_less * cosh + half_less);
    m.clamped.normal = a * (k * sinh * cosh + x);
    m.clamped.coupling = -a * (k * c * sinh2 - x * x) / (2.0 * (1.0 - nu));
    m.clamped.across = mu_q * cosh / sinh;
    const double p = (1.0 - nu) / (mu_q * less * (sinh + x));
    m.free = inverse({p * half_less, p * (sinh * cosh + x),
                      p * (c * sinh2 + x * x) / (2.0 * (1.0 - nu)), cosh / (mu_q * sinh)});
    const double r_along = -p * x_cosh_less_sinh(x), r_normal = p * (sinh + x * cosh);
    const double r_mixed = p * x * sinh;
    m.t_along = r_along * m.free.along - r_mixed * m.free.coupling;
    m.t_along_normal = r_along * m.free.coupling - r_mixed * m.free.normal;
    m.t_normal_along = r_mixed * m.free.along + r_normal * m.free.coupling;
    m.t_normal = r_mixed * m.free.coupling + r_normal * m.free.normal;
    m.t_across = 1.0 / cosh;
    return m;
}

/// Returns p^-1 + t^T (above^-1 + d^-1)^-1 t.
PlaneMatrix below(const LayerMatrices& m, const PlaneMatrix& above) {
    PlaneMatrix d = m.clamped;
    d.coupling = -d.coupling;
    const PlaneMatrix e = inverse(sum(inverse(above), inverse(d)));
    const double u_along = e.along * m.t_along + e.coupling * m.t_normal_along; // e t
    const double w_along = e.coupling * m.t_along + e.normal * m.t_normal_along;
    const double u_normal = e.along * m.t_along_normal + e.coupling * m.t_normal;
    const double w_normal = e.coupling * m.t_along_normal + e.normal * m.t_normal;
    return sum(m.free, {m.t_along * u_along + m.t_normal_along * w_along,
                        m.t_along_normal * u_normal + m.t_normal * w_normal,
                        m.t_along * u_normal + m.t_normal_along * w_normal,
                        m.t_across * e.across * m.t_across});
}

/// Returns the stiffness of the uniform wave: the layers are springs in series.
SurfaceMatrix uniform_stiffness(std::span<const SolidLayer> layers) {
    double shear = 0.0, normal = 0.0; // compliance
    for (const SolidLayer& layer : layers) {
        const double nu = layer.poisson, by_shear = layer.thickness / layer.shear_modulus;
        shear += by_shear;
        normal += by_shear * (1.0 - 2.0 * nu) / (2.0 * (1.0 - nu));
    }
    return {1.0 / shear, 1.0 / shear, 1.0 / normal, 0.0, 0.0, 0.0};
}

} // namespace

SurfaceMatrix continuum_stiffness(std::span<const SolidLayer> layers, double qx, double qy) {
    const double q = std::hypot(qx, qy);
    if (q == 0.0) return uniform_stiffness(layers);
    PlaneMatrix s = matrices(layers.back(), q).clamped;
    for (std::size_t i = layers.size() - 1; i-- > 0;)
        s = below(matrices(layers[i], q), s);
    const double c = qx / q, t = qy / q;
    return {c * c * s.along + t * t * s.across,
            t * t * s.along + c * c * s.across,
            s.normal,
            c * t * (s.along - s.across),
            c * s.coupling,
            t * s.coupling};
}

} // namespace asperity
