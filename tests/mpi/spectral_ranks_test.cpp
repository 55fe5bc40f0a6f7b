// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The spectral block in slabs over the ranks has the bits of the same on one: every rank holds
// both, the slab it shares and a whole surface of its own. Sizes that the ranks divide, and that
// they do not.
#include "engine/statics/relaxation.hpp"
#include "support/cases.hpp"
#include "support/path_case.hpp"
#include "support/world.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <stdexcept>
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

/// Both ways, from and to fields and waves.
template <class T>
void forward(const SurfaceTransform<T>& by, const SiteField<T>& field, Waves<T>& waves) {
    SiteRows<T> rows = by.from_sites();
    for (int y = 0; y < waves.slab().rows; ++y) {
        for (std::size_t c = 0; c < field.size(); ++c)
            std::copy_n(field[c].plane(0).line(y), waves.slab().sites, rows.own()[c]);
        rows.put(y);
    }
    const WaveBlocks<T> blocks = std::move(rows).to_blocks();
    for (int b = 0; b < waves.blocks(); ++b)
        std::copy_n(blocks.get(b), waves.length(), waves.block(b));
}
template <class T>
void backward(const SurfaceTransform<T>& by, const Waves<T>& waves, SiteField<T>& field) {
    WaveBlocks<T> blocks = by.from_waves();
    for (int b = 0; b < waves.blocks(); ++b)
        blocks.put(b, waves.block(b));
    const SiteRows<T> rows = std::move(blocks).to_rows();
    for (int y = 0; y < waves.slab().rows; ++y)
        for (std::size_t c = 0; c < field.size(); ++c)
            std::copy_n(rows.get(y)[c], waves.slab().sites, field[c].plane(0).line(y));
}
/// The waves that the ranks of `part` have between them are those of `whole`.
template <class T>
void expect_part(const Waves<T>& part, const Waves<T>& whole) {
    const Slab& slab = part.slab();
    double mine = 0.0;
    for (int c = 0; c < part.components(); ++c)
        for (int ny = 0; ny < slab.sites; ++ny)
            for (int nx = 0; nx < slab.columns(); ++nx)
                if (const T* const wave = part.wave(c, nx, ny)) {
                    ++mine;
                    const T* const expected = whole.wave(c, nx, ny);
                    ASSERT_EQ(wave[0], expected[0]) << slab.sites << ": " << nx << ' ' << ny;
                    ASSERT_EQ(wave[1], expected[1]) << slab.sites << ": " << nx << ' ' << ny;
                }
    slab.ranks.sum(std::span(&mine, 1));
    EXPECT_EQ(mine, part.components() * slab.sites * slab.columns());
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
    Interface interface(surface, block.tile(), options.spacing, over);
    interface.set_reference_height(surface.statistics.highest + 2.5);
    RelaxOptions relaxation;
    relaxation.tolerance = 1e-7;
    relaxation.scales = test::paper_scales();
    Phases phases;
    State state;
    state.relaxed = relax(block, interface, constraint, relaxation, phases);
    state.top = block.top();
    return state;
}

} // namespace

TEST(SpectralRanks, CountTheEdgesOfContactAlike) {
    for (const int sites : {12, 13}) {
        const Surface surface = test::surface_from(
            sites, [](int x, int y) { return value(x, y, 0); }, 2.6);
        const auto edges = [&](const Communicator& ranks) {
            const Slab slab(sites, ranks);
            Interface interface(surface, slab.tile(), 2.6,
                                test::over(ExponentialWall(0.7, 1.3, 24.0)));
            interface.set_reference_height(0.2);
            const VectorField<double> rest(slab.tile(), 1, 0);
            return interface.contact_edges(rest.plane(0), ranks);
        };
        std::int64_t counted = 0;
        const auto touches = [&](int x, int y) { return value(x % sites, y % sites, 0) > 0.2; };
        for (int y = 0; y < sites; ++y)
            for (int x = 0; x < sites; ++x)
                counted +=
                    (touches(x, y) != touches(x + 1, y)) + (touches(x, y) != touches(x, y + 1));
        EXPECT_GT(counted, sites);
        EXPECT_EQ(edges(Communicator()), counted);
        EXPECT_EQ(edges(test::world()), counted);
    }
}

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
    const SurfaceTransform<double> transform(slab, 1), alone(whole, 1);
    forward(transform, mine, waves);
    forward(alone, all, of_all);
    expect_part(waves, of_all);
    const auto before = field_on<double>(slab, 1);
    backward(transform, waves, mine);
    for (int y = 0; y < slab.rows; ++y)
        for (int x = 0; x < sites; ++x)
            EXPECT_NEAR(mine[0].plane(0)(x, y),
                        static_cast<double>(sites) * sites * before[0].view()(x, y, 0), 1e-9);
}

template <class T>
void transform_like_one_rank(double tolerance, int components) {
    for (int sites : {8, 15, 16, 49, 100, 301}) {
        const Slab slab(sites, test::world()), whole(sites, Communicator());
        auto mine = field_on<T>(slab, components), all = field_on<T>(whole, components);
        const SurfaceTransform<T> shared(slab, components), alone(whole, components);
        Waves<T> part(slab, components), waves(whole, components);
        forward(shared, mine, part);
        forward(alone, all, waves);
        expect_part(part, waves);
        EXPECT_EQ(dot(part, part), dot(waves, waves));

        // Parseval, and the definition of one wave.
        const double n2 = 1.0 * sites * sites;
        double squares = 0.0, re = 0.0, im = 0.0;
        const int nx = sites / 2, ny = sites - 1;
        for (int y = 0; y < sites; ++y)
            for (int x = 0; x < sites; ++x) {
                for (int c = 0; c < components; ++c)
                    squares += value(x, y, c) * value(x, y, c);
                const double phase = -2.0 * std::numbers::pi * (nx * x + ny * y) / sites;
                re += value(x, y, components - 1) * std::cos(phase);
                im += value(x, y, components - 1) * std::sin(phase);
            }
        EXPECT_NEAR(dot(part, part) / (n2 * n2 * squares), 1.0, 10.0 * tolerance);
        EXPECT_NEAR(waves.wave(components - 1, nx, ny)[0], re, n2 * tolerance);
        EXPECT_NEAR(waves.wave(components - 1, nx, ny)[1], im, n2 * tolerance);

        const auto expect_times = [&](double factor) {
            for (int c = 0; c < components; ++c)
                for (int y = 0; y < slab.rows; ++y)
                    for (int x = 0; x < sites; ++x)
                        ASSERT_NEAR(mine[static_cast<std::size_t>(c)].plane(0)(x, y),
                                    factor * value(x, slab.first + y, c),
                                    10.0 * factor * tolerance);
        };
        backward(shared, part, mine);
        expect_times(n2);
        // From the room where waves are written, sixteen times smaller, and on from there.
        Waves<T> back(slab, components);
        {
            WaveBlocks<T> smaller = shared.from_waves();
            for (int b = 0; b < part.blocks(); ++b) {
                combine_row(0.0625, part.block(b), 0.0, smaller.room(),
                            static_cast<int>(part.length()));
                smaller.put(b, smaller.room());
            }
            SiteRows<T> rows = std::move(smaller).to_rows();
            for (int y = 0; y < slab.rows; ++y) {
                T* const* own = rows.get(y);
                for (int c = 0; c < components; ++c)
                    for (int x = 0; x < sites; ++x)
                        own[c][x] *= T(16.0 / n2);
                rows.put(y);
            }
            WaveBlocks<T> blocks = std::move(rows).to_blocks();
            for (int b = 0; b < back.blocks(); ++b) {
                T* const block = blocks.get(b);
                std::copy_n(block, back.length(), back.block(b));
                blocks.put(b, block); // as it is, or changed
            }
            const SiteRows<T> last = std::move(blocks).to_rows();
            EXPECT_THROW(shared.from_sites(), std::logic_error); // one transform at a time
            for (int y = 0; y < slab.rows; ++y)
                for (int c = 0; c < components; ++c)
                    std::copy_n(last.get(y)[c], sites,
                                mine[static_cast<std::size_t>(c)].plane(0).line(y));
        }
        expect_times(n2);
        combine(-1.0, part, 1.0, back);
        EXPECT_LT(dot(back, back), 100.0 * tolerance * tolerance * dot(part, part));
    }
}

TEST(Slabs, TransformLikeOneRankInDouble) {
    for (int components : {1, 3})
        transform_like_one_rank<double>(1e-14, components);
}
TEST(Slabs, TransformLikeOneRankInSingle) {
    for (int components : {1, 3})
        transform_like_one_rank<float>(1e-6, components);
}

/// Each rank has the stiffness of the waves that it transforms and of no others, bit for bit that
/// of one rank, also where the far field of free edges takes part in it.
TEST(StiffnessTable, IsSharedAmongTheRanks) {
    for (const int sites : {8, 33, 64, 100})
        for (const bool frictionless : {false, true})
            for (const bool free_edges : {false, true})
                for (const bool coated : {false, true}) {
                    if (free_edges && !frictionless) continue;
                    BlockOptions options = test::paper_block(sites, 12, 0);
                    options.free_edges = options.continuum = free_edges;
                    if (coated)
                        options.layers = {{{3.0 * options.young, 0.2}, 3 * options.spacing}};
                    const Slab slab(options.grid(), test::world()),
                        whole(options.grid(), Communicator());
                    const StiffnessTable shared(options, slab, frictionless),
                        alone(options, whole, frictionless);
                    EXPECT_EQ(shared.uniform(), alone.uniform());
                    const auto numbers = [](const SurfaceMatrix& s) {
                        return std::tuple(s.xx, s.yy, s.zz, s.xy, s.xz, s.yz);
                    };
                    double columns = slab.end_column() - slab.first_column();
                    for (int nx = slab.first_column(); nx < slab.end_column(); ++nx)
                        for (int ny = 0; ny < slab.columns(); ++ny) {
                            ASSERT_EQ(numbers(shared.at(nx, ny)), numbers(alone.at(nx, ny)))
                                << sites << ": " << nx << ' ' << ny;
                            ASSERT_EQ(alone.at(nx, ny).zz, alone.at(ny, nx).zz);
                        }
                    double bytes = static_cast<double>(shared.bytes());
                    slab.ranks.sum(std::span(&columns, 1));
                    slab.ranks.sum(std::span(&bytes, 1));
                    EXPECT_EQ(columns, slab.columns());
                    EXPECT_EQ(bytes, static_cast<double>(alone.bytes()));
                }
}

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
            ASSERT_GT(std::abs(alone.relaxed[Term::interface]) + alone.relaxed[Term::elastic], 0.1);
            const auto numbers = [](const State& s) {
                const RelaxedState& r = s.relaxed;
                return std::tuple(r.iterations, r[Term::interface], r[Term::elastic], r.mean_height,
                                  r.force, r.in_contact, r.repulsive, s.top, r.top_force);
            };
            EXPECT_EQ(numbers(shared), numbers(alone));
            // What the top feels is what the substrate exerts.
            if (c.wall) continue;
            EXPECT_NEAR(shared.relaxed.top_force, shared.relaxed.force, 1e-7 * c.sites * c.sites);
        }
}
