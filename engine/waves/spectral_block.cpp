// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/waves/spectral_block.hpp"

#include <algorithm>

namespace asperity {

void SpectralBlock::set_uniform(double z) {
    layer_ = VectorField<double>(tile(), 1, 0);
    const PlaneView<double> uz = layer_.z.plane(0);
    for (int y = 0; y < uz.ny; ++y)
        std::fill(uz.line(y), uz.line(y) + uz.nx, z);
    waves_.clear();
    if (slab_.holds_uniform()) waves_.uniform(components_ - 1) = z;
}

void SpectralBlock::begin_step(double dt, double last) {
    if (!memory_) return;
    memory_->begin(from_top(), dt, last);
    const double sites = slab_.sites;
    to_waves(memory_->known_force(), transform<double>(), *memory_force_);
    combine(0.0, *memory_force_, 1.0 / (sites * sites), *memory_force_);
    stiffen_relaxed(*memory_force_);
    factor_ = 1.0 + memory_->stiffening();
}

std::size_t SpectralBlock::bytes() const {
    std::size_t sum = table_bytes() + layer_.bytes() + force_.bytes() + waves_.bytes();
    if (memory_) sum += memory_->bytes() + memory_force_->bytes();
    return sum;
}

} // namespace asperity
