// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Surfaces and fields of sites in bands on 1 to 4 ranks: the same bits as on one rank, and no rank
// holds more than its share.
#include "engine/case/case.hpp"
#include "engine/interface/height_map.hpp"
#include "engine/scene/heights.hpp"
#include "engine/scene/map_statistics.hpp"
#include "engine/surface/pair.hpp"
#include "io/height_map.hpp"
#include "support/cases.hpp"
#include "support/threads.hpp"
#include "support/world.hpp"

#include <fftw3.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <complex>
#include <functional>
#include <string>
#include <vector>

using namespace asperity;

namespace {

using test::world;
using Complex = std::complex<double>;

std::vector<std::uint64_t> bits_of(const std::vector<double>& values) {
    std::vector<std::uint64_t> bits;
    for (const double value : values)
        bits.push_back(std::bit_cast<std::uint64_t>(value));
    return bits;
}

std::vector<double> numbers_of(const SurfaceStatistics& s) {
    std::vector<double> all = {s.rms, s.rms_slope, s.rms_curvature, s.lowest, s.highest};
    for (const SpectrumBin& bin : s.spectrum)
        all.insert(all.end(), {bin.q, bin.realised, bin.target, 1.0 * bin.modes});
    return all;
}

/// Expects a surface of all ranks to be that of one.
void expect_same(const Surface& shared, const Surface& alone, const std::string& name) {
    EXPECT_EQ(shared.height.size(), shared.bands().size()) << name;
    EXPECT_EQ(bits_of(numbers_of(shared.statistics)), bits_of(numbers_of(alone.statistics)))
        << name;
    EXPECT_EQ(shared.holes, alone.holes) << name;
    EXPECT_EQ(shared.notes, alone.notes) << name;
    EXPECT_EQ(shared.doubts, alone.doubts) << name;
    const Surface all = whole(shared);
    EXPECT_EQ(bits_of(all.height), bits_of(alone.height)) << name;
    if (!alone.pair) return;
    EXPECT_EQ(bits_of(all.pair->counter_height), bits_of(alone.pair->counter_height)) << name;
    EXPECT_EQ(all.pair->correlation, alone.pair->correlation) << name;
    EXPECT_EQ(all.pair->band_overlap, alone.pair->band_overlap) << name;
}

SurfaceOptions options_of(int sites) {
    SurfaceOptions o;
    o.sites = sites;
    o.length = 2.6 * sites;
    o.cutoff = 0.5 * sites;
    o.rms = 2.0;
    o.seed = 7;
    return o;
}

/// A rough map of n x n points with a slope, and with line noise if asked for, on the root.
std::vector<double> map_of(int n, bool noisy) {
    std::vector<double> h;
    if (!world().root()) return h;
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x)
            h.push_back(3.0 * std::sin(0.7 * x + 0.2 * y) + std::cos(0.31 * y * x) + 0.1 * x +
                        (noisy ? 2.0 * std::sin(7.3 * y * y) : 0.0));
    return h;
}

} // namespace

/// The transform has the bits of FFTW's own in two dimensions on one rank.
TEST(SurfaceRanks, WavesAreThoseOfTheWholeMap) {
    for (const auto& [nx, ny] : {std::pair(24, 24), std::pair(64, 64), std::pair(25, 25),
                                 std::pair(3, 2), std::pair(40, 28), std::pair(128, 128)})
        for (const int sign : {FFTW_FORWARD, FFTW_BACKWARD}) {
            const Bands bands(world(), nx, ny);
            std::vector<Complex> all, band;
            for (int i = 0; i < nx * ny; ++i)
                all.emplace_back(std::sin(1.3 * i * i), std::cos(0.7 * i));
            const auto first = all.begin() + static_cast<std::ptrdiff_t>(nx) * bands.first();
            band.assign(first, first + static_cast<std::ptrdiff_t>(bands.size()));
            bands.transform(band, sign);
            auto* const raw = reinterpret_cast<fftw_complex*>(all.data());
            const fftw_plan plan = fftw_plan_dft_2d(ny, nx, raw, raw, sign, FFTW_ESTIMATE);
            fftw_execute(plan);
            fftw_destroy_plan(plan);
            EXPECT_EQ(bands.fetch(band, 0, ny), all) << nx << " x " << ny;
        }
}

TEST(SurfaceRanks, RowsComeFromWhereTheyAre) {
    const int n = 7;
    const Bands bands(world(), n, n);
    std::vector<double> band;
    for (int y = bands.first(); y < bands.first() + bands.held(); ++y)
        for (int x = 0; x < n; ++x)
            band.push_back(100.0 * y + x);
    for (int from = -20; from < 20; ++from)
        for (int count = 0; count < 18; ++count) {
            // Each rank asks for rows of its own.
            const int mine = from + world().rank(), some = (count + 3 * world().rank()) % 18;
            const std::vector<double> rows = bands.fetch(band, mine, some);
            ASSERT_EQ(rows.size(), static_cast<std::size_t>(some * n));
            for (int k = 0; k < some; ++k)
                for (int x = 0; x < n; ++x)
                    ASSERT_EQ(rows[static_cast<std::size_t>(k * n + x)],
                              100.0 * periodic(mine + k, n) + x);
        }
}

TEST(SurfaceRanks, RandomSurfacesAreTheSame) {
    const test::Threads threads(2);
    for (const int sites : {3, 16, 25, 64, 130}) {
        SurfaceOptions o = options_of(sites);
        expect_same(make_surface(o, world()), make_surface(o), std::to_string(sites));
        o.amplitudes = Amplitudes::fixed;
        o.radius = 2.0 * o.length;
        expect_same(make_surface(o, world()), make_surface(o), "curved");
        o.kind = SurfaceKind::flat;
        o.radius = 0.3 * o.length; // beyond its equator there is no solid
        expect_same(make_surface(o, world()), make_surface(o), "a sphere");
    }
}

TEST(SurfaceRanks, MeasuredSurfacesAreTheSame) {
    SurfaceOptions o = options_of(24);
    o.kind = SurfaceKind::file;
    const auto expect = [&](const char* name, int points, bool noisy = false, bool holes = false) {
        std::vector<double> h = map_of(points, noisy);
        if (holes && world().root()) h[100] = h[300] = std::nan("");
        const Surface shared = surface_from_heights(o, h, points, points, world());
        std::vector<double> same = h;
        same.resize(static_cast<std::size_t>(points * points));
        world().broadcast(same);
        expect_same(shared, surface_from_heights(o, same, points, points), name);
    };
    expect("as it is", 24);
    o.detrend = true;
    expect("without its plane", 24);
    o.periodic = true;
    expect("periodic", 24);
    expect("finer", 37);
    expect("coarser", 16);
    expect("noisy", 24, true);
    o.line_noise = LineNoise::isotropic;
    expect("without noise", 24, true);
    o.line_noise = LineNoise::align_rows;
    o.map_edge = 2.0 * o.length;
    expect("its middle", 48, true);
    expect("its middle, resampled", 31);
    o = options_of(24);
    o.kind = SurfaceKind::file;
    o.holes = true;
    expect("with holes", 24, false, true);
}

TEST(SurfaceRanks, PairsAreTheSame) {
    const SurfaceOptions box = options_of(24);
    SurfaceOptions large = options_of(48);
    large.seed = 9;
    for (const CounterPlace place : {CounterPlace{0.0, 0.0, 0.0}, CounterPlace{90.0, 5.2, -2.6},
                                     CounterPlace{33.0, 1.0, 2.0}}) {
        const auto pair_on = [&](const Communicator& ranks) {
            return pair_of(box, make_surface(box, ranks),
                           counter_in_box(box, make_surface(large, ranks), place));
        };
        expect_same(pair_on(world()), pair_on(Communicator()), std::to_string(place.turn));
    }
}

TEST(SurfaceRanks, StatisticsByDifferencesAreTheSame) {
    const Surface alone = make_surface(options_of(25)),
                  shared = make_surface(options_of(25), world());
    for (const bool periodic : {true, false}) {
        const MapStatistics one = map_statistics(alone.height, alone.bands(), 2.6, 2.6, periodic),
                            all = map_statistics(shared.height, shared.bands(), 2.6, 2.6, periodic);
        EXPECT_EQ(one.rms_height, all.rms_height);
        EXPECT_EQ(one.rms_slope, all.rms_slope);
        EXPECT_EQ(one.rms_curvature, all.rms_curvature);
        EXPECT_EQ(one.lowest, all.lowest);
        EXPECT_EQ(one.highest, all.highest);
    }
}

TEST(SurfaceRanks, FieldsOfSitesAreTheSame) {
    const test::SharedScratch scratch("fields");
    const std::string file = scratch.directory + "/field.h5";
    world().on_root([&] {
        io::HeightMap map;
        map.rows = map.columns = 30;
        for (int i = 0; i < 900; ++i)
            map.heights.push_back(30.0 + 20.0 * std::sin(0.3 * i * i));
        io::write_height_map(file, map);
    });
    for (const std::string& adhesion :
         {std::string("stripes 10 60 20 Å"), std::string("discs 10 60 8 Å 20 Å"),
          std::string("rings 40 0.5 20 Å"), std::string("patches 10 60 12 Å 3"), file}) {
        const std::vector<std::string> keys = {
            "interface.kind=wall", "drive.mode=quasistatic", "interface.adhesion=" + adhesion,
            "interface.adhesion_unit=meV/Å^2", "interface.hardness=patches 2 5 12 Å 4"};
        const std::string scene = "[surface]\nsites = 30\nrms = 1.0\n";
        const Case one = read_case_text(scene, "s.toml", keys),
                   all = read_case_text(scene, "s.toml", keys, world().size(), world());
        EXPECT_EQ(one.notes, all.notes);
        const InterfaceOptions &alone = one.simulation.interface,
                               &shared = all.simulation.interface;
        EXPECT_EQ(std::to_array(alone.mean_law_factors.of),
                  std::to_array(shared.mean_law_factors.of))
            << adhesion;
        EXPECT_EQ(alone.mean_hardness(), shared.mean_hardness()) << adhesion;
        ASSERT_EQ(shared.site_maps().size(), 2u);
        for (std::size_t i = 0; i < 2; ++i) {
            const SiteMap &a = *alone.site_maps()[i], &b = *shared.site_maps()[i];
            EXPECT_EQ(b.values.size(), b.bands().size()) << adhesion;
            EXPECT_EQ(a.digest, b.digest) << adhesion;
            EXPECT_EQ(a.least, b.least) << adhesion;
            EXPECT_EQ(a.largest, b.largest) << adhesion;
            EXPECT_EQ(b.bands().fetch(b.values, 0, 30), a.values) << adhesion;
            const Tile beyond{20, 25 - world().rank(), 14, 9, 34}; // a grid may end beyond the box
            EXPECT_EQ(b.under(beyond), a.under(beyond)) << adhesion;
        }
    }
}

/// A tile of a wide box holds the rows around it alone.
TEST(SurfaceRanks, ATileHoldsTheRowsAroundIt) {
    const Tile tile{0, 500, 1000, 20, 1000};
    InterfaceOptions o;
    const RowRange over_atoms = HeightMap::rows_under(tile, 2.6, 1000, 2.6, o);
    EXPECT_LE(over_atoms.first, 500 - 64);
    EXPECT_GE(over_atoms.first + over_atoms.count, 520 + 64);
    EXPECT_LT(over_atoms.count, 220);
    o.slides = true;
    EXPECT_EQ(HeightMap::rows_under(tile, 2.6, 1000, 2.6, o).count, 1000);
    o.slides = false;
    o.wall = ExponentialWall(0.7, 1.3, 24.0);
    EXPECT_EQ(HeightMap::rows_under(tile, 2.6, 1000, 2.6, o).first, 500);
    EXPECT_EQ(HeightMap::rows_under(tile, 2.6, 1000, 2.6, o).count, 20);
    EXPECT_EQ(HeightMap::rows_under({0, 490, 1000, 20, 1000}, 2.6, 500, 2.6, o).count, 10);
    EXPECT_EQ(HeightMap::rows_under(tile, 2.6, 400, 2.6, o).count, 0);
}
