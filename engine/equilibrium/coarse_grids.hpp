// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Coarse grids over a block of levels: they make of forces the steps that move long waves at once.
//
// Grid g has nodes 2^g a apart and reaches from the lowest layer up through level g, whose own
// planes are its upper ones; below, it is the finer grid g - 1 thinned out, every second plane and
// every second node along x and y. (Grid 0 is level 0.) A step of a coarse node takes along what is
// finer around it, linearly in x, y and depth; its force is what the transpose collects. For a
// lattice these are the usual halved grids; for a multiscale block, coarse by itself, a few planes
// under each level.
//
// The steps of all grids are added (Bramble, Pasciak, Xu, Math. Comp. 55, 1, 1990), each a node's
// force over its stiffness. With K the lattice's largest stiffness, a node inside has 2^g K times
// 0.5 to 1.6 (coarse_grids.cpp). A node of the lowest layer stands for 4^g sites, which the
// interface holds as well: with s_0 = 0.5 K, s_g = 0.8 2^-g K, and the mean stiffness k of the
// interface around, for each site, grid g adds
//
//     1 / (s_g + k) - 1 / (s_(g-1) + k)           (grid 0: 1 / (s_0 + k)).
//
// The terms of grids 0 to g add up to 1 / (s_g + k): a wave moves by its force over s_g + k, g
// being the coarsest grid that resolves it. That is about (S(q) + k)^-1, without a transform.
//
// Grids are halved while their nodes are an even number across and they are finer than the block is
// thick. Every step is a sum in a fixed order over neighbours: the same bits on any number of
// ranks.
#pragma once

#include "engine/block/block.hpp"

#include <vector>

namespace asperity {

class CoarseGrids {
public:
    /// The block is looked at, not kept up with: only its shape matters.
    explicit CoarseGrids(const Block& block);

    /// The interface's stiffness of each site, eV/Å^2, over the tile: to be filled in before
    /// steps(). Negative means count as zero.
    PlaneView<double> site_stiffness() { return grids_.front().stiffness.plane(0); }
    /// Makes of the forces (eV/Å) on the moving nodes of each level their steps (Å), in place.
    /// Collective.
    void steps(std::vector<VectorField<double>>& nodes);

private:
    /// Where a plane lies between two planes of the coarser grid.
    struct Place {
        int below;    ///< the lower of them
        double share; ///< of the upper one
    };
    struct Grid {
        Tile tile;
        bool tiled = false;
        std::vector<double> depth;    ///< of the planes it has below level g, in cells of edge a
        VectorField<double> thinned;  ///< on these planes: forces, then steps
        Field<double> stiffness;      ///< of the interface around a node, for each site, eV/Å^2
        std::vector<Place> place;     ///< of all its planes, in the next coarser grid
        VectorField<double> between;  ///< that grid's planes, with this one's nodes
        VectorField<double> incoming; ///< forces for the lowest plane of level g, from below it
    };

    double wave_stiffness(std::size_t g) const;
    bool has_level(std::size_t g) const { return g < block_.levels().size(); }
    int thinned(std::size_t g) const { return static_cast<int>(grids_[g].depth.size()); }
    int planes(std::size_t g) const;
    /// Planes of grid g that the finer grid hangs between: of the rigid top there are no steps.
    int posts(std::size_t g) const { return thinned(g) + (has_level(g) ? 1 : 0); }
    VectorPlane<double> plane(std::size_t g, int i, std::vector<VectorField<double>>& nodes);
    LevelSeam seam(std::size_t fine) const;
    Tile collected(std::size_t g) const;
    void collect_stiffness(std::size_t g);
    void collect_forces(std::size_t g, std::vector<VectorField<double>>& nodes);
    void step_row(std::size_t g, int y, std::vector<VectorField<double>>& nodes);
    void add_coarse_row(std::size_t g, int y, std::vector<VectorField<double>>& nodes);
    void exchange(VectorField<double>& field, int planes, bool tiled);

    const Block& block_;
    HaloExchange halo_;
    std::vector<Grid> grids_;
    double atom_stiffness_; ///< the lattice's largest, eV/Å^2
};

} // namespace asperity
