// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A field's rows are first touched by the threads that work on them.
#include "decomposition/field.hpp"
#include "support/threads.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include <omp.h>

using namespace asperity;

TEST(RowsOfThread, EveryRowIsTouchedOnceByTheThreadThatWorksOnIt) {
    for (const int threads : {1, 2, 3, 5})
        for (const int ny : {1, 7, 8, 20, 24, 41}) {
            const test::Threads own(threads);
            constexpr int halo = 2, planes = 3;
            const auto rows = static_cast<std::size_t>(ny + 2 * halo);
            std::vector<int> works(static_cast<std::size_t>(ny), -1);
            std::vector<int> touches(planes * rows, -1), times(planes * rows, 0);
#pragma omp parallel
            {
                const auto [first, last] = rows_of_thread(ny);
                for (int y = first; y < last; ++y)
                    works[static_cast<std::size_t>(y)] = omp_get_thread_num();
            }
            each_row_by_its_thread(ny, halo, planes, [&](int z, int y) {
                const auto row =
                    static_cast<std::size_t>(z) * rows + static_cast<std::size_t>(y + halo);
                touches[row] = omp_get_thread_num();
                ++times[row];
            });
            for (int z = 0; z < planes; ++z)
                for (int y = -halo; y < ny + halo; ++y) {
                    const auto row =
                        static_cast<std::size_t>(z) * rows + static_cast<std::size_t>(y + halo);
                    const auto inside = static_cast<std::size_t>(std::clamp(y, 0, ny - 1));
                    EXPECT_EQ(times[row], 1) << threads << ' ' << ny << ' ' << y;
                    EXPECT_EQ(touches[row], works[inside]) << threads << ' ' << ny << ' ' << y;
                }
        }
}

TEST(RowsOfThread, AFieldIsZeroEverywhere) {
    const test::Threads three(3);
    for (const int ny : {1, 9, 24}) {
        Tile tile{};
        tile.nx = 13, tile.ny = ny;
        // A second time, over memory that was used.
        for (int round = 0; round < 2; ++round) {
            Field<double> field(tile, 5);
            const auto all = field.storage();
            EXPECT_TRUE(std::all_of(all.begin(), all.end(), [](double v) { return v == 0.0; }));
            std::fill(all.begin(), all.end(), 1.0);
        }
    }
}
