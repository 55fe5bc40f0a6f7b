// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The slow, obvious forms of the elastic kernels: energy and forces cell by cell, straight from the
// definition: of small strain by the matrix of a cell (spectral_lattice.hpp), of finite strain
// spring by spring.
#pragma once

#include "kernels/elastic_level.hpp"

namespace asperity::test {

/// Adds forces into out (all planes), eV/Å; returns the energy of all cells of the tile whose lower
/// corner is owned, eV. Forces on nodes at the edge are complete only if the halo of out is folded
/// back. Small strain (elastic_cell.hpp).
double elastic_reference(VectorVolume<const double> u, const LevelCell&, VectorVolume<double> out);
/// The same at finite strain (elastic_finite.hpp).
double finite_reference(VectorVolume<const double> u, const LevelCell&, VectorVolume<double> out);

} // namespace asperity::test
