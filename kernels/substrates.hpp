// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Views of the rigid substrate for the sweeps: heights over a square lattice with tables of the
// atoms in reach, or atoms at arbitrary positions in cells. The engine owns the arrays
// (engine/interface). Units: Å.
#pragma once

#include "kernels/views.hpp"

#include <cstdint>

namespace asperity {

/// Number of sites along x in a block, for which the reach is bounded together: a multiple of every
/// register's width.
inline constexpr int interface_block = 16;
/// Number of rings of lateral distance in the tables of extreme heights of each block.
inline constexpr int interface_rings = 8;
/// Largest number of offsets along one half axis: (cutoff + margin) / a + 1 must not exceed it.
inline constexpr int max_half_offsets = 64;
/// Largest number of rows of a substrate of any spacing within reach to either side.
inline constexpr int max_rows = 2 * max_half_offsets;

/// The substrate as a periodic map of heights, for the reference loop: the rows that a rank holds.
struct SubstrateMap {
    /// height[(j - first) * sites + i] of the atom at (i b, j b), Å.
    const double* height = nullptr;
    int sites = 0;        ///< atoms across the box
    double spacing = 2.6; ///< b, Å
    int first = 0;        ///< first row that is held
    int rows = 0;         ///< number of rows that are held, from the first on
};

/// Largest and smallest heights of the substrate around each block of sites, for rings of lateral
/// distance.
struct ReachBounds {
    const double* highest = nullptr; ///< [(y * blocks + block) * interface_rings + ring], Å
    const double* lowest = nullptr;  ///< lowest heights, in the layout of highest, Å
    int blocks = 0;                  ///< number of blocks in a row
    /// Width of the rings: ring r holds lateral distances [r, r + 1) ring_width from the
    /// undisplaced site, Å.
    double ring_width = 1.0;
    double offset_margin = 0.0; ///< largest lateral displacement that the tables allow for, Å
};

/// The substrate's heights relative to the highest atom.
struct SubstrateHeights {
    PlaneView<const double> height; ///< height over the datum, Å
    double datum = 0.0;             ///< height of the highest atom, Å
};

/// Unit of fixed-point heights, Å, a power of two. Rounding moves positions by at most half a unit,
/// as much as the rounding of a float at 3 Å.
inline constexpr double fixed_quantum = 0x1p-22;
/// Largest depth below the datum, Å. Deeper atoms are moved to this depth, so that differences of
/// heights fit into 32 bits; sites that low are summed by the reference loop.
inline constexpr double fixed_depth = 250.0;

/// A substrate with the block's own lattice: atom (x, y) of the tile is at ((x0+x) a, (y0+y) a,
/// height).
///
/// Offsets from a hollow site to atoms are (±(m - 1/2) a, ±(n - 1/2) a), m, n = 1, 2, ...
struct LatticeSubstrate {
    SubstrateHeights heights; ///< heights with a halo that holds every offset and a whole vector
    PlaneView<const std::int32_t> fixed; ///< heights for the mixed sweep, in fixed_quantum
    /// Number of m within the lateral distance k / cuts_per_length: [k * half_offsets + n - 1].
    const std::int32_t* columns = nullptr;
    int half_offsets = 0; ///< largest m and n
    int cut_count = 0;
    double cuts_per_length = 1.0; ///< 1/Å
    ReachBounds reach;
    SubstrateMap map;
};

/// A substrate of any spacing b: atom (i, j), counted over the box and beyond it, is at (i b, j b,
/// height(i - i0, j - j0)). The view holds all atoms within reach of any site, plus padding of a
/// register and a row.
struct RowSubstrate {
    SubstrateHeights heights;
    int i0 = 0;
    int j0 = 0;
    ReachBounds reach;
    SubstrateMap map;
};

/// Substrate atoms at arbitrary positions, periodic in x and y, for the reference loop.
struct SubstrateAtoms {
    const double* x = nullptr; ///< Å, in the box
    const double* y = nullptr;
    const double* z = nullptr;
    const std::int32_t* type = nullptr; ///< index in the PairTable; nullptr: 0 for all
    std::int64_t count = 0;
    double edge = 0.0; ///< edge of the box, Å
};

/// Number of atoms in a cell: a multiple of every register's width.
inline constexpr int cell_atoms = 16;
/// Largest cutoff over cells, Å. Atoms that pad a cell are too deep to be reached with such a
/// cutoff.
inline constexpr double largest_cell_cutoff = 100.0;

/// A periodic image of a cell, moved by (x, y) edges of the box.
struct CellImage {
    std::int32_t cell;
    std::int16_t x, y;
};

/// Atoms at arbitrary positions in cells of cell_atoms, [(cell * 3 + axis) * cell_atoms + atom].
/// The atoms of a cell have one type. Heights are relative to the datum. Incomplete cells are
/// padded with atoms too deep to be reached.
struct CellSubstrate {
    const double* places = nullptr; ///< Å
    /// Centre of the bounding box of a cell's atoms (x, y, z, 0) and half its edges, Å: [cell * 8 +
    /// n].
    const double* bounds = nullptr;
    /// The cells of a type within the lateral distance of its cutoff plus the margin from a block
    /// of sites: images[k], k from first[i] to first[i + 1] with i = b * types + type, b = y *
    /// blocks + x / interface_block and the types of the PairTable; in ascending order of (y, x,
    /// cell).
    const CellImage* images = nullptr;
    const std::int64_t* first = nullptr;
    const double* highest = nullptr; ///< highest atom of these cells over the datum, Å: [b]
    int blocks = 0;                  ///< number of blocks in a row
    double datum = 0.0;              ///< height of the highest atom, Å
    double offset_margin = 0.0;      ///< largest lateral displacement that the lists allow for, Å
    SubstrateAtoms atoms;
};

} // namespace asperity
