// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Stresses inside a stack of isotropic layers by tractions on its lower surface, wave by wave.
//
// The stack is that of continuum_stiffness.hpp, z leads from the surface into it, and tension is
// positive. A cut at the depth z divides the stack into a layer below, of matrices p, d and t, and
// the rest above, of stiffness S. If the lower surface is displaced by u, the traction on the cut
// and the displacement of the cut are
//
//     f = (S^-1 + d^-1)^-1 t u,      u(z) = S^-1 f,
//
// products without cancellation, each as accurate as the stiffness, that decay with depth as the
// stress does. The stress follows from f and from the strain along the wave, i q U,
//
//     s_zz = -f_z,   s_xz = -f_x,   s_xx = 2 mu / (1 - nu) i q U + nu / (1 - nu) s_zz,
//     s_yy = nu (s_xx + s_zz),
//
// x along and y across the wave. In a half-space with Z = q z a pressure P cos(q x) gives
//
//     s_zz = -P (1 + Z) exp(-Z) cos,  s_xx = -P (1 - Z) exp(-Z) cos,  s_xz = -P Z exp(-Z) sin.
#pragma once

#include "kernels/continuum_stiffness.hpp"

#include <array>
#include <span>
#include <vector>

namespace asperity {

/// Stresses at a depth by tractions exp(i q x) of unit amplitude on the surface. The members of
/// each group are real; those named in its comment are to be multiplied by i.
struct WaveStress {
    double poisson = 0.0; ///< Poisson's ratio at this depth
    struct {
        double zz = 0.0, xx = 0.0, xz = 0.0;
    } pressure; ///< stress by a pressure; xz times i
    struct {
        double xz = 0.0, xx = 0.0, zz = 0.0;
    } shear; ///< stress by a traction along x on the solid; xx and zz times i
    struct {
        double yz = 0.0, xy = 0.0;
    } across; ///< stress by a traction along y on the solid; xy times i
};

/// Returns the stresses of a wave q > 0, 1/Å, at depths in ascending order, Å, each less than the
/// thickness of the stack. layers: in the order from the lower surface upwards. At the boundary of
/// two layers the stresses are those of the lower one. Relative error 1e-11.
std::vector<WaveStress> subsurface_stress(std::span<const SolidLayer> layers, double q,
                                          std::span<const double> depths);

/// Returns the Poisson ratio at a depth, Å; at the boundary of two layers that of the lower one.
double poisson_at(std::span<const SolidLayer> layers, double depth);

/// Returns the stress along x and y by a uniform pressure of 1. Held sides, as in a periodic box:
/// no strain along the surface. Free sides: the mean over all directions of the limit of long
/// waves, in which the layers follow the strain of the half-space below them.
double uniform_lateral_stress(std::span<const SolidLayer> layers, double depth, bool free_sides);

/// A symmetric tensor of stress.
struct Stress {
    double xx = 0.0, yy = 0.0, zz = 0.0, xy = 0.0, xz = 0.0, yz = 0.0;
};
double von_mises(const Stress& s); ///< returns the stress of von Mises
/// Returns the principal stresses, the largest first.
std::array<double, 3> principal_stresses(const Stress& s);

} // namespace asperity
