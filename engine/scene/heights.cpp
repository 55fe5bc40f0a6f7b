// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/scene/heights.hpp"

#include "decomposition/tile.hpp"

#include <fftw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>

namespace asperity::heights {

namespace {

using std::numbers::pi;
using Complex = std::complex<double>;

std::size_t cells(int n) { return static_cast<std::size_t>(n) * static_cast<std::size_t>(n); }

double mean_of(const std::vector<double>& h) {
    double sum = 0.0;
    std::size_t count = 0;
    for (double v : h)
        if (!std::isnan(v)) sum += v, ++count;
    return sum / static_cast<double>(count);
}

} // namespace

void transform(std::vector<Complex>& data, int nx, int ny, int sign) {
    auto* raw = reinterpret_cast<fftw_complex*>(data.data());
    const std::unique_ptr<fftw_plan_s, void (*)(fftw_plan)> plan(
        fftw_plan_dft_2d(ny, nx, raw, raw, sign, FFTW_ESTIMATE), fftw_destroy_plan);
    if (!plan)
        throw std::runtime_error(
            fmt::format("surface: FFTW cannot plan a transform of {} x {} points", nx, ny));
    fftw_execute(plan.get());
}

double rms_of(const std::vector<double>& h) {
    const double mean = mean_of(h);
    double square = 0.0;
    std::size_t count = 0;
    for (double v : h)
        if (!std::isnan(v)) square += (v - mean) * (v - mean), ++count;
    return std::sqrt(square / static_cast<double>(count));
}

void remove_mean(std::vector<double>& h) {
    const double mean = mean_of(h);
    for (double& v : h)
        v -= mean;
}

Steps steps(const std::vector<double>& h, int n) {
    double inside = 0.0, seam = 0.0;
    const auto at = [&](int x, int y) {
        return h[static_cast<std::size_t>(y) * static_cast<std::size_t>(n) +
                 static_cast<std::size_t>(x)];
    };
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
            const double along_x = at((x + 1) % n, y) - at(x, y);
            const double along_y = at(x, (y + 1) % n) - at(x, y);
            (x + 1 < n ? inside : seam) += along_x * along_x;
            (y + 1 < n ? inside : seam) += along_y * along_y;
        }
    const double pairs = 2.0 * n; // over the edges; n - 1 times as many inside
    return {std::sqrt(inside / (pairs * std::max(1, n - 1))), std::sqrt(seam / pairs)};
}

void remove_plane(std::vector<double>& h, int nx, int ny) {
    remove_mean(h);
    double sx = 0.0, sy = 0.0, xx = 0.0, yy = 0.0;
    const auto at = [&](int x, int y) -> double& {
        return h[static_cast<std::size_t>(y) * static_cast<std::size_t>(nx) +
                 static_cast<std::size_t>(x)];
    };
    for (int y = 0; y < ny; ++y)
        for (int x = 0; x < nx; ++x) {
            const double px = x - 0.5 * (nx - 1), py = y - 0.5 * (ny - 1);
            sx += px * at(x, y);
            sy += py * at(x, y);
            xx += px * px;
            yy += py * py;
        }
    for (int y = 0; y < ny; ++y)
        for (int x = 0; x < nx; ++x)
            at(x, y) -= (xx > 0.0 ? sx / xx : 0.0) * (x - 0.5 * (nx - 1)) +
                        (yy > 0.0 ? sy / yy : 0.0) * (y - 0.5 * (ny - 1));
}

void remove_jumps(std::vector<double>& h, int nx, int ny) {
    const auto at = [&](int x, int y) {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(nx) +
               static_cast<std::size_t>(x);
    };
    std::vector<Complex> smooth(h.size());
    for (int y = 0; y < ny; ++y) {
        const double jump = h[at(nx - 1, y)] - h[at(0, y)];
        smooth[at(0, y)] += jump;
        smooth[at(nx - 1, y)] -= jump;
    }
    for (int x = 0; x < nx; ++x) {
        const double jump = h[at(x, ny - 1)] - h[at(x, 0)];
        smooth[at(x, 0)] += jump;
        smooth[at(x, ny - 1)] -= jump;
    }
    transform(smooth, nx, ny, FFTW_FORWARD);
    for (int y = 0; y < ny; ++y)
        for (int x = 0; x < nx; ++x) {
            const double laplacian =
                2.0 * std::cos(2.0 * pi * x / nx) + 2.0 * std::cos(2.0 * pi * y / ny) - 4.0;
            smooth[at(x, y)] *= x == 0 && y == 0 ? 0.0 : 1.0 / laplacian;
        }
    transform(smooth, nx, ny, FFTW_BACKWARD);
    for (std::size_t i = 0; i < h.size(); ++i)
        h[i] -= smooth[i].real() / static_cast<double>(h.size());
}

std::vector<double> middle(const std::vector<double>& h, int m, int n) {
    std::vector<double> cut;
    cut.reserve(cells(n));
    const int first = (m - n) / 2;
    for (int y = first; y < first + n; ++y) {
        const auto row = h.begin() + static_cast<std::ptrdiff_t>(y) * m + first;
        cut.insert(cut.end(), row, row + n);
    }
    return cut;
}

std::vector<double> resample(const std::vector<double>& h, int nx, int ny, int n) {
    std::vector<Complex> from(h.begin(), h.end());
    transform(from, nx, ny, FFTW_FORWARD);
    std::vector<Complex> to(cells(n));
    // A wave at the Nyquist limit of the coarser grid stands for both signs: half for each.
    const auto fraction = [](int k, int m) { return 2 * std::abs(k) == m ? 0.5 : 1.0; };
    const int mx = std::min(nx, n), my = std::min(ny, n);
    for (int ky = -(my / 2); ky <= my / 2; ++ky)
        for (int kx = -(mx / 2); kx <= mx / 2; ++kx)
            to[static_cast<std::size_t>(periodic(ky, n)) * static_cast<std::size_t>(n) +
               static_cast<std::size_t>(periodic(kx, n))] +=
                fraction(kx, mx) * fraction(ky, my) *
                from[static_cast<std::size_t>(periodic(ky, ny)) * static_cast<std::size_t>(nx) +
                     static_cast<std::size_t>(periodic(kx, nx))];
    transform(to, n, n, FFTW_BACKWARD);
    std::vector<double> result(to.size());
    const double scale = 1.0 / (static_cast<double>(nx) * static_cast<double>(ny));
    for (std::size_t i = 0; i < to.size(); ++i)
        result[i] = to[i].real() * scale;
    return result;
}

void scale_to_rms(std::vector<double>& h, double rms) {
    const double factor = rms / rms_of(h);
    for (double& v : h)
        v *= factor;
}

} // namespace asperity::heights
