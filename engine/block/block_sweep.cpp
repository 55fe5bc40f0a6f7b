// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The pass over a block's planes: forces, and what is done with them.
#include "engine/block/block.hpp"

#include <omp.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

namespace asperity {

Kick Block::kick(const Level& level, int z, const StepPlan& plan) const {
    const double m = level.mass(z);
    const double depth = level.depth + z * static_cast<double>(1 << level.plan.level);
    const bool damped = plan.damping > 0.0 && depth >= plan.damping_from * options_.thickness;
    const double g = damped ? 0.5 * plan.damping * plan.dt : 0.0;
    Kick kick;
    kick.keep = (1.0 - g) / (1.0 + g);
    kick.kick = plan.dt / m / (1.0 + g);
    kick.drag_z = 2.0 * g * plan.medium_velocity / (1.0 + g);
    kick.half_mass = 0.5 * m;
    kick.medium_z = plan.medium_velocity;
    kick.damped = damped;
    kick.observed = plan.observe;
    kick.drag = m * plan.damping * plan.dt;
    return kick;
}

namespace {

/// Below this many nodes a level's work is done sooner than threads are woken.
constexpr long long worth_threads = 8192;

/// The share of this thread: whole bands, next to each other.
Block::Rows rows_of_thread(int ny) {
    const int bands = (ny + Block::band - 1) / Block::band;
    const auto cut = [&](int thread) {
        return std::min(ny, Block::band * (bands * thread / omp_get_num_threads()));
    };
    return {cut(omp_get_thread_num()), cut(omp_get_thread_num() + 1)};
}

/// One node beyond the tile on each side: the coarse nodes inside reach that far.
Patch beyond(const Tile& tile, Block::Rows rows) {
    return {-1, tile.nx + 1, rows.begin == 0 ? -1 : rows.begin,
            rows.end == tile.ny ? tile.ny + 1 : rows.end};
}

/// Hands the forces on a level's upper plane to the level that it hangs on.
class Restriction {
public:
    /// nodes: those of the coarse level that this rank sums.
    Restriction(LevelSeam seam, Block::Level& fine, Block::Level& coarse, const Tile& nodes)
        : seam_(seam), force_(std::as_const(fine.upper_force).plane(0)),
          incoming_(coarse.incoming.plane(0)), x0_(nodes.x0 - coarse.tile.x0), nx_(nodes.nx) {}

    /// Into the coarse rows that lie on fine rows of this range; the forces on these and on one row
    /// more at each side are done.
    void operator()(Block::Rows fine) const {
        const auto& restrict_forces = transfer_kernels().restrict_forces;
        const int shift = seam_.fine_y0 - 2 * seam_.coarse_y0;
        for (int y = (fine.begin + shift + 1) / 2; y < (fine.end + shift + 1) / 2; ++y) {
            restrict_forces(seam_, force_.x, incoming_.x, y, x0_, nx_);
            restrict_forces(seam_, force_.y, incoming_.y, y, x0_, nx_);
            restrict_forces(seam_, force_.z, incoming_.z, y, x0_, nx_);
        }
    }

private:
    LevelSeam seam_;
    VectorPlane<const double> force_;
    VectorPlane<double> incoming_;
    int x0_, nx_;
};

} // namespace

/// Level by level from below: work on all bands of all moving planes, and the force on the upper
/// plane, which goes to the level above as its incoming force, or is the top plane's. Planes of a
/// band are done one after the other, while they are in the cache, and so are the coarse rows above
/// it; what needs rows of two threads comes last.
template <class Work>
void Block::sweep(const Work& work) {
    for (std::size_t l = 0; l < levels_.size(); ++l) {
        Level& level = levels_[l];
        const int ny = level.tile.ny;
        const long long nodes = static_cast<long long>(level.tile.nx) * ny * level.plan.cells;
        std::optional<Restriction> restriction;
        if (l + 1 < levels_.size()) {
            Level& coarse = levels_[l + 1];
            // A fine level held whole feeds the whole coarse one on every rank alike.
            restriction.emplace(seam(l), level, coarse,
                                level.tiled ? grid_.footprint(coarse.plan.level, grid_.rank())
                                            : coarse.tile);
        }
#pragma omp parallel if (nodes > worth_threads)
        {
            typename Work::Sums mine;
            const Rows share = rows_of_thread(ny);
            // Rows of the upper plane whose neighbours are this thread's, too.
            const Rows alone = {share.begin + (share.begin > 0), share.end - (share.end < ny)};
            for (int y0 = share.begin; y0 < share.end; y0 += band) {
                const Rows rows = {y0, std::min(share.end, y0 + band)};
                if (options_.finite_strain)
                    sweep_finite_band(level, rows, share, work, mine);
                else
                    sweep_band(level, rows, share, work, mine);
                if (restriction)
                    (*restriction)({std::max(rows.begin - 1, alone.begin),
                                    rows.end == share.end ? alone.end : rows.end - 1});
            }
#pragma omp barrier
            if (restriction && share.begin < share.end) {
                (*restriction)({share.begin, alone.begin});
                (*restriction)({std::max(alone.begin, alone.end), share.end});
            }
            work.finish(level, share);
#pragma omp critical(asperity_block_sums)
            work.merge(level, mine);
        }
        if (l + 1 < levels_.size()) hand_up(l);
    }
}

template <class Work>
void Block::sweep_band(Level& level, Rows rows, Rows share, const Work& work,
                       typename Work::Sums& sums) {
    const auto u = std::as_const(level.u).view();
    const int cells = level.plan.cells;
    for (int z = 0; z < cells; ++z) {
        const Following next = z + 1 < cells          ? Following{z + 1, rows.begin}
                               : rows.end < share.end ? Following{0, rows.end}
                                                      : Following{z, rows.begin};
        work(level, u, z, rows, next, sums);
        if (z > 0) work.leave(level, z - 1, rows, share);
    }
    elastic_kernels().force(u, cells, level.upper, beyond(level.tile, rows),
                            level.upper_force.plane(0));
    work.leave(level, cells - 1, rows, share);
}

/// The same at finite strain: from plane to plane the forces begun on the plane above are handed
/// on; work.place() says where they are summed, work.complete() takes them.
template <class Work>
void Block::sweep_finite_band(Level& level, Rows rows, Rows share, const Work& work,
                              typename Work::Sums& sums) {
    const FiniteKernels& kernels = finite_kernels();
    const FiniteCell cell = level.finite_cell(options_.spacing);
    const auto u = std::as_const(level.u).view();
    const auto incoming = std::as_const(level.incoming).plane(0);
    const int cells = level.plan.cells, nx = level.tile.nx;
    const Patch inside = {0, nx, rows.begin, rows.end};
    VectorPlane<double> lower = work.place(level, 0, rows);
    for (int y = rows.begin; y < rows.end; ++y) {
        std::copy_n(incoming.x.line(y), nx, lower.x.line(y));
        std::copy_n(incoming.y.line(y), nx, lower.y.line(y));
        std::copy_n(incoming.z.line(y), nx, lower.z.line(y));
    }
    for (int z = 0; z < cells; ++z) {
        const bool last = z + 1 == cells;
        const auto upper = last ? level.upper_force.plane(0) : work.place(level, z + 1, rows);
        kernels.cells(u, z, cell, inside, lower, last ? beyond(level.tile, rows) : inside, upper);
        work.complete(level, z, rows, lower, sums);
        work.leave(level, z, rows, share); // the cells above plane z were the last to need it
        lower = upper;
    }
    kernels.surface(u, cells, cell, beyond(level.tile, rows), lower);
}

/// To every rank, where these hold the coarse level whole.
void Block::hand_up(std::size_t l) {
    const Level& coarse = levels_[l + 1];
    if (!levels_[l].tiled || coarse.tiled) return;
    const auto in = levels_[l + 1].incoming.plane(0);
    const std::array planes = {in.x, in.y, in.z};
    gather_footprints(communicator_, grid_, coarse.plan.level, planes);
}

namespace {

using Rows = Block::Rows;

/// Kick, and drift behind it in place: a row moves on when the forces on the rows and planes around
/// it are done. The outermost rows of a thread's share are needed by its neighbours and wait for
/// them.
template <class Coefficients>
struct Advance {
    using Sums = KickSums;
    const Block& block;
    const Coefficients& coefficients; ///< of a plane of a level
    double dt;
    std::vector<VectorField<double>>& scratch; ///< at finite strain
    KickSums& total;

    void operator()(Block::Level& level, const VectorVolume<const double>& u, int z, Rows rows,
                    Following next, KickSums& sums) const {
        const Kick kick = coefficients(level, z);
        elastic_kernels().kick(u, z, level.stencil(z), rows.begin, rows.end,
                               std::as_const(level.incoming).plane(0), kick, next, level.v.view(),
                               sums);
    }
    /// Two planes of this thread's scratch in turn.
    VectorPlane<double> place(const Block::Level&, int z, Rows rows) const {
        auto plane = scratch[static_cast<std::size_t>(omp_get_thread_num())].plane(z & 1);
        for (PlaneView<double>* component : {&plane.x, &plane.y, &plane.z})
            component->origin -= rows.begin * component->row;
        return plane;
    }
    void complete(Block::Level& level, int z, Rows rows, const VectorPlane<double>& force,
                  KickSums& sums) const {
        finite_kernels().kick(force, z, rows.begin, rows.end, coefficients(level, z),
                              level.v.view(), sums);
    }
    /// No force on a band needs its rows of plane z any more: those that no other band needs.
    void leave(Block::Level& level, int z, Rows rows, Rows share) const {
        drift(level, z, {std::max(rows.begin - 1, share.begin + 1), rows.end - 1});
    }
    /// Forces of all threads are done.
    void finish(Block::Level& level, Rows share) const {
        for (int z = 0; z < level.plan.cells; ++z) {
            drift(level, z, {share.begin, std::min(share.begin + 1, share.end)});
            drift(level, z, {std::max(share.end - 1, share.begin + 1), share.end});
        }
    }
    void merge(const Block::Level& level, const KickSums& sums) const {
        if (block.counts(level)) total.merge(sums);
    }

private:
    void drift(Block::Level& level, int z, Rows rows) const {
        elastic_kernels().drift(std::as_const(level.v).plane(z), dt, rows.begin, rows.end,
                                level.u.plane(z));
    }
};

/// Forces kept.
struct Keep {
    struct Sums {};
    std::vector<VectorField<double>>& out;

    void operator()(Block::Level& level, const VectorVolume<const double>& u, int z, Rows rows,
                    Following, Sums&) const {
        const auto f = out[static_cast<std::size_t>(level.plan.level)].plane(z);
        elastic_kernels().force(u, z, level.stencil(z), {0, level.tile.nx, rows.begin, rows.end},
                                f);
        if (z > 0) return;
        const auto incoming = std::as_const(level.incoming).plane(0);
        for (int y = rows.begin; y < rows.end; ++y)
            for (int x = 0; x < level.tile.nx; ++x) {
                f.x(x, y) += incoming.x(x, y);
                f.y(x, y) += incoming.y(x, y);
                f.z(x, y) += incoming.z(x, y);
            }
    }
    VectorPlane<double> place(const Block::Level& level, int z, Rows) const {
        return out[static_cast<std::size_t>(level.plan.level)].plane(z);
    }
    void complete(Block::Level&, int, Rows, const VectorPlane<double>&, Sums&) const {}
    void leave(Block::Level&, int, Rows, Rows) const {}
    void finish(Block::Level&, Rows) const {}
    void merge(const Block::Level&, const Sums&) const {}
};

} // namespace

/// A band as wide as the widest level's.
Tile Block::scratch_tile(const ProcessGrid& grid, int levels) {
    int widest = 0;
    for (int level = 0; level < levels; ++level)
        widest = std::max(widest, grid.tile(level).nx);
    return {0, 0, widest, band, grid.tile(0).sites};
}

std::size_t Block::finite_bytes_for(const BlockOptions& options, const ProcessGrid& grid,
                                    int threads) {
    const int levels = static_cast<int>(plan_levels(options).size());
    return options.finite_strain ? static_cast<std::size_t>(threads) *
                                       VectorField<double>::bytes_for(scratch_tile(grid, levels), 2)
                                 : 0;
}

void Block::advance(const StepPlan& plan, KickSums& sums) {
    const auto coefficients = [&](const Level& level, int z) { return kick(level, z, plan); };
    if (options_.finite_strain)
        while (scratch_.size() < static_cast<std::size_t>(omp_get_max_threads()))
            scratch_.emplace_back(scratch_tile(grid_, static_cast<int>(levels_.size())), 2);
    sweep(Advance<decltype(coefficients)>{*this, coefficients, plan.dt, scratch_, sums});
}

void Block::forces(std::vector<VectorField<double>>& out) { sweep(Keep{out}); }

} // namespace asperity
