// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/scene/heights.hpp"

#include "decomposition/tile.hpp"

#include <fftw3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>

namespace asperity::heights {

namespace {

using std::numbers::pi;
using Complex = std::complex<double>;

double mean_of(const std::vector<double>& h, const Bands& bands) {
    std::array<double, 2> sums{};
    double &sum = sums[0], &count = sums[1];
    bands.in_order(sums, [&] {
        for (double v : h)
            if (!std::isnan(v)) sum += v, ++count;
    });
    return sum / count;
}

} // namespace

double rms_of(const std::vector<double>& h, const Bands& bands) {
    const double mean = mean_of(h, bands);
    std::array<double, 2> sums{};
    double &square = sums[0], &count = sums[1];
    bands.in_order(sums, [&] {
        for (double v : h)
            if (!std::isnan(v)) square += (v - mean) * (v - mean), ++count;
    });
    return std::sqrt(square / count);
}

void remove_mean(std::vector<double>& h, const Bands& bands) {
    const double mean = mean_of(h, bands);
    for (double& v : h)
        v -= mean;
}

Steps steps(const std::vector<double>& h, const Bands& bands) {
    const int n = bands.columns(), first = bands.first();
    const std::vector<double> with_next = bands.fetch(h, first, bands.held() + 1);
    std::array<double, 2> sums{};
    double &inside = sums[0], &seam = sums[1];
    const auto at = [&](int x, int y) { return with_next[bands.at(x, y)]; };
    bands.in_order(sums, [&] {
        for (int y = first; y < first + bands.held(); ++y)
            for (int x = 0; x < n; ++x) {
                const double along_x = at((x + 1) % n, y) - at(x, y);
                const double along_y = at(x, y + 1) - at(x, y);
                (x + 1 < n ? inside : seam) += along_x * along_x;
                (y + 1 < n ? inside : seam) += along_y * along_y;
            }
    });
    const double pairs = 2.0 * n; // over the edges; n - 1 times as many inside
    return {std::sqrt(inside / (pairs * std::max(1, n - 1))), std::sqrt(seam / pairs)};
}

void remove_plane(std::vector<double>& h, const Bands& bands) {
    remove_mean(h, bands);
    const int nx = bands.columns(), first = bands.first(), end = first + bands.held();
    const double middle_x = 0.5 * (nx - 1), middle_y = 0.5 * (bands.rows() - 1);
    std::array<double, 4> sums{};
    double &sx = sums[0], &sy = sums[1], &xx = sums[2], &yy = sums[3];
    bands.in_order(sums, [&] {
        for (int y = first; y < end; ++y)
            for (int x = 0; x < nx; ++x) {
                const double px = x - middle_x, py = y - middle_y;
                sx += px * h[bands.at(x, y)];
                sy += py * h[bands.at(x, y)];
                xx += px * px;
                yy += py * py;
            }
    });
    for (int y = first; y < end; ++y)
        for (int x = 0; x < nx; ++x)
            h[bands.at(x, y)] -= (xx > 0.0 ? sx / xx : 0.0) * (x - middle_x) +
                                 (yy > 0.0 ? sy / yy : 0.0) * (y - middle_y);
}

void remove_jumps(std::vector<double>& h, const Bands& bands) {
    const int nx = bands.columns(), ny = bands.rows(), first = bands.first(),
              end = first + bands.held();
    const std::vector<double> edges = bands.fetch(h, ny - 1, 2); // the last row and the first
    std::vector<Complex> smooth(h.size());
    for (int y = first; y < end; ++y) {
        const double jump = h[bands.at(nx - 1, y)] - h[bands.at(0, y)];
        smooth[bands.at(0, y)] += jump;
        smooth[bands.at(nx - 1, y)] -= jump;
    }
    for (int x = 0; x < nx; ++x) {
        const auto column = static_cast<std::size_t>(x);
        const double jump = edges[column] - edges[column + static_cast<std::size_t>(nx)];
        if (first == 0 && end > 0) smooth[bands.at(x, 0)] += jump;
        if (end == ny && first < ny) smooth[bands.at(x, ny - 1)] -= jump;
    }
    bands.transform(smooth, FFTW_FORWARD);
    for (int y = first; y < end; ++y)
        for (int x = 0; x < nx; ++x) {
            const double laplacian =
                2.0 * std::cos(2.0 * pi * x / nx) + 2.0 * std::cos(2.0 * pi * y / ny) - 4.0;
            smooth[bands.at(x, y)] *= x == 0 && y == 0 ? 0.0 : 1.0 / laplacian;
        }
    bands.transform(smooth, FFTW_BACKWARD);
    const double points = static_cast<double>(nx) * ny;
    for (std::size_t i = 0; i < h.size(); ++i)
        h[i] -= smooth[i].real() / points;
}

std::vector<double> middle(const std::vector<double>& h, const Bands& bands, int n) {
    const int m = bands.columns(), edge = (m - n) / 2;
    const Bands smaller(bands.ranks(), n);
    const std::vector<double> rows = bands.fetch(h, edge + smaller.first(), smaller.held());
    std::vector<double> cut;
    cut.reserve(smaller.size());
    for (auto row = rows.begin(); row != rows.end(); row += m)
        cut.insert(cut.end(), row + edge, row + edge + n);
    return cut;
}

std::vector<double> resample(const std::vector<double>& h, const Bands& bands, int n) {
    const int nx = bands.columns(), ny = bands.rows();
    std::vector<Complex> from(h.begin(), h.end());
    bands.transform(from, FFTW_FORWARD);
    const Bands finer(bands.ranks(), n);
    std::vector<Complex> to(finer.size());
    // A wave at the Nyquist limit of the coarser grid stands for both signs: half for each.
    const auto fraction = [](int k, int m) { return 2 * std::abs(k) == m ? 0.5 : 1.0; };
    const int mx = std::min(nx, n), my = std::min(ny, n);
    const auto add_waves = [&](int begin, int end) { // ky
        const int count = std::max(0, end - begin);
        const std::vector<Complex> rows = bands.fetch(from, begin, count);
        for (int k = 0; k < count; ++k)
            for (int kx = -(mx / 2); kx <= mx / 2; ++kx)
                to[finer.at(periodic(kx, n), periodic(begin + k, n))] +=
                    fraction(kx, mx) * fraction(begin + k, my) *
                    rows[static_cast<std::size_t>(k) * static_cast<std::size_t>(nx) +
                         static_cast<std::size_t>(periodic(kx, nx))];
    };
    const int first = finer.first(), end = first + finer.held();
    add_waves(std::max(-(my / 2), first - n), std::min(0, end - n));
    add_waves(first, std::min(my / 2 + 1, end));
    finer.transform(to, FFTW_BACKWARD);
    std::vector<double> result(to.size());
    const double scale = 1.0 / (static_cast<double>(nx) * static_cast<double>(ny));
    for (std::size_t i = 0; i < to.size(); ++i)
        result[i] = to[i].real() * scale;
    return result;
}

void scale_to_rms(std::vector<double>& h, const Bands& bands, double rms) {
    const double factor = rms / rms_of(h, bands);
    for (double& v : h)
        v *= factor;
}

} // namespace asperity::heights
