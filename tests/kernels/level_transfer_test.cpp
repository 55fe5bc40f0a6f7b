// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Between two levels: interpolation P and the forces handed back by its transpose. The identity
// <P u, f> = <u, P^T f> is what makes the block conserve energy; tiles may start at any node.
#include "decomposition/field.hpp"
#include "kernels/level_transfer.hpp"

#include <gtest/gtest.h>

#include <random>
#include <utility>

using namespace asperity;

namespace {

constexpr int coarse_sites = 9, fine_sites = 2 * coarse_sites;

Tile whole(int sites) { return {0, 0, sites, sites, sites}; }

template <class Value>
void fill(Field<double>& field, const Tile& tile, const Value& value) {
    const auto p = field.plane(0);
    for (int y = -halo_width; y < tile.ny + halo_width; ++y)
        for (int x = -halo_width; x < tile.nx + halo_width; ++x)
            p(x, y) = value(tile.x0 + x, tile.y0 + y);
}

/// A periodic random field over a box, by global position.
class RandomBox {
public:
    RandomBox(int sites, unsigned seed) : sites_(sites) {
        std::mt19937_64 random(seed);
        std::uniform_real_distribution<double> uniform(-1.0, 1.0);
        for (int i = 0; i < sites * sites; ++i)
            value_.push_back(uniform(random));
    }
    double operator()(int x, int y) const {
        return value_[static_cast<std::size_t>(periodic(y, sites_) * sites_ + periodic(x, sites_))];
    }

private:
    int sites_;
    std::vector<double> value_;
};

void interpolate_all(LevelSeam seam, const Field<double>& coarse, Field<double>& fine, int ny,
                     int halo) {
    for (int y = -halo; y < ny + halo; ++y)
        transfer_kernels().interpolate(seam, coarse.plane(0), fine.plane(0), y, halo);
}

/// Rows from..to of the coarse plane, columns x0 on.
void restrict_rows(LevelSeam seam, const Field<double>& fine, Field<double>& coarse, int from,
                   int to, int x0, int columns) {
    for (int y = from; y < to; ++y)
        transfer_kernels().restrict_forces(seam, fine.plane(0), coarse.plane(0), y, x0, columns);
}

/// Two levels of the whole box: a coarse field interpolated, fine forces handed back.
struct Whole {
    Tile c = whole(coarse_sites), f = whole(fine_sites);
    Field<double> coarse{c, 1}, fine{f, 1}, fine_force{f, 1}, handed{c, 1};

    template <class U, class Force>
    Whole(const U& u, const Force& force) {
        fill(coarse, c, u);
        fill(fine_force, f, force);
        interpolate_all({0, 0, 0, 0}, coarse, fine, f.ny, halo_width);
        restrict_rows({0, 0, 0, 0}, fine_force, handed, 0, c.ny, 0, c.nx);
    }
};

} // namespace

TEST(LevelTransfer, BilinearFieldsAreExact) {
    // Small integers: every product and mean is exact in binary, so the law holds to the bit.
    const Whole box([](int x, int y) { return 3.0 + 4.0 * x - 6.0 * y + 8.0 * x * y; },
                    [](int, int) { return 0.0; });
    for (int y = -halo_width; y < box.f.ny + halo_width; ++y)
        for (int x = -halo_width; x < box.f.nx + halo_width; ++x)
            ASSERT_EQ(box.fine.plane(0)(x, y), 3.0 + 2.0 * x - 3.0 * y + 2.0 * x * y);
}

TEST(LevelTransfer, ForcesGoBackByTheTranspose) {
    const RandomBox u(coarse_sites, 1), force(fine_sites, 2);
    const Whole box(u, force);
    double left = 0.0, right = 0.0, given = 0.0, received = 0.0;
    for (int y = 0; y < box.f.ny; ++y)
        for (int x = 0; x < box.f.nx; ++x)
            left += box.fine.plane(0)(x, y) * force(x, y), given += force(x, y);
    for (int y = 0; y < box.c.ny; ++y)
        for (int x = 0; x < box.c.nx; ++x)
            right += u(x, y) * box.handed.plane(0)(x, y), received += box.handed.plane(0)(x, y);
    // 324 terms of order one: rounding below 1e-13.
    EXPECT_NEAR(left, right, 1e-13);
    EXPECT_NEAR(given, received, 1e-13) << "no force may be lost on the way";
}

class LevelTransferTiles : public testing::TestWithParam<std::pair<int, int>> {};

TEST_P(LevelTransferTiles, GiveTheBitsOfTheWholeBox) {
    const auto [x0, y0] = GetParam();
    const RandomBox u(coarse_sites, 3), force(fine_sites, 4);
    const Whole box(u, force);

    // A fine tile anywhere; the coarse level held whole, or cut where the offset is even.
    const Tile mine{x0, y0, 7, 5, fine_sites};
    Field<double> piece(mine, 1);
    interpolate_all({x0, y0, 0, 0}, box.coarse, piece, mine.ny, 0);
    for (int y = 0; y < mine.ny; ++y)
        for (int x = 0; x < mine.nx; ++x)
            ASSERT_EQ(piece.plane(0)(x, y), box.fine.plane(0)(x0 + x, y0 + y));

    Field<double> own_force(mine, 1), into(box.c, 1);
    fill(own_force, mine, force);
    const int cx0 = (x0 + 1) / 2, cx1 = (x0 + mine.nx + 1) / 2, cy0 = (y0 + 1) / 2,
              cy1 = (y0 + mine.ny + 1) / 2;
    restrict_rows({x0, y0, 0, 0}, own_force, into, cy0, cy1, cx0, cx1 - cx0);
    for (int y = cy0; y < cy1; ++y)
        for (int x = cx0; x < cx1; ++x)
            ASSERT_EQ(into.plane(0)(x, y), box.handed.plane(0)(x, y));

    if (x0 % 2 || y0 % 2) return;
    const Tile cut{x0 / 2, y0 / 2, 4, 3, coarse_sites};
    Field<double> coarse_piece(cut, 1);
    fill(coarse_piece, cut, u);
    Field<double> again(mine, 1);
    interpolate_all({x0, y0, cut.x0, cut.y0}, coarse_piece, again, mine.ny, halo_width);
    for (int y = -halo_width; y < mine.ny + halo_width; ++y)
        for (int x = -halo_width; x < mine.nx + halo_width; ++x)
            ASSERT_EQ(again.plane(0)(x, y), box.fine.plane(0)(periodic(x0 + x, fine_sites),
                                                              periodic(y0 + y, fine_sites)));
}

INSTANTIATE_TEST_SUITE_P(Offsets, LevelTransferTiles,
                         testing::Values(std::pair{0, 0}, std::pair{3, 8}, std::pair{4, 11},
                                         std::pair{5, 7}, std::pair{10, 12}, std::pair{11, 13}));
