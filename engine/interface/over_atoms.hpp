// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A substrate of atoms at arbitrary positions, each with the potential of its type.
#pragma once

#include "engine/interface/substrate_cells.hpp"
#include "engine/options/interface_options.hpp"

#include <vector>

namespace asperity {

/// A substrate of atoms at arbitrary positions.
class OverAtoms {
public:
    /// Makes the cells. spacing: spacing of the sites, Å. Throws std::invalid_argument for a tail,
    /// and for a cutoff above largest_cell_cutoff.
    OverAtoms(const AtomPositions& atoms, const Tile& tile, double spacing,
              const InterfaceOptions& options);

    /// Computes the forces on row y of the sites and adds to the sums. how: options of the sweep.
    void sweep_row(const InterfaceSites& sites, int y, SweepOptions how, InterfaceSums& sums) const;
    /// Computes the forces on row y of the sites by the reference loop over all atoms, and adds to
    /// the sums.
    void reference_row(const InterfaceSites& sites, int y, InterfaceSums& sums) const;

    std::size_t bytes() const { return cells_.bytes(); }

private:
    PairTable pairs() const { return {pairs_.data(), static_cast<int>(pairs_.size())}; }

    std::vector<PairPotential> pairs_; ///< potentials by type
    SubstrateCells cells_;
};

} // namespace asperity
