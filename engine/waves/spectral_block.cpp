// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/waves/spectral_block.hpp"

#include <algorithm>
#include <cmath>

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
    for (const std::unique_ptr<Memory>& memory : memories_)
        memory->begin({dt, last});
    if (!branches_) return;
    pattern_.reset();
    const double sites = slab_.sites;
    to_waves(branches_->known_force(), transform<double>(), *memory_force_);
    combine(0.0, *memory_force_, 1.0 / (sites * sites), *memory_force_);
    stiffen_relaxed(*memory_force_);
    factor_ = 1.0 + branches_->stiffening();
}

double SpectralBlock::begin_turn(const MovingPattern& pattern) {
    const bool first = !pattern_;
    if (first) begin_step(units::forever); // relaxed, and nothing is known
    pattern_ = pattern;
    Waves<double> change = new_waves<double>();
    combine(-1.0, *memory_force_, 0.0, change);
    combine(1.0, waves_, 0.0, *memory_force_);
    const MovingPattern::Factors remainder = pattern.remainder();
#pragma omp parallel for schedule(static)
    for (int b = 0; b < memory_force_->blocks(); ++b)
        scale_waves(b, pattern.axis(), remainder, memory_force_->block(b));
    stiffen_relaxed(*memory_force_);
    combine(1.0, *memory_force_, 1.0, change);
    return first ? HUGE_VAL : std::sqrt(dot(change, change)) / slab_.sites;
}

void SpectralBlock::settle_branches() {
    Waves<double> waves = new_waves<double>();
    for (std::size_t k = 0; k < pattern_->branches(); ++k) {
        combine(1.0, waves_, 0.0, waves);
#pragma omp parallel for schedule(static)
        for (int b = 0; b < waves.blocks(); ++b)
            scale_waves(b, pattern_->axis(), pattern_->of_branch(k), waves.block(b));
        to_sites(waves, transform<double>(), branches_->extension(k));
    }
    branches_->forget_last_step();
}

std::size_t SpectralBlock::bytes() const {
    std::size_t sum = table_.bytes() + layer_.bytes() + force_.bytes() + waves_.bytes();
    for (const std::unique_ptr<Memory>& memory : memories_)
        sum += memory->bytes();
    return memory_force_ ? sum + memory_force_->bytes() : sum;
}

} // namespace asperity
