// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Forces between the block's lowest layer and the rigid substrate: pairs (pair_potential.hpp), or a
// wall with a law of the gap below each site (wall_law.hpp), which has a sweep of its own.
//
// The substrate's atoms are a map of heights over a square lattice, or have arbitrary positions.
// There are four sweeps:
//   reference  explicit scalar loop over all pairs of a site with substrate atoms in reach, against
//              which the other three are tested;
//   lattice    both sides are the same lattice, so the neighbours of a site are known offsets: SIMD
//              over sites, sums in registers over the offsets in a fixed order;
//   rows       a substrate of another spacing (incommensurate): site by site, SIMD over the
//              atoms along x, row after row;
//   cells      arbitrary atoms, sixteen to a cell: site by site, SIMD over the atoms of the cells
//              near it.
//
// The lattice sweep exists in double and in mixed precision; in mixed precision the pairs of a site
// and their sums are in single precision, for potentials that allow it. Heights are then 32-bit
// integers, multiples of 2^-22 Å, whose differences are exact at any place and height before they
// are converted to float.
//
// Sites beyond the interaction range are skipped. The largest height of the substrate is tabulated
// for each block of sixteen sites along x, in rings of lateral distance around the block. The
// lowest site of the block gives a gap, the gap gives the lateral distance beyond which no pair
// interacts, and only nearer offsets (atoms) are visited; the others would add exact zeros.
// The smallest heights of the substrate, tabulated in the same rings, show which offsets need no
// comparison with the cutoff. The sweep over cells compares each site with the bounds of the cells
// near its block.
//
// Reproducibility: a site's force is summed in an order that depends on the site alone (index of
// the offset, index of the atom relative to the site, index of the cell) and not on its tile, block
// or lane, so that the force is bitwise identical for any decomposition and number of threads. Sums
// over sites are exact sums.
//
// Sites displaced laterally by more than offset_margin (as in a run that a guard is about to stop)
// are summed one by one with the reference loop, so that no pair is missed.
#pragma once

#include "kernels/pair_sum.hpp"
#include "kernels/wall_kernels.hpp"

namespace asperity {

/// Sweeps rows [row_begin, row_end) with pair_sum() for each site: the reference for the other
/// sweeps.
void reference_sweep(const InterfaceSites& sites, const SubstrateMap& map,
                     const PairPotential& potential, int row_begin, int row_end,
                     InterfaceSums& sums);
void reference_sweep(const InterfaceSites& sites, const SubstrateAtoms& atoms,
                     const PairTable& pairs, int row_begin, int row_end, InterfaceSums& sums);

/// Adds the tail (pair_potential.hpp) of a substrate of `density` atoms per Å^2 to the forces and
/// sums of a sweep; mean_height: height of the local mean plane below each site, Å; observe: also
/// adds energies and recounts the repulsive sites. Requires a potential with a tail.
void tail_sweep(const InterfaceSites& sites, const PairPotential& potential, double density,
                PlaneView<const double> mean_height, int row_begin, int row_end, bool observe,
                InterfaceSums& sums);

/// Sweeps compiled for one processor level. Each sweep overwrites the forces of rows [row_begin,
/// row_end) of the tile; with [observe] = 1 it also computes energy, contacts and nearest
/// distances.
struct InterfaceKernels {
    template <class Substrate, class Potential = PairPotential>
    using Sweep = void (*)(const InterfaceSites&, const Substrate&, const Potential&, int row_begin,
                           int row_end, InterfaceSums&);
    template <class Substrate, class Potential = PairPotential>
    struct Sweeps {
        Sweep<Substrate, Potential> of[2]; ///< [observe]
    };
    /// Sweeps over a lattice in double and mixed precision.
    struct LatticeSweeps {
        Sweep<LatticeSubstrate> in_double[2], mixed[2]; ///< [observe]
    };
    LatticeSweeps lattice;
    Sweeps<RowSubstrate> rows;
    Sweeps<CellSubstrate, PairTable> cells;
    WallKernels wall;
};

/// Returns the kernels for the running processor (processor_level()).
const InterfaceKernels& interface_kernels();

} // namespace asperity
