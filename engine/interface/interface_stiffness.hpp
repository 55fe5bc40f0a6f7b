// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Stiffness of the interface at each site: -dF/du, six numbers a site, or -dF_z/du_z alone.
//
// The substrate is rigid, so the force on a site depends on its own position alone, and the
// interface's whole Hessian is this map of 3 x 3 matrices. The map is computed by finite
// differences from three sweeps with all sites displaced along x, y and z, or from one sweep for
// the normal component alone. The displacement is a compromise between the curvature of the force,
// which requires a small one, and the steps of the force at the cutoff (1.2e-4 of a site's largest
// attraction per pair, at 4 r0), which require a large one. Successive measurements displace in
// opposite directions, so that a site whose difference crosses such a step is measured on the other
// side the next time.
#pragma once

#include "decomposition/field.hpp"
#include "decomposition/surface_transform.hpp"
#include "engine/interface/interface.hpp"
#include "kernels/surface_rows.hpp"

namespace asperity {

/// Stiffness of the interface at each site of a tile.
class InterfaceStiffness {
public:
    /// Allocates the map. components: 3, or 1 for the normal component alone; difference:
    /// displacement, Å; home: workspace of the memory, nullptr for none.
    InterfaceStiffness(const Tile& tile, int components, double difference,
                       Workspace* home = nullptr);

    /// Measures the stiffness at the displacements u, Å. force: the interface's forces at u, eV/Å.
    void measure(const Interface& interface, const VectorPlane<const double>& u,
                 const VectorPlane<const double>& force);
    /// Measures the mean over all sites of max(-dF_z/du_z, 0), eV/Å^2. Arguments as for measure().
    /// Collective.
    double mean(const Interface& interface, const VectorPlane<const double>& u,
                const VectorPlane<const double>& force, const Communicator& ranks);
    /// Multiplies the sites of row y by their matrices, v <- H v. v: pointer to row y of each
    /// component.
    void apply_row(int y, float* const* v) const;

private:
    /// Returns the map of an entry (matrix_entry); with one component the only map is zz.
    PlaneView<float> entry(int e) { return map_[displaced_.empty() ? 0 : e].plane(0); }
    PlaneView<const float> entry(int e) const { return map_[displaced_.empty() ? 0 : e].plane(0); }

    double sites_;         ///< number of sites across the box
    double difference_;    ///< displacement, Å, whose sign alternates
    SiteField<float> map_; ///< eV/Å^2, by entry
    /// displaced_: displacements with the difference added, three components.
    VectorField<double> displaced_, force_;
};

} // namespace asperity
