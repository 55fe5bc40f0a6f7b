// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Arrays that were freed serve again, for the same size alone, and never two at once.
#include "decomposition/aligned_array.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

using namespace asperity;

TEST(AlignedArray, AFreedOneServesTheNextOfItsSize) {
    const std::size_t size = 40000; // 320 KB
    Workspace home;
    AlignedArray<double> first = aligned_array<double>(size, &home);
    const void* const at = first.get();
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(at) % 64, 0u);
    const AlignedArray<double> beside = aligned_array<double>(size, &home);
    EXPECT_NE(beside.get(), at);
    first.reset();
    AlignedArray<float> same = aligned_array<float>(2 * size, &home);
    EXPECT_EQ(same.get(), static_cast<const void*>(at));
    AlignedArray<double> third = aligned_array<double>(size, &home);
    EXPECT_NE(third.get(), at);
    same.reset();
    // Room for three in use and one kept: a smaller one is then new, and the kept one stays.
    aligned_array<double>(2 * size, &home).reset();
    const AlignedArray<double> smaller = aligned_array<double>(size - 8, &home);
    third.reset();
    EXPECT_EQ(home.kept(), size * sizeof(double));
    const AlignedArray<double> smallest = aligned_array<double>(size - 16, &home);
    EXPECT_EQ(home.kept(), size * sizeof(double));
}

TEST(AlignedArray, NoMoreIsKeptThanWasInUse) {
    Workspace home;
    EXPECT_EQ(home.kept(), 0u);
    const std::size_t bytes = 1 << 20, other = bytes - 6400, count = 40;
    const auto make = [&](std::size_t n, std::size_t of) {
        std::vector<AlignedArray<std::byte>> list;
        for (std::size_t i = 0; i < n; ++i)
            list.push_back(aligned_array<std::byte>(of, &home));
        return list;
    };
    make(count, bytes);
    EXPECT_EQ(home.kept(), count * bytes);
    const auto half = make(count / 2, bytes); // all of them are of those kept
    EXPECT_EQ(home.kept(), count / 2 * bytes);
    const auto others = make(count / 2, other); // none is: as many go
    EXPECT_EQ(home.kept(), 0u);
    make(2, (128u << 20) + 1); // too large
    EXPECT_EQ(home.kept(), 0u);
    make(count, bytes);
    EXPECT_GT(home.kept(), 0u);
    home.free_kept();
    EXPECT_EQ(home.kept(), 0u);
}
