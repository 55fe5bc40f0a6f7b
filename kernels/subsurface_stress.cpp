// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "kernels/subsurface_stress.hpp"

#include "kernels/continuum_layer.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace asperity {

namespace {

/// Components along, normal to, and across the wave.
struct PlaneVector {
    double along = 0.0, normal = 0.0, across = 0.0;
};

PlaneVector product(const PlaneMatrix& m, const PlaneVector& v) {
    return {m.along * v.along + m.coupling * v.normal, m.coupling * v.along + m.normal * v.normal,
            m.across * v.across};
}

/// Returns t u, the displacement of the upper surface of a layer if it were free.
PlaneVector carried(const LayerMatrices& m, const PlaneVector& u) {
    return {m.t_along * u.along + m.t_along_normal * u.normal,
            m.t_normal_along * u.along + m.t_normal * u.normal, m.t_across * u.across};
}

/// Cuts the layers at the depths. The layers between two cuts follow each other; ends[k]: number of
/// layers below cut k.
std::vector<SolidLayer> cut(std::span<const SolidLayer> layers, std::span<const double> depths,
                            std::vector<std::size_t>& ends) {
    std::vector<SolidLayer> parts;
    parts.reserve(layers.size() + depths.size());
    double top = 0.0, from = 0.0;
    std::size_t k = 0;
    for (std::size_t i = 0; i < layers.size(); ++i) {
        top += layers[i].thickness;
        for (; k < depths.size() && (depths[k] <= top || i + 1 == layers.size()); ++k) {
            if (depths[k] > from) {
                parts.push_back(layers[i]);
                parts.back().thickness = depths[k] - from;
                from = depths[k];
            }
            ends.push_back(parts.size());
        }
        if (top > from) {
            parts.push_back(layers[i]);
            parts.back().thickness = top - from;
            from = top;
        }
    }
    return parts;
}

/// Returns the layer at a depth.
const SolidLayer& layer_at(std::span<const SolidLayer> layers, double depth) {
    double top = 0.0;
    for (const SolidLayer& layer : layers) {
        top += layer.thickness;
        if (depth <= top) return layer;
    }
    return layers.back();
}

/// Sets the stresses of one column: the traction f on the cut and the displacement u there.
void set_stress(const SolidLayer& layer, double q, const PlaneVector& f, const PlaneVector& u,
                double* along, double* normal, double* shear) {
    const double nu = layer.poisson;
    *normal = -f.normal;
    *shear = -f.along;
    *along = (2.0 * layer.shear_modulus * q * u.along + nu * *normal) / (1.0 - nu);
}

} // namespace

std::vector<WaveStress> subsurface_stress(std::span<const SolidLayer> layers, double q,
                                          std::span<const double> depths) {
    std::vector<std::size_t> ends;
    ends.reserve(depths.size());
    const std::vector<SolidLayer> parts = cut(layers, depths, ends);
    // The sums begin at the clamped surface: the matrices of each part, the stiffness between it
    // and the parts above it, and the stiffness at its lower surface.
    const std::size_t count = parts.size();
    std::vector<LayerMatrices> matrices(count);
    std::vector<PlaneMatrix> between(count), stiffness(count);
    matrices[count - 1] = layer_matrices(parts[count - 1], q);
    stiffness[count - 1] = matrices[count - 1].clamped;
    for (std::size_t i = count - 1; i-- > 0;) {
        matrices[i] = layer_matrices(parts[i], q);
        between[i] = stiffness_between(matrices[i], stiffness[i + 1]);
        stiffness[i] = stiffness_below(matrices[i], stiffness[i + 1]);
    }
    // The vectors lead from the loaded surface upwards. The first one is that of a pressure,
    // (0, i P), with a number across the wave beside; the second one that of a traction along.
    PlaneVector f[2] = {{0.0, 1.0, 1.0}, {1.0, 0.0, 0.0}}, u[2];
    for (int k : {0, 1})
        u[k] = product(inverse(stiffness[0]), f[k]);
    std::vector<WaveStress> found;
    found.reserve(depths.size());
    std::size_t below = 0;
    for (const std::size_t end : ends) {
        for (; below < end; ++below) {
            const PlaneMatrix compliance = inverse(stiffness[below + 1]);
            for (int k : {0, 1}) {
                f[k] = product(between[below], carried(matrices[below], u[k]));
                u[k] = product(compliance, f[k]);
            }
        }
        const SolidLayer& layer = end > 0 ? parts[end - 1] : parts.front();
        WaveStress s;
        s.poisson = layer.poisson;
        // f_z = -i (i P) of the pressure; its strain is i q U with U of i P.
        set_stress(layer, q, f[0], {-u[0].along, 0.0, 0.0}, &s.pressure.xx, &s.pressure.zz,
                   &s.pressure.xz);
        // i f_z is the normal component: f_z = -i times it.
        set_stress(layer, q, {f[1].along, -f[1].normal, 0.0}, u[1], &s.shear.xx, &s.shear.zz,
                   &s.shear.xz);
        s.across.yz = -f[0].across;
        s.across.xy = layer.shear_modulus * q * u[0].across;
        found.push_back(s);
    }
    return found;
}

double poisson_at(std::span<const SolidLayer> layers, double depth) {
    return layer_at(layers, depth).poisson;
}

double uniform_lateral_stress(std::span<const SolidLayer> layers, double depth, bool free_sides) {
    const SolidLayer& layer = layer_at(layers, depth);
    const double nu = layer.poisson;
    if (!free_sides) return -nu / (1.0 - nu);
    const SolidLayer& base = layers.back();
    const double strain =
        -(1.0 - 2.0 * base.poisson) / (2.0 * base.shear_modulus); // along the wave
    const double along = (2.0 * layer.shear_modulus * strain - nu) / (1.0 - nu);
    return 0.5 * (along + nu * (along - 1.0));
}

double von_mises(const Stress& s) {
    const double a = s.xx - s.yy, b = s.yy - s.zz, c = s.zz - s.xx;
    return std::sqrt(0.5 * (a * a + b * b + c * c) +
                     3.0 * (s.xy * s.xy + s.xz * s.xz + s.yz * s.yz));
}

std::array<double, 3> principal_stresses(const Stress& s) {
    // The roots of the characteristic polynomial as cosines of a third of an angle.
    const double mean = (s.xx + s.yy + s.zz) / 3.0;
    const double xx = s.xx - mean, yy = s.yy - mean, zz = s.zz - mean;
    const double radius = von_mises(s) / 3.0; // the roots are within mean +- 2 radius
    if (radius == 0.0) return {mean, mean, mean};
    const double det = xx * (yy * zz - s.yz * s.yz) - s.xy * (s.xy * zz - s.yz * s.xz) +
                       s.xz * (s.xy * s.yz - yy * s.xz);
    const double cosine = std::clamp(det / (2.0 * radius * radius * radius), -1.0, 1.0);
    const double angle = std::acos(cosine) / 3.0;
    const double first = mean + 2.0 * radius * std::cos(angle);
    const double last = mean + 2.0 * radius * std::cos(angle + 2.0 * std::numbers::pi / 3.0);
    return {first, 3.0 * mean - first - last, last};
}

} // namespace asperity
