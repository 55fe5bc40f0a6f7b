// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A block slides over a wall: the friction of one wave in full contact against its closed form, the
// balance of work and losses, no friction of an elastic block, and slides under a load.
#include "support/path_case.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <vector>

using namespace asperity;

namespace {

using std::numbers::pi;
using test::held::top, test::held::height, test::points_of;

InterfaceOptions sliding_over(const WallLaw& wall) {
    InterfaceOptions o = test::over(wall);
    o.slides = true;
    return o;
}

/// A frictionless block over a wall on which it can slide.
struct OnWall {
    BlockOptions options;
    Surface surface;
    ProcessGrid grid;
    Interface interface;
    SpectralBlock block;

    OnWall(const BlockOptions& o, Surface s, const WallLaw& wall)
        : options(o), surface(std::move(s)), grid(test::serial_grid(o)),
          interface(surface, grid.tile(0), o.spacing, sliding_over(wall)),
          block(o, Communicator(), true) {}

    QuasistaticPath path(double velocity, double tolerance, double step,
                         Constraint::Of along = height) {
        PathOptions p;
        p.along = along;
        p.step = step;
        p.tolerance = tolerance;
        p.scales = test::paper_scales();
        p.velocity = velocity;
        p.over_wall = true;
        if (std::visit([](const auto& law) { return law.reach(); }, *interface.options().wall) >
            0.0)
            p.binding_energy = 1.0;
        return {block, interface, p};
    }
    double edge() const { return options.edge(); }
};

BlockOptions block_of(int sites, int thickness, const std::vector<Branch>& branches = {}) {
    BlockOptions o = test::paper_block(sites, thickness, 0);
    o.branches = branches;
    return o;
}

Segment slide(int axis, double by, std::optional<double> load = {}) {
    Segment s{Segment::slide, by, axis, ""};
    s.under = load;
    return s;
}

/// A map h cos(q r), q = 2 pi (kx, ky)/L.
Surface wave(int sites, int kx, int ky, double h) {
    return test::surface_from(
        sites, [=](int x, int y) { return h * std::cos(2.0 * pi * (kx * x + ky * y) / sites); });
}

} // namespace

/// The closed form of a wave in full contact, sigma = 1/4 q q_x h^2 E* sum r w tau/(1 + w^2 tau^2),
/// w = q_x v, over six decades of velocity; the branches begin as they move.
TEST(SlideOverWall, FrictionOfOneWaveIsThatOfTheLossModulus) {
    const double tau = 1e4; // fs
    const std::vector<Branch> branches = {{3.0, 0.01 * tau}, {2.0, tau}, {1.0, 100.0 * tau}};
    const int sites = 64;
    const double h = 0.5;
    struct Way {
        int kx, ky, axis;
    };
    for (const auto& [kx, ky, axis] : {Way{1, 0, 0}, Way{0, 1, 1}, Way{1, -1, 0}, Way{-1, 1, 1}})
        for (double decade = -3.0; decade <= 3.0; decade += axis == 0 && ky == 0 ? 1.0 : 3.0) {
            OnWall c(block_of(sites, 4 * sites, branches), wave(sites, kx, ky, h),
                     ExponentialWall(0.0, 1.0, 1e5));
            const double unit = 2.0 * pi / c.edge(), q = unit * std::hypot(kx, ky),
                         along = unit * (axis == 0 ? kx : ky);
            const double omega = std::pow(10.0, decade) / tau, v = omega / std::abs(along);
            const double modulus = c.options.contact_modulus();
            // Pressed until it is in contact everywhere at any speed.
            const double pressure = 10.0 * 0.5 * modulus * q * h;
            const double mean =
                -c.interface.start_height() - pressure * std::pow(c.options.spacing, 2) / 1e5;
            for (int y = 0; y < sites; ++y)
                for (int x = 0; x < sites; ++x)
                    c.block.layer().z.plane(0)(x, y) =
                        mean + c.surface.height[static_cast<std::size_t>(y * sites + x)];
            c.block.hold(Constraint::mean_height(mean));
            c.block.begin_step(units::forever);
            c.block.end_step();
            const double turning = along > 0.0 ? 1.0 : -1.0;
            const std::vector<RestoredArray> extensions = c.block.memories().front()->arrays();
            for (std::size_t k = 0; k < branches.size(); ++k) {
                const double x = omega * branches[k].time, loss = x / (1.0 + x * x);
                for (int j = 0; j < sites; ++j)
                    for (int i = 0; i < sites; ++i) {
                        const double phase = 2.0 * pi * (kx * i + ky * j) / sites;
                        extensions[k].field->plane(0)(i, j) =
                            h * loss * (x * std::cos(phase) - turning * std::sin(phase));
                    }
            }
            QuasistaticPath path = c.path(v, 1e-6, 0.1);
            path.start_here({.remembers = true});
            path.begin(slide(axis, c.edge()));
            const auto points = points_of(path);
            double series = 0.0;
            for (const Branch& b : branches)
                series += b.ratio * omega * b.time / (1.0 + std::pow(omega * b.time, 2));
            const double sigma = 0.25 * q * std::abs(along) * h * h * modulus * series;
            const double area = c.edge() * c.edge();
            EXPECT_NEAR(path.lateral_work() / c.edge(), sigma * area, 1e-3 * sigma * area)
                << kx << " " << ky << " along " << axis << ", 10^" << decade;
            EXPECT_NEAR(path.in_segment()[Term::in_block], path.lateral_work(),
                        1e-3 * path.lateral_work());
            for (const StepRecord& p : points)
                ASSERT_NEAR(p.force, pressure * area, 1e-6 * pressure * area);
            EXPECT_EQ(path.dissipation().events, 0);
        }
}

/// From rest it comes to the same.
TEST(SlideOverWall, WorkOfASlowCoarseWaveIsOfFourthOrder) {
    // Steps of half a spacing, far longer than the relaxation time: the forces at their ends give
    // (q d)^2/3 more than the closed form.
    const double tau = 1e4, h = 0.3, omega = 1e-3 / tau;
    for (const int sites : {8, 16}) {
        BlockOptions o = block_of(sites, 4 * sites, {{2.0, tau}});
        o.continuum = true;
        OnWall c(o, wave(sites, 1, 0, h), ExponentialWall(0.0, 1.0, 1e5));
        const double q = 2.0 * pi / c.edge(), modulus = c.options.contact_modulus();
        const double area = c.edge() * c.edge(), a = c.options.spacing;
        const double pressure = 10.0 * 0.5 * modulus * q * h;
        QuasistaticPath path = c.path(omega / q, 1e-4, 0.5 * a);
        path.start();
        path.begin({Segment::load, pressure * area, 0, ""});
        points_of(path);
        path.begin(slide(0, 0.5 * c.edge())); // comes to its shape
        points_of(path);
        const Segment more = slide(0, 2.0 * c.edge());
        path.begin(more);
        points_of(path);
        const double sigma = 0.25 * q * q * h * h * modulus * 2.0 * omega * tau;
        const double wanted = sigma * area * more.amount, order = std::pow(q * 0.5 * a, 2) / 3.0;
        EXPECT_NEAR(path.lateral_work(), wanted, 2.0 * order * order * wanted) << sites;
        EXPECT_NEAR(path.work_left_out(), order * wanted, 0.5 * order * wanted) << sites;
    }
}

TEST(SlideOverWall, FrictionOfOneWaveIsReachedFromRest) {
    const double tau = 1e4;
    const int sites = 32;
    const double h = 0.3;
    OnWall c(block_of(sites, 4 * sites, {{2.0, tau}}), wave(sites, 1, 0, h),
             ExponentialWall(0.0, 1.0, 1e5));
    const double q = 2.0 * pi / c.edge(), v = 0.7 / (q * tau), area = c.edge() * c.edge();
    const double modulus = c.options.contact_modulus();
    QuasistaticPath path = c.path(v, 1e-6, 0.1);
    path.start();
    path.begin({Segment::load, 5.0 * 0.5 * modulus * q * h * area, 0, ""});
    points_of(path);
    path.begin(slide(0, 4.0 * c.edge()));
    const auto points = points_of(path);
    const double sigma = 0.25 * q * q * h * h * modulus * 2.0 * 0.7 / (1.0 + 0.49);
    EXPECT_NEAR(-points.back().lateral_force[0], sigma * area, 4e-3 * sigma * area);
}

/// A slide until steady begins in its steady shape: of one wave in full contact from the first
/// point on, slow branches or not, along both axes.
TEST(SlideOverWall, UntilSteadyItBeginsWithTheFrictionOfTheClosedForm) {
    const double tau = 1e4;
    const std::vector<Branch> branches = {{3.0, 0.01 * tau}, {20.0, tau}, {5.0, 1e5 * tau}};
    const int sites = 32;
    const double h = 0.3;
    for (const int axis : {0, 1})
        for (const double omega : {-1e-2 / tau, 1.0 / tau, 1e3 / tau}) { // below 0: backwards
            OnWall c(block_of(sites, 4 * sites, branches),
                     axis == 0 ? wave(sites, 1, 0, h) : wave(sites, 0, 1, h),
                     ExponentialWall(0.0, 1.0, 1e5));
            const double q = 2.0 * pi / c.edge(), area = c.edge() * c.edge();
            const double modulus = c.options.contact_modulus();
            QuasistaticPath path = c.path(std::abs(omega) / q, 1e-6, 0.1);
            path.start();
            path.begin({Segment::load, 60.0 * 0.5 * modulus * q * h * area, 0, ""});
            points_of(path);
            Segment steady = slide(axis, omega > 0.0 ? 2.0 : -2.0);
            steady.until_steady = true;
            path.begin(steady);
            const auto points = points_of(path);
            double series = 0.0;
            for (const Branch& b : branches)
                series += b.ratio * omega * b.time / (1.0 + std::pow(omega * b.time, 2));
            const double force = -0.25 * q * q * h * h * modulus * series * area;
            ASSERT_EQ(points[1].slide, points[0].slide);
            ASSERT_EQ(points[1].time, points[0].time);
            for (std::size_t i = 1; i < points.size(); ++i)
                ASSERT_NEAR(points[i].lateral_force[static_cast<std::size_t>(axis)], force,
                            2e-3 * std::abs(force))
                    << axis << ", " << omega * tau << ", point " << i;
            EXPECT_NEAR(path.lateral_work(), path.in_segment()[Term::in_block],
                        2e-3 * path.lateral_work());
            EXPECT_NEAR(path.work() - path.lateral_work(), path.settling_work(),
                        1e-12 * std::abs(path.settling_work()));
            EXPECT_NEAR(path.work(), path.stored() + path.in_segment()[Term::in_block],
                        2e-3 * path.lateral_work());
        }
}

/// On a rough wall, of which a part is in contact, the shape in which it begins is the one that a
/// long slide comes to; the work of settling keeps the balance.
TEST(SlideOverWall, UntilSteadyItBeginsWhereALongSlideComes) {
    const double tau = 1e4;
    const int sites = 32;
    const Surface hills = test::surface_from(sites, [](int x, int y) {
        const double unit = 2.0 * pi / 32;
        return std::cos(unit * x) + 0.4 * std::cos(unit * (2 * x + y) + 1.0) +
               0.3 * std::cos(unit * (3 * x - 2 * y) + 2.0);
    });
    for (const double adhesion : {0.0, 0.02}) {
        double friction[2] = {}, contact[2] = {};
        for (const bool settled : {false, true}) {
            OnWall c(block_of(sites, sites, {{4.0, tau}}), hills,
                     ExponentialWall(adhesion, 1.5, 50.0));
            const double load = 0.01 * c.options.contact_modulus() * c.edge() * c.edge();
            QuasistaticPath path = c.path(2.0 / tau, 2e-6, 0.5);
            path.start();
            path.begin({Segment::load, load, 0, ""});
            points_of(path);
            Segment s = slide(0, c.edge(), load); // eight times v tau (1 + r), to the same place
            if (!settled) {
                path.begin(s);
                points_of(path);
            }
            s.amount = 2.0 * c.options.spacing;
            s.until_steady = settled;
            path.begin(s);
            const auto points = points_of(path);
            friction[settled] = path.lateral_work() / s.amount;
            contact[settled] = static_cast<double>(points.back().in_contact);
            EXPECT_NEAR(path.work(), path.stored() + path.in_segment().losses(),
                        1e-3 * std::abs(path.lateral_work()) + path.uncertainty());
            EXPECT_EQ(path.settling_work() != 0.0, settled);
        }
        EXPECT_GT(friction[1], 0.0);
        EXPECT_NEAR(friction[1], friction[0], 0.01 * friction[0]) << adhesion;
        EXPECT_NEAR(contact[1], contact[0], 0.02 * contact[0]) << adhesion;
    }
}

/// Work of the slide = stored + dissipated in the block + lost at instabilities; at a held height
/// and under a load, with and without adhesion, along both axes.
TEST(SlideOverWall, WorkIsWhatTheBlockAndInstabilitiesLose) {
    const double tau = 1e4;
    for (const double adhesion : {0.0, 0.05})
        for (const bool loaded : {false, true})
            for (const int axis : {0, 1}) {
                OnWall c(block_of(32, 32, {{3.0, tau}}), test::self_affine(32, 0.5),
                         ExponentialWall(adhesion, 1.5, 50.0));
                const double area = c.edge() * c.edge();
                const double load = 0.01 * c.options.contact_modulus() * area;
                QuasistaticPath path = c.path(10.0 / tau, 2e-6, 0.2);
                path.start();
                path.begin({Segment::load, load, 0, ""});
                points_of(path);
                path.begin(slide(axis, 8.0, loaded ? std::optional(load) : std::nullopt));
                const auto points = points_of(path);
                const double work = path.work(), lateral = path.lateral_work();
                const double spent = path.in_segment().losses();
                ASSERT_GT(lateral, 0.0);
                EXPECT_NEAR(work, path.stored() + spent, 1e-3 * lateral)
                    << adhesion << " " << loaded << " " << axis << " of " << lateral << " in "
                    << points.size();
                if (loaded)
                    for (std::size_t i = 1; i < points.size(); ++i)
                        ASSERT_NEAR(points[i].force, load, 1e-3 * load);
                else
                    EXPECT_EQ(work, lateral);
                EXPECT_GT(path.in_segment()[Term::in_block], 0.2 * lateral);
            }
}

/// An elastic block over a wall that only repels comes back to its energy with every spacing.
TEST(SlideOverWall, AnElasticBlockWithoutAdhesionHasNoFriction) {
    for (const bool loaded : {false, true})
        for (const int axis : {0, 1}) {
            OnWall c(block_of(32, 32), test::self_affine(32, 0.5), ExponentialWall(0.0, 1.5, 50.0));
            const double load = 0.02 * c.options.contact_modulus() * c.edge() * c.edge();
            QuasistaticPath path = c.path(0.0, 1e-6, 0.2);
            path.start();
            path.begin({Segment::load, load, 0, ""});
            points_of(path);
            const double way = 3.0 * c.options.spacing;
            // A first point is under the load to the tolerance of a load segment only.
            path.begin(slide(axis, c.options.spacing, loaded ? std::optional(load) : std::nullopt));
            points_of(path);
            path.begin(slide(axis, way, loaded ? std::optional(load) : std::nullopt));
            const auto points = points_of(path);
            EXPECT_NEAR(path.lateral_work(), 0.0, 1e-6 * load * way) << loaded << axis;
            double largest = 0.0;
            for (const StepRecord& p : points)
                largest =
                    std::max(largest, std::abs(p.lateral_force[static_cast<std::size_t>(axis)]));
            EXPECT_GT(largest, 1e-5 * load) << "sites come into contact one by one";
        }
}

/// The force against the slide is the derivative of the energy along it.
TEST(SlideOverWall, ForceIsTheDerivativeOfTheEnergy) {
    OnWall c(block_of(16, 16), test::self_affine(16, 0.5), ExponentialWall(0.0, 1.5, 50.0));
    QuasistaticPath path = c.path(0.0, 1e-8, 0.2);
    path.start();
    path.begin_to(0.3 - c.interface.start_height());
    points_of(path);
    for (const int axis : {0, 1}) {
        const auto a = static_cast<std::size_t>(axis);
        for (int i = 0; i < 5; ++i) {
            const StepRecord from = path.now();
            const double by = 1e-3;
            path.begin(slide(axis, by));
            points_of(path);
            const StepRecord to = path.now();
            const double mean = -0.5 * (from.lateral_force[a] + to.lateral_force[a]);
            EXPECT_NEAR(to.stored() - from.stored(), mean * by, 2e-4 * std::abs(mean) * by + 1e-9);
            path.begin(slide(axis, 0.83));
            points_of(path);
        }
    }
}

/// Maps move whole spacings as atoms do, and back to where they were; a slide along y over the
/// transposed map is that along x; a cap goes with its map.
TEST(SlideOverWall, TheMapMovesExactly) {
    const int n = 32;
    for (const double radius : {0.0, 400.0}) {
        Surface s = test::self_affine(n, 0.5);
        if (radius > 0.0) {
            s.radius = radius;
            const double a = 2.6;
            for (int y = 0; y < n; ++y)
                for (int x = 0; x < n; ++x)
                    s.height[static_cast<std::size_t>(y * n + x)] +=
                        cap_of(radius, (x - n / 2) * a, (y - n / 2) * a);
        }
        OnWall c(block_of(n, 8), s, ExponentialWall(0.0, 1.5, 50.0));
        const auto at = [&](int x, int y) {
            return s.height[static_cast<std::size_t>(((y + n) % n) * n + (x + n) % n)];
        };
        const double a = c.options.spacing;
        c.interface.slide_to(3.0 * a, -5.0 * a);
        for (int y = 0; y < n; ++y)
            for (int x = 0; x < n; ++x)
                ASSERT_NEAR(c.interface.wall()->height()(x, y), at(x + 3, y - 5), 1e-12);
        c.interface.slide_to(0.4, 1.1);
        std::array<double, 2> mean{};
        const double d = 1e-5;
        for (const std::size_t axis : {0u, 1u}) {
            std::vector<double> before, slope;
            for (int y = 0; y < n; ++y)
                for (int x = 0; x < n; ++x) {
                    before.push_back(c.interface.wall()->height()(x, y));
                    slope.push_back(c.interface.wall()->slope(axis)(x, y));
                    mean[axis] += before.back();
                }
            c.interface.slide_to(0.4 + (axis == 0 ? d : 0.0), 1.1 + (axis == 1 ? d : 0.0));
            for (int y = 0; y < n; ++y)
                for (int x = 0; x < n; ++x) {
                    const auto i = static_cast<std::size_t>(y * n + x);
                    // The rim of a cap has a kink.
                    if (radius > 0.0 && (x == n - 1 || y == n - 1 || x == 0 || y == 0)) continue;
                    ASSERT_NEAR((c.interface.wall()->height()(x, y) - before[i]) / d, slope[i],
                                1e-4);
                }
            c.interface.slide_to(0.4, 1.1);
        }
        c.interface.slide_to(0.0, 0.0);
        for (int y = 0; y < n; ++y)
            for (int x = 0; x < n; ++x)
                ASSERT_NEAR(c.interface.wall()->height()(x, y), at(x, y), 1e-13);
    }
}
