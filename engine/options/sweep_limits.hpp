// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Limits of the tables of the interface's sweeps (kernels/substrates.hpp), as lengths.
#pragma once

#include "kernels/substrates.hpp"

#include <algorithm>

namespace asperity {

/// Returns the largest lateral displacement of a site that the tables allow for, Å. spacing: Å.
inline double sideways_margin(double spacing) { return 2.0 * spacing; }

/// Returns the lateral displacement of a site up to which its rank knows the heights below it,
/// where the block does not slide, Å: a site displaced further has left the model. spacing: Å.
inline double farthest_sideways(double spacing) { return 64.0 * spacing; }

/// Returns the largest cutoff that the tables allow for over a substrate of one layer, Å. spacing:
/// spacing of the sites, Å; between_atoms: spacing of the atoms, Å.
inline double largest_cutoff(double spacing, double between_atoms) {
    return std::min((max_half_offsets - 2) * spacing, (max_rows - 3) * between_atoms) -
           sideways_margin(spacing);
}

} // namespace asperity
