// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Forces between the block's lowest layer and the rigid substrate: pairs (pair_potential.hpp), or a
// wall with a law of the gap below each site (wall_law.hpp), which has a sweep of its own.
//
// Pairs are with a map of heights over a square lattice, or with atoms anywhere. Four sweeps:
//   reference  every site against every substrate atom in reach by an explicit loop over pairs,
//              scalar: the other three are tested against it;
//   lattice    both sides are the same lattice, so the neighbours of a site are known offsets: SIMD
//              over sites, sums in registers over the offsets in a fixed order;
//   rows       a substrate with a spacing of its own (incommensurate): site by site, SIMD over the
//              atoms along x, row after row;
//   cells      atoms anywhere, sixteen to a cell: site by site, SIMD over the atoms of the cells
//              near it.
//
// The lattice sweep exists twice: in double, and mixed: a site's pairs and their sums in single
// precision, of potentials that allow for it. Mixed heights are 32-bit integers, multiples of 2^-22
// Å: the difference of two is exact, wherever in the box and however high it is formed, and only
// then becomes a float.
//
// Sites beyond the interaction range are skipped. For each block of sixteen sites along x the owner
// tabulates the greatest height of the substrate in rings of lateral distance around it. From the
// lowest site of the block follows a gap, from the gap the lateral distance beyond which no pair
// can interact, and only offsets (atoms) nearer than that are visited. The others would have added
// exact zeros. In the same way, the least heights of the substrate tell which offsets need no
// comparison with the cutoff. The sweep over cells compares each site with the bounds of the cells
// near its block.
//
// Reproducibility: a site's force is summed in an order that the site alone decides (offset number,
// atoms counted from the one below it, number of the cell), never its tile, block or lane; so it is
// bitwise identical for any decomposition and number of threads. Sums over sites are exact sums.
//
// Sites displaced sideways by more than offset_margin (a run about to be stopped by its guard) are
// summed one by one with the reference loop, so no pair is ever missed.
#pragma once

#include "kernels/pair_sum.hpp"
#include "kernels/wall_kernels.hpp"

namespace asperity {

/// Sweeps rows [row_begin, row_end) with pair_sum for each site: the reference.
void reference_sweep(const InterfaceSites& sites, const SubstrateMap& map,
                     const PairPotential& potential, int row_begin, int row_end,
                     InterfaceSums& sums);
void reference_sweep(const InterfaceSites& sites, const SubstrateAtoms& atoms,
                     const PairTable& pairs, int row_begin, int row_end, InterfaceSums& sums);

/// Adds the tail (pair_potential.hpp) of a substrate of `density` atoms per Å^2 to the forces and
/// sums of a sweep; mean_height is the local mean plane below each site. If observed, adds energies
/// and counts the repulsive sites anew. Only for potentials with a tail.
void tail_sweep(const InterfaceSites& sites, const PairPotential& potential, double density,
                PlaneView<const double> mean_height, int row_begin, int row_end, bool observe,
                InterfaceSums& sums);

/// Sweeps compiled for one processor level. Each handles rows [row_begin, row_end) of the tile and
/// overwrites their forces; `observed` ones also find energy, contacts and nearest distances.
struct InterfaceKernels {
    template <class Substrate, class Potential = PairPotential>
    using Sweep = void (*)(const InterfaceSites&, const Substrate&, const Potential&, int row_begin,
                           int row_end, InterfaceSums&);
    template <class Substrate, class Potential = PairPotential>
    struct Sweeps {
        Sweep<Substrate, Potential> of[2]; ///< [observe]
    };
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
