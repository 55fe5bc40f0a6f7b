// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Newton's direction of a spectral block: (S + H) d = -g by conjugate gradients, preconditioned
// with (S + k)^-1, in single precision and without sweeps of the interface. H, the interface's
// Hessian, is a map of 3 x 3 matrices (interface_stiffness.hpp).
#pragma once

#include "engine/interface/interface_stiffness.hpp"
#include "engine/options/scales.hpp"
#include "engine/waves/preconditioner.hpp"

namespace asperity {

/// Newton's method for a block at rest over an interface.
class Newton {
public:
    /// Allocates the work arrays. Keeps references to block and preconditioner.
    Newton(const Response& block, const Preconditioner& preconditioner, const Scales& scales);

    /// Computes the direction d at the block's displacements; interface_force() and the gradient g
    /// must be up to date. Conjugate gradients stop at a residual of `forcing` times the gradient,
    /// both in the norm of the preconditioner. Returns false, without a direction, if a negative
    /// curvature is met. Collective.
    bool direction(const Interface& interface, double forcing, const Waves<double>& g,
                   Waves<float>& d);
    /// Measures the mean stiffness of the interface per site at the block's displacements, eV/Å^2.
    /// Collective.
    double mean_stiffness(const Interface& interface);

private:
    /// Sets p to P r + fraction p and q to (S + H) p. Returns p.q.
    double multiply(double fraction);
    /// Sets d to d + a p and r to r - a q. Returns r.(P r).
    double advance(double a, Waves<float>& d);

    const Response& block_;
    const Preconditioner& preconditioner_;
    InterfaceStiffness stiffness_;
    Waves<float> r_, p_, q_;
};

} // namespace asperity
