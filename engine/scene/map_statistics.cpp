// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/scene/map_statistics.hpp"

#include "engine/scene/heights.hpp"

#include <fftw3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>

namespace asperity {

namespace {

/// Mean over what is a number, which runs through the bands of a map.
class Mean {
public:
    void add(double value) {
        if (std::isnan(value)) return;
        sums[0] += value;
        ++sums[1];
    }
    double value() const { return sums[1] > 0.0 ? sums[0] / sums[1] : 0.0; }

    std::array<double, 2> sums{}; ///< sum and number of the values
};

} // namespace

MapStatistics map_statistics(const std::vector<double>& h, const Bands& bands, double dx, double dy,
                             bool periodic) {
    const int nx = bands.columns(), ny = bands.rows(), first = bands.first(),
              end = first + bands.held();
    MapStatistics s;
    s.lowest = HUGE_VAL;
    s.highest = -s.lowest;
    Mean height, square, slope, curvature;
    for (const double v : h) {
        if (v < s.lowest) s.lowest = v;
        if (v > s.highest) s.highest = v;
    }
    s.lowest = -bands.ranks().max(-s.lowest);
    s.highest = bands.ranks().max(s.highest);
    bands.in_order(height.sums, [&] {
        for (const double v : h)
            height.add(v);
    });
    bands.in_order(square.sums, [&] {
        for (const double v : h)
            square.add((v - height.value()) * (v - height.value()));
    });
    // The rows of the band, with one before and one behind.
    const std::vector<double> rows = bands.fetch(h, first - 1, bands.held() + 2);
    const auto at = [&](int x, int y) {
        return rows[static_cast<std::size_t>(y - first + 1) * static_cast<std::size_t>(nx) +
                    static_cast<std::size_t>(x < nx ? x : x - nx)];
    };
    // Slopes of a map that does not repeat lack the last row and column, curvatures both edges.
    const int edge = periodic ? 0 : 1;
    bands.in_order(slope.sums, [&] {
        for (int y = first; y < std::min(end, ny - edge); ++y)
            for (int x = 0; x + edge < nx; ++x) {
                const double hx = (at(x + 1, y) - at(x, y)) / dx,
                             hy = (at(x, y + 1) - at(x, y)) / dy;
                slope.add(hx * hx + hy * hy);
            }
    });
    bands.in_order(curvature.sums, [&] {
        for (int y = std::max(first, edge); y < std::min(end, ny - edge); ++y)
            for (int x = edge; x + edge < nx; ++x) {
                const double centre = 2.0 * at(x, y);
                const double hxx = (at(x + 1, y) - centre + at(x + nx - 1, y)) / (dx * dx),
                             hyy = (at(x, y + 1) - centre + at(x, y - 1)) / (dy * dy);
                curvature.add(0.25 * (hxx + hyy) * (hxx + hyy));
            }
    });
    s.rms_height = std::sqrt(square.value());
    s.rms_slope = std::sqrt(slope.value());
    s.rms_curvature = std::sqrt(curvature.value());
    return s;
}

LineStatistics line_statistics(const std::vector<double>& h, int n, double length) {
    std::vector<std::complex<double>> wave(h.begin(), h.end());
    Bands({}, n).transform(wave, FFTW_FORWARD);
    LineStatistics s;
    const double points = static_cast<double>(n) * n;
    for (int k = 1; k <= n / 2; ++k) {
        double power = 0.0; // |h_q|^2 of this qx, summed over all qy: the mean over the lines
        for (int y = 0; y < n; ++y)
            power += std::norm(wave[static_cast<std::size_t>(y) * static_cast<std::size_t>(n) +
                                    static_cast<std::size_t>(k)]) /
                     (points * points);
        s.q.push_back(2.0 * std::numbers::pi * k / length);
        s.c1d.push_back(power * length);
    }
    for (int i = 1; i <= n / 2; ++i) {
        double sum = 0.0;
        for (int k = 1; k <= n / 2; ++k) { // two signs of q; Nyquist's is one wave
            const double waves = 2 * k == n ? 1.0 : 2.0;
            const double phase =
                2.0 * std::numbers::pi * static_cast<double>((1ll * k * i) % n) / n;
            sum += waves * s.c1d[static_cast<std::size_t>(k - 1)] * (1.0 - std::cos(phase));
        }
        s.r.push_back(length * i / n);
        s.acf.push_back(sum / length);
        s.slope.push_back(std::sqrt(2.0 * s.acf.back()) / s.r.back());
    }
    return s;
}

} // namespace asperity
