// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The interface: one tile of the block's lowest layer over the rigid substrate (docs/model.md),
// whose atoms it meets, or a wall in their place.
//
// Built once per run. It keeps what the sweeps need of the substrate around the tile (heights with
// a halo as wide as the reach), the table of neighbour offsets, and for each block of sites how
// high and low the substrate gets around it. Every rank knows the whole height map, so nothing is
// communicated here: the sweep is local to the tile, and its sums are exact (ExactSum), to be
// merged over ranks in any order.
//
// Which sweep runs is decided at construction: wall if there is one; cells if the substrate's atoms
// have positions of their own; lattice if it has the block's lattice, rows otherwise; in double, or
// mixed. The tables allow for sideways
// displacements up to two spacings; sites that go beyond are summed by the reference loop
// (kernels/interface_sweep.hpp), so no pair is ever missed and no table is ever rebuilt.
//
// A wall (InterfaceOptions::wall) acts along z alone. The height below site (x, y) is value (x, y)
// of the surface, which has the block's lattice; it needs no table but these.
#pragma once

#include "decomposition/communicator.hpp"
#include "decomposition/field.hpp"
#include "decomposition/tile.hpp"
#include "engine/block/substrate_cells.hpp"
#include "engine/scene/surface.hpp"
#include "kernels/interface_sweep.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace asperity {

enum class InterfaceMethod { automatic, reference, lattice, rows, cells, wall };

struct InterfaceOptions {
    std::optional<WallLaw> wall = {}; ///< in place of atoms; a smeared layer is that of `potential`
    LennardJones potential;
    /// Of atoms anywhere, by AtomPositions::type; empty: `potential` for all.
    std::vector<LennardJones> by_type = {};
    bool tail = false; ///< continuum correction beyond the cutoff
    bool mixed =
        false; ///< pairs in single precision, sums in double; the reference is in double only
    bool single_too = false; ///< a double sweep may now and then be asked for in mixed precision
    InterfaceMethod method = InterfaceMethod::automatic;
    bool skip = true; ///< false: visit all offsets or atoms everywhere (same bits; for tests)

    PairTable pairs() const {
        if (by_type.empty()) return potential;
        return {by_type.data(), static_cast<int>(by_type.size())};
    }
};

/// Contacts over all tiles.
struct ContactCount {
    long long in_contact = 0, repulsive = 0; ///< sites
    double closest = 0.0;                    ///< smallest pair distance, Å; infinite out of reach
};
/// Distance from which on the substrate does not act on a site, Å: beyond the cutoff; with the
/// tail, which ends nowhere, 4 cutoffs, where 1/256 of its energy is left.
double reach_of(const InterfaceOptions& options);

/// From the sums of this rank's tile. Collective.
ContactCount count_contacts(const InterfaceSums& sums, const Communicator& ranks);

/// Maps over the tile's sites, [y * nx + x].
struct InterfaceMaps {
    int nx = 0, ny = 0;
    std::vector<std::uint8_t> contact; ///< 1 where the nearest atom is within contact distance
    std::vector<double> distance; ///< to the nearest atom, Å; infinite where none is in reach; over
                                  ///< a wall the gap, 0 where it is negative
    std::vector<double> gap; ///< height above the substrate below (a wall, or bilinear between its
                             ///< atoms), Å
    std::vector<double> pressure; ///< normal force on the site per a^2, GPa; positive pushes
};

class Interface {
public:
    /// spacing: a, the block's lattice constant, Å. The surface is copied as far as it is needed.
    Interface(const Surface& substrate, const Tile& tile, double spacing,
              const InterfaceOptions& options);

    /// Forces of the substrate on the tile's sites (overwritten) and their sums over the tile.
    /// Energy, contacts and nearest distances only if observed. in_single: in mixed precision,
    /// where the options have it (forces good to some 1e-6 eV/Å).
    InterfaceSums sweep(const VectorPlane<const double>& displacement,
                        const VectorPlane<double>& force, double reference_height, bool observe,
                        bool in_single = false) const;

    /// Of a wall: its height below each site of the tile, Å, and a row of sites that come to rest
    /// (kernels/interface_sweep.hpp).
    PlaneView<const double> wall_height() const { return height_.plane(0); }
    WallSums settle_row(const WallRow<double>& row, const WallRule& rule, int sites) const;
    WallSums settle_row(const WallRow<float>& row, const WallRule& rule, int sites) const;

    /// Per-site maps of the state; makes a sweep of its own.
    InterfaceMaps maps(const VectorPlane<const double>& displacement,
                       double reference_height) const;

    /// The reference height from which nothing is in reach of undisplaced sites: highest atom +
    /// reach_of().
    double start_height() const;
    /// Heights that distances of the tile's undisplaced sites count from, Å, [y * nx + x]: of a
    /// wall; over atoms such that a site that is z - height above it, within the cutoff, has no
    /// atom closer than that. Not over atoms anywhere.
    std::vector<double> heights_below() const;
    /// Down to this reference height the attraction of undisplaced sites only grows; the start
    /// height, where no better bound is known.
    double attraction_grows_down_to() const;

    /// What the sweep over a lattice or rows reads, for a device that keeps a copy. Views are of
    /// this object.
    struct Tables {
        LatticeSubstrate lattice;
        RowSubstrate rows;
        const Field<double>* heights = nullptr;     ///< in double
        const Field<std::int32_t>* fixed = nullptr; ///< mixed
        std::span<const std::int32_t> columns;
        std::span<const double> highest, lowest, map;
        const Field<double>* mean_height = nullptr; ///< with the tail
        TailCorrection tail;
    };
    Tables tables() const;
    /// Their sizes in bytes over a substrate of N x N atoms, without making them.
    struct TableSizes {
        std::size_t heights, fixed, mean_height, reach, columns,
            map; ///< reach: highest, and lowest
    };
    static TableSizes tables_for(const InterfaceOptions& options, const Tile& tile, double spacing,
                                 int substrate_sites);

    const Tile& tile() const { return tile_; }
    InterfaceMethod method() const { return method_; }
    /// Atoms across the box, of a substrate that is a map.
    int substrate_sites() const { return map_.sites; }
    const InterfaceOptions& options() const { return options_; }
    std::size_t bytes() const;
    std::size_t tail_bytes() const { return mean_height_.empty() ? 0 : mean_height_.bytes(); }

private:
    InterfaceSums sweep_sites(const InterfaceSites& sites, bool observe, bool mixed) const;
    double height_below(const VectorPlane<const double>& displacement, int x, int y) const;
    void build_wall(const Surface& substrate);
    void build_cells(const Surface& substrate);
    void build_reach();
    void build_lattice();
    void build_rows();
    /// The heights of atoms (i, j) of a tile of the substrate's lattice and a halo.
    SubstrateHeights heights_on(const Tile& atoms, int halo);

    InterfaceOptions options_;
    InterfaceMethod method_ = InterfaceMethod::reference;
    Tile tile_;
    double spacing_ = 0.0;
    double margin_ = 0.0; ///< sideways displacement the tables allow for, Å
    double highest_ = 0.0;
    std::vector<double> map_height_;
    SubstrateMap map_;
    std::vector<double> reach_highest_, reach_lowest_;
    ReachBounds reach_;
    Field<double> height_;             ///< in double; of a wall, below each site
    Field<std::int32_t> fixed_height_; ///< mixed
    std::vector<std::int32_t> columns_;
    LatticeSubstrate lattice_;
    RowSubstrate rows_;
    std::optional<SubstrateCells> cells_; ///< where the substrate has atoms of its own
    Field<double> mean_height_;           ///< tail: of the atoms within the cutoff sideways
    TailCorrection tail_;

public:
    // The views point into the object's own arrays.
    Interface(const Interface&) = delete;
    Interface& operator=(const Interface&) = delete;
    Interface(Interface&&) = default; ///< vectors keep their storage when moved
    Interface& operator=(Interface&&) = default;
};

} // namespace asperity
