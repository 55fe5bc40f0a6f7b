// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Langevin noise of one node and step: normal numbers from a counter-based generator (Philox,
// Random123), and their effect on velocity and displacement. For processor and device. Logarithm,
// sine and cosine are computed from additions, multiplications and divisions that are never fused,
// so that every compiler and machine gives bitwise identical results.
#pragma once

#include "kernels/annotations.hpp"
#include "kernels/kick.hpp"
#include "kernels/thermal_noise.hpp"

#include <Random123/philox.h>

#include <cmath>
#include <cstdint>

namespace asperity::ASPERITY_VARIANT {

/// Returns ln(x) for normal numbers 0 < x <= 1, within two units of the last place.
ASPERITY_INLINE double logarithm(double x) {
    const auto bits = __builtin_bit_cast(std::uint64_t, x);
    int exponent = static_cast<int>(bits >> 52) - 1023;
    double m = __builtin_bit_cast(double, (bits & 0xfffffffffffffu) | 0x3ff0000000000000u);
    if (m > 1.4142135623730951) m *= 0.5, ++exponent;
    // ln m = 2 artanh s = 2 (s + s^3/3 + s^5/5 + ...), |s| < 0.172.
    const double s = (m - 1.0) / (m + 1.0), q = s * s;
    double sum = 0.0;
    ASPERITY_UNROLL(9)
    for (int k = 19; k >= 3; k -= 2)
        sum = (sum + 1.0 / k) * q;
    return exponent * 0.6931471805599453 + 2.0 * (s + s * sum);
}

/// Cosine and sine of an angle.
struct CosineSine {
    double cosine, sine;
};
/// Returns cosine and sine of the angle 2 pi (bits + 1/2) / 2^32, within 2e-16.
ASPERITY_INLINE CosineSine cosine_and_sine(std::uint32_t bits) {
    // The nearest quarter of a turn, and the remainder x, |x| <= pi/4.
    const std::uint32_t quarter = (bits + 0x20000000u) >> 30;
    const auto remainder = static_cast<std::int32_t>(bits - (quarter << 30));
    const double x = (remainder + 0.5) * 1.4629180792671596e-9; // 2 pi / 2^32
    const double q = x * x;
    double c = 1.0, s = 1.0;
    ASPERITY_UNROLL(8)
    for (int k = 16; k >= 2; k -= 2) {
        c = 1.0 - c * (q * (1.0 / ((k - 1) * k)));
        s = 1.0 - s * (q * (1.0 / (k * (k + 1))));
    }
    s *= x;
    const bool odd = quarter & 1u;
    const double along = odd ? -s : c, across = odd ? c : s;
    return quarter & 2u ? CosineSine{-along, -across} : CosineSine{along, across};
}

/// Returns three independent normal numbers (mean 0, variance 1) of a node in a step. level, x, y,
/// z: place of the node in the block.
ASPERITY_INLINE Triple<double> normals(const ThermalNoise& noise, int level, int x, int y, int z) {
    const auto u = static_cast<std::uint64_t>(noise.step);
    // The C interface, whose functions are static: no variant's code is linked into another's.
    const philox4x32_ctr_t counter = {
        {static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y),
         static_cast<std::uint32_t>(z) | static_cast<std::uint32_t>(level) << 24,
         static_cast<std::uint32_t>(u)}};
    const philox4x32_key_t key = {{static_cast<std::uint32_t>(noise.seed ^ (u >> 32) * 0x9E3779B9u),
                                   static_cast<std::uint32_t>(noise.seed >> 32)}};
    const philox4x32_ctr_t bits = philox4x32(counter, key);
    const auto radius = [](std::uint32_t b) {
        return std::sqrt(-2.0 * logarithm((b + 0.5) * 0x1p-32));
    };
    const double r1 = radius(bits.v[0]), r2 = radius(bits.v[2]);
    const CosineSine first = cosine_and_sine(bits.v[1]), second = cosine_and_sine(bits.v[3]);
    return {r1 * first.cosine, r1 * first.sine, r2 * second.cosine};
}

/// Changes of the sums of a step by its noise, eV, or eV per mass.
struct NoiseEnergies {
    double heat = 0.0;    ///< energy given to the nodes
    double kinetic = 0.0; ///< change of the kinetic energy at the whole step
};
ASPERITY_INLINE NoiseEnergies operator+(const NoiseEnergies& a, const NoiseEnergies& b) {
    return {a.heat + b.heat, a.kinetic + b.kinetic};
}

/// Adds `add` to the velocity v(n+1/2) of a node along one axis and dt add to its displacement
/// u(n+1). old: v(n-1/2); medium: velocity of the damping medium V. Returns the changes of energy
/// per mass.
///
/// Friction and noise act at the fixed place u(n), between two half kicks of the force F: from
/// v(n-1/2) to p = v(n-1/2) + dt F/2m, and from p' = v(n+1/2) - dt F/2m to v(n+1/2). They change
/// the kinetic energy by exactly m (p'^2 - p^2)/2, and the kinetic energy of the whole step is the
/// mean m (p^2 + p'^2)/4. With w = (old + v)/2 before the noise, g = Gamma dt/2, p' - p = add - 2 g
/// (w - V) and p' + p = 2 w + add. The terms without noise are summed by the kick (kick.hpp).
ASPERITY_INLINE NoiseEnergies push(const ThermalNoise& noise, double old, double& v, double& u,
                                   double add, double medium) {
    const double w = 0.5 * (old + v), lost = (noise.drag - 1.0) * (w - medium);
    const double jump = add - 2.0 * lost;
    v = v + add;
    u = u + noise.dt * add;
    return {add * (w - lost + 0.5 * add), 0.5 * (add * w + 0.25 * add * add + 0.25 * jump * jump)};
}

/// Returns the standard deviation of the change of velocity of a node of mass m (eV fs^2/Å^2) by
/// noise, Å/fs.
ASPERITY_INLINE double noise_speed(const ThermalNoise& noise, double m) {
    return std::sqrt(noise.strength / m) / noise.drag;
}

/// Adds the noise of a node of mass m (eV fs^2/Å^2) to v and u. xi: normal numbers; old: v(n-1/2).
/// Returns the changes of energy, eV.
ASPERITY_INLINE NoiseEnergies add_noise(const ThermalNoise& noise, double m,
                                        const Triple<double>& xi, const Triple<double>& old,
                                        Triple<double>& v, Triple<double>& u) {
    const double sigma = noise_speed(noise, m);
    const NoiseEnergies x = push(noise, old.x, v.x, u.x, sigma * xi.x, 0.0);
    const NoiseEnergies y = push(noise, old.y, v.y, u.y, sigma * xi.y, 0.0);
    const NoiseEnergies all = x + y + push(noise, old.z, v.z, u.z, sigma * xi.z, noise.medium_z);
    return {m * all.heat, m * all.kinetic};
}

} // namespace asperity::ASPERITY_VARIANT
