// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Seams that absorb what the next level cannot carry (docs/explanation/seams.md).
#include "engine/block/block.hpp"

#include "kernels/absorption.hpp"

#include <omp.h>

#include <algorithm>
#include <memory>
#include <utility>

namespace asperity {

namespace {

/// Rows whose changes wait: the first of a thread's share, and two in turn.
constexpr int waiting_rows = 3;
constexpr std::size_t alignment = 64;

std::size_t working_memory(const AbsorbingCells& c) {
    return static_cast<std::size_t>(c.smooth_size() + waiting_rows * c.changes_size()) +
           alignment / sizeof(double);
}

} // namespace

/// Of the velocities that an absorption of these levels reads beyond its own rows.
void Block::exchange_absorbing(std::size_t absorbing) {
    std::vector<HaloField> fields;
    fields.reserve(3 * levels_.size());
    for (std::size_t l = 0; l <= absorbing; ++l) {
        Level& level = levels_[l];
        const int from = l > 0 ? 0 : level.absorbs_from; // plane 0 constrains the finer level
        const int to = l < absorbing ? level.shape.cells : 1;
        const auto v = level.v.view();
        for (VolumeView<double> component : {v.x, v.y, v.z}) {
            component.origin += from * component.plane;
            fields.push_back({component, to - from, level.tiled});
        }
    }
    halo_.exchange(fields);
}

/// Every change is made of the velocities from before. What the changes of a level do to the plane
/// that it follows goes there as an impulse, the way forces do.
void Block::absorb(long long number, ExactSum& taken) {
    std::size_t absorbing = 0; // levels
    while (absorbing + 1 < levels_.size() && number % (1ll << absorbing) == 0)
        ++absorbing;
    exchange_absorbing(absorbing);
#pragma omp parallel if (levels_.front().nodes() > worth_threads)
    for (std::size_t l = 0; l < absorbing; ++l)
        follow(l, std::as_const(levels_[l + 1].v).plane(0), levels_[l].constrained_v.plane(0));
    for (std::size_t l = 0; l <= absorbing; ++l) {
        if (l < absorbing) {
            absorb_in_cells(l, taken);
            share_restricted_forces(l);
        }
        if (l > 0) absorb_from_below(l, taken);
    }
}

/// Row by row in place: a row is changed when the one behind it has been looked at, and the
/// outermost rows of a thread's share, which its neighbours look at, when all have been.
void Block::absorb_in_cells(std::size_t l, ExactSum& taken) {
    const AbsorptionKernels& kernels = absorption_kernels();
    Level& level = levels_[l];
    const int ny = level.tile.ny;
    const auto threads = static_cast<std::size_t>(omp_get_max_threads());
    if (absorption_rows_.size() < threads) absorption_rows_.resize(threads);
    const AbsorbingCells cells{level.absorbs_from,
                               level.shape.cells,
                               level.fraction.data(),
                               level.node_mass,
                               level.mass(0),
                               level.v.view(),
                               std::as_const(level.constrained_v).plane(0),
                               level.upper_force.plane(0)};
    ExactSum sum;
#pragma omp parallel if (level.nodes() > worth_threads)
    {
        const auto [first, last] = rows_of_thread(ny);
        std::vector<double>& memory =
            absorption_rows_[static_cast<std::size_t>(omp_get_thread_num())];
        if (memory.size() < working_memory(cells)) memory.resize(working_memory(cells));
        void* begin = memory.data();
        std::size_t size = memory.size() * sizeof(double);
        auto* const smooth =
            static_cast<double*>(std::align(alignment, size - alignment, begin, size));
        const auto changes = [&, outermost = first](int y) {
            const int slot = y == outermost ? 0 : 1 + (y & 1);
            return smooth + cells.smooth_size() + slot * cells.changes_size();
        };
        ExactSum mine;
        if (first == 0 && last > 0) kernels.changes(cells, -1, smooth, changes(0));
        for (int y = first; y < last; ++y) {
            kernels.changes(cells, y, smooth, changes(y));
            if (y - 1 > first) kernels.apply(cells, y - 1, changes(y - 1), mine);
        }
        if (last == ny && first < last) kernels.changes(cells, ny, smooth, nullptr);
#pragma omp barrier
        if (first < last) kernels.apply(cells, first, changes(first), mine);
        if (first + 1 < last) kernels.apply(cells, last - 1, changes(last - 1), mine);
        restrict_forces(l);
#pragma omp critical(asperity_block_sums)
        sum.merge(mine);
    }
    if (counts(level)) taken.merge(sum);
}

/// The lowest plane takes the impulse of the constrained plane below.
void Block::absorb_from_below(std::size_t l, ExactSum& taken) {
    Level& level = levels_[l];
    ExactSum sum;
    for (int y = 0; y < level.tile.ny; ++y)
        absorption_kernels().take(level.v.plane(0), std::as_const(level.transferred).plane(0),
                                  levels_[l - 1].node_mass, level.mass(0), y, sum);
    if (counts(level)) taken.merge(sum);
}

} // namespace asperity
