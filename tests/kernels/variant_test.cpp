// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Which of the levels that were compiled runs.
#include "kernels/variant.hpp"

#include <gtest/gtest.h>

using namespace asperity;
using L = ProcessorLevel;

TEST(Variant, HighestThatTheProcessorHas) {
    for (L has : {L::v2, L::v3, L::v4})
        EXPECT_EQ(choose_level({L::v2, L::v3, L::v4}, has, {}), has);
    EXPECT_EQ(choose_level({L::v2, L::v4}, L::v3, {}), L::v2);
    EXPECT_EQ(choose_level({L::v3}, L::v4, {}), L::v3);
}

TEST(Variant, OneAskedForIsNotExceeded) {
    for (L asked : {L::v2, L::v3, L::v4})
        EXPECT_EQ(choose_level({L::v2, L::v3, L::v4}, L::v4, asked), asked);
    EXPECT_EQ(choose_level({L::v2, L::v3, L::v4}, L::v3, L::v4), L::v3);
    EXPECT_EQ(choose_level({L::v4}, L::v4, L::v2), L::v4); // the only one
}

TEST(Variant, CompiledOnceItIsTheProcessors) {
    EXPECT_EQ(choose_level({}, L::portable, {}), L::portable);
    EXPECT_EQ(choose_level({}, L::aarch64, L::v2), L::aarch64);
}

TEST(Variant, TheseKernelsRunHere) { EXPECT_FALSE(missing_level()); }
