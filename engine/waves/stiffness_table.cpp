// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/waves/stiffness_table.hpp"

#include "engine/waves/free_edges.hpp"

#include <algorithm>
#include <optional>
#include <span>
#include <stdexcept>
#include <type_traits>

namespace asperity {

using namespace matrix_entry;

StiffnessTable::StiffnessTable(const BlockOptions& options, const Slab& slab, bool frictionless)
    : layout_(slab, frictionless ? 1 : 3), table_(layout_.size(slab.blocks())) {
    if (options.free_edges && !frictionless)
        throw std::invalid_argument("a block with free edges takes no lateral tractions");
    std::optional<FreeEdges> free_edges;
    if (options.free_edges) free_edges.emplace(options, slab);
    std::vector<WavePhase> phase;
    for (int n = 0; n <= layout_.sites / 2; ++n)
        phase.push_back(wave_phase(n, layout_.sites));
    const auto put = [&](const SurfaceMatrix& s, int nx, int ny) {
        if (slab.holds(nx)) layout_.put(s, nx, ny, table_);
    };
#pragma omp parallel for schedule(dynamic, 4)
    for (int column = slab.first_column(); column < slab.end_column(); ++column)
        for (int ny = 0; ny < slab.columns(); ++ny) {
            // A wave and its mirror image along the diagonal are computed once if this rank holds
            // both, and alike on every rank.
            if (ny > column && slab.holds(ny)) continue;
            const int i = std::max(column, ny), j = std::min(column, ny);
            const WavePhase along_x = phase[static_cast<std::size_t>(i)],
                            along_y = phase[static_cast<std::size_t>(j)];
            if (frictionless) {
                const double normal =
                    1.0 / (free_edges ? free_edges->compliance(i, j)
                                      : options.normal_compliance(along_x, along_y));
                put({.zz = normal}, i, j);
                put({.zz = normal}, j, i);
                continue;
            }
            const SurfaceMatrix s = options.stiffness(along_x, along_y);
            // Terms odd in a component of q vanish where it is that of the shortest wave, which
            // stands for both signs.
            const double x = 2 * i == layout_.sites ? 0.0 : 1.0;
            const double y = 2 * j == layout_.sites ? 0.0 : 1.0;
            const double s_xy = x * y * s.xy, s_xz = x * s.xz, s_yz = y * s.yz;
            put({s.xx, s.yy, s.zz, s_xy, s_xz, s_yz}, i, j);
            put({s.yy, s.xx, s.zz, s_xy, s_yz, s_xz}, j, i);
        }
    if (slab.holds_uniform()) {
        SurfaceMatrix free = at(0, 0);
        uniform_ = free.zz;
        free.zz = 0.0;
        layout_.put(free, 0, 0, table_);
    }
    slab.ranks.broadcast(std::span(&uniform_, 1)); // the root holds it
    single_.assign(table_.begin(), table_.end());
}

SurfaceMatrix StiffnessTable::at(int nx, int ny) const {
    const auto entry = [&](std::size_t e) { return table_[layout_.at(e, nx, ny)]; };
    if (layout_.components == 1) return {0.0, 0.0, entry(0), 0.0, 0.0, 0.0};
    return {entry(xx), entry(yy), entry(zz), entry(xy), entry(xz), entry(yz)};
}

template <class T>
void StiffnessTable::multiply(int b, const T* u, double norm, const T* g, T* f) const {
    const T* table = nullptr;
    if constexpr (std::is_same_v<T, double>)
        table = table_.data();
    else
        table = single_.data();
    multiply_block(table + layout_.size(b), layout_.sites, layout_.components, u, norm, g, f);
}
template void StiffnessTable::multiply(int, const float*, double, const float*, float*) const;
template void StiffnessTable::multiply(int, const double*, double, const double*, double*) const;

} // namespace asperity
