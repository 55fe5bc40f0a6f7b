// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/equilibrium/coarse_grids.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace asperity {

namespace {

// Stiffness of a node of grid g over 2^g times the lattice's largest: as small as the sum of all
// steps allows. The largest eigenvalue of steps after forces is then 2.0, whatever the block
// (tests/engine/coarse_grids_test.cpp); with the means of planes, one more at most. A descent with
// a momentum of 0.8 is stable below 3.6.
constexpr double level_node = 0.5;   // of a level's own planes,
constexpr double level_lowest = 0.8; // but the lowest, which takes along what is below
constexpr double thinned_node = 1.6; // of the thinned planes,
constexpr double wave = 0.8;         // but the lowest layer: s_g over 2^-g of it

/// Below this many nodes work is done sooner than threads are woken.
constexpr int worth_threads = 8192;

} // namespace

CoarseGrids::CoarseGrids(const Block& block)
    : block_(block), halo_(block.communicator(), block.grid()) {
    const double w = block.options().highest_frequency(0.0);
    atom_stiffness_ = w * w * block.options().atom_mass;
    for (std::size_t g = 0;; ++g) {
        const int level = static_cast<int>(g);
        Grid grid;
        grid.tile = block.grid().tile(level);
        grid.tiled = block.grid().tiled(level);
        grid.stiffness = Field<double>(grid.tile, 1);
        if (g > 0) {
            // Of the finer grid's planes every second stays, unless the next post is too near.
            Grid& fine = grids_.back();
            std::vector<double> depth = fine.depth;
            if (has_level(g - 1)) {
                const Block::Level& own = block.levels()[g - 1];
                for (int z = 0; z < own.shape.cells; ++z)
                    depth.push_back(own.depth + std::ldexp(z, level - 1));
            }
            for (std::size_t i = 0; i < depth.size(); i += 2)
                if (i == 0 || i + 1 < depth.size()) grid.depth.push_back(depth[i]);
            std::vector<double> post = grid.depth;
            post.push_back(has_level(g) ? block.levels()[g].depth : block.options().thickness);
            for (double d : depth) {
                const auto above = std::upper_bound(post.begin(), post.end() - 1, d);
                fine.place.push_back({static_cast<int>(above - post.begin()) - 1,
                                      (d - *(above - 1)) / (*above - *(above - 1))});
            }
            const int kept = static_cast<int>(grid.depth.size());
            grid.thinned = VectorField<double>(grid.tile, kept);
            fine.between = VectorField<double>(fine.tile, kept + (has_level(g) ? 1 : 0));
            if (has_level(g)) grid.incoming = VectorField<double>(grid.tile, 1);
        }
        grids_.push_back(std::move(grid));
        const bool thinner = std::ldexp(1.0, level + 1) <= block.options().thickness;
        if (grids_.back().tile.sites % 2 != 0 || !(thinner || has_level(g + 1))) return;
    }
}

double CoarseGrids::wave_stiffness(std::size_t g) const {
    return std::ldexp((g == 0 ? level_node : wave) * atom_stiffness_, -static_cast<int>(g));
}

int CoarseGrids::planes(std::size_t g) const {
    return thinned(g) + (has_level(g) ? block_.levels()[g].shape.cells : 0);
}

VectorPlane<double> CoarseGrids::plane(std::size_t g, int i,
                                       std::vector<VectorField<double>>& nodes) {
    return i < thinned(g) ? grids_[g].thinned.plane(i) : nodes[g].plane(i - thinned(g));
}

LevelSeam CoarseGrids::seam(std::size_t fine) const {
    const Tile &f = grids_[fine].tile, &c = grids_[fine + 1].tile;
    return {f.x0, f.y0, c.x0, c.y0};
}

/// Nodes of a grid, in its tile's coordinates, whose forces this rank collects. A fine grid held
/// whole feeds the whole coarse one on every rank alike.
Tile CoarseGrids::collected(std::size_t g) const {
    Tile nodes = grids_[g].tile;
    if (grids_[g - 1].tiled)
        nodes = block_.grid().footprint(static_cast<int>(g), block_.grid().rank());
    nodes.x0 -= grids_[g].tile.x0;
    nodes.y0 -= grids_[g].tile.y0;
    return nodes;
}

void CoarseGrids::exchange(VectorField<double>& field, int planes, bool tiled) {
    const auto v = field.view();
    const std::array fields = {HaloField{v.x, planes, tiled}, HaloField{v.y, planes, tiled},
                               HaloField{v.z, planes, tiled}};
    halo_.exchange(fields);
}

/// Means over the sites around the nodes of grid g.
void CoarseGrids::collect_stiffness(std::size_t g) {
    Grid& fine = grids_[g - 1];
    const std::array from = {HaloField{fine.stiffness.view(), 1, fine.tiled}};
    halo_.exchange(from);
    const std::array to = {grids_[g].stiffness.plane(0)};
    const Tile nodes = collected(g);
    for (int y = nodes.y0; y < nodes.y0 + nodes.ny; ++y) {
        transfer_kernels().restrict_forces(seam(g - 1), std::as_const(fine.stiffness).plane(0),
                                           to[0], y, nodes.x0, nodes.nx);
        for (int x = nodes.x0; x < nodes.x0 + nodes.nx; ++x)
            to[0](x, y) *= 0.25;
    }
    if (fine.tiled && !grids_[g].tiled)
        gather_footprints(block_.communicator(), block_.grid(), static_cast<int>(g), to);
}

/// Forces on grid g, from all that is finer: first along the depth, then along x and y.
void CoarseGrids::collect_forces(std::size_t g, std::vector<VectorField<double>>& nodes) {
    Grid &fine = grids_[g - 1], &coarse = grids_[g];
    const int nx = fine.tile.nx;
#pragma omp parallel for schedule(static) if (fine.tile.ny * nx > worth_threads)
    for (int y = 0; y < fine.tile.ny; ++y) {
        for (int j = 0; j < posts(g); ++j)
            for (double* row : lines(fine.between.plane(j), y))
                std::fill_n(row, nx, 0.0);
        for (int i = 0; i < planes(g - 1); ++i) {
            const auto [below, share] = fine.place[static_cast<std::size_t>(i)];
            const auto from = lines(plane(g - 1, i, nodes), y);
            for (int j = below; j <= below + 1 && j < posts(g); ++j) {
                const double part = j == below ? 1.0 - share : share;
                if (part == 0.0) continue;
                const auto to = lines(fine.between.plane(j), y);
                for (std::size_t c = 0; c < 3; ++c)
                    for (int x = 0; x < nx; ++x)
                        to[c][x] += part * from[c][x];
            }
        }
    }
    exchange(fine.between, posts(g), fine.tiled);

    const Tile own = collected(g);
    std::vector<PlaneView<double>> made;
    for (int j = 0; j < posts(g); ++j) {
        const auto to = j < thinned(g) ? coarse.thinned.plane(j) : coarse.incoming.plane(0);
        made.insert(made.end(), {to.x, to.y, to.z});
    }
#pragma omp parallel for schedule(static) if (own.ny * own.nx > worth_threads)
    for (int y = own.y0; y < own.y0 + own.ny; ++y)
        for (int j = 0; j < posts(g); ++j) {
            const auto from = std::as_const(fine.between).plane(j);
            const auto to = &made[3 * static_cast<std::size_t>(j)];
            const auto& restrict_forces = transfer_kernels().restrict_forces;
            restrict_forces(seam(g - 1), from.x, to[0], y, own.x0, own.nx);
            restrict_forces(seam(g - 1), from.y, to[1], y, own.x0, own.nx);
            restrict_forces(seam(g - 1), from.z, to[2], y, own.x0, own.nx);
        }
    if (fine.tiled && !coarse.tiled)
        gather_footprints(block_.communicator(), block_.grid(), static_cast<int>(g), made);
    if (!has_level(g)) return;
    for (int y = 0; y < coarse.tile.ny; ++y) {
        const auto from = lines(coarse.incoming.plane(0), y), to = lines(nodes[g].plane(0), y);
        for (std::size_t c = 0; c < 3; ++c)
            for (int x = 0; x < coarse.tile.nx; ++x)
                to[c][x] += from[c][x];
    }
}

/// Force over stiffness, on row y of all planes of grid g.
void CoarseGrids::step_row(std::size_t g, int y, std::vector<VectorField<double>>& nodes) {
    const Grid& grid = grids_[g];
    const int level = static_cast<int>(g);
    for (int i = 0; i < planes(g); ++i) {
        const auto f = lines(plane(g, i, nodes), y);
        if (i == 0) {
            const double* stiffness = std::as_const(grid.stiffness).plane(0).line(y);
            const double s = wave_stiffness(g), finer = g == 0 ? 0.0 : wave_stiffness(g - 1);
            const double per_site = std::ldexp(1.0, -2 * level);
            for (int x = 0; x < grid.tile.nx; ++x) {
                const double k = std::max(0.0, stiffness[x]);
                double step = 1.0 / (s + k);
                if (g > 0) step -= 1.0 / (finer + k);
                step *= per_site;
                for (std::size_t c = 0; c < 3; ++c)
                    f[c][x] *= step;
            }
        } else {
            const double share = i < thinned(g)    ? thinned_node
                                 : i == thinned(g) ? level_lowest
                                                   : level_node;
            const double step = std::ldexp(1.0 / (share * atom_stiffness_), -level);
            for (std::size_t c = 0; c < 3; ++c)
                for (int x = 0; x < grid.tile.nx; ++x)
                    f[c][x] *= step;
        }
    }
}

/// Adds to row y of all planes of grid g the steps of the next coarser.
void CoarseGrids::add_coarse_row(std::size_t g, int y, std::vector<VectorField<double>>& nodes) {
    Grid &fine = grids_[g], &coarse = grids_[g + 1];
    const int nx = fine.tile.nx;
    for (int j = 0; j < posts(g + 1); ++j) {
        const auto from = j < thinned(g + 1) ? std::as_const(coarse.thinned).plane(j)
                                             : std::as_const(nodes[g + 1]).plane(0);
        const auto to = fine.between.plane(j);
        const auto& interpolate = transfer_kernels().interpolate;
        interpolate(seam(g), from.x, to.x, y, 0);
        interpolate(seam(g), from.y, to.y, y, 0);
        interpolate(seam(g), from.z, to.z, y, 0);
    }
    for (int i = 0; i < planes(g); ++i) {
        const auto [below, share] = fine.place[static_cast<std::size_t>(i)];
        const auto to = lines(plane(g, i, nodes), y);
        for (int j = below; j <= below + 1 && j < posts(g + 1); ++j) {
            const double part = j == below ? 1.0 - share : share;
            if (part == 0.0) continue;
            const auto from = lines(fine.between.plane(j), y);
            for (std::size_t c = 0; c < 3; ++c)
                for (int x = 0; x < nx; ++x)
                    to[c][x] += part * from[c][x];
        }
    }
}

void CoarseGrids::steps(std::vector<VectorField<double>>& nodes) {
    for (std::size_t g = 1; g < grids_.size(); ++g) {
        collect_stiffness(g);
        collect_forces(g, nodes);
    }
    for (std::size_t g = grids_.size(); g-- > 0;) {
        const bool coarsest = g + 1 == grids_.size();
        if (!coarsest) {
            exchange(grids_[g + 1].thinned, thinned(g + 1), grids_[g + 1].tiled);
            if (has_level(g + 1)) exchange(nodes[g + 1], 1, grids_[g + 1].tiled);
        }
        const Tile& tile = grids_[g].tile;
#pragma omp parallel for schedule(static) if (tile.ny * tile.nx > worth_threads)
        for (int y = 0; y < tile.ny; ++y) {
            step_row(g, y, nodes);
            if (!coarsest) add_coarse_row(g, y, nodes);
        }
    }
}

} // namespace asperity
