// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Arrays that were freed serve again, for the same size alone, and never two at once.
#include "decomposition/aligned_array.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <utility>
#include <vector>

using namespace asperity;

TEST(AlignedArray, AFreedOneServesTheNextOfItsSize) {
    const std::size_t size = 40000; // 320 KB
    AlignedArray<double> first = aligned_array<double>(size);
    const void* const at = first.get();
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(at) % 64, 0u);
    const AlignedArray<double> beside = aligned_array<double>(size);
    EXPECT_NE(beside.get(), at);
    first.reset();
    const AlignedArray<double> other = aligned_array<double>(size + 8);
    EXPECT_NE(other.get(), at);
    const AlignedArray<float> same = aligned_array<float>(2 * size);
    EXPECT_EQ(same.get(), at);
    const AlignedArray<double> third = aligned_array<double>(size);
    EXPECT_NE(third.get(), at);
}

TEST(AlignedArray, NoMoreIsKeptThanSaid) {
    const std::size_t size = (1 << 20) / sizeof(double); // 1 MB each, 24 are kept
    std::vector<AlignedArray<double>> many;
    for (int i = 0; i < 40; ++i)
        many.push_back(aligned_array<double>(size));
    std::vector<const void*> freed;
    for (AlignedArray<double>& array : many)
        freed.push_back(std::exchange(array, {}).get());
    int reused = 0;
    std::vector<AlignedArray<double>> next;
    for (int i = 0; i < 24; ++i) {
        next.push_back(aligned_array<double>(size));
        reused += next.back().get() == freed[static_cast<std::size_t>(39 - i)];
    }
    EXPECT_EQ(reused, 24); // the last freed first
}
