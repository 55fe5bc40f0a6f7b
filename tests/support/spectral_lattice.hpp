// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The lattice block's static response at one wavevector, straight from the definition of the cell
// energy: the 24 x 24 matrix of one cell, folded to two planes, and the planes eliminated one by
// one from the clamped top. Shares nothing with the kernels or the block: it is their reference.
#pragma once

#include <array>
#include <vector>

namespace asperity::test {

/// Second derivatives of the energy of one cell, node by node (bits x, y, z), then by component.
using CellStiffness = std::array<std::array<double, 24>, 24>;
CellStiffness cell_stiffness(double spacing, double lame, double shear);

/// Cells of one material: lame = lambda, shear = mu in eV/Å^3.
struct LatticeLayer {
    int cells;
    double lame, shear;
};
/// Returns the frictionless normal stiffness of the surface of layers, from the surface upwards,
/// eV/Å^4: 1 / (S^-1)_zz per a^2. q in 1/Å.
double layered_stiffness(double qx, double qy, const std::vector<LatticeLayer>& layers,
                         double spacing);

/// Frictionless normal stiffness of the surface, 1 / (S^-1)_zz per a^2, in units of E* q / 2.
/// q in 1/Å; lame = lambda, shear = mu in eV/Å^3; thickness in cells.
double surface_stiffness_ratio(double qx, double qy, int thickness, double spacing, double lame,
                               double shear);

} // namespace asperity::test
