// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/equilibrium/curvature_memory.hpp"

#include <cmath>
#include <utility>

namespace asperity {

CurvatureMemory::CurvatureMemory(const SpectralBlock& block, const Preconditioner& preconditioner,
                                 std::size_t pairs)
    : block_(block), preconditioner_(preconditioner), limit_(pairs), z_(block.new_waves<float>()) {}

double CurvatureMemory::look(const Waves<double>& g) {
    const std::size_t known = pairs_.size();
    RowSums sums(block_.slab(), 2 + 2 * known);
#pragma omp parallel for schedule(static)
    for (int y = 0; y < g.rows(); ++y) {
        double* sum = sums.row(y);
        preconditioner_.apply_row(y, g, z_);
        for (int c = 0; c < g.components(); ++c) {
            const double* at = g.row(c, y);
            const int sites = g.slab().sites;
            sum[0] += row_dot(at, at, sites);
            sum[1] += row_dot(at, z_.row(c, y), sites);
            for (std::size_t j = 0; j < known; ++j) {
                sum[2 + 2 * j] += row_dot(at, pairs_[j].s.row(c, y), sites);
                sum[3 + 2 * j] += row_dot(at, pairs_[j].w.row(c, y), sites);
            }
        }
    }
    const std::vector<double> all = sums.total();
    gz_ = all[1];
    for (std::size_t j = 0; j < known; ++j) {
        pairs_[j].sg = all[2 + 2 * j];
        pairs_[j].wg = all[3 + 2 * j];
    }
    return all[0];
}

double CurvatureMemory::learn(const Waves<double>& g, double t, const Waves<float>& d,
                              double slope_before) {
    Pair pair = make_pair();
    std::vector<double> sg, wg; // of the older pairs, a look ago
    for (const Pair& p : pairs_) {
        sg.push_back(p.sg);
        wg.push_back(p.wg);
    }
    const double gz_before = gz_;
    const std::size_t known = pairs_.size();
    RowSums sums(block_.slab(), 6 + 2 * known);
#pragma omp parallel
    {
        const int sites = g.slab().sites, length = g.length();
        std::vector<float> before(static_cast<std::size_t>(g.components() * length)); // z of a row
        const auto z_before = [&](int c) { return before.data() + c * length; };
#pragma omp for schedule(static)
        for (int y = 0; y < g.rows(); ++y) {
            double* sum = sums.row(y);
            for (int c = 0; c < g.components(); ++c)
                combine_row(1.0, z_.row(c, y), 0.0, z_before(c), length);
            preconditioner_.apply_row(y, g, z_);
            for (int c = 0; c < g.components(); ++c) {
                const double* at = g.row(c, y);
                const float* z = z_.row(c, y);
                ShortFloat *s = pair.s.row(c, y), *w = pair.w.row(c, y);
                shorten_row(t, d.row(c, y), 0.0, z, s, length);
                shorten_row(1.0, z, -1.0, z_before(c), w, length);
                sum[0] += row_dot(at, at, sites);
                sum[1] += row_dot(at, z, sites);
                sum[2] += row_dot(at, z_before(c), sites);
                sum[3] += row_dot(at, d.row(c, y), sites);
                sum[4] += row_dot(at, s, sites);
                sum[5] += row_dot(at, w, sites);
                for (std::size_t j = 0; j < known; ++j) {
                    sum[6 + 2 * j] += row_dot(at, pairs_[j].s.row(c, y), sites);
                    sum[7 + 2 * j] += row_dot(at, pairs_[j].w.row(c, y), sites);
                }
            }
        }
    }
    const std::vector<double> all = sums.total();
    gz_ = all[1];
    slope_ = all[3];
    pair.sg = all[4];
    pair.wg = all[5];
    for (std::size_t j = 0; j < known; ++j) {
        pairs_[j].sg = all[6 + 2 * j];
        pairs_[j].wg = all[7 + 2 * j];
        pair.sy.push_back(pairs_[j].sg - sg[j]);
        pair.wy.push_back(pairs_[j].wg - wg[j]);
    }
    const double sy = t * (slope_ - slope_before);
    // (g - g_before).(z - z_before), P being symmetric.
    pair.yw = gz_ - 2.0 * all[2] + gz_before;
    if (!(sy > 1e-8 * std::abs(t * slope_before) && pair.yw > 0.0)) {
        spare_.push_back(std::move(pair));
        return all[0];
    }
    pair.rho = 1.0 / sy;
    pairs_.push_back(std::move(pair));
    return all[0];
}

CurvatureMemory::Pair CurvatureMemory::make_pair() {
    if (pairs_.size() == limit_) {
        spare_.push_back(std::move(pairs_.front()));
        pairs_.pop_front();
        for (Pair& p : pairs_) {
            p.sy.erase(p.sy.begin());
            p.wy.erase(p.wy.begin());
        }
    }
    if (spare_.empty())
        return {.s = block_.new_waves<ShortFloat>(),
                .w = block_.new_waves<ShortFloat>(),
                .sy = {},
                .wy = {}};
    Pair pair = std::move(spare_.back());
    spare_.pop_back();
    pair.sy.clear();
    pair.wy.clear();
    return pair;
}

void CurvatureMemory::direction(Waves<float>& d) const {
    const std::size_t known = pairs_.size();
    // s_i.y_j and w_i.y_j, i older than j, are kept by the younger.
    const auto wy = [&](std::size_t i, std::size_t j) {
        return i == j ? pairs_[i].yw : i < j ? pairs_[j].wy[i] : pairs_[i].wy[j];
    };
    std::vector<double> alpha(known), gamma(known); // gamma = alpha - beta
    for (std::size_t i = known; i-- > 0;) {
        double sq = pairs_[i].sg;
        for (std::size_t j = i + 1; j < known; ++j)
            sq -= alpha[j] * pairs_[j].sy[i];
        alpha[i] = pairs_[i].rho * sq;
    }
    for (std::size_t i = 0; i < known; ++i) {
        double yr = pairs_[i].wg;
        for (std::size_t j = 0; j < known; ++j)
            yr -= alpha[j] * wy(i, j);
        for (std::size_t j = 0; j < i; ++j)
            yr += gamma[j] * pairs_[i].sy[j];
        gamma[i] = alpha[i] - pairs_[i].rho * yr;
    }
    std::vector<float> weight;
    for (std::size_t j = 0; j < known; ++j) {
        weight.push_back(static_cast<float>(alpha[j]));
        weight.push_back(static_cast<float>(-gamma[j]));
    }
#pragma omp parallel
    {
        std::vector<const ShortFloat*> from(weight.size());
#pragma omp for schedule(static)
        for (int y = 0; y < d.rows(); ++y)
            for (int c = 0; c < d.components(); ++c) {
                for (std::size_t j = 0; j < known; ++j) {
                    from[2 * j] = pairs_[j].w.row(c, y);
                    from[2 * j + 1] = pairs_[j].s.row(c, y);
                }
                weigh_rows(-1.0, z_.row(c, y), from.data(), weight.data(),
                           static_cast<int>(weight.size()), d.row(c, y), d.length());
            }
    }
}

std::size_t CurvatureMemory::bytes() const { return (limit_ + 2) * z_.bytes(); }

} // namespace asperity
