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

FreeEdges::FreeEdges(const BlockOptions& block, int grid)
    : block_(block), has_added_(block.is_coated()), grid_(grid),
      far_(Slab(grid, Communicator()), 1) {
    block_.thickness = 1 << 30;
    plain_ = block_.uncoated();
    using Spline = boost::math::interpolators::cardinal_cubic_b_spline<double>;
    std::optional<Spline> added;
    if (has_added_) {
        const std::vector<double> table = added_far();
        added.emplace(table.data(), table.size(), 0.0, table_step * block.spacing, 0.0);
    }
    const Slab slab(grid, Communicator());
    SiteField<double> far = site_field<double>(slab, 1);
    const PlaneView<double> at = far[0].plane(0);
    const double modulus = block.contact_modulus(), a = block.spacing, s = smoothing * a;
    const double centre = 1.0 / (std::pow(std::numbers::pi, 1.5) * modulus * s);
#pragma omp parallel for schedule(static)
    for (int y = 0; y < grid; ++y)
        for (int x = 0; x < grid; ++x) {
            const double dx = std::min(x, grid - x), dy = std::min(y, grid - y);
            const double r = a * std::sqrt(dx * dx + dy * dy);
            at(x, y) = r > 0.0 ? std::erf(0.5 * r / s) / (std::numbers::pi * modulus * r) : centre;
            if (added) at(x, y) += (*added)(r);
        }
    to_waves(far, SurfaceTransform<double>(slab, 1), far_);
}

double FreeEdges::compliance(int nx, int ny) const {
    const double far = *far_.wave(0, nx, ny);
    if (nx == 0 && ny == 0) return far + near_uniform();
    const double phase_x = phase_of(nx, grid_), phase_y = phase_of(ny, grid_);
    return far + near(wave_phase(nx, grid_), wave_phase(ny, grid_),
                      std::sqrt(phase_x * phase_x + phase_y * phase_y));
}

double FreeEdges::near(WavePhase x, WavePhase y, double phase) const {
    const double rest = block_.normal_compliance(x, y) - far_wave(phase);
    return has_added_ ? rest - added(phase) : rest;
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
    const double widest = grid_ / std::numbers::sqrt2 + 2.0; // all lengths over the spacing
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
#pragma omp parallel for schedule(static)
    for (std::size_t i = 0; i < table.size(); ++i)
        for (std::size_t j = 0; j < phase.size(); ++j)
            table[i] += weight[j] * boost::math::cyl_bessel_j(0, phase[j] * table_step *
                                                                     static_cast<double>(i));
    return table;
}

/// Returns the limit of long waves, from three of them, without layers and surface stress: their
/// part vanishes there.
double FreeEdges::near_uniform() const {
    const double longest = phase_of(1, 16 * grid_);
    double value[3];
    for (int i = 0; i < 3; ++i) {
        const double phase = longest / (1 << i);
        value[i] = plain_.normal_compliance(along(phase), {1.0, 0.0}) - far_wave(phase);
    }
    const double coarse = 2.0 * value[1] - value[0], fine = 2.0 * value[2] - value[1];
    return (4.0 * fine - coarse) / 3.0;
}

} // namespace asperity
