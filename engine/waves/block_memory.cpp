// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/waves/block_memory.hpp"

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

/// to = a x + b y, site by site; `to` may be either.
void combine(double a, const SiteField<double>& x, double b, const SiteField<double>& y,
             SiteField<double>& to) {
    for (std::size_t c = 0; c < to.size(); ++c) {
        const PlaneView<const double> from_x = x[c].plane(0), from_y = y[c].plane(0);
        const PlaneView<double> result = to[c].plane(0);
#pragma omp parallel for schedule(static)
        for (int row = 0; row < result.ny; ++row) {
            const double* const xs = from_x.line(row);
            const double* const ys = from_y.line(row);
            double* const line = result.line(row);
            for (int i = 0; i < result.nx; ++i)
                line[i] = a * xs[i] + b * ys[i];
        }
    }
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
    SiteField<double> sum = new_field();
    combine(-stiffening(), w_, 0.0, w_, sum);
    for (std::size_t k = 0; k < branches_.size(); ++k)
        combine(branches_[k].ratio * Decay(dt_ / branches_[k].time).e, h_[k], 1.0, sum, sum);
    return sum;
}

BranchEnergies BlockMemory::energies(const SiteField<double>& to, const Square& square) const {
    BranchEnergies energies;
    SiteField<double> moved = new_field(), field = new_field();
    combine(1.0, to, -1.0, w_, moved);
    const double of_step = square(moved);
    for (std::size_t k = 0; k < branches_.size(); ++k) {
        const auto& [ratio, time] = branches_[k];
        const Decay decay(dt_ / time);
        const Loss loss(dt_ / time);
        combine(decay.e, h_[k], decay.b, moved, field);
        energies.stored += 0.5 * ratio * square(field);
        combine(1.0, h_[k], loss.shift, moved, field);
        energies.dissipated += ratio * (loss.a * square(field) + loss.rest * of_step);
    }
    return energies;
}

void BlockMemory::end(SiteField<double> to) {
    combine(1.0, to, -1.0, w_, w_); // the step
    for (std::size_t k = 0; k < branches_.size(); ++k) {
        const Decay decay(dt_ / branches_[k].time);
        combine(decay.e, h_[k], decay.b, w_, h_[k]);
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
