// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/surface/pair.hpp"

#include "decomposition/tile.hpp"
#include "engine/scene/heights.hpp"

#include <fftw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace asperity {

namespace {

using std::numbers::pi;
using Complex = std::complex<double>;

std::size_t at(int x, int y, int n) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(n) + static_cast<std::size_t>(x);
}

/// Returns the map whose point (x, y) is point from(x, y) of a map of n x n.
template <class From>
std::vector<double> moved(const std::vector<double>& h, int n, const From& from) {
    std::vector<double> to(h.size());
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
            const auto [i, j] = from(x, y);
            to[at(x, y, n)] = h[at(i, j, n)];
        }
    return to;
}

/// Multiplies each wave of a map by factor(kx, ky) with wave numbers of both signs.
template <class Factor>
void multiply_waves(std::vector<double>& h, int n, const Factor& factor) {
    std::vector<Complex> waves(h.begin(), h.end());
    const Bands map({}, n);
    map.transform(waves, FFTW_FORWARD);
    const auto both = [n](int k) { return 2 * k > n ? k - n : k; };
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x)
            waves[at(x, y, n)] *= factor(both(x), both(y));
    map.transform(waves, FFTW_BACKWARD);
    for (std::size_t i = 0; i < h.size(); ++i)
        h[i] = waves[i].real() / static_cast<double>(h.size());
}

constexpr int finer = 4;  ///< points of the interpolated map along an edge for one of the map
constexpr int points = 8; ///< points of an interpolation: 2e-4 of the shortest wave is lost

/// Returns Lagrange's weights of the points -3 .. 4 at a place t of the interval 0 .. 1.
std::array<double, points> weights(double t) {
    std::array<double, points> all{};
    for (int i = 0; i < points; ++i) {
        double& weight = all[static_cast<std::size_t>(i)];
        weight = 1.0;
        for (int j = 0; j < points; ++j)
            if (j != i) weight *= (t + points / 2 - 1 - j) / (i - j);
    }
    return all;
}

/// Returns a map turned about its middle by an angle and then shifted by (x, y) points, resampled
/// band-limited.
std::vector<double> turned(std::vector<double> h, int n, double angle, double shift_x,
                           double shift_y) {
    multiply_waves(h, n, [n](int kx, int ky) {
        return 4.0 * (1.0 * kx * kx + 1.0 * ky * ky) > 1.0 * n * n ? 0.0 : 1.0;
    });
    const int m = finer * n;
    const std::vector<double> fine = heights::resample(h, Bands({}, n), m);
    const double cosine = std::cos(angle), sine = std::sin(angle), middle = 0.5 * (n - 1);
#pragma omp parallel for schedule(static)
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
            const double dx = x - middle - shift_x, dy = y - middle - shift_y;
            const double from_x = finer * (middle + cosine * dx + sine * dy);
            const double from_y = finer * (middle - sine * dx + cosine * dy);
            const double left = std::floor(from_x), below = std::floor(from_y);
            const auto along_x = weights(from_x - left), along_y = weights(from_y - below);
            double sum = 0.0;
            for (int j = 0; j < points; ++j)
                for (int i = 0; i < points; ++i)
                    sum += along_x[static_cast<std::size_t>(i)] *
                           along_y[static_cast<std::size_t>(j)] *
                           fine[at(periodic(static_cast<int>(left) + i - points / 2 + 1, m),
                                   periodic(static_cast<int>(below) + j - points / 2 + 1, m), m)];
            h[at(x, y, n)] = sum;
        }
    return h;
}

/// Returns the correlation of two maps; 0 if one is flat. Collective.
double correlation(const std::vector<double>& one, const std::vector<double>& other,
                   const Bands& bands) {
    const auto each = [&](const auto& add) {
        for (std::size_t i = 0; i < one.size(); ++i)
            if (!std::isnan(one[i]) && !std::isnan(other[i])) add(one[i], other[i]);
    };
    std::array<double, 3> means{}, sums{};
    double &mean_one = means[0], &mean_other = means[1], &count = means[2];
    bands.in_order(
        means, [&] { each([&](double a, double b) { mean_one += a, mean_other += b, ++count; }); });
    mean_one /= count, mean_other /= count;
    double &sum = sums[0], &of_one = sums[1], &of_other = sums[2];
    bands.in_order(sums, [&] {
        each([&](double a, double b) {
            sum += (a - mean_one) * (b - mean_other);
            of_one += (a - mean_one) * (a - mean_one);
            of_other += (b - mean_other) * (b - mean_other);
        });
    });
    return of_one > 0.0 && of_other > 0.0 ? sum / std::sqrt(of_one * of_other) : 0.0;
}

/// Returns the overlap of two spectra, sum sqrt(P_1 P_2) / sqrt(sum P_1 sum P_2) over bins of power
/// P; 0 if one surface is flat.
double overlap(const SurfaceStatistics& one, const SurfaceStatistics& other) {
    double both = 0.0, of_one = 0.0, of_other = 0.0;
    for (std::size_t i = 0; i < std::min(one.spectrum.size(), other.spectrum.size()); ++i) {
        const double a = one.spectrum[i].realised * one.spectrum[i].modes,
                     b = other.spectrum[i].realised * other.spectrum[i].modes;
        both += std::sqrt(a * b), of_one += a, of_other += b;
    }
    return of_one > 0.0 && of_other > 0.0 ? both / std::sqrt(of_one * of_other) : 0.0;
}

} // namespace

bool CounterPlace::is_quarter() const { return std::remainder(turn, 90.0) == 0.0; }

std::vector<double> in_place(std::vector<double> h, int n, double spacing,
                             const CounterPlace& place) {
    h = moved(h, n, [n](int x, int y) { return std::pair(n - 1 - x, y); });
    const double remainder = std::remainder(place.turn, 90.0);
    const int quarters =
        periodic(static_cast<int>(std::lround((place.turn - remainder) / 90.0)), 4);
    for (int k = 0; k < quarters; ++k)
        h = moved(h, n, [n](int x, int y) { return std::pair(y, n - 1 - x); });
    const double x = place.shift_x / spacing, y = place.shift_y / spacing;
    if (remainder != 0.0) return turned(std::move(h), n, remainder * pi / 180.0, x, y);
    const double whole_x = std::round(x), whole_y = std::round(y);
    constexpr double rounding = 1e-9;
    if (std::abs(x - whole_x) < rounding && std::abs(y - whole_y) < rounding) {
        const int by_x = static_cast<int>(std::remainder(whole_x, n)),
                  by_y = static_cast<int>(std::remainder(whole_y, n));
        return moved(h, n, [&](int i, int j) {
            return std::pair(periodic(i - by_x, n), periodic(j - by_y, n));
        });
    }
    // The shortest wave along an axis has no sign: it is multiplied by the mean of both.
    const auto phase = [n](int k, double by) {
        const double angle = -2.0 * pi * k * by / n;
        return 2 * k == n ? Complex(std::cos(angle)) : std::polar(1.0, angle);
    };
    multiply_waves(h, n, [&](int kx, int ky) { return phase(kx, x) * phase(ky, y); });
    return h;
}

Surface counter_in_box(const SurfaceOptions& box, const Surface& whole, const CounterPlace& place) {
    const double spacing = box.length / box.sites;
    const bool repeats = box.repeats && whole.sites == box.sites;
    const double turn = place.turn * pi / 180.0, cosine = std::cos(turn), sine = std::sin(turn);
    double widest = 0.0; // twice the largest coordinate of a corner of the box on the map
    for (const double x : {-0.5, 0.5})
        for (const double y : {-0.5, 0.5}) {
            const double dx = x * box.length - place.shift_x, dy = y * box.length - place.shift_y;
            widest = std::max({widest, 2.0 * std::abs(cosine * dx + sine * dy),
                               2.0 * std::abs(cosine * dy - sine * dx)});
        }
    if (widest > (1.0 + 1e-9) * whole.length && !(repeats && place.is_quarter()))
        throw std::invalid_argument(fmt::format(
            "the map is {:.6g} Å wide and does not cover the box of {:.6g} Å{}; {}give a map "
            "{:.6g} "
            "Å wide",
            whole.length, box.length,
            whole.length < (1.0 - 1e-9) * box.length
                ? ""
                : fmt::format(
                      " when it is turned by {:.6g} degrees and shifted by ({:.6g}, {:.6g}) "
                      "Å",
                      place.turn, place.shift_x, place.shift_y),
            repeats ? "take a quarter turn (surface.counter_turn = 90), or " : "", widest));
    SurfaceOptions options = box;
    options.kind = SurfaceKind::file;
    options.rms = options.radius = 0.0;
    options.detrend = false;
    options.line_noise = LineNoise::keep;
    options.periodic = box.periodic && !repeats;
    options.map_edge = whole.length;
    // A turn takes rows to columns, or anywhere: the root moves the map.
    const Bands bands = whole.bands();
    std::vector<double> moved = bands.fetch(whole.height, 0, whole.ranks.root() ? whole.sites : 0);
    whole.ranks.on_root([&] { moved = in_place(std::move(moved), whole.sites, spacing, place); });
    Surface counter =
        surface_from_heights(options, std::move(moved), whole.sites, whole.sites, whole.ranks);
    counter.file_digest = whole.file_digest;
    counter.doubts = whole.doubts; // doubts belong to the file
    counter.notes.insert(counter.notes.begin(), whole.notes.begin(), whole.notes.end());
    if (!place.is_quarter())
        counter.notes.push_back(fmt::format(
            "turned by {:.6g} degrees and resampled band-limited: it does not repeat any more",
            place.turn));
    return counter;
}

Surface pair_of(const SurfaceOptions& box, Surface own, Surface counter) {
    SurfacePair pair;
    pair.correlation = correlation(own.height, counter.height, own.bands());
    pair.band_overlap = overlap(own.statistics, counter.statistics);
    pair.own = std::move(own.statistics);
    pair.counter = std::move(counter.statistics);
    pair.digest = counter.file_digest.value_or(0);
    for (std::size_t i = 0; i < own.height.size(); ++i)
        own.height[i] += counter.height[i];
    pair.counter_height = std::move(counter.height);
    own.pair = std::move(pair);
    for (std::string& note : counter.notes)
        own.notes.push_back("the second solid: " + std::move(note));
    for (std::string& doubt : counter.doubts)
        own.doubts.push_back("the second solid: " + std::move(doubt));
    SurfaceOptions options = box;
    options.kind = SurfaceKind::file; // the sum has no target spectrum
    return finished(options, std::move(own));
}

} // namespace asperity
