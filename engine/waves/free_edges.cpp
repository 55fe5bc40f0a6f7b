// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/waves/free_edges.hpp"

#include "decomposition/surface_transform.hpp"

#include <boost/math/interpolators/cardinal_cubic_b_spline.hpp>
#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/special_functions/bessel.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <utility>

namespace asperity {

namespace {

constexpr double smoothing = 1.9; ///< s over the spacing: erfc(s pi/a) is 1e-17

constexpr double cut = 1.7;          ///< c over the wave number 1/a: exp(-(pi/c)^6) is 1e-17
constexpr double table_step = 0.125; ///< step of the table of far displacements, spacings
constexpr double least_phase =
    5e-4; ///< phase up to which K is taken as constant: S of longer waves takes long

double phase_of(int n, int sites) { return 2.0 * std::numbers::pi * n / sites; }

WavePhase along(double phase) { return {std::cos(phase), std::sin(phase)}; }

} // namespace

FreeEdges::FreeEdges(const BlockOptions& block, const Slab& slab)
    : block_(block), has_added_(block.is_coated()), slab_(slab) {
    block_.thickness = 1 << 30;
    plain_ = block_.uncoated();
    using Spline = boost::math::interpolators::cardinal_cubic_b_spline<double>;
    std::optional<Spline> added;
    if (has_added_) {
        const std::vector<double> table = added_far();
        added.emplace(table.data(), table.size(), 0.0, table_step * block.spacing, 0.0);
    }
    const int grid = slab.sites;
    const double modulus = block.contact_modulus(), a = block.spacing, s = smoothing * a;
    const double centre = 1.0 / (std::pow(std::numbers::pi, 1.5) * modulus * s);
    const SurfaceTransform<double> transform(slab, 1);
    SiteRows<double> rows = transform.from_sites();
#pragma omp parallel for schedule(static) num_threads(rows.threads())
    for (int row = 0; row < slab.rows; ++row) {
        double* const sites = rows.own()[0];
        const int y = slab.first + row;
        for (int x = 0; x < grid; ++x) {
            const double dx = std::min(x, grid - x), dy = std::min(y, grid - y);
            const double r = a * std::sqrt(dx * dx + dy * dy);
            sites[x] = r > 0.0 ? std::erf(0.5 * r / s) / (std::numbers::pi * modulus * r) : centre;
            if (added) sites[x] += (*added)(r);
        }
        rows.put(row);
    }
    far_.resize(at(slab.end_column(), 0));
    const WaveBlocks<double> blocks = std::move(rows).to_blocks();
#pragma omp parallel for schedule(static) num_threads(blocks.threads())
    for (int b = 0; b < slab.blocks(); ++b) {
        const double* const waves = blocks.get(b);
        const int first = slab.first_column() + b * block_columns;
        for (int nx = first; nx < std::min(first + block_columns, slab.end_column()); ++nx)
            for (int ny = 0; ny < slab.columns(); ++ny)
                far_[at(nx, ny)] = waves[2 * (block_columns * ny + nx - first)];
    }
    mirror();
}

void FreeEdges::mirror() {
    const int mine = slab_.ranks.rank(), first = slab_.first_column(), end = slab_.end_column();
    const auto width = [&](int rank) {
        return slab_.first_column(rank + 1) - slab_.first_column(rank);
    };
    // The rank of the larger nx sends its waves, [nx][ny], to the rank that holds the column ny.
    std::vector<std::vector<double>> parts(static_cast<std::size_t>(slab_.ranks.size()));
    std::vector<Message> messages;
    for (int rank = 0; rank < slab_.ranks.size(); ++rank) {
        if (rank == mine) continue;
        std::vector<double>& part = parts[static_cast<std::size_t>(rank)];
        part.resize(static_cast<std::size_t>(width(mine)) * static_cast<std::size_t>(width(rank)));
        if (rank > mine) {
            messages.push_back({.to = rank, .from = rank, .send = {}, .receive = part});
            continue;
        }
        auto to = part.begin();
        for (int nx = first; nx < end; ++nx)
            to = std::copy_n(far_.data() + at(nx, slab_.first_column(rank)), width(rank), to);
        messages.push_back({.to = rank, .from = rank, .send = part, .receive = {}});
    }
    slab_.ranks.exchange(messages);
    for (int nx = first; nx < end; ++nx)
        for (int ny = nx + 1; ny < end; ++ny)
            far_[at(nx, ny)] = far_[at(ny, nx)];
    for (int rank = mine + 1; rank < slab_.ranks.size(); ++rank) {
        auto from = parts[static_cast<std::size_t>(rank)].begin();
        for (int ny = slab_.first_column(rank); ny < slab_.first_column(rank + 1); ++ny)
            for (int nx = first; nx < end; ++nx)
                far_[at(nx, ny)] = *from++;
    }
}

double FreeEdges::compliance(int nx, int ny) const {
    if (nx < ny) std::swap(nx, ny);
    const double far = far_[slab_.holds(nx) ? at(nx, ny) : at(ny, nx)];
    if (nx == 0 && ny == 0) return far + near_uniform();
    const double phase_x = phase_of(nx, slab_.sites), phase_y = phase_of(ny, slab_.sites);
    return far + near(wave_phase(nx, slab_.sites), wave_phase(ny, slab_.sites),
                      std::sqrt(phase_x * phase_x + phase_y * phase_y));
}

double FreeEdges::near(WavePhase x, WavePhase y, double phase) const {
    const double remainder = block_.normal_compliance(x, y) - far_wave(phase);
    return has_added_ ? remainder - added(phase) : remainder;
}

double FreeEdges::far_wave(double phase) const {
    return 2.0 * std::erfc(smoothing * phase) / (block_.contact_modulus() * phase * block_.spacing);
}

double FreeEdges::added(double phase) const {
    const double low_pass = std::exp(-std::pow(phase / cut, 6));
    if (low_pass < 1e-17) return 0.0;
    const auto compliance = [&](const BlockOptions& block) {
        return block.normal_compliance(along(phase), {1.0, 0.0});
    };
    return low_pass * (compliance(block_) - compliance(plain_));
}

std::vector<double> FreeEdges::added_far() const {
    using Gauss = boost::math::quadrature::gauss<double, 10>;
    const double widest = slab_.sites / std::numbers::sqrt2 + 2.0; // all lengths over the spacing
    std::vector<double> phase, weight;
    const auto add = [&](double from, double to) {
        for (std::size_t i = 0; i < Gauss::abscissa().size(); ++i)
            for (const double side : {-1.0, 1.0}) {
                phase.push_back(0.5 * (from + to + side * (to - from) * Gauss::abscissa()[i]));
                weight.push_back(0.5 * (to - from) * Gauss::weights()[i] * phase.back() *
                                 added(std::max(phase.back(), least_phase)) /
                                 (2.0 * std::numbers::pi));
            }
    };
    // Panels of half a wave of J0 at the widest r; the first is halved again and again, for thick
    // layers.
    const double panel = std::numbers::pi / widest, last = std::numbers::pi;
    double to = panel;
    for (; to > least_phase; to *= 0.5)
        add(0.5 * to, to);
    add(0.0, to);
    for (double from = panel; from < last; from += panel)
        add(from, std::min(from + panel, last));
    std::vector<double> table(static_cast<std::size_t>(widest / table_step) + 1);
    // The ranks compute the entries in turn.
    const auto ranks = static_cast<std::size_t>(slab_.ranks.size());
#pragma omp parallel for schedule(static)
    for (std::size_t i = static_cast<std::size_t>(slab_.ranks.rank()); i < table.size(); i += ranks)
        for (std::size_t j = 0; j < phase.size(); ++j)
            table[i] += weight[j] * boost::math::cyl_bessel_j(0, phase[j] * table_step *
                                                                     static_cast<double>(i));
    slab_.ranks.sum(std::span(table)); // each entry and zeros
    return table;
}

/// Returns the limit of long waves, from three of them, without layers and surface stress: their
/// part vanishes there.
double FreeEdges::near_uniform() const {
    const double longest = phase_of(1, 16 * slab_.sites);
    double value[3];
    for (int i = 0; i < 3; ++i) {
        const double phase = longest / (1 << i);
        value[i] = plain_.normal_compliance(along(phase), {1.0, 0.0}) - far_wave(phase);
    }
    const double coarse = 2.0 * value[1] - value[0], fine = 2.0 * value[2] - value[1];
    return (4.0 * fine - coarse) / 3.0;
}

} // namespace asperity
