// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Substrate atoms at arbitrary positions, in cells for the sweep over cells
// (kernels/substrates.hpp).
//
// Each type of atoms has separate cells, so that the pairs of a cell have one potential. The atoms
// are halved along the longest edge of their bounds, at a multiple of cell_atoms, until cell_atoms
// or fewer are left, so that the cells of any solid are compact and full. Ties are broken by the
// index of the atom, so that every rank makes the same cells in the same order. The substrate is
// rigid: cells and the lists of cells near each block of sites are made once.
#pragma once

#include "decomposition/tile.hpp"
#include "engine/options/substrate.hpp"
#include "kernels/substrates.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace asperity {

/// Parameters of the cells.
struct CellOptions {
    double spacing = 2.6;                  ///< spacing of the sites, Å
    std::vector<double> cutoffs = {13.12}; ///< cutoff of each type, Å, at most largest_cell_cutoff
    double margin = 5.2;                   ///< lateral displacement that the lists allow for, Å
    bool skip = true; ///< skip blocks of sites; false: none (bitwise identical; for tests)
};

/// Substrate atoms in cells.
class SubstrateCells {
public:
    /// Makes the cells, and for the sites of a tile the lists of cells within reach; the box is
    /// tile.sites spacings wide. Throws std::invalid_argument if an atom's type has no cutoff.
    SubstrateCells(AtomPositions atoms, const Tile& tile, const CellOptions& options);

    /// Returns a view of the cells for the sweep.
    CellSubstrate view() const;
    /// Returns a view of the atoms for the reference loop.
    SubstrateAtoms atoms() const;

    std::size_t bytes() const; ///< returns the memory of the cells, bytes

private:
    struct Tree;
    void fill(const Tree& tree);
    void list(const Tree& tree, const Tile& tile, const CellOptions& options);

    AtomPositions atoms_; ///< atoms as given
    double edge_, datum_, margin_;
    std::vector<double> places_;
    std::vector<double> bounds_, block_highest_;
    std::vector<CellImage> images_;
    std::vector<std::int64_t> block_first_;
    int blocks_ = 0;
};

} // namespace asperity
