// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// S(q): static stiffness of an elastic continuum at its lower surface, wave by wave: the limit of a
// lattice (surface_stiffness.hpp) for fine cells.
//
// The solid is a stack of isotropic layers, its upper surface clamped. In a layer of shear modulus
// mu, Poisson ratio nu and thickness h a wave exp(i q x) displaces by u_x = U(Z) exp(i q x), u_z =
// -i w(Z) exp(i q x), Z = q z, with
//
//     U'' - U = p,   w'' - w = p',   U - w' = (1 - 2 nu) p,   p'' = p,
//
// whose solutions are (A + B Z) exp(-Z) + (C + D Z) exp(Z). The tractions are mu q (U' + w) along
// the wave and mu q (2 w' - 2 nu p) along z. Solutions that are even and odd about the middle of
// the layer give, with X = q h, k = 3 - 4 nu, c = 1 - 2 nu, in closed form on (U, w)
//
//     a, stiffness of the lower surface below a clamped upper one, times Q / (4 (1 - nu) mu q),
//         Q = k^2 sinh^2 X - X^2:
//         k sinh cosh - X,   k sinh cosh + X,   coupling -(k c sinh^2 - X^2) / (2 (1 - nu)),
//     p^-1, stiffness of the lower surface below a free upper one, over 2 mu q e / M, with e = 1 +
//     c,
//         M = e^2 + (1 + 2 c) sinh^2 X + X^2:
//         sinh cosh + X,     sinh cosh - X,     coupling -(c sinh^2 + X^2) / e,
//     t, displacement of the free upper surface by that of the lower one, over e / M:
//         ( e cosh - X sinh    -c sinh - X cosh )
//         ( X cosh - c sinh     e cosh + X sinh ).
//
// The stiffness follows from the top layer downwards by a sum without cancellation, with d the
// matrix a with the other sign of the coupling:
//
//     S_1 = a,      S_(n+1) = p^-1 + t^T (S_n^-1 + d^-1)^-1 t.
//
// Across the wave a is mu q coth X, p^-1 mu q tanh X and t 1 / cosh X.
//
// All terms are finite at nu = 1/2 but the uniform wave, which compresses the layers. A half-space
// has S = E* q / 2 against normal forces without friction, 1 / (S^-1)_zz.
#pragma once

#include "kernels/surface_stiffness.hpp"

#include <span>

namespace asperity {

/// Layer of an isotropic solid.
struct SolidLayer {
    double shear_modulus = 0.0; ///< eV/Å^3
    double poisson = 0.0;
    double thickness = 0.0; ///< Å
};

/// Returns S of the wave (qx, qy), 1/Å, per area, eV/Å^4. layers: in the order from the lower
/// surface upwards. Relative error 1e-12.
SurfaceMatrix continuum_stiffness(std::span<const SolidLayer> layers, double qx, double qy);

} // namespace asperity
