// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/block/block.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace asperity {

double BlockOptions::sound_speed() const {
    const double density = atom_mass / (spacing * spacing * spacing);
    return std::sqrt((lame() + 2.0 * shear_modulus()) / density);
}

CellElasticity BlockOptions::elasticity(int level) const { return cell(spacing * (1 << level)); }

std::vector<Material> BlockOptions::materials() const {
    std::vector<Material> all;
    for (const MaterialLayer& layer : layers)
        all.push_back(layer.material);
    all.push_back(*this);
    return all;
}

double BlockOptions::softest_column() const {
    double softest = HUGE_VAL;
    for (const Material& m : materials())
        softest = std::min(softest, m.lame() + 2.0 * m.shear_modulus());
    return softest;
}

std::vector<CellLayer> BlockOptions::column() const {
    std::vector<CellLayer> column;
    const auto add = [&](const Material& material, int cells) {
        const CellElasticity elasticity = material.cell(spacing);
        if (!column.empty() && column.back().elasticity == elasticity)
            column.back().cells += cells;
        else if (cells > 0)
            column.push_back({elasticity, cells});
    };
    int rest = thickness;
    for (const MaterialLayer& layer : layers) {
        add(layer.material, layer.cells);
        rest -= layer.cells;
    }
    add(*this, rest);
    return column;
}

SurfaceMatrix BlockOptions::stiffness(WavePhase x, WavePhase y) const {
    SurfaceMatrix s = surface_stiffness(column(), x, y);
    s.zz += surface_stress * (2.0 * (1.0 - x.cosine) + 2.0 * (1.0 - y.cosine));
    return s;
}

double BlockOptions::softest_wave() const {
    if (layers.empty()) return contact_modulus() * std::numbers::pi / (sites * spacing);
    return 1.0 / inverse(stiffness(wave_phase(1, sites), wave_phase(0, sites))).zz /
           (spacing * spacing);
}

double BlockOptions::highest_frequency(double site_stiffness) const {
    // The largest eigenvalue of the bulk's dynamical matrix is that of a longitudinal wave, of
    // phases (pi, 0, 0) or, below a Poisson ratio of about 0.12, (t, t, t). With c = cos t it is
    // there (1 - c) (24 kappa (1 + c)^2 + k (10 + 8 c)), whose derivative vanishes at the root of
    // 72 kappa c^2 + (48 kappa + 16 k) c + 2 k - 24 kappa that is -1/8 for kappa = 0. Surfaces and
    // coarser levels have no higher one. tests/engine/block_test.cpp searches the whole zone.
    const CellElasticity e = elasticity(0);
    const double axis = 64.0 * e.kappa + 12.0 * e.k;
    const double a = 72.0 * e.kappa, b = 48.0 * e.kappa + 16.0 * e.k,
                 d = 2.0 * e.k - 24.0 * e.kappa;
    const double c = -2.0 * d / (b + std::sqrt(b * b - 4.0 * a * d));
    const double diagonal =
        (1.0 - c) * (24.0 * e.kappa * (1.0 + c) * (1.0 + c) + e.k * (10.0 + 8.0 * c));
    return std::sqrt((std::max(axis, diagonal) + site_stiffness) / atom_mass);
}

std::vector<LevelShape> level_shapes(const BlockOptions& options) {
    std::vector<LevelShape> shapes;
    int rest = options.thickness, sites = options.sites;
    for (int level = 0;; ++level) {
        const int least = options.layers_per_level;
        // One cell more where the rest would not divide by two.
        const int cells = least + ((rest - least) & 1);
        const bool coarsen = options.multiscale && sites % 2 == 0 && (rest - cells) / 2 >= least;
        shapes.push_back({level, sites, coarsen ? cells : rest});
        if (!coarsen) return shapes;
        rest = (rest - cells) / 2;
        sites /= 2;
    }
}

double nodes_of(const std::vector<LevelShape>& levels) {
    double nodes = 0.0;
    for (const LevelShape& l : levels)
        nodes += static_cast<double>(l.sites) * l.sites * l.cells;
    return nodes;
}

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
