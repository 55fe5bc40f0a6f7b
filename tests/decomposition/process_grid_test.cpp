// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Who owns what: every node of every level has one owner, and cells of the cut levels are whole.
#include "decomposition/process_grid.hpp"
#include "kernels/views.hpp"
#include "support/message.hpp"

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>
#include <tuple>
#include <utility>
#include <vector>

using namespace asperity;

class Cuts : public testing::TestWithParam<std::tuple<int, int>> {};

TEST_P(Cuts, EveryNodeHasOneOwnerAndCoarseCellsAreWhole) {
    const auto [ranks, sites] = GetParam();
    int levels = 1;
    while ((sites >> levels) << levels == sites && sites >> levels >= 2)
        ++levels;
    const ProcessGrid first(ranks, 0, sites, levels);
    ASSERT_EQ(first.ranks(), ranks);
    for (int level = 0; level < levels; ++level) {
        const int n = sites >> level;
        std::vector<int> owners(static_cast<std::size_t>(n) * static_cast<std::size_t>(n));
        for (int r = 0; r < ranks; ++r) {
            const ProcessGrid grid(ranks, r, sites, levels);
            const Tile mine = grid.tile(level);
            ASSERT_EQ(mine.sites, n);
            if (!grid.tiled(level)) {
                EXPECT_EQ(std::pair(mine.nx, mine.ny), std::pair(n, n));
            } else {
                EXPECT_GE(mine.nx, halo_width); // a neighbour's halo comes from one tile
                EXPECT_GE(mine.ny, halo_width);
                if (level > 0) {
                    const Tile finer = grid.tile(level - 1);
                    EXPECT_EQ(std::tuple(finer.x0, finer.y0, finer.nx, finer.ny),
                              std::tuple(2 * mine.x0, 2 * mine.y0, 2 * mine.nx, 2 * mine.ny));
                }
            }
            const Tile own = grid.footprint(level, r); // of a level held whole too
            for (int y = own.y0; y < own.y0 + own.ny; ++y)
                for (int x = own.x0; x < own.x0 + own.nx; ++x)
                    ++owners.at(static_cast<std::size_t>(y * n + x));
            EXPECT_EQ(grid.tile(level, r).x0, mine.x0);
        }
        ASSERT_EQ(owners, std::vector<int>(owners.size(), 1));
    }
    // Neighbourhood is mutual.
    for (int r = 0; r < ranks; ++r) {
        const ProcessGrid grid(ranks, r, sites, levels);
        for (const auto& [dx, dy] : {std::pair{1, 0}, {0, 1}}) {
            const ProcessGrid other(ranks, grid.neighbour(dx, dy), sites, levels);
            EXPECT_EQ(other.neighbour(-dx, -dy), r);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Boxes, Cuts,
                         testing::Combine(testing::Values(1, 2, 3, 4, 6, 8),
                                          testing::Values(16, 24, 32, 100, 512)));

TEST(ProcessGrid, KnownCuts) {
    // 2 x 2 tiles down to the level whose tiles still hold two nodes.
    const ProcessGrid four(4, 3, 32, 5);
    EXPECT_EQ(four.cut_level(), 3);
    EXPECT_EQ(four.tile(0).x0, 16);
    EXPECT_EQ(four.tile(3).nx, 2);
    EXPECT_EQ(four.tile(4).nx, 2) << "level 4 has 2 x 2 nodes: held whole";
    // Three ranks share 32 rows as 10 + 11 + 11, coarser cuts would be less even; level 1 is held
    // whole.
    const ProcessGrid three(3, 1, 32, 3);
    EXPECT_EQ(three.cut_level(), 0);
    EXPECT_EQ(three.tile(0).y0, 10);
    EXPECT_EQ(three.tile(0).ny, 11);
    EXPECT_EQ(three.footprint(1, 2).y0, 11) << "node 11 of level 1 is node 22 of level 0, above 21";
}

TEST(ProcessGrid, TooManyRanksAreRefusedWithTheNumbers) {
    const std::string text =
        test::message_of<std::invalid_argument>([] { const ProcessGrid grid(16, 0, 7, 1); });
    EXPECT_TRUE(test::has(text, "7 x 7") && test::has(text, "4 x 4")) << text;
}
