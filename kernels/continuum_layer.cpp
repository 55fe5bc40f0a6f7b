// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "kernels/continuum_layer.hpp"

#include <cmath>

namespace asperity {

namespace {

/// q h from which the upper surface of a layer is not felt at the lower one, to 1e-16.
constexpr double thick = 40.0;

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

} // namespace

PlaneMatrix inverse(const PlaneMatrix& m) {
    const double det = m.along * m.normal - m.coupling * m.coupling;
    return {m.normal / det, m.along / det, -m.coupling / det, 1.0 / m.across};
}

PlaneMatrix sum(const PlaneMatrix& a, const PlaneMatrix& b) {
    return {a.along + b.along, a.normal + b.normal, a.coupling + b.coupling, a.across + b.across};
}

LayerMatrices layer_matrices(const SolidLayer& layer, double q) {
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
    const double e = 2.0 * (1.0 - nu);
    const double by = e / (e * e + (1.0 + 2.0 * c) * sinh2 + x * x), f = 2.0 * mu_q * by;
    m.free = {f * (sinh * cosh + x), f * half_less, -f * (c * sinh2 + x * x) / e,
              mu_q * sinh / cosh};
    m.t_along = by * (e * cosh - x * sinh);
    m.t_along_normal = -by * (c * sinh + x * cosh);
    m.t_normal_along = by * (2.0 * nu * sinh + x_cosh_less_sinh(x));
    m.t_normal = by * (e * cosh + x * sinh);
    m.t_across = 1.0 / cosh;
    return m;
}

PlaneMatrix stiffness_between(const LayerMatrices& m, const PlaneMatrix& above) {
    PlaneMatrix d = m.clamped;
    d.coupling = -d.coupling;
    return inverse(sum(inverse(above), inverse(d)));
}

PlaneMatrix stiffness_below(const LayerMatrices& m, const PlaneMatrix& above) {
    const PlaneMatrix e = stiffness_between(m, above);
    const double u_along = e.along * m.t_along + e.coupling * m.t_normal_along; // e t
    const double w_along = e.coupling * m.t_along + e.normal * m.t_normal_along;
    const double u_normal = e.along * m.t_along_normal + e.coupling * m.t_normal;
    const double w_normal = e.coupling * m.t_along_normal + e.normal * m.t_normal;
    return sum(m.free, {m.t_along * u_along + m.t_normal_along * w_along,
                        m.t_along_normal * u_normal + m.t_normal * w_normal,
                        m.t_along * u_normal + m.t_normal_along * w_normal,
                        m.t_across * e.across * m.t_across});
}

} // namespace asperity
