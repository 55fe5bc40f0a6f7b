// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/block/block_memory.hpp"

#include <cmath>
#include <utility>

namespace asperity {

namespace {

/// Of a step that is x relaxation times long.
struct Decay {
    double e, b;
    explicit Decay(double x) : e(std::exp(-x)), b(x == 0.0 ? 1.0 : -std::expm1(-x) / x) {}
};

/// 1/tau int h.(S h) dt over the step is  a |h + shift d|^2 + rest |d|^2,  d = w' - w.
struct Loss {
    double a, shift, rest;
    explicit Loss(double x) {
        const double left = -std::expm1(-x); // 1 - e
        a = -0.5 * std::expm1(-2.0 * x);
        const double mixed = 0.5 * left * left / x;
        double square = 0.0; // of the part of h that d makes
        if (x < 0.03)        // where the difference below loses its digits
            square =
                x * (1.0 / 3.0 +
                     x * (-1.0 / 4.0 +
                          x * (7.0 / 60.0 + x * (-1.0 / 24.0 + x * (31.0 / 2520.0 - x / 320.0)))));
        else
            square = (1.0 - (2.0 * left - a) / x) / x;
        shift = mixed / a;
        rest = square - mixed * shift;
    }
};

/// result(site) over all sites and components of some fields of the same shape.
template <class Rule>
void at_each_site(SiteField<double>& result, const Rule& rule) {
    for (std::size_t c = 0; c < result.size(); ++c) {
        const PlaneView<double> to = result[c].plane(0);
#pragma omp parallel for schedule(static)
        for (int y = 0; y < to.ny; ++y)
            for (int x = 0; x < to.nx; ++x)
                to(x, y) = rule(c, x, y);
    }
}

double at(const SiteField<double>& field, std::size_t c, int x, int y) {
    return field[c].plane(0)(x, y);
}

} // namespace

BlockMemory::BlockMemory(const std::vector<Branch>& branches, const Slab& slab, int components)
    : branches_(branches), slab_(slab), components_(components), w_(new_field()) {
    for (std::size_t k = 0; k < branches.size(); ++k)
        h_.push_back(new_field());
}

void BlockMemory::begin(SiteField<double> w, double dt) {
    w_ = std::move(w);
    dt_ = dt;
}

double BlockMemory::stiffening() const {
    double sum = 0.0;
    for (const Branch& branch : branches_)
        sum += branch.ratio * Decay(dt_ / branch.time).b;
    return sum;
}

SiteField<double> BlockMemory::known() const {
    const double stiffening = this->stiffening();
    SiteField<double> sum = new_field();
    at_each_site(sum, [&](auto c, int x, int y) { return -stiffening * at(w_, c, x, y); });
    for (std::size_t k = 0; k < branches_.size(); ++k) {
        const double kept = branches_[k].ratio * Decay(dt_ / branches_[k].time).e;
        at_each_site(sum, [&](auto c, int x, int y) {
            return at(sum, c, x, y) + kept * at(h_[k], c, x, y);
        });
    }
    return sum;
}

BranchEnergies BlockMemory::energies(const SiteField<double>& to, const Square& square) const {
    BranchEnergies energies;
    SiteField<double> field = new_field();
    at_each_site(field, [&](auto c, int x, int y) { return at(to, c, x, y) - at(w_, c, x, y); });
    const double moved = square(field);
    for (std::size_t k = 0; k < branches_.size(); ++k) {
        const auto& [ratio, time] = branches_[k];
        const Decay decay(dt_ / time);
        const Loss loss(dt_ / time);
        const auto combined = [&](double kept, double of_step) {
            at_each_site(field, [&](auto c, int x, int y) {
                return kept * at(h_[k], c, x, y) + of_step * (at(to, c, x, y) - at(w_, c, x, y));
            });
            return square(field);
        };
        energies.stored += 0.5 * ratio * combined(decay.e, decay.b);
        energies.dissipated += ratio * (loss.a * combined(1.0, loss.shift) + loss.rest * moved);
    }
    return energies;
}

void BlockMemory::end(SiteField<double> to) {
    for (std::size_t k = 0; k < branches_.size(); ++k) {
        const Decay decay(dt_ / branches_[k].time);
        at_each_site(h_[k], [&](auto c, int x, int y) {
            return decay.e * at(h_[k], c, x, y) + decay.b * (at(to, c, x, y) - at(w_, c, x, y));
        });
    }
    w_ = std::move(to);
}

std::size_t BlockMemory::bytes() const {
    std::size_t sum = 0;
    for (const Field<double>& field : w_)
        sum += field.bytes();
    return sum * (1 + h_.size());
}

} // namespace asperity
