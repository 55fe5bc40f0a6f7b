// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "kernels/continuum_stiffness.hpp"

#include "kernels/continuum_layer.hpp"

#include <cmath>

namespace asperity {

namespace {

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
    PlaneMatrix s = layer_matrices(layers.back(), q).clamped;
    for (std::size_t i = layers.size() - 1; i-- > 0;)
        s = stiffness_below(layer_matrices(layers[i], q), s);
    const double c = qx / q, t = qy / q;
    return {c * c * s.along + t * t * s.across,
            t * t * s.along + c * c * s.across,
            s.normal,
            c * t * (s.along - s.across),
            c * s.coupling,
            t * s.coupling};
}

} // namespace asperity
