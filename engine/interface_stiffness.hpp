// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// How stiff the interface holds each site: -dF/du, six numbers a site.
//
// The substrate is rigid, so the force on a site depends on its own position alone, and the
// interface's whole Hessian is this map of 3 x 3 matrices. Three sweeps, all sites displaced by a
// little along x, y and z, give it by differences. The displacement is a compromise: the force's
// own curvature asks for a small one, its steps at the cutoff (4.5e-5 eV/Å a pair at 4 r0) for a
// large one.
#pragma once

#include "decomposition/field.hpp"
#include "engine/interface.hpp"

namespace asperity {

class InterfaceStiffness {
public:
    explicit InterfaceStiffness(const Tile& tile)
        : diagonal_(tile, 1, 0), off_diagonal_(tile, 1, 0), displaced_(tile, 1, 0),
          force_(tile, 1, 0) {}

    /// At these displacements, where the force is as given.
    void measure(const Interface& interface, const VectorPlane<const double>& u,
                 const VectorPlane<const double>& force, double reference_height);
    /// v <- H v at every site.
    void apply(const VectorPlane<float>& v) const;
    std::size_t bytes() const {
        return diagonal_.bytes() + off_diagonal_.bytes() + displaced_.bytes() + force_.bytes();
    }

private:
    VectorField<float> diagonal_, off_diagonal_; ///< xx yy zz; xy xz yz, eV/Å^2
    VectorField<double> displaced_, force_;
};

} // namespace asperity
