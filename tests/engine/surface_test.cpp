// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Surfaces: what was asked for is what is there (docs/explanation/model.md).
#include "engine/scene/surface.hpp"

#include "engine/scene/map_statistics.hpp"
#include "support/message.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <stdexcept>

namespace asperity {
namespace {

using std::numbers::pi;

SurfaceOptions self_affine(int sites) {
    SurfaceOptions o;
    o.sites = sites;
    o.length = 2.6 * sites;
    return o;
}

double rms_of(const std::vector<double>& h) {
    return std::sqrt(std::inner_product(h.begin(), h.end(), h.begin(), 0.0) /
                     static_cast<double>(h.size()));
}

double mean_of(const std::vector<double>& h) {
    return std::accumulate(h.begin(), h.end(), 0.0) / static_cast<double>(h.size());
}

/// Of a map from a file, taken as high as it is.
SurfaceOptions measured(int sites) {
    SurfaceOptions o = self_affine(sites);
    o.kind = SurfaceKind::file;
    o.rms = 0.0;
    return o;
}

/// nx * ny heights, height(x, y).
template <class Height>
std::vector<double> map_of(int nx, int ny, const Height& height) {
    std::vector<double> h;
    for (int y = 0; y < ny; ++y)
        for (int x = 0; x < nx; ++x)
            h.push_back(height(x, y));
    return h;
}

TEST(SelfAffineSurface, HasTheRmsAskedForAndNoMean) {
    for (int n : {16, 33, 64})
        for (auto amplitudes : {Amplitudes::gaussian, Amplitudes::fixed}) {
            SurfaceOptions o = self_affine(n);
            o.amplitudes = amplitudes;
            o.rms = 1.7;
            const Surface s = make_surface(o);
            ASSERT_EQ(s.height.size(), static_cast<std::size_t>(n * n));
            EXPECT_NEAR(rms_of(s.height), 1.7, 1e-12) << n;
            EXPECT_NEAR(mean_of(s.height), 0.0, 1e-12) << n;
            EXPECT_NEAR(s.statistics.rms, 1.7, 1e-12);
            EXPECT_LT(s.statistics.lowest, 0.0);
            EXPECT_GT(s.statistics.highest, 0.0);
        }
}

TEST(SelfAffineSurface, FixedAmplitudesFollowTheTarget) {
    for (int n : {64, 101}) {
        SurfaceOptions o = self_affine(n);
        o.amplitudes = Amplitudes::fixed;
        const Surface s = make_surface(o);
        // The same factor for every bin inside the spectrum: the sum over the box's waves is not
        // quite the integral, which the scaling to the rms makes up for.
        const double first = s.statistics.spectrum[0].realised / s.statistics.spectrum[0].target;
        EXPECT_NEAR(first, 1.0, 0.12) << n;
        for (const SpectrumBin& b : s.statistics.spectrum)
            if (b.target > 0.0) {
                EXPECT_NEAR(b.realised / b.target, first, 1e-9) << b.q;
            }
    }
}

TEST(SelfAffineSurface, GaussianAmplitudesFollowTheTargetOnAverage) {
    SurfaceOptions o = self_affine(128);
    double ratio = 0.0;
    int bins = 0;
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        o.seed = seed;
        const Surface s = make_surface(o);
        for (const SpectrumBin& b : s.statistics.spectrum)
            if (b.modes > 60 && b.target > 0.0) {
                ratio += b.realised / b.target;
                ++bins;
                EXPECT_NEAR(b.realised / b.target, 1.0, 0.8) << b.q;
            }
    }
    EXPECT_NEAR(ratio / bins, 1.0, 0.15);
}

TEST(SelfAffineSurface, TargetSpectrumIntegratesToTheRms) {
    for (double hurst : {0.0, 0.5, 0.8})
        for (double rolloff : {0.5, 1.0, 3.0, 200.0}) {
            SurfaceOptions o = self_affine(128);
            o.hurst = hurst;
            o.rolloff = rolloff;
            const double unit = 2.0 * pi / o.length;
            double sum = 0.0;
            const int steps = 400000;
            const double from = 1.0, to = 64.0;
            for (int k = 0; k < steps; ++k) {
                const double q = (from + (to - from) * (k + 0.5) / steps) * unit;
                sum += 2.0 * pi * q * target_spectrum(o, q) * (to - from) / steps * unit;
            }
            EXPECT_NEAR(sum, 9.0, 1e-3) << hurst << ' ' << rolloff;
        }
}

TEST(SelfAffineSurface, SlopeIsThatOfItsWaves) {
    // One ring of waves only: q = q_L, so slope = q_L rms.
    SurfaceOptions o = self_affine(32);
    o.cutoff = 1.0;
    const Surface s = make_surface(o);
    EXPECT_NEAR(s.statistics.rms_slope, 2.0 * pi / o.length * o.rms, 1e-12);
}

TEST(SelfAffineSurface, EveryBinOfTheSpectrumHasItsWaves) {
    for (int n : {2, 3, 16, 33}) {
        const Surface s = make_surface(self_affine(n));
        double power = 0.0, last = 0.0;
        for (const SpectrumBin& b : s.statistics.spectrum) {
            EXPECT_GT(b.modes, 0) << n;
            EXPECT_GT(b.q, last) << n;
            last = b.q;
            power += b.modes * b.realised;
        }
        // The waves beyond the largest ring are in no bin.
        const double unit = 2.0 * pi / self_affine(n).length;
        EXPECT_GT(power, 0.0) << n;
        EXPECT_LE(power * unit * unit, s.statistics.rms * s.statistics.rms * (1.0 + 1e-9)) << n;
    }
}

TEST(SelfAffineSurface, SameSeedSameBits) {
    SurfaceOptions o = self_affine(48);
    const Surface first = make_surface(o), again = make_surface(o);
    EXPECT_EQ(first.height, again.height);
    o.seed = 2;
    EXPECT_NE(make_surface(o).height, first.height);
    o.seed = 1 + (1ull << 32); // the upper half of the seed counts too
    EXPECT_NE(make_surface(o).height, first.height);
}

TEST(SelfAffineSurface, KeepsItsLargeScaleShapeOnAFinerGrid) {
    SurfaceOptions coarse = self_affine(64), fine = self_affine(128);
    coarse.cutoff = fine.cutoff = 16.0;
    fine.length = coarse.length;
    const Surface c = make_surface(coarse), f = make_surface(fine);
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x)
            EXPECT_NEAR(c.height[static_cast<std::size_t>(y * 64 + x)],
                        f.height[static_cast<std::size_t>(2 * y * 128 + 2 * x)], 1e-10);
}

TEST(SelfAffineSurface, SaysThatItClips) {
    SurfaceOptions o = self_affine(64);
    const Surface s = make_surface(o);
    ASSERT_EQ(s.notes.size(), 1u);
    EXPECT_NE(s.notes[0].find("Nyquist"), std::string::npos);
    EXPECT_NE(s.notes[0].find("32"), std::string::npos);
    EXPECT_EQ(s.statistics.spectrum.back().modes > 0, true);
    o.cutoff = 20.0;
    EXPECT_TRUE(make_surface(o).notes.empty());
}

TEST(FlatSurface, IsFlat) {
    SurfaceOptions flat = self_affine(8), smooth = self_affine(8);
    flat.kind = SurfaceKind::flat;
    smooth.rms = 0.0;
    for (const SurfaceOptions& o : {flat, smooth})
        EXPECT_EQ(make_surface(o).height, std::vector<double>(64));
}

TEST(CurvedSurface, IsTheSphericalCap) {
    SurfaceOptions o = self_affine(64);
    o.kind = SurfaceKind::flat;
    o.radius = 441.0;
    const Surface s = make_surface(o);
    EXPECT_EQ(s.height[32 * 64 + 32], 0.0);
    const double rho2 = (10.0 * 10.0 + 20.0 * 20.0) * 2.6 * 2.6;
    EXPECT_NEAR(s.height[52 * 64 + 22], -(441.0 - std::sqrt(441.0 * 441.0 - rho2)), 1e-11);
    EXPECT_EQ(s.statistics.highest, 0.0);
    EXPECT_EQ(s.statistics.rms, 0.0);
    // Roughness is added to it and measured without it.
    o.kind = SurfaceKind::self_affine;
    const Surface rough = make_surface(o);
    SurfaceOptions plain = o;
    plain.radius = 0.0;
    const Surface without = make_surface(plain);
    EXPECT_NEAR(rough.statistics.rms, 3.0, 1e-12);
    EXPECT_NEAR(rough.height[77] - without.height[77], s.height[77], 1e-11);
}

std::vector<double> wavy(int nx, int ny) {
    return map_of(nx, ny, [=](int x, int y) {
        const double px = 2.0 * pi * x / nx, py = 2.0 * pi * y / ny;
        return 0.3 + std::cos(2.0 * px - py) + 0.5 * std::sin(3.0 * py) +
               0.2 * std::sin(4.0 * px + 3.0 * py + 0.4);
    });
}

TEST(MeasuredSurface, IsTakenAsItIsWhereItFits) {
    const Surface s = surface_from_heights(measured(16), wavy(16, 16), 16, 16);
    EXPECT_EQ(s.height, wavy(16, 16));
    EXPECT_TRUE(s.notes.empty());
}

TEST(MeasuredSurface, ResamplesBandLimitedMapsExactly) {
    for (auto [from_x, from_y, to] : {std::tuple{12, 12, 30},
                                      {30, 30, 12},
                                      {17, 17, 33},
                                      {33, 33, 14},
                                      {20, 15, 16},
                                      {11, 24, 45}}) {
        const Surface s = surface_from_heights(measured(to), wavy(from_x, from_y), from_x, from_y);
        const std::vector<double> exact = wavy(to, to);
        for (std::size_t i = 0; i < exact.size(); ++i)
            ASSERT_NEAR(s.height[i], exact[i], 1e-12) << from_x << ' ' << to;
        EXPECT_EQ(s.notes.size(), 1u);
    }
}

TEST(MeasuredSurface, LosesItsPlaneAndIsScaledOnRequest) {
    const int n = 20;
    std::vector<double> h = wavy(n, n);
    const auto plane = map_of(n, n, [](int x, int y) { return 0.7 * x - 0.2 * y + 5.0; });
    std::transform(h.begin(), h.end(), plane.begin(), h.begin(), std::plus());
    SurfaceOptions o = measured(n);
    o.detrend = true;
    Surface s = surface_from_heights(o, h, n, n);
    const auto moment = [&](const std::vector<double>& arm) {
        return std::inner_product(arm.begin(), arm.end(), s.height.begin(), 0.0);
    };
    EXPECT_NEAR(moment(map_of(n, n, [](int x, int) { return x - 9.5; })), 0.0, 1e-9);
    EXPECT_NEAR(moment(map_of(n, n, [](int, int y) { return y - 9.5; })), 0.0, 1e-9);
    EXPECT_NEAR(mean_of(s.height), 0.0, 1e-12);
    o.rms = 2.5;
    s = surface_from_heights(o, h, n, n);
    EXPECT_NEAR(rms_of(s.height), 2.5, 1e-12);
}

TEST(MapFromAFile, KeepsItsWidth) {
    // Waves of 8 Å and 12 Å on a map of 96 x 96 points, 96 Å wide; the box is its middle half.
    const int m = 96;
    const auto wave = [](double x, double y) {
        return std::sin(2 * pi * x / 8) + 0.5 * std::cos(2 * pi * y / 12);
    };
    const std::vector<double> h = map_of(m, m, wave);
    SurfaceOptions o = measured(24);
    o.length = 48.0;
    o.map_edge = 96.0;
    EXPECT_EQ(sites_of_map(o), 48);
    const Surface s = surface_from_heights(o, h, m, m);
    ASSERT_EQ(s.height.size(), 576u);
    for (int y = 0; y < 24; ++y)
        for (int x = 0; x < 24; ++x)
            EXPECT_NEAR(s.height[static_cast<std::size_t>(24 * y + x)],
                        wave(24 + 2 * x, 24 + 2 * y), 1e-12);
    o.map_edge = 48.2; // as good as the box
    EXPECT_EQ(sites_of_map(o), 24);
    o.map_edge *= 1e14; // more than an int holds
    EXPECT_THROW(sites_of_map(o), std::invalid_argument);
    o.map_edge /= 1e14;
    EXPECT_NO_THROW(surface_from_heights(o, h, m, m));
    o.map_edge = 40.0;
    const auto message =
        test::message_of<std::invalid_argument>([&] { surface_from_heights(o, h, m, m); });
    EXPECT_TRUE(test::has(message, "40 Å wide, the box 48 Å")) << message;
}

TEST(MapFromAFile, LosesItsJumpsAndNothingElse) {
    constexpr int n = 48;
    SurfaceOptions o = measured(n);
    o.periodic = true;
    const auto wave = [](int x, int y) {
        return std::sin(2 * pi * 5 * x / n) * std::cos(2 * pi * 3 * y / n);
    };
    const std::vector<double> even = map_of(n, n, wave),
                              tilted = map_of(n, n, [&](int x, int y) {
                                  return wave(x, y) + 0.3 * x + 0.002 * y * y;
                              });
    const auto jump = [&](const std::vector<double>& h) { // between the first and the last column
        double sum = 0.0;
        for (int y = 0; y < n; ++y)
            sum += h[static_cast<std::size_t>(y * n)] - h[static_cast<std::size_t>(y * n + n - 1)];
        return std::abs(sum) / n;
    };
    const Surface s = surface_from_heights(o, tilted, n, n);
    EXPECT_GT(jump(tilted), 14.0);
    EXPECT_LT(jump(s.height), 1.5); // a step like any other: 0.65 from the wave
    // In the middle what is taken off is smooth: second differences along x are those of the wave.
    for (int x = 20; x < 28; ++x) {
        const auto at = [&](const std::vector<double>& h, int k) {
            return h[static_cast<std::size_t>(24 * n + k)];
        };
        const auto second = [&](const std::vector<double>& h) {
            return at(h, x + 1) - 2 * at(h, x) + at(h, x - 1);
        };
        EXPECT_NEAR(second(s.height), second(even), 0.02);
    }
}

TEST(MapFromAFile, SaysHowItsEdgesJump) {
    const auto jump_note = [](const Surface& s) {
        const auto note = std::find_if(s.notes.begin(), s.notes.end(), [](const std::string& text) {
            return text.find("does not repeat") != std::string::npos;
        });
        return note == s.notes.end() ? std::string() : *note;
    };
    const int n = 32;
    SurfaceOptions o = measured(n);
    // A ramp along x: steps of 0.3 Å along x and none along y, and jumps of 31 times as much.
    const std::vector<double> ramp = map_of(n, n, [](int x, int) { return 0.3 * x; });
    const Surface tilted = surface_from_heights(o, ramp, n, n);
    EXPECT_NE(jump_note(tilted).find("jump by 6.58 Å (rms)"), std::string::npos)
        << jump_note(tilted) << ": 31 x 0.3 Å / sqrt 2";
    EXPECT_NE(jump_note(tilted).find("inside by 0.212 Å"), std::string::npos) << jump_note(tilted);
    EXPECT_NE(jump_note(tilted).find("surface.detrend = \"periodic\""), std::string::npos);
    // What repeats says nothing: waves, self-affine surfaces of any roughness, the map made
    // periodic.
    EXPECT_EQ(jump_note(surface_from_heights(o, wavy(n, n), n, n)), "");
    for (const double hurst : {0.1, 0.8, 1.0})
        for (std::uint64_t seed = 1; seed <= 20; ++seed) {
            SurfaceOptions rough = self_affine(n);
            rough.hurst = hurst;
            rough.seed = seed;
            const Surface made = make_surface(rough);
            EXPECT_EQ(jump_note(surface_from_heights(o, made.height, n, n)), "") << hurst;
        }
    // Half of a self-affine surface does not, and the middle of a map does not either, until it is
    // made periodic as it is taken.
    const Surface large = make_surface(self_affine(2 * n));
    o.map_edge = 2.0 * o.length;
    const Surface middle = surface_from_heights(o, large.height, 2 * n, 2 * n);
    EXPECT_NE(jump_note(middle), "");
    o.periodic = true;
    EXPECT_EQ(jump_note(surface_from_heights(o, large.height, 2 * n, 2 * n)), "");
}

TEST(BadSurfaces, SayWhatIsWrong) {
    EXPECT_THROW(make_surface(self_affine(1)), std::invalid_argument); // holds no wave

    SurfaceOptions o = self_affine(4);
    o.kind = SurfaceKind::file;
    std::vector<double> h(16, 1.0);
    EXPECT_THROW(surface_from_heights(o, h, 4, 4), std::invalid_argument); // flat, scaled to 3 Å
    EXPECT_THROW(surface_from_heights(o, h, 4, 5), std::invalid_argument);
    h[6] = std::nan("");
    const auto message =
        test::message_of<std::invalid_argument>([&] { surface_from_heights(o, h, 4, 4); });
    EXPECT_TRUE(test::has(message, "row 2, column 3")) << message;
}

TEST(SubstrateSites, AreWholeAtoms) {
    EXPECT_EQ(substrate_sites(512, 1.0), 512);
    EXPECT_EQ(substrate_sites(512, 1.618), 828);
    EXPECT_EQ(substrate_sites(4, 0.01), 1);
}

// A single wave has closed forms: slope and curvature by waves and by differences, C1D,
// autocorrelation.
TEST(MapStatistics, OfOneWave) {
    const int n = 48, k = 5, m = 3; // waves along x and y
    const double length = 96.0, a = 1.5, pixel = length / n;
    const std::vector<double> h = map_of(n, n, [=](int x, int y) {
        return 7.0 + a * std::cos(2.0 * pi * (k * x + m * y) / n + 0.3);
    });
    const double qx = 2.0 * pi * k / length, qy = 2.0 * pi * m / length, rms = a / std::sqrt(2.0);
    const auto differences = [&](double q) { return 2.0 / pixel * std::sin(0.5 * q * pixel); };
    const double dx = differences(qx), dy = differences(qy);
    const auto size = static_cast<std::size_t>(n);
    const MapStatistics s = map_statistics(h, Bands({}, n), pixel, pixel, true);
    EXPECT_NEAR(s.rms_height, rms, 1e-12);
    EXPECT_NEAR(s.rms_slope, rms * std::sqrt(dx * dx + dy * dy), 1e-12);
    EXPECT_NEAR(s.rms_curvature, 0.5 * rms * (dx * dx + dy * dy), 1e-12);
    EXPECT_NEAR(s.highest - s.lowest, 2.0 * a, 0.02);

    SurfaceOptions o = measured(n);
    o.length = length;
    const SurfaceStatistics spectral = surface_from_heights(o, h, n, n).statistics;
    EXPECT_NEAR(spectral.rms_slope, rms * std::hypot(qx, qy), 1e-12);
    EXPECT_NEAR(spectral.rms_curvature, 0.5 * rms * (qx * qx + qy * qy), 1e-12);

    const LineStatistics lines = line_statistics(h, n, length);
    ASSERT_EQ(lines.q.size(), size / 2); // to Nyquist
    ASSERT_EQ(lines.r.size(), size / 2); // to half the width
    EXPECT_NEAR(lines.q.back(), pi / pixel, 1e-12);
    EXPECT_NEAR(lines.r.back(), 0.5 * length, 1e-12);
    EXPECT_NEAR(lines.c1d[k - 1], 0.25 * a * a * length, 1e-9);
    double integral = 0.0; // h_rms^2 = 1/pi int C1D dq
    for (const double c : lines.c1d)
        integral += c * 2.0 * pi / length / pi;
    EXPECT_NEAR(integral, rms * rms, 1e-9);
    for (std::size_t i = 0; i < lines.r.size(); ++i)
        EXPECT_NEAR(lines.acf[i], rms * rms * (1.0 - std::cos(qx * lines.r[i])), 1e-9) << i;
    ASSERT_EQ(lines.slope.size(), lines.r.size());
    for (std::size_t i = 0; i < lines.r.size(); ++i) // rms of (h(x + r) - h(x)) / r
        EXPECT_NEAR(lines.slope[i],
                    2.0 * rms * std::abs(std::sin(0.5 * qx * lines.r[i])) / lines.r[i], 1e-7)
            << i;
}

TEST(MapStatistics, OfAPlaneThatDoesNotRepeat) {
    std::vector<double> h = map_of(7, 4, [](int x, int y) { return 3.0 * x + 8.0 * y; });
    const Bands bands({}, 7, 4);
    MapStatistics s = map_statistics(h, bands, 1.0, 2.0, false);
    EXPECT_NEAR(s.rms_slope, 5.0, 1e-12);
    EXPECT_NEAR(s.rms_curvature, 0.0, 1e-12);
    h[9] = std::nan(""); // its neighbours' differences are left out
    s = map_statistics(h, bands, 1.0, 2.0, false);
    EXPECT_NEAR(s.rms_slope, 5.0, 1e-12);
    EXPECT_EQ(s.highest, 42.0);
}

} // namespace
} // namespace asperity
