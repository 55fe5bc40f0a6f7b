// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The passes over a block's planes: forces, and a time step.
#include "engine/block/block.hpp"

#include <omp.h>

#include <algorithm>
#include <array>
#include <utility>

namespace asperity {

double Block::Level::mass(int z) const {
    if (z > 0 || shape.level == 0) return node_mass; // the lowest layer's atoms are full atoms
    // Half a coarse cell above, and from below the constrained plane's half cells: 4 (m/8)/2 = m/4.
    return 0.75 * node_mass;
}

double Block::mass() const {
    double sum = 0.0;
    for (const Level& level : levels_) {
        const double nodes = options_.sites >> level.shape.level;
        for (int z = 0; z < level.shape.cells; ++z)
            sum += nodes * nodes * level.mass(z);
    }
    return sum;
}

ElasticLevel Block::Level::view(double a) {
    return {shape.cells, u.view(), v.view(), transferred.plane(0), upper_force.plane(0), lower,
            inner,       upper,    cell(a)};
}

int Block::Level::first_plane_from(double share_of_thickness, int thickness) const {
    int z = 0;
    while (z < shape.cells &&
           depth + z * static_cast<double>(1 << shape.level) < share_of_thickness * thickness)
        ++z;
    return z;
}

LevelKicks Block::kicks(const Level& level, const StepParameters& step) const {
    const auto make = [&](int z, bool damped) {
        const double m = level.mass(z);
        const double g = damped ? 0.5 * step.damping * step.dt : 0.0;
        Kick kick;
        kick.velocity_factor = (1.0 - g) / (1.0 + g);
        kick.kick = step.dt / m / (1.0 + g);
        kick.drag_z = 2.0 * g * step.medium_velocity / (1.0 + g);
        kick.half_mass = 0.5 * m;
        kick.medium_z = step.medium_velocity;
        kick.damped = damped;
        kick.observed = step.observe;
        kick.drag = m * step.damping * step.dt;
        kick.per_force = -0.125 * step.dt * step.dt / m;
        return kick;
    };
    const int from = step.damping > 0.0
                         ? level.first_plane_from(step.damping_from, options_.thickness)
                         : level.shape.cells;
    return {make(0, from == 0), make(1, false), make(1, true), from};
}

/// Advances level by level from below, because the upper plane's forces are the transferred forces
/// of the level above. Each thread advances its share of the rows band by band; a row drifts as
/// soon as no force needs its old place; the outermost rows of a share, which the neighbouring
/// threads need, drift when all forces of the level are done.
void Block::advance(const StepParameters& step, KickSums& sums) {
    const ElasticKernels& kernels = elastic_kernels(strain());
    if (options_.finite_strain)
        while (scratch_.size() < static_cast<std::size_t>(omp_get_max_threads()))
            scratch_.emplace_back(scratch_tile(grid_, static_cast<int>(levels_.size())), 2);
    for (std::size_t l = 0; l < levels_.size(); ++l) {
        Level& level = levels_[l];
        const ElasticLevel view = level.view(options_.spacing);
        const LevelKicks kick = kicks(level, step);
        const int ny = level.tile.ny;
        KickSums of_level;
#pragma omp parallel if (level.nodes() > worth_threads)
        {
            const auto [first, last] = rows_of_thread(ny);
            VectorVolume<double> scratch{};
            if (!scratch_.empty())
                scratch = scratch_[static_cast<std::size_t>(omp_get_thread_num())].view();
            KickSums mine;
            for (int y = first; y < last; y += band)
                kernels.advance(view, kick, step.dt, {y, std::min(last, y + band), first, last},
                                scratch, mine);
#pragma omp barrier
            kernels.drift(view, step.dt, first, std::min(first + 1, last));
            kernels.drift(view, step.dt, std::max(last - 1, first + 1), last);
            restrict_forces(l);
#pragma omp critical(asperity_block_sums)
            of_level.merge(mine);
        }
        share_restricted_forces(l);
        if (counts(level)) sums.merge(of_level);
    }
}

void Block::forces(std::vector<VectorField<double>>& out) {
    const ElasticKernels& kernels = elastic_kernels(strain());
    for (std::size_t l = 0; l < levels_.size(); ++l) {
        Level& level = levels_[l];
        const ElasticLevel view = level.view(options_.spacing);
        const auto forces = out[l].view();
        const int ny = level.tile.ny;
#pragma omp parallel if (level.nodes() > worth_threads)
        {
#pragma omp for schedule(static)
            for (int y = 0; y < ny; y += band)
                kernels.forces(view, y, std::min(ny, y + band), forces);
            restrict_forces(l);
        }
        share_restricted_forces(l);
    }
}

/// Passes the forces on a level's upper plane to the level that it follows. Called by all threads.
void Block::restrict_forces(std::size_t fine) {
    if (fine + 1 >= levels_.size()) return;
    Level& coarse = levels_[fine + 1];
    // A fine level held whole feeds the whole coarse one on every rank alike.
    const Tile nodes =
        levels_[fine].tiled ? grid_.footprint(coarse.shape.level, grid_.rank()) : coarse.tile;
    const auto force = std::as_const(levels_[fine].upper_force).plane(0);
    const auto transferred = coarse.transferred.plane(0);
    const int x0 = nodes.x0 - coarse.tile.x0, y0 = nodes.y0 - coarse.tile.y0;
#pragma omp for schedule(static)
    for (int y = y0; y < y0 + nodes.ny; ++y) {
        const auto& restrict_forces = transfer_kernels().restrict_forces;
        restrict_forces(seam(fine), force.x, transferred.x, y, x0, nodes.nx);
        restrict_forces(seam(fine), force.y, transferred.y, y, x0, nodes.nx);
        restrict_forces(seam(fine), force.z, transferred.z, y, x0, nodes.nx);
    }
}

/// Sums the forces over all ranks if these hold the coarse level whole.
void Block::share_restricted_forces(std::size_t fine) {
    if (fine + 1 >= levels_.size()) return;
    const Level& coarse = levels_[fine + 1];
    if (!levels_[fine].tiled || coarse.tiled) return;
    const auto in = levels_[fine + 1].transferred.plane(0);
    const std::array planes = {in.x, in.y, in.z};
    gather_footprints(communicator_, grid_, coarse.shape.level, planes);
}

/// Returns the tile of a band as wide as the widest level's.
Tile Block::scratch_tile(const ProcessGrid& grid, int levels) {
    int widest = 0;
    for (int level = 0; level < levels; ++level)
        widest = std::max(widest, grid.tile(level).nx);
    return {0, 0, widest, band, grid.tile(0).sites};
}

void Block::add_top_force(ExactSum& sum) const {
    const Level& last = levels_.back();
    if (!counts(last)) return;
    elastic_kernels().sum(last.upper_force.plane(0).z, 0, last.tile.ny, sum);
}

void Block::add_elastic_energy(ExactSum& sum) const {
    const ElasticKernels& kernels = elastic_kernels(strain());
#pragma omp parallel
    {
        ExactSum mine;
        for (const Level& level : levels_) {
            if (!counts(level)) continue;
            const LevelCell cell = level.cell(options_.spacing);
            const int ny = level.tile.ny;
#pragma omp for schedule(static) nowait
            for (int y = 0; y < ny; y += band)
                kernels.energy(level.u.view(), cell, y, std::min(ny, y + band), mine);
        }
#pragma omp critical(asperity_block_sums)
        sum.merge(mine);
    }
}

void Block::add_lowest_z(ExactSum& sum) const {
    const auto z = lowest_layer().z;
#pragma omp parallel
    {
        ExactSum mine;
#pragma omp for schedule(static) nowait
        for (int y0 = 0; y0 < z.ny; y0 += band)
            elastic_kernels().sum(z, y0, std::min(z.ny, y0 + band), mine);
#pragma omp critical(asperity_block_sums)
        sum.merge(mine);
    }
}

} // namespace asperity
