// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/block/block.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace asperity {

std::size_t Block::Level::bytes() const {
    return u.bytes() + v.bytes() + transferred.bytes() + upper_force.bytes();
}

Block::Block(const BlockOptions& options, const Communicator& communicator, const ProcessGrid& grid)
    : options_(options), communicator_(communicator), grid_(grid), halo_(communicator, grid) {
    double depth = 0.0;
    for (const LevelShape& shape : level_shapes(options)) {
        Level level;
        level.shape = shape;
        level.tile = grid.tile(shape.level);
        level.tiled = grid.tiled(shape.level);
        level.node_mass = options.atom_mass * std::pow(8.0, shape.level);
        level.depth = depth;
        level.elasticity = options.elasticity(shape.level);
        level.lower = make_stencil(level.elasticity, Face::lower);
        level.inner = make_stencil(level.elasticity, Face::inner);
        level.upper = make_stencil(level.elasticity, Face::upper);
        level.u = VectorField<double>(level.tile, shape.cells + 1);
        level.transferred = VectorField<double>(level.tile, 1);
        level.upper_force = VectorField<double>(level.tile, 1);
        level.v = VectorField<double>(level.tile, shape.cells);
        depth += shape.cells * static_cast<double>(1 << shape.level);
        levels_.push_back(std::move(level));
    }
}

void Block::set_uniform(double z, double w) {
    for (Level& level : levels_) {
        const VectorVolume<double> u = level.u.view(), v = level.v.view();
        const int h = halo_width;
        for (int k = 0; k <= level.shape.cells; ++k)
            for (int y = -h; y < level.tile.ny + h; ++y)
                for (int x = -h; x < level.tile.nx + h; ++x) {
                    u.x(x, y, k) = u.y(x, y, k) = 0.0;
                    u.z(x, y, k) = z;
                    if (k < level.shape.cells && x >= 0 && x < level.tile.nx && y >= 0 &&
                        y < level.tile.ny) {
                        v.x(x, y, k) = v.y(x, y, k) = 0.0;
                        v.z(x, y, k) = w;
                    }
                }
    }
    set_top(z);
}

void Block::set_top(double z) {
    top_ = z;
    Level& last = levels_.back();
    const PlaneView<double> plane = last.u.z.plane(last.shape.cells);
    for (int y = -halo_width; y < plane.ny + halo_width; ++y)
        std::fill(plane.line(y) - halo_width, plane.line(y) + plane.nx + halo_width, z);
}

LevelSeam Block::seam(std::size_t fine) const {
    const Tile& f = levels_[fine].tile;
    const Tile& c = levels_[fine + 1].tile;
    return {f.x0, f.y0, c.x0, c.y0};
}

void Block::interpolate() {
    const auto& interpolate_row = transfer_kernels().interpolate;
#pragma omp parallel
    for (std::size_t l = 0; l + 1 < levels_.size(); ++l) {
        const VectorPlane<const double> coarse = std::as_const(levels_[l + 1].u).plane(0);
        const VectorPlane<double> fine = levels_[l].u.plane(levels_[l].shape.cells);
#pragma omp for schedule(static) nowait
        for (int y = -halo_width; y < fine.x.ny + halo_width; ++y) {
            interpolate_row(seam(l), coarse.x, fine.x, y, halo_width);
            interpolate_row(seam(l), coarse.y, fine.y, y, halo_width);
            interpolate_row(seam(l), coarse.z, fine.z, y, halo_width);
        }
    }
}

void Block::exchange() {
    std::vector<HaloField> fields;
    fields.reserve(3 * levels_.size());
    for (Level& level : levels_) {
        const auto u = level.u.view();
        for (const auto& component : {u.x, u.y, u.z})
            fields.push_back({component, level.shape.cells, level.tiled});
    }
    halo_.exchange(fields);
}

std::size_t Block::bytes() const {
    std::size_t total = 0;
    for (const VectorField<double>& planes : scratch_)
        total += planes.bytes();
    for (const Level& level : levels_)
        total += level.bytes();
    return total;
}

} // namespace asperity
