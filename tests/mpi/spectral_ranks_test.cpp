// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The spectral block in slabs over the ranks has the bits of the same on one: every rank holds
// both, the slab it shares and a whole surface of its own. Sizes that the ranks divide, and that
// they do not.
#include "engine/equilibrium/relaxation.hpp"
#include "support/cases.hpp"
#include "support/world.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

using namespace asperity;

namespace {

/// Something without symmetry, known at every site.
double value(int x, int y, int component) {
    return std::sin(0.7 * x + 1.3 * y * y + component) + 0.1 * std::cos(2.1 * x * y);
}

template <class T>
SiteField<T> field_on(const Slab& slab, int components) {
    auto field = site_field<T>(slab, components);
    for (int c = 0; c < components; ++c)
        for (int y = 0; y < slab.rows; ++y)
            for (int x = 0; x < slab.sites; ++x)
                field[static_cast<std::size_t>(c)].plane(0)(x, y) =
                    static_cast<T>(value(x, slab.first + y, c));
    return field;
}

struct State {
    RelaxedState relaxed;
    double top = 0.0;
};

/// Pressed down on a rough map by what is prescribed, or let go.
State relax_on(const Communicator& ranks, const BlockOptions& options, const Surface& surface,
               const Constraint& constraint, bool frictionless,
               const std::optional<WallLaw>& wall = {}) {
    SpectralBlock block(options, ranks, frictionless);
    InterfaceOptions over = test::paper_interface();
    over.wall = wall;
    const Interface interface(surface, block.tile(), options.spacing, over);
    RelaxOptions relaxation;
    relaxation.tolerance = 1e-7;
    relaxation.scales = test::paper_scales();
    Phases phases;
    State state;
    state.relaxed =
        relax(block, interface, surface.statistics.highest + 2.5, constraint, relaxation, phases);
    state.top = block.top();
    return state;
}

} // namespace

TEST(Slabs, AreOfTheRanksTheyAreGiven) {
    // Two halves of the ranks, each with a surface of its own, of another size: waves there and
    // back, against one rank's.
    const Communicator& world = test::world();
    const bool second = world.rank() >= (world.size() + 1) / 2;
    const Communicator part = world.split(second);
    const int sites = second ? 24 : 16;
    const Slab slab(sites, part), whole(sites, Communicator());
    auto mine = field_on<double>(slab, 1), all = field_on<double>(whole, 1);
    Waves<double> waves(slab, 1), of_all(whole, 1);
    const SurfaceTransform<double> transform(slab), alone(whole);
    transform.forward(std::as_const(mine[0]).plane(0), waves, 0);
    alone.forward(std::as_const(all[0]).plane(0), of_all, 0);
    for (int y = 0; y < slab.rows; ++y)
        for (int i = 0; i < 2 * slab.columns(); ++i)
            EXPECT_EQ(waves.row(0, y)[i], of_all.row(0, slab.first + y)[i]);
    const auto before = field_on<double>(slab, 1);
    transform.backward(waves, 0, mine[0].plane(0));
    for (int y = 0; y < slab.rows; ++y)
        for (int x = 0; x < sites; ++x)
            EXPECT_NEAR(mine[0].plane(0)(x, y),
                        static_cast<double>(sites) * sites * before[0].view()(x, y, 0), 1e-9);
}

template <class T>
void transform_like_one_rank(double tolerance) {
    for (int sites : {8, 15, 16, 49}) {
        const Slab slab(sites, test::world()), whole(sites, Communicator());
        auto mine = field_on<T>(slab, 3), all = field_on<T>(whole, 3);
        const SurfaceTransform<T> shared(slab), alone(whole);
        Waves<T> part(slab, 3), waves(whole, 3);
        for (int c = 0; c < 3; ++c) {
            const auto at = static_cast<std::size_t>(c);
            shared.forward(mine[at].plane(0), part, c);
            alone.forward(all[at].plane(0), waves, c);
        }
        for (int c = 0; c < 3; ++c)
            for (int y = 0; y < slab.rows; ++y)
                for (int i = 0; i < part.length(); ++i)
                    ASSERT_EQ(part.row(c, y)[i], waves.row(c, slab.first + y)[i]) << sites;
        EXPECT_EQ(dot(part, part), dot(waves, waves));
        shared.backward(part, 1, mine[1].plane(0));
        for (int y = 0; y < slab.rows; ++y)
            for (int x = 0; x < sites; ++x)
                ASSERT_NEAR(mine[1].plane(0)(x, y) / (1.0 * sites * sites),
                            value(x, slab.first + y, 1), 10.0 * tolerance);
    }
}

template <class T>
void transform_rows_like_fields(int components) {
    for (int sites : {8, 15, 49}) {
        const Slab slab(sites, test::world());
        const SurfaceTransform<T> transform(slab);
        auto field = field_on<T>(slab, components);
        const auto row_of = [&](int c, int y) {
            return field[static_cast<std::size_t>(c)].plane(0).line(y);
        };
        const auto expect_equal = [&](const Waves<T>& a, const Waves<T>& b) {
            for (int c = 0; c < components; ++c)
                for (int y = 0; y < slab.rows; ++y)
                    for (int i = 0; i < a.length(); ++i)
                        ASSERT_EQ(a.row(c, y)[i], b.row(c, y)[i]) << sites << ' ' << c;
        };
        Waves<T> by_field(slab, components), by_row(slab, components), kept(slab, components);
        for (int c = 0; c < components; ++c)
            transform.forward(std::as_const(field[static_cast<std::size_t>(c)]).plane(0), by_field,
                              c);
        transform.forward(
            [&](int y, T* const* rows) {
                for (int c = 0; c < components; ++c)
                    std::copy_n(row_of(c, y), sites, rows[c]);
            },
            by_row);
        expect_equal(by_row, by_field);

        // There, doubled, and back again.
        combine(1.0, by_field, 0.0, kept);
        for (int c = 0; c < components; ++c)
            transform.backward(by_field, c, field[static_cast<std::size_t>(c)].plane(0));
        std::vector<int> equal(static_cast<std::size_t>(slab.rows));
        transform.backward(by_row, [&](int y, T* const* rows) {
            bool all = true;
            for (int c = 0; c < components; ++c)
                all = all && std::equal(rows[c], rows[c] + sites, row_of(c, y));
            equal[static_cast<std::size_t>(y)] = all;
        });
        EXPECT_EQ(std::count(equal.begin(), equal.end(), 1), slab.rows) << sites;
        const auto twice = [&](T* row) {
            for (int x = 0; x < sites; ++x)
                row[x] *= T(2);
        };
        for (int c = 0; c < components; ++c) {
            for (int y = 0; y < slab.rows; ++y)
                twice(row_of(c, y));
            transform.forward(std::as_const(field[static_cast<std::size_t>(c)]).plane(0), by_field,
                              c);
        }
        Waves<T> untouched(slab, components);
        combine(1.0, kept, 0.0, untouched);
        transform.through(
            kept,
            [&](int, T* const* rows) {
                for (int c = 0; c < components; ++c)
                    twice(rows[c]);
            },
            by_row);
        expect_equal(by_row, by_field);
        expect_equal(kept, untouched);
    }
}

TEST(Slabs, TransformRowsLikeFields) {
    for (int components : {1, 3}) {
        transform_rows_like_fields<double>(components);
        transform_rows_like_fields<float>(components);
    }
}
TEST(Slabs, TransformLikeOneRankInDouble) { transform_like_one_rank<double>(1e-14); }
TEST(Slabs, TransformLikeOneRankInSingle) { transform_like_one_rank<float>(1e-6); }

TEST(SpectralBlock, RelaxesLikeOneRank) {
    using Constraints = std::array<Constraint, 3>;
    const Constraints gently = {Constraint::load(0.0), Constraint::top(-0.3),
                                Constraint::mean_height(-0.3)},
                      firmly = {Constraint::load(5.0), Constraint::top(-4.5),
                                Constraint::mean_height(-4.5)};
    const struct {
        const char* map;
        int sites, thickness;
        bool frictionless;
        std::optional<WallLaw> wall;
        const Constraints& constraints;
    } cases[] = {{"n8_b_rms1.0", 8, 6, false, {}, gently},
                 {"n8_b_rms1.0", 8, 6, true, {}, gently},
                 {"c2_N16_T8_rms1.5", 16, 8, false, {}, gently},
                 {"c2_N16_T8_rms1.5", 16, 8, true, {}, gently},
                 {"c2_N16_T8_rms1.5", 16, 8, true,
                  SmearedWall(LennardJones{0.1, 3.28, 13.12}, 1.0 / (2.6 * 2.6), false), firmly},
                 {"c2_N16_T8_rms1.5", 16, 8, true, ExponentialWall(0.7, 1.3, 1000.0), firmly},
                 {"c2_N16_T8_rms1.5", 16, 8, true, ExponentialWall(0.0, 1.0, 1000.0), firmly}};
    for (const auto& c : cases)
        for (const Constraint& constraint : c.constraints) {
            SCOPED_TRACE(&c - cases);
            const BlockOptions options = test::paper_block(c.sites, c.thickness, 0);
            const Surface surface = test::reference_surface(c.map);
            const auto on = [&](const Communicator& ranks) {
                return relax_on(ranks, options, surface, constraint, c.frictionless, c.wall);
            };
            const State shared = on(test::world()), alone = on(Communicator());
            ASSERT_TRUE(shared.relaxed.converged && alone.relaxed.converged);
            ASSERT_GT(std::abs(alone.relaxed.interface_energy) + alone.relaxed.elastic_energy, 0.1);
            const auto numbers = [](const State& s) {
                const RelaxedState& r = s.relaxed;
                return std::tuple(r.iterations, r.interface_energy, r.elastic_energy, r.mean_height,
                                  r.force, r.in_contact, r.repulsive, s.top, r.top_force);
            };
            EXPECT_EQ(numbers(shared), numbers(alone));
            // What the top feels is what the substrate exerts.
            if (c.wall) continue;
            EXPECT_NEAR(shared.relaxed.top_force, shared.relaxed.force, 1e-7 * c.sites * c.sites);
        }
}
