// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Line noise is found where it was added and nowhere else, and the filter gives back the map below
// it.
#include "engine/scene/line_noise.hpp"

#include "engine/scene/heights.hpp"
#include "engine/scene/map_statistics.hpp"
#include "engine/scene/surface.hpp"

#include <fftw3.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <random>

namespace asperity {
namespace {

using Map = std::vector<double>;

std::size_t cells(int n) { return static_cast<std::size_t>(n) * static_cast<std::size_t>(n); }

/// A self-affine map of n x n pixels, cut out of a periodic one of twice its width: its edges jump.
Map self_affine(int n, double hurst, double rolloff, double cutoff, std::uint64_t seed) {
    SurfaceOptions o;
    o.sites = 2 * n;
    o.length = o.sites;
    o.rms = 10.0;
    o.hurst = hurst;
    o.rolloff = 2.0 * rolloff;
    o.cutoff = 2.0 * cutoff;
    o.seed = seed;
    return heights::middle(make_surface(o).height, Bands({}, 2 * n), n);
}

/// A ground surface: self-affine with wavelengths `ratio` times as long along x (or y).
Map ground(int n, double hurst, double ratio, bool along_x, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    std::vector<std::complex<double>> wave(cells(n));
    for (auto& w : wave)
        w = normal(random);
    Bands({}, n).transform(wave, FFTW_FORWARD);
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
            const double kx = std::min(x, n - x), ky = std::min(y, n - y);
            const double q = along_x ? std::hypot(kx * ratio, ky) : std::hypot(kx, ky * ratio);
            wave[static_cast<std::size_t>(y * n + x)] *= q > 0.0 ? std::pow(q, -1.0 - hurst) : 0.0;
        }
    Bands({}, n).transform(wave, FFTW_BACKWARD);
    Map h;
    for (const auto& w : wave)
        h.push_back(w.real());
    return h;
}

/// Noise of lines along x with rms 1: independent from line to line, correlated over `length`
/// points of a line; 0: the same all along the line.
Map noise(int n, double length, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    const double keep = length > 0.0 ? std::exp(-1.0 / length) : 1.0;
    Map h;
    for (int y = 0; y < n; ++y) {
        double value = normal(random);
        for (int x = 0; x < n; ++x) {
            h.push_back(value);
            value = keep * value + std::sqrt(1.0 - keep * keep) * normal(random);
        }
    }
    return h;
}

Map transposed(const Map& h, int n) {
    Map t(h.size());
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x)
            t[static_cast<std::size_t>(x * n + y)] = h[static_cast<std::size_t>(y * n + x)];
    return t;
}

double slope(const Map& h, int n) {
    return map_statistics(h, Bands({}, n), 1.0, 1.0, false).rms_slope;
}

/// What flattens the map, up to a factor.
double energy(Map h, int n) { return make_isotropic(h, n, true, n).whole; }

TEST(LineNoise, IsNotFoundInIsotropicMaps) {
    int maps = 0, alarms = 0;
    double largest = 0.0;
    for (const int n : {24, 48, 96})
        for (const double hurst : {0.05, 0.3, 0.5, 0.8, 1.0})
            for (const double rolloff : {1.0, 4.0})
                for (const double cutoff : {n / 4.0, n / 2.0})
                    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
                        Map h = self_affine(n, hurst, rolloff, cutoff, seed);
                        ++maps;
                        alarms += line_noise_statistics(h, n).found();
                        largest = std::max(largest, make_isotropic(h, n, true, n).share());
                    }
    EXPECT_EQ(alarms, 0) << "of " << maps;
    EXPECT_LT(largest, 0.01); // an isotropic map keeps its waves
}

TEST(LineNoise, IsNotFoundInGroundSurfaces) {
    int maps = 0, alarms = 0, anisotropic = 0;
    for (const double hurst : {0.2, 0.3, 0.5, 0.8})
        for (const double ratio : {2.0, 4.0, 10.0})
            for (const bool along_x : {true, false})
                for (unsigned seed = 1; seed <= 4; ++seed) {
                    const LineNoiseStatistics s =
                        line_noise_statistics(ground(64, hurst, ratio, along_x, seed), 64);
                    ++maps;
                    alarms += s.found();
                    anisotropic += s.slope_ratio > 1.5;
                    EXPECT_EQ(s.along_y, along_x);
                }
    EXPECT_EQ(alarms, 0) << "of " << maps;
    EXPECT_GT(anisotropic, maps / 2);
}

TEST(LineNoise, IsFoundAndTakenOff) {
    constexpr int n = 128;
    for (const double hurst : {0.5, 0.8})
        for (const double length : {0.0, 40.0, 15.0})
            for (const double amplitude : {1.0, 3.0})
                for (const bool along_y : {true, false}) {
                    SCOPED_TRACE(testing::Message() << hurst << " " << length << " " << amplitude);
                    const Map own = self_affine(n, hurst, 2.0, 0.5 * n, 7),
                              lines = noise(n, length, 3);
                    const double step = slope(own, n) / std::sqrt(2.0);
                    Map h = own;
                    for (std::size_t i = 0; i < h.size(); ++i)
                        h[i] += amplitude * step * lines[i];
                    const Map across = along_y ? h : transposed(h, n);
                    const LineNoiseStatistics s = line_noise_statistics(across, n);
                    EXPECT_TRUE(s.found());
                    EXPECT_EQ(s.along_y, along_y);
                    EXPECT_NEAR(s.correlation, -0.5, 0.1);
                    Map clean = across;
                    const ExcessOfLines excess = make_isotropic(clean, n, along_y, n);
                    const double before = energy(h, n), true_energy = energy(own, n);
                    const double noisy = 1.0 - true_energy / before;
                    EXPECT_NEAR(excess.share(), noisy, 0.2 * noisy);
                    const Map back = along_y ? clean : transposed(clean, n);
                    // Noise that is correlated over a few points has some waves along the lines.
                    const double left = (energy(back, n) - true_energy) / (before - true_energy);
                    EXPECT_LT(std::abs(left), length > 0.0 ? 0.25 : 0.08);
                    if (length == 0.0) {
                        EXPECT_NEAR(slope(back, n) / slope(own, n), 1.0, 0.03);
                    }
                    EXPECT_FALSE(line_noise_statistics(back, n).found());
                    // A second time there is nothing to take off.
                    EXPECT_LT(make_isotropic(clean, n, along_y, n).share(), 0.1 * excess.share());
                    Map rows = across;
                    align_rows(rows, n, along_y);
                    EXPECT_EQ(line_noise_statistics(rows, n).found(), length > 0.0);
                }
}

TEST(LineNoise, LeavesPlaneJumpsAndLongWaves) {
    constexpr int n = 96;
    const Map lines = noise(n, 0.0, 5);
    Map h;
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x)
            h.push_back(0.3 * x - 0.7 * y + 20.0 * std::sin(2.0 * std::numbers::pi * 3 * y / n) +
                        0.5 * std::sin(2.0 * std::numbers::pi * 20 * x / n));
    Map noisy = h;
    for (std::size_t i = 0; i < h.size(); ++i)
        noisy[i] += lines[i];
    make_isotropic(noisy, n, true, n);
    double rest = 0.0, added = 0.0;
    for (std::size_t i = 0; i < h.size(); ++i) {
        rest += (noisy[i] - h[i]) * (noisy[i] - h[i]);
        added += lines[i] * lines[i];
    }
    EXPECT_LT(rest, 0.5 * added); // of the noise, its long waves stay
    align_rows(h, n, true);       // has a step of the median, no noise: the plane stays
    EXPECT_NEAR(h[cells(n) - 1] - h[0], 0.3 * (n - 1) - 0.7 * (n - 1), 30.0);
}

/// The note says what is there, what it does and what helps; the remedy is named in the note too.
TEST(LineNoise, IsSaidWithARemedyThatHelps) {
    constexpr int n = 128;
    const Map own = self_affine(n, 0.8, 2.0, 0.5 * n, 7);
    for (const double length : {0.0, 20.0}) {
        Map h = own;
        const Map lines = noise(n, length, 3);
        const double rms = 2.0 * slope(own, n);
        for (std::size_t i = 0; i < h.size(); ++i)
            h[i] += rms * lines[i];
        const std::string name = length > 0.0 ? "isotropic" : "align-rows";
        Map same = h;
        const auto said = treat_line_noise(same, n, 2.6, n, LineNoise::keep);
        ASSERT_EQ(said.size(), 1u);
        EXPECT_EQ(same, h);
        EXPECT_NE(said[0].find("surface.line_noise = \"" + name + "\" takes it off"),
                  std::string::npos)
            << said[0];
        const auto done = treat_line_noise(
            same, n, 2.6, n, length > 0.0 ? LineNoise::isotropic : LineNoise::align_rows);
        ASSERT_EQ(done.size(), 1u);
        EXPECT_NE(done[0].find("\"" + name + "\" changed the rms height"), std::string::npos);
        EXPECT_EQ(done[0].find("is left"), std::string::npos) << done[0];
        EXPECT_TRUE(treat_line_noise(same, n, 2.6, n, LineNoise::keep).empty());
        // The wrong remedy says so.
        if (length > 0.0) {
            const auto aligned = treat_line_noise(h, n, 2.6, n, LineNoise::align_rows);
            EXPECT_NE(aligned[0].find("\"isotropic\" takes off"), std::string::npos);
        }
    }
    Map copy = own;
    EXPECT_TRUE(treat_line_noise(copy, n, 2.6, n, LineNoise::keep).empty());
    EXPECT_NE(treat_line_noise(copy, n, 2.6, n, LineNoise::isotropic)[0].find("none was found"),
              std::string::npos);
}

TEST(LineNoise, SmallAndFlatMapsHaveNone) {
    for (const int n : {1, 2, 3, 4}) {
        Map h(cells(n), 1.5);
        EXPECT_FALSE(line_noise_statistics(h, n).found());
        EXPECT_TRUE(treat_line_noise(h, n, 2.6, n, LineNoise::keep).empty());
        treat_line_noise(h, n, 2.6, n, LineNoise::isotropic);
        treat_line_noise(h, n, 2.6, n, LineNoise::align_rows);
        for (const double v : h)
            EXPECT_NEAR(v, 1.5, 1e-12);
    }
}

} // namespace
} // namespace asperity
