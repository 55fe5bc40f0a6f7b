// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Stiffness of the interface at each site: -dF/du, six numbers a site, or -dF_z/du_z alone.
//
// The substrate is rigid, so the force on a site depends on its own position alone, and the
// interface's whole Hessian is this map of 3 x 3 matrices. Three sweeps, with all sites displaced
// by a little along x, y and z, give it by differences; the normal component alone takes one. The
// displacement is a compromise: the force's own curvature requires a small one, its steps at the
// cutoff (1.2e-4 of a site's largest attraction a pair, at 4 r0) a large one. Each measurement
// displaces in the direction opposite to the last: a site beside such a step, whose difference
// gives a wrong stiffness, is then measured on its other side.
#pragma once

#include "decomposition/field.hpp"
#include "decomposition/surface_transform.hpp"
#include "engine/interface/interface.hpp"
#include "kernels/surface_rows.hpp"

namespace asperity {

/// Stiffness of the interface at each site of a tile.
class InterfaceStiffness {
public:
    /// Allocates the map. components: three, or one: the normal. difference: the displacement, Å.
    /// home: workspace that its memory comes from; null: none.
    InterfaceStiffness(const Tile& tile, int components, double difference,
                       Workspace* home = nullptr);

    /// Measures the stiffness at these displacements, at which the force is given.
    void measure(const Interface& interface, const VectorPlane<const double>& u,
                 const VectorPlane<const double>& force);
    /// Returns the mean over all sites of -dF_z/du_z, zero where it is negative, eV/Å^2.
    /// Collective.
    double mean(const Interface& interface, const VectorPlane<const double>& u,
                const VectorPlane<const double>& force, const Communicator& ranks);
    /// Multiplies the sites of row y: v <- H v; v: the row of each component.
    void apply_row(int y, float* const* v) const;

private:
    /// Returns the map of an entry (matrix_entry); that of zz is the only one of one component.
    PlaneView<float> entry(int e) { return map_[displaced_.empty() ? 0 : e].plane(0); }
    PlaneView<const float> entry(int e) const { return map_[displaced_.empty() ? 0 : e].plane(0); }

    double sites_;         ///< number of sites across the box
    double difference_;    ///< displacement, Å, of either sign
    SiteField<float> map_; ///< eV/Å^2, by entry
    /// displaced_: displacements with the difference, of three components
    VectorField<double> displaced_, force_;
};

} // namespace asperity
