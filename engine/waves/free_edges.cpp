// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/waves/free_edges.hpp"

#include "decomposition/surface_transform.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace asperity {

namespace {

constexpr double smoothing = 1.9; ///< s over the spacing: erfc(s pi/a) is 1e-17

double phase_of(int n, int sites) { return 2.0 * std::numbers::pi * n / sites; }

WavePhase along(double phase) { return {std::cos(phase), std::sin(phase)}; }

} // namespace

FreeEdges::FreeEdges(const BlockOptions& block, int grid)
    : block_(block), grid_(grid), far_(Slab(grid, Communicator()), 1) {
    block_.thickness = 1 << 30;
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
        }
    to_waves(far, SurfaceTransform<double>(slab, 1), far_);
}

double FreeEdges::compliance(int nx, int ny) const {
    const double far = *far_.wave(0, nx, ny);
    if (nx == 0 && ny == 0) return far + near_uniform();
    return far + near(wave_phase(nx, grid_), wave_phase(ny, grid_),
                      std::hypot(phase_of(nx, grid_), phase_of(ny, grid_)));
}

double FreeEdges::near(WavePhase x, WavePhase y, double phase) const {
    const double far =
        2.0 * std::erfc(smoothing * phase) / (block_.contact_modulus() * phase * block_.spacing);
    return inverse(block_.stiffness(x, y)).zz - far;
}

/// Returns the limit of long waves, from three of them.
double FreeEdges::near_uniform() const {
    const double longest = phase_of(1, 16 * grid_);
    double value[3];
    for (int i = 0; i < 3; ++i) {
        const double phase = longest / (1 << i);
        value[i] = near(along(phase), {1.0, 0.0}, phase);
    }
    const double coarse = 2.0 * value[1] - value[0], fine = 2.0 * value[2] - value[1];
    return (4.0 * fine - coarse) / 3.0;
}

} // namespace asperity
