// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The elastic block: a stack of levels over one cell stencil (docs/explanation/model.md).
//
// Level l is a regular lattice of cells of edge 2^l a, `cells` layers thick. Its planes are
// numbered from below: planes 0 .. cells-1 move; plane `cells` is constrained to the
// lowest plane of level l+1 (bilinear interpolation) or, on the last level, is the rigid driven
// top. A block of one level is the plain lattice.
//
// Data of a level: u (displacement) and v (velocity at the half step), three arrays each; and
// `transferred`, the forces on its lowest plane from below: from the interface on level 0, from the
// constrained plane of the level below on the others. A step consists of
//   interpolate()  sets constrained planes       needs u with halos
//   (interface)    fills transferred of level 0  needs u of the lowest plane
//   advance()      level by level from below: forces and kick; force on the upper plane, added to
//                  the level above; drift of u in place, row after row behind the forces
//   exchange()     halos of u
//
//
// Each node's arithmetic is the same on any tile and thread, so states are bitwise identical.
#pragma once

#include "decomposition/communicator.hpp"
#include "decomposition/field.hpp"
#include "decomposition/halo_exchange.hpp"
#include "decomposition/process_grid.hpp"
#include "decomposition/rows_of_thread.hpp"
#include "engine/options/block_options.hpp"
#include "kernels/elastic_level.hpp"
#include "kernels/level_transfer.hpp"

#include <vector>

namespace asperity {

/// Parameters of a step, from which the block computes coefficients for each plane.
struct StepParameters {
    double dt = 0.0;              ///< fs
    double damping = 0.0;         ///< Gamma, 1/fs
    double damping_from = 0.0;    ///< fraction of the thickness above which damping acts
    double medium_velocity = 0.0; ///< velocity of the damping medium along z, Å/fs
    bool observe = false;         ///< sum the kinetic energy
    bool operator==(const StepParameters&) const = default;
};

/// The elastic block: this rank's tiles of all levels.
class Block {
public:
    /// Number of rows in a band, the unit of work.
    static constexpr int band = band_rows;
    /// Number of nodes below which a level is faster without threads.
    static constexpr long long worth_threads = 8192;

    /// A level on this rank: its tile, constants and fields.
    struct Level {
        LevelShape shape;
        Tile tile;
        bool tiled = false;     ///< cut into tiles; false: every rank holds the whole level
        double node_mass = 0.0; ///< mass of a node inside, eV fs^2/Å^2
        double depth = 0.0;     ///< depth of its lowest plane, in cells of edge a
        CellElasticity elasticity;
        Stencil lower, inner, upper;
        VectorField<double> u, transferred;
        VectorField<double> v;
        VectorField<double> upper_force; ///< force on the prescribed plane; one plane

        std::size_t bytes() const; ///< returns the memory of the fields, bytes
        /// Returns the edge of a cell, Å. a: spacing of the atoms, Å.
        double edge(double a) const { return a * (1 << shape.level); }
        /// Returns the mass of a node of plane z, eV fs^2/Å^2.
        double mass(int z) const;
        /// Returns the number of this tile's nodes that move.
        long long nodes() const { return static_cast<long long>(tile.nx) * tile.ny * shape.cells; }
        /// Returns the first plane at or above this fraction of the block's thickness; shape.cells
        /// if there is none. Nodes from this plane on are damped and receive noise.
        int first_plane_from(double share_of_thickness, int thickness) const;
        /// Returns the cell for the kernels. a: spacing of the atoms, Å.
        LevelCell cell(double a) const { return {edge(a), elasticity}; }
        /// Returns the view for the kernels. a: spacing of the atoms, Å.
        ElasticLevel view(double a);
    };

    /// Allocates the undisplaced block at rest.
    Block(const BlockOptions& options, const Communicator& communicator, const ProcessGrid& grid);

    const BlockOptions& options() const { return options_; }
    const ProcessGrid& grid() const { return grid_; }
    const Communicator& communicator() const { return communicator_; }
    const std::vector<Level>& levels() const { return levels_; }
    /// Fields of a level of this block, for writing.
    struct Fields {
        VectorField<double>&u, &v, &transferred;
    };
    /// Returns the fields of a level for writing.
    Fields fields(const Level& level) {
        Level& own = levels_[static_cast<std::size_t>(level.shape.level)];
        return {own.u, own.v, own.transferred};
    }

    /// Returns the displacements of the lowest layer, Å.
    VectorPlane<const double> lowest_layer() const { return levels_.front().u.view()[0]; }
    /// Returns the forces of the interface on the lowest layer, eV/Å, for writing.
    VectorPlane<double> interface_force() { return levels_.front().transferred.plane(0); }

    /// Displaces the whole block by (0, 0, z), Å, and sets its velocity to (0, 0, w), Å/fs.
    void set_uniform(double z, double w);
    /// Sets the top plane's displacement along z, Å.
    void set_top(double z);
    double top() const { return top_; }
    /// Records the top plane's displacement along z, Å, without writing the plane, which is on a
    /// device.
    void note_top(double z) { top_ = z; }

    CellStrain strain() const {
        return options_.finite_strain ? CellStrain::finite : CellStrain::small;
    }
    /// Returns the coefficients of the kicks of the planes of a level for a step.
    LevelKicks kicks(const Level& level, const StepParameters& step) const;

    /// Returns true if the block has constrained planes, which is so for two or more levels.
    bool has_constrained_planes() const { return levels_.size() > 1; }
    /// Sets the constrained planes by interpolation from the coarse planes. u needs current halos.
    void interpolate();
    /// Computes the forces of all levels from below, kicks and drifts the nodes, and adds to the
    /// sums. Collective.
    void advance(const StepParameters& step, KickSums& sums);
    /// Updates the halos of u. Collective.
    void exchange();
    /// Computes the forces on all moving planes, transferred forces included, into out[level],
    /// eV/Å, without moving the nodes. Collective.
    void forces(std::vector<VectorField<double>>& out);

    // Shares of this rank in global values:
    /// Adds this rank's share of the elastic force on the rigid top plane along z, eV/Å, after the
    /// last advance() or forces().
    void add_top_force(ExactSum& sum) const;
    /// Adds this rank's share of the elastic energy, eV.
    void add_elastic_energy(ExactSum& sum) const;
    /// Adds this rank's share of the sum of u_z over the lowest layer, Å.
    void add_lowest_z(ExactSum& sum) const;
    /// Returns the mass of all nodes that move, of all ranks, eV fs^2/Å^2. Not collective.
    double mass() const;
    /// Returns the memory of the block on this rank, bytes.
    std::size_t bytes() const;
    /// Returns the bytes sent so far in halo exchanges.
    std::size_t halo_bytes() const { return halo_.bytes_sent(); }

    /// Returns true if this rank adds a level's nodes to global sums: every rank for tiled levels,
    /// the root alone for levels that every rank holds whole.
    bool counts(const Level& level) const { return level.tiled || communicator_.root(); }

private:
    BlockOptions options_;
    Communicator communicator_;
    ProcessGrid grid_;
    HaloExchange halo_;
    std::vector<Level> levels_;
    double top_ = 0.0;
    /// Workspace for forces at finite strain: two planes of a band of rows for each thread.
    std::vector<VectorField<double>> scratch_;

    static Tile scratch_tile(const ProcessGrid& grid, int levels);
    LevelSeam seam(std::size_t fine) const;
    void restrict_forces(std::size_t fine);
    void share_restricted_forces(std::size_t fine);
};

} // namespace asperity
