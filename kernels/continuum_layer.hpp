// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Matrices of one layer of an isotropic solid for a wave: a, p^-1 and t of continuum_stiffness.hpp,
// and the stiffness of a stack of such layers.
#pragma once

#include "kernels/continuum_stiffness.hpp"

namespace asperity {

/// A symmetric matrix on (U, w), and the number across the wave.
struct PlaneMatrix {
    double along = 0.0, normal = 0.0, coupling = 0.0;
    double across = 0.0;
};

PlaneMatrix inverse(const PlaneMatrix& m);                   ///< returns the inverse
PlaneMatrix sum(const PlaneMatrix& a, const PlaneMatrix& b); ///< returns a + b

/// A layer below others: a, p^-1 and t of the head of continuum_stiffness.hpp.
struct LayerMatrices {
    PlaneMatrix clamped, free;
    double t_along = 0.0, t_normal = 0.0, t_along_normal = 0.0, t_normal_along = 0.0;
    double t_across = 0.0;
};

/// Returns the matrices of a layer for a wave q > 0, 1/Å.
LayerMatrices layer_matrices(const SolidLayer& layer, double q);
/// Returns (above^-1 + d^-1)^-1: the tractions by which a layer presses the stack above, over the
/// displacement that its upper surface would have if it were free.
PlaneMatrix stiffness_between(const LayerMatrices& m, const PlaneMatrix& above);
/// Returns the stiffness of a stack: that of a layer below others with the stiffness `above`, p^-1
/// + t^T (above^-1 + d^-1)^-1 t.
PlaneMatrix stiffness_below(const LayerMatrices& m, const PlaneMatrix& above);

} // namespace asperity
