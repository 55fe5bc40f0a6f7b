// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/waves/stiffness_table.hpp"

#include "engine/waves/free_edges.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <type_traits>

namespace asperity {

using namespace matrix_entry;

StiffnessTable::StiffnessTable(const BlockOptions& options, const Slab& slab, bool frictionless)
    : layout_{options.grid(), frictionless ? 1 : 3}, first_block_(slab.first_block()),
      table_(layout_.size(slab.all_blocks())) {
    if (options.free_edges && !frictionless)
        throw std::invalid_argument("a block with free edges takes no lateral tractions");
    std::optional<FreeEdges> free_edges;
    if (options.free_edges) free_edges.emplace(options, layout_.sites);
    std::vector<WavePhase> phase;
    for (int n = 0; n <= layout_.sites / 2; ++n)
        phase.push_back(wave_phase(n, layout_.sites));
#pragma omp parallel for schedule(dynamic, 4)
    for (int i = 0; i < slab.columns(); ++i)
        for (int j = 0; j <= i; ++j) {
            const WavePhase along_x = phase[static_cast<std::size_t>(i)],
                            along_y = phase[static_cast<std::size_t>(j)];
            if (frictionless) {
                const double normal =
                    1.0 / (free_edges ? free_edges->compliance(i, j)
                                      : options.normal_compliance(along_x, along_y));
                layout_.put({.zz = normal}, i, j, table_);
                layout_.put({.zz = normal}, j, i, table_);
                continue;
            }
            const SurfaceMatrix s = options.stiffness(along_x, along_y);
            // Terms odd in a component of q vanish where it is that of the shortest wave, which
            // stands for both signs.
            const double x = 2 * i == layout_.sites ? 0.0 : 1.0;
            const double y = 2 * j == layout_.sites ? 0.0 : 1.0;
            const double s_xy = x * y * s.xy, s_xz = x * s.xz, s_yz = y * s.yz;
            layout_.put({s.xx, s.yy, s.zz, s_xy, s_xz, s_yz}, i, j, table_);
            layout_.put({s.yy, s.xx, s.zz, s_xy, s_yz, s_xz}, j, i, table_);
        }
    SurfaceMatrix free = at(0, 0);
    uniform_ = free.zz;
    free.zz = 0.0;
    layout_.put(free, 0, 0, table_);
    single_.assign(table_.begin(), table_.end());
}

SurfaceMatrix StiffnessTable::at(int nx, int ny) const {
    const auto entry = [&](std::size_t e) { return table_[layout_.at(e, nx, ny)]; };
    if (layout_.components == 1) return {0.0, 0.0, entry(0), 0.0, 0.0, 0.0};
    return {entry(xx), entry(yy), entry(zz), entry(xy), entry(xz), entry(yz)};
}

double StiffnessTable::stiffest() const {
    double stiffest = 0.0;
    for (int ny = 0; ny <= layout_.sites / 2; ++ny)
        for (int nx = 0; nx <= layout_.sites / 2; ++nx)
            stiffest = std::max(stiffest, at(nx, ny).zz);
    return stiffest;
}

template <class T>
void StiffnessTable::multiply(int b, const T* u, double norm, const T* g, T* f) const {
    const T* table = nullptr;
    if constexpr (std::is_same_v<T, double>)
        table = table_.data();
    else
        table = single_.data();
    multiply_block(table + layout_.size(first_block_ + b), layout_.sites, layout_.components, u,
                   norm, g, f);
}
template void StiffnessTable::multiply(int, const float*, double, const float*, float*) const;
template void StiffnessTable::multiply(int, const double*, double, const double*, double*) const;

} // namespace asperity
