// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A surface with free edges (engine/waves/free_edges.hpp): displacements by a force without images,
// Hertz' contact, the flat punch and JKR's in boxes hardly wider than the contact.
#include "engine/waves/free_edges.hpp"
#include "support/path_case.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

using namespace asperity;

namespace {

using std::numbers::pi;

/// A half-space of contact modulus E* over N x N sites of a box with this edge.
BlockOptions free_block(int sites, double edge, double modulus, double poisson = 0.3,
                        bool continuum = true) {
    BlockOptions o;
    o.sites = sites;
    o.spacing = edge / sites;
    o.poisson = poisson;
    o.young = modulus * (1.0 - poisson * poisson);
    o.free_edges = true;
    o.continuum = continuum;
    return o;
}

/// A block with free edges over a wall.
struct Free {
    BlockOptions options;
    Surface surface;
    Interface interface;
    SpectralBlock block;
    Scales scales;

    /// length: of the interface, over which its force on a site changes.
    Free(const BlockOptions& o, Surface s, const WallLaw& law, double length)
        : options(o), surface(std::move(s)),
          interface(surface, ProcessGrid::slabs(1, 0, o.grid()).tile(0), o.spacing,
                    test::over(law)),
          block(o, Communicator(), true) {
        scales.length = length;
        scales.stiffness = 100.0 * o.contact_modulus() * o.spacing;
    }
    /// From where the block is.
    RelaxedState relax(const Constraint& constraint, double tolerance, Start start) {
        RelaxOptions how;
        how.start = start;
        how.tolerance = tolerance;
        how.scales = scales;
        Phases phases;
        const RelaxedState s = asperity::relax(block, interface, constraint, how, phases);
        EXPECT_TRUE(s.converged) << s.residual << " at " << constraint.value;
        return s;
    }
    double radius_of(const RelaxedState& s) const {
        return options.spacing * std::sqrt(static_cast<double>(s.in_contact) / pi);
    }
};

/// A paraboloid of radius R about the middle of the box.
Surface paraboloid(int sites, double edge, double R) {
    const double a = edge / sites;
    return test::surface_from(
        sites,
        [=](int x, int y) {
            const double dx = a * x - 0.5 * edge, dy = a * y - 0.5 * edge;
            return -(dx * dx + dy * dy) / (2.0 * R);
        },
        a);
}

/// A wall that only repels, of so many times the stiffness of the shortest wave.
ExponentialWall hard_wall(const BlockOptions& o, double factor = 1000.0) {
    return {0.0, o.spacing, factor * 0.5 * pi * o.contact_modulus() * o.spacing};
}

/// Returns the displacement by a force on one site as a function of the sites away from it; over a
/// continuum the force is shared by the sites (0 or -1, 0 or -1): its waves end at the shortest one
/// of the sites, and a force on one site makes displacements that alternate.
std::function<double(int, int)> displacement_by(double force, const BlockOptions& o) {
    const FreeEdges edges(o, Slab(o.grid(), Communicator()));
    const int n = o.grid();
    std::vector<double> wave, cosine;
    for (int i = 0; i < n * n; ++i)
        wave.push_back(edges.compliance(std::min(i % n, n - i % n), std::min(i / n, n - i / n)));
    for (int i = 0; i < n; ++i)
        cosine.push_back(std::cos(2.0 * pi * i / n));
    const bool shared = o.continuum;
    return [=](int x, int y) {
        double sum = 0.0;
        for (int corner = 0; corner < (shared ? 4 : 1); ++corner)
            for (int i = 0; i < n * n; ++i) // even in both directions
                sum += wave[static_cast<std::size_t>(i)] *
                       cosine[static_cast<std::size_t>(i % n * (x + corner % 2) % n)] *
                       cosine[static_cast<std::size_t>(i / n * (y + corner / 2) % n)];
        return force * sum / (n * n * (shared ? 4.0 : 1.0));
    };
}

} // namespace

TEST(FreeEdges, HaveAGridThatIsWideEnoughAndTransformsFast) {
    for (const int sites : {4, 5, 33, 59, 176, 177, 354, 1021, 4096, 4099}) {
        const int grid = free_block(sites, 10.0, 1.0).grid();
        EXPECT_GE(grid, 2 * sites);
        EXPECT_LE(grid, 2 * sites * 1.1);
        EXPECT_EQ(grid % 2, 0);
        int left = grid;
        for (const int factor : {2, 3, 5, 7})
            while (left % factor == 0)
                left /= factor;
        EXPECT_EQ(left, 1) << grid << " for " << sites << " sites";
    }
}

TEST(FreeEdges, HaveAPositiveComplianceOfAllWaves) {
    for (const double poisson : {-0.3, 0.0, 0.3, 0.49})
        for (const int sites : {4, -4, 5, -5, 16, -16, 33, -33, 64, -64}) { // < 0: a lattice
            const BlockOptions o = free_block(std::abs(sites), 10.0, 1.0, poisson, sites > 0);
            const FreeEdges edges(o, Slab(o.grid(), Communicator()));
            double longest = 0.0, least = edges.compliance(0, 0);
            for (int nx = 0; nx <= o.grid() / 2; ++nx)
                for (int ny = 0; ny <= o.grid() / 2; ++ny) {
                    least = std::min(least, edges.compliance(nx, ny));
                    longest = std::max(longest, edges.compliance(nx, ny));
                }
            EXPECT_GT(least, 0.0) << sites << " sites, nu = " << poisson;
            EXPECT_EQ(longest, edges.compliance(0, 0));
        }
}

TEST(FreeEdges, HaveAPositiveComplianceOfAllWavesOf256Sites) {
    const BlockOptions o = free_block(256, 256.0, 1.0);
    const FreeEdges edges(o, Slab(o.grid(), Communicator()));
    double least = edges.compliance(0, 0);
    for (int ny = 0; ny <= o.grid() / 2; ++ny)
        for (int nx = 0; nx <= ny; ++nx) // the same with x and y exchanged
            least = std::min(least, edges.compliance(nx, ny));
    EXPECT_GT(least, 0.0);
}

TEST(FreeEdges, AnswerAForceWithoutImages) {
    // Under a force F on the site of a corner u = F/(pi E* r) away from it, in the corner opposite
    // too, and it is that of a wider box. What the lattice has beside the continuum falls as r^-3,
    // and is the only part that repeats: over the displacement it is 0.16/N^2.
    constexpr double F = 0.7;
    for (const bool continuum : {false, true}) {
        const auto displacement = [&](int sites) {
            return displacement_by(F, free_block(sites, 2.6 * sites, 1.0, 0.3, continuum));
        };
        const auto wide = displacement(40);
        const double middle = continuum ? 0.5 : 0.0;
        for (const int sites : {16, 17}) { // grids of 32 and 36
            const auto narrow = displacement(sites);
            for (int y = 0; y < 15; ++y)
                for (int x = 0; x < 15; x += 3) {
                    const double u = narrow(x, y), r = 2.6 * std::hypot(x + middle, y + middle);
                    EXPECT_NEAR(u, wide(x, y), 0.2 / (16 * 16) * u) << x << ", " << y;
                    if (r > (continuum ? 16.0 : 12.0)) {
                        EXPECT_NEAR(u, F / (pi * r), 0.005 * u)
                            << x << ", " << y << " " << continuum;
                    }
                }
        }
    }
}

TEST(FreeEdges, AnswerAForceOnLayersWithoutImages) {
    // Coatings of four cells, ten times as stiff and as soft, and a gradient of three layers: in
    // boxes of 16, 40 and 96 sites the same, and that of the half-space far away.
    constexpr double F = 0.7, a = 2.6;
    const std::vector<std::vector<MaterialLayer>> columns{
        {{{10.0, 0.3}, 4 * a}},
        {{{0.1, 0.3}, 4 * a}},
        {{{0.3, 0.45}, 6 * a}, {{3.0, 0.2}, 6 * a}, {{0.6, 0.3}, 6 * a}}};
    for (const std::vector<MaterialLayer>& layers : columns) {
        const auto on_layers = [&](int sites) {
            BlockOptions o = free_block(sites, a * sites, 1.0);
            o.layers = layers;
            return displacement_by(F, o);
        };
        const auto narrow = on_layers(16), wide = on_layers(40), widest = on_layers(96);
        for (int y = 0; y < 16; y += 3)
            for (int x = 0; x < 16; x += 3) {
                EXPECT_NEAR(narrow(x, y), wide(x, y), 0.7 / (16 * 16) * wide(x, y));
                EXPECT_NEAR(wide(x, y), widest(x, y), 0.7 / (40 * 40) * wide(x, y));
            }
        const double far = F / (pi * a * 94.5);
        EXPECT_NEAR(widest(94, 0), far, 0.03 * far);
    }
}

TEST(FreeEdges, HaveAPositiveComplianceOfAllWavesOfLayers) {
    for (const double young : {0.02, 0.5, 20.0})
        for (const double stress : {0.0, 10.0}) {
            BlockOptions o = free_block(33, 86.0, 1.0);
            o.layers = {{{young, 0.4}, 5 * o.spacing}, {{3.0, 0.2}, 3 * o.spacing}};
            o.surface_stress = stress;
            const FreeEdges edges(o, Slab(o.grid(), Communicator()));
            for (int nx = 0; nx <= o.grid() / 2; ++nx)
                for (int ny = 0; ny <= o.grid() / 2; ++ny)
                    EXPECT_GT(edges.compliance(nx, ny), 0.0) << young << ", " << stress;
        }
}

TEST(FreeEdges, AnswerAForceOnASurfaceStressWithoutImages) {
    // 1/S = 2/(E* q + 2 Y q^2) has u(r) = F/(2 pi Y) integral of exp(-k r t)/sqrt(1 + t^2) over t
    // from 0, k = E*/(2 Y).
    constexpr double F = 0.7, a = 2.6;
    for (const double stress : {2.0, 8.0, 40.0}) { // of a modulus of 1: 2 Y/E* of 4 to 80 Å
        BlockOptions o = free_block(24, 24 * a, 1.0);
        o.surface_stress = stress;
        const auto found = displacement_by(F, o);
        const double k = 0.5 / stress;
        for (int x = 5; x < 24; x += 3) {
            double sum = 0.0;
            const double r = a * std::hypot(x + 0.5, 0.5), step = 1e-3;
            for (double s = 0.5 * step; s < 40.0; s += step) // t = sinh(s)
                sum += std::exp(-k * r * std::sinh(s));
            const double wanted = F / (2.0 * pi * stress) * sum * step;
            EXPECT_NEAR(found(x, 0), wanted, 0.005 * wanted) << stress << ", " << x;
        }
    }
}

TEST(FreeEdges, OfHertz) {
    // R = 20, E* = 102, F = 15 in a box of 1.25 contact diameters, and of 2.5.
    constexpr double R = 20.0, modulus = 102.0, F = 15.0, a = 1.30175, depth = 0.084728;
    double depths[2];
    for (const int wide : {1, 2}) {
        const int sites = 96 * wide;
        const BlockOptions o = free_block(sites, 2.5 * a * wide, modulus);
        Free c(o, paraboloid(sites, o.edge(), R), hard_wall(o), 0.1 * depth);
        c.block.set_uniform(0.0);
        const RelaxedState s = c.relax(Constraint::load(F), 1e-5 * F / (38 * 38), Start::anywhere);
        EXPECT_NEAR(c.radius_of(s), a, 0.005 * a) << sites;
        EXPECT_NEAR(-s.top, depth, 0.005 * depth) << sites;
        EXPECT_NEAR(s[Term::elastic], 0.4 * F * depth, 0.005 * 0.4 * F * depth) << sites;
        depths[wide - 1] = -s.top;
    }
    EXPECT_NEAR(depths[0], depths[1], 1e-3 * depth);
}

TEST(ContactArea, LosesWhatItsEdgesCountTooMuch) {
    // Contacts of some ten sites across, about several points of the mesh: sites at the edge are
    // counted whole, and (pi - 1 + ln 2)/24 of a site for each step of the edge is too much. Hertz'
    // contact in closed form, that of an adhesive sphere against a mesh four times finer.
    constexpr double R = 20.0, modulus = 102.0, F = 15.0, w = 0.1, radius = 1.30175;
    const double K = 4.0 * modulus / 3.0, a0 = std::cbrt(pi * w * R * R / K);
    const double range = 0.4 * a0 * a0 / R, edge = 2.6 * radius;
    struct Area {
        double counted = 0.0, corrected = 0.0; // over that of Hertz
    };
    const auto area_of = [&](int sites, bool sticks, double x0, double y0) {
        const BlockOptions o = free_block(sites, edge, modulus);
        const double spacing = o.spacing;
        Surface s = test::surface_from(
            sites,
            [&](int x, int y) {
                const double dx = spacing * (x + x0 - 0.5 * sites);
                const double dy = spacing * (y + y0 - 0.5 * sites);
                return -(dx * dx + dy * dy) / (2.0 * R);
            },
            spacing);
        const ExponentialWall sticky(w * spacing * spacing, range, 500.0 * pi * modulus * spacing);
        Free c(o, std::move(s), sticks ? sticky : hard_wall(o), sticks ? range : 0.01);
        c.block.set_uniform(sticks ? -c.interface.start_height() : 0.0);
        const RelaxedState state =
            c.relax(Constraint::load(sticks ? 0.0 : F), 1e-5 * F / (38 * 38), Start::anywhere);
        const double counted = static_cast<double>(state.in_contact);
        const auto edges = static_cast<double>(
            c.interface.contact_edges(c.block.lowest_layer(), c.block.communicator()));
        const double unit = spacing * spacing / (pi * radius * radius);
        return Area{counted * unit,
                    (counted - (pi - 1.0 + std::numbers::ln2) / 24.0 * edges) * unit};
    };
    for (const bool sticks : {false, true}) {
        const double wanted = sticks ? area_of(112, true, 0.3, 0.1).corrected : 1.0;
        Area mean;
        for (const auto& [x, y] : {std::pair{0.0, 0.0}, {0.5, 0.5}, {0.3, 0.1}, {0.7, 0.4}}) {
            const Area one = area_of(28, sticks, x, y);
            mean.counted += 0.25 * one.counted / wanted;
            mean.corrected += 0.25 * one.corrected / wanted;
        }
        // What is left is within half of the difference.
        EXPECT_GT(mean.counted, 1.015) << sticks;
        EXPECT_NEAR(mean.corrected, 1.0, 0.5 * (mean.counted - mean.corrected)) << sticks;
        EXPECT_NEAR(mean.corrected, 1.0, sticks ? 0.015 : 0.003) << sticks;
    }
}

TEST(FreeEdges, OfASphereOnACoating) {
    // A coating ten times as stiff, half as thick as Hertz' contact is wide: the depth is between
    // those of both materials, and the same in a box of 1.25 and of 2.5 diameters.
    constexpr double R = 20.0, modulus = 102.0, F = 15.0, a = 1.30175;
    double depths[2];
    for (const int wide : {1, 2}) {
        const int sites = 32 * wide;
        BlockOptions o = free_block(sites, 2.5 * a * wide, modulus);
        o.layers = {{{10.0 * o.young, o.poisson}, 13 * o.spacing}};
        Free c(o, paraboloid(sites, o.edge(), R), hard_wall(o, 3e3), 0.01);
        c.block.set_uniform(0.0);
        depths[wide - 1] = -c.relax(Constraint::load(F), 1e-5 * F / (38 * 38), Start::anywhere).top;
    }
    EXPECT_NEAR(depths[0], depths[1], 1e-3 * depths[1]);
    EXPECT_LT(depths[1], 0.8 * 0.084728);
    EXPECT_GT(depths[1], 1.2 * 0.084728 / std::pow(10.0, 2.0 / 3.0));
}

TEST(FreeEdges, OfTheFlatPunch) {
    // F = 2 R E* delta; a map with holes is a punch. Sites of the edge belong to it in part: the
    // radius is that of its area, and the force goes with it.
    constexpr double radius = 10.0, modulus = 1.0, depth = 0.01;
    double forces[2];
    for (const int wide : {1, 2}) {
        const int sites = 80 * wide;
        const BlockOptions o = free_block(sites, 2.5 * radius * wide, modulus);
        int inside = 0;
        Surface punch = test::surface_from(
            sites,
            [&](int x, int y) {
                const double r =
                    o.spacing * std::hypot(x - 0.5 * sites + 0.5, y - 0.5 * sites + 0.5);
                inside += r < radius;
                return r < radius ? 0.0 : std::numeric_limits<double>::quiet_NaN();
            },
            o.spacing);
        Free c(o, std::move(punch), hard_wall(o), 0.1 * depth);
        c.block.set_uniform(0.0);
        const RelaxedState s =
            c.relax(Constraint::top(-depth), 1e-7 * modulus * depth, Start::anywhere);
        const double of_area = o.spacing * std::sqrt(inside / pi);
        const double wanted = 2.0 * of_area * modulus * depth;
        EXPECT_EQ(s.in_contact, inside);
        EXPECT_NEAR(s.force, wanted, 0.01 * wanted) << sites;
        forces[wide - 1] = s.force;
    }
    EXPECT_NEAR(forces[0], forces[1], 1e-3 * forces[0]);
}

TEST(FreeEdges, OfTheAdhesiveSphere) {
    // In Maugis' units, F0 = pi w R, a0 = (pi w R^2/K)^(1/3), D0 = a0^2/R, a sphere pulled to
    // delta = -0.436 D0 has F = -1.5 F0 and a^3 = 1.5 a0^3 by JKR, where the range of the
    // attraction falls. At a range of 0.4 D0 rings under the same law (scenes/validation/rings.py),
    // without images, have F = -1.6120 F0 and a = 0.997 a0 there, and -1.4171 F0 at delta = 0. The
    // box is 1.25 times as wide as JKR's contact without a load, 6^(1/3) a0.
    constexpr double R = 20.0, modulus = 102.0, w = 0.1, K = 4.0 * modulus / 3.0;
    const double a0 = std::cbrt(pi * w * R * R / K), D0 = a0 * a0 / R, F0 = pi * w * R;
    const double range = 0.4 * D0;
    double forces[2];
    for (const int wide : {1, 2}) {
        const int sites = 64 * wide;
        const BlockOptions o = free_block(sites, 2.5 * std::cbrt(6.0) * a0 * wide, modulus);
        const double area = o.spacing * o.spacing;
        const ExponentialWall law(w * area, range, 500.0 * pi * modulus * o.spacing);
        Free c(o, paraboloid(sites, o.edge(), R), law, range);
        const double tolerance = 1e-5 * law.tension(), start = c.interface.start_height();
        c.block.set_uniform(-start);
        const RelaxedState at_zero = c.relax(Constraint::top(-start), tolerance, Start::anywhere);
        EXPECT_NEAR(at_zero.force, -1.4171 * F0, 0.005 * 1.4171 * F0) << sites;
        RelaxedState s;
        for (int i = 1; i <= 8; ++i)
            s = c.relax(Constraint::top(0.436 * D0 * i / 8 - start), tolerance, Start::near);
        EXPECT_NEAR(s.force, -1.6120 * F0, 0.005 * 1.6120 * F0) << sites;
        EXPECT_NEAR(c.radius_of(s), 0.997 * a0, 0.02 * a0) << sites;
        forces[wide - 1] = s.force;
    }
    EXPECT_NEAR(forces[0], forces[1], 1e-3 * F0);
}
