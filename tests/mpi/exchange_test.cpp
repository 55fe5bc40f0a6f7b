// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Collectives, halos and planes on 1 to 4 ranks. Values are functions of the global position, so
// every rank knows what every other must have sent; copies are compared bit for bit.
#include "decomposition/field.hpp"
#include "decomposition/halo_exchange.hpp"
#include "decomposition/plane_bands.hpp"
#include "support/message.hpp"
#include "support/world.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <span>
#include <vector>

using namespace asperity;

namespace {

using test::world;

/// A number that no other node of any field has.
double mark(int field, int level, int x, int y, int z) {
    return std::sin(1.0 + field + 10.0 * level + 100.0 * z + 7.1 * x + 0.013 * y) + 1e3 * field;
}

struct Stack {
    ProcessGrid grid;
    std::vector<Field<double>> fields;
    std::vector<int> planes;
    std::vector<int> levels;

    Stack(int sites, int level_count) : grid(world().size(), world().rank(), sites, level_count) {
        for (int level = 0; level < level_count; ++level)
            for (int copy = 0; copy < 2; ++copy) {
                levels.push_back(level);
                planes.push_back(2 + level + copy);
                fields.emplace_back(grid.tile(level), planes.back() + 1);
            }
    }
};

class Boxes : public testing::TestWithParam<std::pair<int, int>> {};

} // namespace

TEST_P(Boxes, HalosAreExactCopiesOfTheirOwners) {
    Stack s(GetParam().first, GetParam().second);
    std::vector<HaloField> list;
    for (std::size_t i = 0; i < s.fields.size(); ++i) {
        const Tile t = s.grid.tile(s.levels[i]);
        const auto v = s.fields[i].view();
        for (int z = 0; z < s.planes[i]; ++z)
            for (int y = 0; y < t.ny; ++y)
                for (int x = 0; x < t.nx; ++x)
                    v(x, y, z) = mark(static_cast<int>(i), s.levels[i], t.x0 + x, t.y0 + y, z);
        list.push_back({v, s.planes[i], s.grid.tiled(s.levels[i])});
    }
    HaloExchange halo(world(), s.grid);
    halo.exchange(list);
    EXPECT_EQ(halo.bytes_sent() > 0, world().size() > 1);
    for (std::size_t i = 0; i < s.fields.size(); ++i) {
        const Tile t = s.grid.tile(s.levels[i]);
        const auto v = s.fields[i].view();
        int wrong = 0;
        for (int z = 0; z < s.planes[i]; ++z)
            for (int y = -halo_width; y < t.ny + halo_width; ++y)
                for (int x = -halo_width; x < t.nx + halo_width; ++x)
                    wrong += v(x, y, z) != mark(static_cast<int>(i), s.levels[i],
                                                periodic(t.x0 + x, t.sites),
                                                periodic(t.y0 + y, t.sites), z);
        EXPECT_EQ(wrong, 0) << "field " << i << " of level " << s.levels[i];
        EXPECT_EQ(v(0, 0, s.planes[i]), 0.0)
            << "the plane behind the exchanged ones must be left alone";
    }
}

TEST_P(Boxes, PlanesAreGatheredAndScattered) {
    Stack s(GetParam().first, GetParam().second);
    for (std::size_t i = 0; i < s.fields.size(); ++i) {
        const int level = s.levels[i];
        const Tile t = s.grid.tile(level);
        const auto p = s.fields[i].plane(1);
        for (int y = 0; y < t.ny; ++y)
            for (int x = 0; x < t.nx; ++x)
                p(x, y) = mark(0, level, t.x0 + x, t.y0 + y, 1);
        auto dense = gather_plane(world(), s.grid, level, std::as_const(s.fields[i]).plane(1));
        const auto sites = static_cast<std::size_t>(t.sites);
        ASSERT_EQ(dense.size(), world().root() ? sites * sites : 0u);
        int wrong = 0;
        for (std::size_t k = 0; k < dense.size(); ++k)
            wrong += dense[k] !=
                     mark(0, level, static_cast<int>(k % sites), static_cast<int>(k / sites), 1);
        EXPECT_EQ(wrong, 0);

        const auto back = s.fields[i].plane(0);
        scatter_bands(
            world(), s.grid, level,
            [&](int first, std::span<double> band) {
                std::transform(
                    dense.begin() +
                        static_cast<std::ptrdiff_t>(static_cast<std::size_t>(first) * sites),
                    dense.begin() + static_cast<std::ptrdiff_t>(
                                        static_cast<std::size_t>(first) * sites + band.size()),
                    band.begin(), [](double d) { return d + 1.0; });
            },
            back);
        wrong = 0;
        for (int y = 0; y < t.ny; ++y)
            for (int x = 0; x < t.nx; ++x)
                wrong += back(x, y) != p(x, y) + 1.0;
        EXPECT_EQ(wrong, 0);
    }
}

TEST_P(Boxes, FootprintsBecomeOneWholePlaneOnEveryRank) {
    const auto [sites, levels] = GetParam();
    const ProcessGrid grid(world().size(), world().rank(), sites, levels);
    for (int level = 0; level < levels; ++level) {
        const int n = sites >> level;
        const Tile whole{0, 0, n, n, n};
        Field<double> a(whole, 1), b(whole, 1);
        const Tile own = grid.footprint(level, grid.rank());
        for (int y = own.y0; y < own.y0 + own.ny; ++y)
            for (int x = own.x0; x < own.x0 + own.nx; ++x)
                a.plane(0)(x, y) = mark(1, level, x, y, 0),
                              b.plane(0)(x, y) = mark(2, level, x, y, 0);
        const std::array planes = {a.plane(0), b.plane(0)};
        gather_footprints(world(), grid, level, planes);
        int wrong = 0;
        for (int y = 0; y < n; ++y)
            for (int x = 0; x < n; ++x)
                wrong += a.plane(0)(x, y) != mark(1, level, x, y, 0) ||
                         b.plane(0)(x, y) != mark(2, level, x, y, 0);
        EXPECT_EQ(wrong, 0) << "level " << level;
    }
}

INSTANTIATE_TEST_SUITE_P(Sizes, Boxes,
                         testing::Values(std::pair{16, 4}, std::pair{24, 4}, std::pair{32, 5},
                                         std::pair{18, 2}, std::pair{9, 1}));

TEST(Communicator, SumsMaximaAndBroadcasts) {
    const int p = world().size(), r = world().rank();
    std::array<double, 2> sum = {1.0 + r, 0.5};
    world().sum(sum);
    EXPECT_EQ(sum[0], 0.5 * p * (p + 1));
    EXPECT_EQ(sum[1], 0.5 * p);
    std::array<std::int64_t, 1> count = {std::int64_t{1} << (40 + r)};
    world().sum(count);
    EXPECT_EQ(count[0], ((std::int64_t{1} << p) - 1) << 40);
    EXPECT_EQ(world().max(r), p - 1);
    EXPECT_EQ(world().max(-r), 0.0);
    std::vector<double> told(3, r == 0 ? 2.5 : 0.0);
    world().broadcast(std::span<double>(told));
    EXPECT_EQ(told, std::vector<double>(3, 2.5));
}

TEST(Communicator, GathersUnevenSharesInRankOrder) {
    const int p = world().size(), r = world().rank();
    std::vector<int> counts;
    std::vector<double> expected;
    for (int i = 0; i < p; ++i) {
        counts.push_back(i); // the first rank has nothing to say
        expected.insert(expected.end(), static_cast<std::size_t>(i), 10.0 * i);
    }
    const std::vector<double> mine(static_cast<std::size_t>(r), 10.0 * r);
    std::vector<double> all(expected.size());
    world().all_gather(mine, counts, all);
    EXPECT_EQ(all, expected);
}

TEST(Communicator, ExchangesRoundTheRingAndWithItself) {
    const int p = world().size(), r = world().rank();
    const std::vector<double> up = {1.0 * r, 2.0}, down = {100.0 + r};
    std::vector<double> from_below(2), from_above(1);
    const int above = (r + 1) % p, below = (r + p - 1) % p;
    const std::array messages = {Message{above, below, 0, up, from_below},
                                 Message{below, above, 1, down, from_above}};
    world().exchange(messages);
    EXPECT_EQ(from_below, (std::vector<double>{1.0 * below, 2.0}));
    EXPECT_EQ(from_above, (std::vector<double>{100.0 + above}));
}

TEST(Communicator, AFailureOfTheRootEndsAllTogether) {
    const auto fail = [] { world().on_root([] { throw std::runtime_error("no space left"); }); };
    if (world().root()) { // which has the reason itself, no RootFailure
        EXPECT_EQ(test::message_of<std::runtime_error>(fail), "no space left");
    } else {
        EXPECT_THROW(fail(), RootFailure);
    }
    EXPECT_NO_THROW(world().on_root([] {}));
}

TEST(Communicator, TheRanksOfAMachineAreNumbered) {
    // The tests run on one machine, where a rank's number is its number in the world.
    EXPECT_EQ(world().local_rank(), world().rank());
    EXPECT_EQ(Communicator().local_rank(), 0);
    EXPECT_EQ(world().sum_on_machine(1.0), world().size());
    EXPECT_EQ(Communicator().sum_on_machine(2.0), 2.0);
}
