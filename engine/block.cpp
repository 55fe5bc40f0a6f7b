// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/block.hpp"

#include <omp.h>

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

CellElasticity BlockOptions::elasticity(int level) const {
    const double s = spacing * (1 << level);
    return {shear_modulus() * s, (lame() - shear_modulus()) * s / 16.0};
}

double BlockOptions::highest_frequency(double site_stiffness) const {
    // Dispersion of the bulk stencil: w = 2 inside, so the dynamical matrix follows from the
    // filters of elastic_cell.hpp at a plane wave (phases p, q, r). Its largest eigenvalue, over a
    // mesh of the Brillouin zone that holds all symmetry points, is bounded by power iteration at
    // each of them.
    const CellElasticity e = elasticity(0);
    double highest = 0.0;
    constexpr int mesh = 12;
    for (int i = 0; i <= mesh; ++i)
        for (int j = 0; j <= i; ++j)
            for (int k = 0; k <= j; ++k) {
                const double pi = std::numbers::pi;
                const std::array<double, 3> phase = {pi * i / mesh, pi * j / mesh, pi * k / mesh};
                std::array<double, 3> c{}, s{};
                for (std::size_t n = 0; n < 3; ++n)
                    c[n] = std::cos(phase[n]), s[n] = std::sin(phase[n]);
                double d[3][3];
                for (std::size_t a = 0; a < 3; ++a)
                    for (std::size_t b = 0; b < 3; ++b) {
                        const std::size_t o = (a + 1) % 3, p = (a + 2) % 3;
                        if (a == b) {
                            const double theta = (2 - 2 * c[a]) * (2 + 2 * c[o]) * (2 + 2 * c[p]);
                            const double springs =
                                2 * (1 - c[a]) + 2 * (1 - c[a] * c[o]) + 2 * (1 - c[a] * c[p]);
                            d[a][b] = e.kappa * theta + e.k * springs;
                        } else {
                            const std::size_t t = 3 - a - b;
                            d[a][b] =
                                e.kappa * 4 * s[a] * s[b] * (2 + 2 * c[t]) + 2 * e.k * s[a] * s[b];
                        }
                    }
                std::array<double, 3> x = {1.0, 0.7, 0.4};
                double value = 0.0;
                for (int iteration = 0; iteration < 60; ++iteration) {
                    std::array<double, 3> y{};
                    double norm = 0.0;
                    for (std::size_t a = 0; a < 3; ++a) {
                        for (std::size_t b = 0; b < 3; ++b)
                            y[a] += d[a][b] * x[b];
                        norm += y[a] * y[a];
                    }
                    value = std::sqrt(norm);
                    if (value == 0.0) break;
                    for (std::size_t a = 0; a < 3; ++a)
                        x[a] = y[a] / value;
                }
                highest = std::max(highest, value);
            }
    return std::sqrt((highest + site_stiffness) / atom_mass);
}

std::vector<LevelPlan> plan_levels(const BlockOptions& options) {
    std::vector<LevelPlan> plan;
    int rest = options.thickness, sites = options.sites;
    for (int level = 0;; ++level) {
        const int least = options.layers_per_level;
        // One cell more where the rest would not divide by two.
        const int cells = least + ((rest - least) & 1);
        const bool coarsen = options.multiscale && sites % 2 == 0 && (rest - cells) / 2 >= least;
        plan.push_back({level, sites, coarsen ? cells : rest});
        if (!coarsen) return plan;
        rest = (rest - cells) / 2;
        sites /= 2;
    }
}

std::size_t Block::Level::bytes() const {
    return u.bytes() + v.bytes() + incoming.bytes() + upper_force.bytes();
}

double Block::Level::mass(int z) const {
    if (z > 0 || plan.level == 0) return node_mass; // the lowest layer's atoms are full atoms
    // Half a coarse cell above, and from below the hanging plane's half cells: 4 (m/8)/2 = m/4.
    return 0.75 * node_mass;
}

Block::Block(const BlockOptions& options, const Communicator& communicator, const ProcessGrid& grid,
             Motion motion)
    : options_(options), communicator_(communicator), grid_(grid), halo_(communicator, grid) {
    const auto plans = plan_levels(options);
    double depth = 0.0;
    for (const LevelPlan& plan : plans) {
        Level level;
        level.plan = plan;
        level.tile = grid.tile(plan.level);
        level.tiled = grid.tiled(plan.level);
        level.node_mass = options.atom_mass * std::pow(8.0, plan.level);
        level.depth = depth;
        level.elasticity = options.elasticity(plan.level);
        level.lower = make_stencil(level.elasticity, Face::lower);
        level.inner = make_stencil(level.elasticity, Face::inner);
        level.upper = make_stencil(level.elasticity, Face::upper);
        level.u = VectorField<double>(level.tile, plan.cells + 1);
        level.incoming = VectorField<double>(level.tile, 1);
        level.upper_force = VectorField<double>(level.tile, 1);
        if (motion == Motion::in_time) level.v = VectorField<double>(level.tile, plan.cells);
        depth += plan.cells * static_cast<double>(1 << plan.level);
        levels_.push_back(std::move(level));
    }
}

Block Block::copy_at_rest() const {
    Block copy(options_, communicator_, grid_, Motion::at_rest);
    for (std::size_t l = 0; l < levels_.size(); ++l) {
        copy.levels_[l].u.copy_from(levels_[l].u);
        copy.levels_[l].incoming.copy_from(levels_[l].incoming);
    }
    copy.top_ = top_;
    return copy;
}

void Block::set_uniform(double z, double w) {
    for (Level& level : levels_) {
        const VectorVolume<double> u = level.u.view(), v = level.v.view();
        const int h = halo_width;
        for (int k = 0; k <= level.plan.cells; ++k)
            for (int y = -h; y < level.tile.ny + h; ++y)
                for (int x = -h; x < level.tile.nx + h; ++x) {
                    u.x(x, y, k) = u.y(x, y, k) = 0.0;
                    u.z(x, y, k) = z;
                    if (!level.v.empty() && k < level.plan.cells && x >= 0 && x < level.tile.nx &&
                        y >= 0 && y < level.tile.ny) {
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
    const PlaneView<double> plane = last.u.z.plane(last.plan.cells);
    for (int y = -halo_width; y < plane.ny + halo_width; ++y)
        std::fill(plane.line(y) - halo_width, plane.line(y) + plane.nx + halo_width, z);
}

LevelSeam Block::seam(std::size_t fine) const {
    const Tile& f = levels_[fine].tile;
    const Tile& c = levels_[fine + 1].tile;
    return {f.x0, f.y0, c.x0, c.y0};
}

void Block::interpolate() {
#pragma omp parallel
    for (std::size_t l = 0; l + 1 < levels_.size(); ++l) {
        const auto fine = levels_[l].u.plane(levels_[l].plan.cells);
        const auto coarse = std::as_const(levels_[l + 1].u).plane(0);
#pragma omp for schedule(static) nowait
        for (int y = -halo_width; y < fine.x.ny + halo_width; ++y) {
            const auto& interpolate = transfer_kernels().interpolate;
            interpolate(seam(l), coarse.x, fine.x, y, halo_width);
            interpolate(seam(l), coarse.y, fine.y, y, halo_width);
            interpolate(seam(l), coarse.z, fine.z, y, halo_width);
        }
    }
}

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

/// Rows are handed to threads in bands.
constexpr int band = 8;

/// Below this many nodes a level's work is done sooner than threads are woken.
constexpr long long worth_threads = 8192;

} // namespace

namespace {

/// Rows [begin, end) of a tile.
struct Rows {
    int begin, end;
};

/// The share of this thread: whole bands, next to each other.
Rows rows_of_thread(int ny) {
    const int bands = (ny + band - 1) / band;
    const auto cut = [&](int thread) {
        return std::min(ny, band * (bands * thread / omp_get_num_threads()));
    };
    return {cut(omp_get_thread_num()), cut(omp_get_thread_num() + 1)};
}

} // namespace

/// Level by level from below: work on all bands of all moving planes; then the force on the upper
/// plane, which goes to the level above as its incoming force, or is the top plane's. Planes of a
/// band are done one after the other, while they are in the cache.
template <class Work>
void Block::sweep(const Work& work) {
    const ElasticKernels& kernels = elastic_kernels();
    for (std::size_t l = 0; l < levels_.size(); ++l) {
        Level& level = levels_[l];
        const auto u = std::as_const(level.u).view();
        const auto upper = level.upper_force.plane(0);
        const int cells = level.plan.cells, nx = level.tile.nx, ny = level.tile.ny;
#pragma omp parallel if (static_cast <long long>(nx) * ny * cells > worth_threads)
        {
            typename Work::Sums mine;
            const Rows share = rows_of_thread(ny);
            for (int y0 = share.begin; y0 < share.end; y0 += band) {
                const Rows rows = {y0, std::min(share.end, y0 + band)};
                for (int z = 0; z < cells; ++z) {
                    const Following next = z + 1 < cells          ? Following{z + 1, y0}
                                           : rows.end < share.end ? Following{0, rows.end}
                                                                  : Following{z, y0};
                    work(level, u, z, rows, next, mine);
                    if (z > 0) work.leave(level, z - 1, rows, share);
                }
                // One node beyond the tile on each side: the coarse nodes inside reach that far.
                kernels.force(u, cells, level.upper,
                              {-1, nx + 1, y0 == 0 ? -1 : y0, rows.end == ny ? ny + 1 : rows.end},
                              upper);
                work.leave(level, cells - 1, rows, share);
            }
#pragma omp barrier
            work.finish(level, share);
#pragma omp critical(asperity_block_sums)
            work.merge(level, mine);
        }
        if (l + 1 < levels_.size()) hand_up(l);
    }
}

void Block::hand_up(std::size_t l) {
    const auto force = std::as_const(levels_[l].upper_force).plane(0);
    const Level& coarse = levels_[l + 1];
    const auto in = levels_[l + 1].incoming.plane(0);
    // A fine level held whole feeds the whole coarse one on every rank alike.
    const Tile mine =
        levels_[l].tiled ? grid_.footprint(coarse.plan.level, grid_.rank()) : coarse.tile;
    const int x0 = mine.x0 - coarse.tile.x0, y0 = mine.y0 - coarse.tile.y0;
#pragma omp parallel for schedule(static) if (static_cast <long long>(mine.nx) * mine.ny >         \
                                              worth_threads)
    for (int y = y0; y < y0 + mine.ny; ++y) {
        const auto& restrict_forces = transfer_kernels().restrict_forces;
        restrict_forces(seam(l), force.x, in.x, y, x0, mine.nx);
        restrict_forces(seam(l), force.y, in.y, y, x0, mine.nx);
        restrict_forces(seam(l), force.z, in.z, y, x0, mine.nx);
    }
    if (levels_[l].tiled && !coarse.tiled) {
        const std::array planes = {in.x, in.y, in.z};
        gather_footprints(communicator_, grid_, coarse.plan.level, planes);
    }
}

namespace {

/// Kick, and drift behind it in place: a row moves on when the forces on the rows and planes around
/// it are done. The outermost rows of a thread's share are needed by its neighbours and wait for
/// them.
template <class Coefficients>
struct Advance {
    using Sums = KickSums;
    const Block& block;
    const Coefficients& coefficients; ///< of a plane of a level
    double dt;
    KickSums& total;

    void operator()(Block::Level& level, const VectorVolume<const double>& u, int z, Rows rows,
                    Following next, KickSums& sums) const {
        const Kick kick = coefficients(level, z);
        elastic_kernels().kick(u, z, level.stencil(z), rows.begin, rows.end,
                               std::as_const(level.incoming).plane(0), kick, next, level.v.view(),
                               sums);
        const long long nodes = static_cast<long long>(level.tile.nx) * (rows.end - rows.begin);
        sums.nodes += nodes;
        if (kick.damped) sums.damped += nodes;
    }
    /// Forces on planes z and z + 1 of a band are done: the rows that only they were waiting for.
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
    void leave(Block::Level&, int, Rows, Rows) const {}
    void finish(Block::Level&, Rows) const {}
    void merge(const Block::Level&, const Sums&) const {}
};

} // namespace

void Block::advance(const StepPlan& plan, KickSums& sums) {
    const auto coefficients = [&](const Level& level, int z) { return kick(level, z, plan); };
    sweep(Advance<decltype(coefficients)>{*this, coefficients, plan.dt, sums});
}

void Block::forces(std::vector<VectorField<double>>& out) { sweep(Keep{out}); }

void Block::exchange() {
    std::vector<HaloField> fields;
    fields.reserve(3 * levels_.size());
    for (Level& level : levels_) {
        const auto u = level.u.view();
        for (const auto& component : {u.x, u.y, u.z})
            fields.push_back({component, level.plan.cells, level.tiled});
    }
    halo_.exchange(fields);
}

void Block::add_top_force(ExactSum& sum) const {
    const Level& last = levels_.back();
    if (!counts(last)) return;
    elastic_kernels().sum(last.upper_force.plane(0).z, 0, last.tile.ny, sum);
}

void Block::add_elastic_energy(ExactSum& sum) const {
    const ElasticKernels& kernels = elastic_kernels();
#pragma omp parallel
    {
        ExactSum mine;
        for (const Level& level : levels_) {
            if (!counts(level)) continue;
            const int ny = level.tile.ny;
#pragma omp for schedule(static) nowait
            for (int y0 = 0; y0 < ny; y0 += band)
                for (int z = 0; z < level.plan.cells; ++z)
                    kernels.energy(level.u.view(), z, level.elasticity, y0, std::min(ny, y0 + band),
                                   mine);
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

std::size_t Block::bytes() const {
    std::size_t total = 0;
    for (const Level& level : levels_)
        total += level.bytes();
    return total;
}

std::size_t Block::motion_bytes() const {
    std::size_t total = 0;
    for (const Level& level : levels_)
        total += level.v.bytes();
    return total;
}

Block::Memory Block::memory_for(const BlockOptions& options, const ProcessGrid& grid) {
    Memory memory;
    for (const LevelPlan& plan : plan_levels(options)) {
        const auto planes = [&](int n) {
            return VectorField<double>::bytes_for(grid.tile(plan.level), n);
        };
        const std::size_t motion = planes(plan.cells);
        memory.motion += motion;
        const std::size_t level = motion + planes(plan.cells + 1) + 2 * planes(1);
        memory.bytes += level;
        if (plan.level > 0) memory.coarse += level;
    }
    return memory;
}

} // namespace asperity
