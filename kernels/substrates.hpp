// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The rigid substrate as the sweeps read it: heights over a square lattice with tables of the atoms
// in reach, or atoms anywhere in cells. Views of arrays that the engine owns (engine/interface).
// Units: Å.
#pragma once

#include "kernels/views.hpp"

#include <cstdint>

namespace asperity {

/// Number of sites along x whose reach is bounded together: a multiple of every register's width.
inline constexpr int interface_block = 16;
/// Number of rings of lateral distance for which each block knows the substrate's greatest height.
inline constexpr int interface_rings = 8;
/// Largest number of offsets along one half axis: (cutoff + margin) / a + 1 must not exceed it.
inline constexpr int max_half_offsets = 64;
/// Largest number of rows of a substrate of any spacing within reach to either side.
inline constexpr int max_rows = 2 * max_half_offsets;

/// The whole substrate as a periodic map of heights, for the reference loop.
struct SubstrateMap {
    const double* height = nullptr; ///< height[j * sites + i] of the atom at (i b, j b), Å
    int sites = 0;                  ///< atoms across the box
    double spacing = 2.6;           ///< b, Å
};

/// Greatest and least heights of the substrate around each block of sites, ring by ring.
struct ReachBounds {
    const double* highest = nullptr; ///< [(y * blocks + block) * interface_rings + ring], Å
    const double* lowest = nullptr;  ///< lowest heights, in the layout of highest, Å
    int blocks = 0;                  ///< blocks in a row
    /// Width of the rings: ring r holds lateral distances [r, r + 1) ring_width from the
    /// undisplaced site, Å.
    double ring_width = 1.0;
    double offset_margin = 0.0; ///< largest sideways displacement the tables allow for, Å
};

/// The substrate's heights as the sweeps read them.
struct SubstrateHeights {
    PlaneView<const double> height; ///< height over the datum, Å
    double datum = 0.0;             ///< height of the highest atom, Å
};

/// Unit of fixed-point heights, Å, a power of two: rounding moves positions by at most half of it,
/// as much as a float does at 3 Å.
inline constexpr double fixed_quantum = 0x1p-22;
/// Largest depth below the datum, Å; deeper atoms are placed there, so that differences of heights
/// fit into 32 bits. Sites as low as that are left to the reference loop.
inline constexpr double fixed_depth = 250.0;

/// A substrate of the block's own lattice: atom (x, y) of the tile at ((x0+x) a, (y0+y) a, height).
///
/// Offsets from a hollow site to atoms are (±(m - 1/2) a, ±(n - 1/2) a), m, n = 1, 2, ...
struct LatticeSubstrate {
    SubstrateHeights heights; ///< heights with a halo that holds every offset and a whole vector
    PlaneView<const std::int32_t> fixed; ///< the same heights for the mixed sweep, in fixed_quantum
    /// Number of m within the lateral distance k / cuts_per_length: [k * half_offsets + n - 1].
    const std::int32_t* columns = nullptr;
    int half_offsets = 0; ///< greatest m and n
    int cut_count = 0;
    double cuts_per_length = 1.0; ///< 1/Å
    ReachBounds reach;
    SubstrateMap map;
};

/// A substrate of any spacing b: atom (i, j), counted over the box and beyond it, at (i b, j b,
/// height(i - i0, j - j0)). The view holds all atoms within reach of any site, and a register and a
/// row more.
struct RowSubstrate {
    SubstrateHeights heights;
    int i0 = 0;
    int j0 = 0;
    ReachBounds reach;
    SubstrateMap map;
};

/// Substrate atoms anywhere, periodic in x and y, for the reference loop.
struct SubstrateAtoms {
    const double* x = nullptr; ///< Å, in the box
    const double* y = nullptr;
    const double* z = nullptr;
    const std::int32_t* type = nullptr; ///< row of the PairTable; null: all are of the first
    std::int64_t count = 0;
    double edge = 0.0; ///< edge of the box, Å
};

/// Number of atoms in a cell: a multiple of every register's width.
inline constexpr int cell_atoms = 16;
/// Largest cutoff over cells, Å: the atoms that fill a cell stand so deep that no smaller cutoff
/// reaches them.
inline constexpr double largest_cell_cutoff = 100.0;

/// A periodic image of a cell, moved by (x, y) edges of the box.
struct CellImage {
    std::int32_t cell;
    std::int16_t x, y;
};

/// Atoms anywhere in cells of cell_atoms, [(cell * 3 + axis) * cell_atoms + atom]; the atoms of a
/// cell are of one type. Heights are over the datum. A cell that is not full is filled with atoms
/// so low that no site reaches them.
struct CellSubstrate {
    const double* places = nullptr; ///< Å
    /// Centre of the bounds of a cell's atoms (x, y, z, 0), and half their edges, Å: [cell * 8 +
    /// n].
    const double* bounds = nullptr;
    /// The cells of a type within its cutoff and the margin of a block of sites, sideways:
    /// images[k], k from first[i] to first[i + 1] with i = b * types + type, b = y * blocks + x /
    /// interface_block and the types of the PairTable; in ascending order of (y, x, cell).
    const CellImage* images = nullptr;
    const std::int64_t* first = nullptr;
    const double* highest = nullptr; ///< highest atom of these cells over the datum, Å: [b]
    int blocks = 0;                  ///< number of blocks in a row
    double datum = 0.0;              ///< height of the highest atom, Å
    double offset_margin = 0.0;      ///< largest sideways displacement the lists allow for, Å
    SubstrateAtoms atoms;
};

} // namespace asperity
