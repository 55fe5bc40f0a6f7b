// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/waves/preconditioner.hpp"

namespace asperity {

Preconditioner::Preconditioner(const Response& block, double k)
    : layout_(block.slab(), block.components()), table_(layout_.size(block.slab().blocks())) {
    tune(block, k);
}

void Preconditioner::tune(const Response& block, double k) {
    k_ = k;
    const Slab& slab = block.slab();
#pragma omp parallel for schedule(static)
    for (int ny = 0; ny < slab.columns(); ++ny)
        for (int nx = slab.first_column(); nx < slab.end_column(); ++nx) {
            SurfaceMatrix m = block.acting_stiffness(nx, ny);
            m.xx += k;
            m.yy += k;
            m.zz += k;
            SurfaceMatrix i = inverse(m);
            if (nx == 0 && ny == 0 && block.constraint().is_mean_height()) i.zz = 0.0;
            layout_.put(i, nx, ny, table_);
        }
}

void Preconditioner::apply(int b, const float* from, double fraction, float* to) const {
    multiply_block(table_.data() + layout_.size(b), layout_.sites, layout_.components, from,
                   fraction, to, to);
}

} // namespace asperity
