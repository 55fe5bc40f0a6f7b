// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What kernels are handed can be copied to a device byte by byte.
#include "kernels/device/device.hpp"
#include "kernels/elastic_level.hpp"
#include "kernels/exact_sum.hpp"
#include "kernels/interface_kernels.hpp"
#include "kernels/level_transfer.hpp"
#include "kernels/views.hpp"

#include <gtest/gtest.h>

#include <type_traits>

using namespace asperity;

template <class T>
class GoesToADevice : public testing::Test {};

using Types =
    testing::Types<PlaneView<double>, VolumeView<const float>, VectorPlane<const double>,
                   VectorVolume<double>, CellElasticity, LevelCell, ElasticLevel, Band, Stencil,
                   Patch, Kick, LevelKicks, KickSums, ExactSum, LennardJones, InterfaceSites,
                   InterfaceSums, SubstrateMap, ReachBounds, LatticeSubstrate, RowSubstrate,
                   Tail<LennardJones>, Morse, Tabulated, Pair<Morse>, Pair<Tabulated>, LevelSeam,
                   DeviceLevel, ThermalNoise, DeviceStep, DeviceHalo, NodeRanges, PassSums>;
TYPED_TEST_SUITE(GoesToADevice, Types);

TYPED_TEST(GoesToADevice, ByteByByte) {
    EXPECT_TRUE(std::is_trivially_copyable_v<TypeParam>);
    // The device's compiler is another one: the order of members must be the standard's.
    EXPECT_TRUE(std::is_standard_layout_v<TypeParam>);
}
