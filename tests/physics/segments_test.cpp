// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Segments of a path (drive.path): to a load, a height, held, and sideways. A slide is the same as
// displaced sites; its force is minus the gradient of the energy; what a segment's work brings is
// stored or lost; directions and returns are what symmetry makes of them.
#include "engine/dynamics/drive.hpp"
#include "engine/units.hpp"
#include "support/path_case.hpp"
#include "support/swept.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace asperity;
using test::energy;
using test::follow;

namespace {

InterfaceOptions sliding(double cutoff_in_r0 = 4.0) {
    InterfaceOptions o = test::paper_interface(cutoff_in_r0);
    o.slides = true;
    return o;
}

/// A rough contact that can slide, without time.
struct Slider : test::PathCase {
    explicit Slider(Surface s, int thickness = 8)
        : PathCase(test::paper_block(16, thickness, 0), std::move(s)) {
        interface = Interface(surface, grid.tile(0), options.spacing, sliding());
    }
};

Surface rough() { return test::reference_surface("c1_N16_T16_rms0.5"); }

/// Heights with x and y exchanged.
Surface transposed(const Surface& s) {
    return test::surface_from(
        s.sites, [&](int x, int y) { return s.height[static_cast<std::size_t>(x * s.sites + y)]; });
}

double integral(const VelocityProfile& p, double ramp) {
    const double end = p.end(ramp);
    constexpr int n = 20000;
    double sum = 0.0;
    for (int i = 0; i < n; ++i)
        sum += p.at((i + 0.5) * end / n, ramp) * end / n;
    return sum;
}

} // namespace

TEST(VelocityProfiles, EndAtRestAtTheDistance) {
    constexpr double v = 5e-5;
    for (double ramp : {500.0, 20000.0})
        for (double from : {0.0, -v, v, 0.3 * v})
            for (double distance : {3.0, -3.0, 0.02, -0.02, 0.0}) {
                const VelocityProfile p = VelocityProfile::over(distance, from, v, ramp);
                EXPECT_NEAR(integral(p, ramp), distance, 1e-6) << ramp << ", " << from;
                EXPECT_NEAR(p.at(p.end(ramp), ramp), 0.0, 1e-12 * v);
                EXPECT_NEAR(p.at(0.0, ramp), from, 1e-12 * v);
                double before = from, fastest = 0.0;
                for (double t = 0.0; t <= p.end(ramp); t += 10.0) {
                    fastest = std::max(fastest, std::abs(p.at(t, ramp)));
                    // No sudden kick: the ramps may lie one over the other.
                    EXPECT_LE(std::abs(p.at(t, ramp) - before),
                              3.0 * v * std::numbers::pi * 10.0 / ramp);
                    before = p.at(t, ramp);
                }
                EXPECT_LE(fastest, v * (1.0 + 1e-12));
            }
}

TEST(Slides, AreTheSameAsDisplacedSites) {
    // Over a lattice, rows of another spacing, and atoms anywhere; each against the reference loop,
    // which takes any displacement.
    const Tile whole{0, 0, 16, 16, 16};
    unsigned seed = 5;
    InterfaceOptions slow = sliding();
    slow.method = InterfaceMethod::reference;
    const Surface rows = test::scattered(13, 16 * 2.6, 0.4, seed);
    for (const Surface& surface : {rough(), rows, test::disordered(rough())})
        for (const auto& [x, y] : {std::pair{0.4, 0.0}, {1.3, -1.29}, {7.9, 3.1}, {-30.0, 100.3}}) {
            Interface slides(surface, whole, 2.6, sliding());
            Interface still(surface, whole, 2.6, slow);
            test::State state(16, 0.2, 0.2, ++seed);
            const VectorField<double> u = state.on(whole);
            for (double& at : state.u[0])
                at += x;
            for (double& at : state.u[1])
                at += y;
            const VectorField<double> moved = state.on(whole);
            VectorField<double> f(whole, 1), g(whole, 1);
            slides.slide_to(x, y);
            slides.set_reference_height(slides.start_height() - 10.0);
            still.set_reference_height(slides.reference_height());
            const InterfaceSums one = slides.sweep(u.plane(0), f.plane(0), {.observe = true});
            const InterfaceSums other = still.sweep(moved.plane(0), g.plane(0), {.observe = true});
            ASSERT_LT(other.energy.value(), -1.0);
            EXPECT_NEAR(one.energy.value(), other.energy.value(), 1e-9);
            EXPECT_EQ(one.repulsive, other.repulsive);
            EXPECT_LT(
                test::largest_difference(test::values_of(f.plane(0)), test::values_of(g.plane(0))),
                1e-9);
            // Maps too: gaps are over what is below the sites where they are.
            EXPECT_LT(test::largest_difference(slides.maps(u.plane(0)).gap,
                                               still.maps(moved.plane(0)).gap),
                      1e-9);
        }
}

TEST(Slides, WorkIsStoredOrLostAndForceIsTheGradient) {
    for (const auto along : {Constraint::Of::top, Constraint::Of::mean_height}) {
        Slider c(rough());
        constexpr double tolerance = 1e-4, distance = 4.0;
        test::KeptPath path = c.approached(tolerance, 0.1, 0.0, along);
        const auto points = follow(path, {Segment::slide, distance, 0});
        EXPECT_EQ(path.now().slide[0], distance);
        EXPECT_EQ(path.now().slide[1], 0.0);
        const double stored = energy(points.back()) - energy(points.front());
        EXPECT_NEAR(path.work(Segment::slide), stored + path.lost(Segment::slide),
                    path.uncertainty(Segment::slide) + tolerance * c.sites() * distance);
        EXPECT_GT(path.lost(Segment::slide), 1.0) << "it is meant to slip";
        int compared = 0;
        for (std::size_t i = 3; i + 1 < points.size(); ++i) {
            const StepRecord &l = points[i - 1], &r = points[i];
            if (r[Term::lost] != points[i - 3][Term::lost]) continue;
            ForceTrail trail;
            trail.begin(points[i - 3].slide[0], points[i - 3].lateral_force[0]);
            trail.add(points[i - 2].slide[0], points[i - 2].lateral_force[0]);
            trail.add(l.slide[0], l.lateral_force[0]);
            const double h = r.slide[0] - l.slide[0];
            EXPECT_NEAR(-(energy(r) - energy(l)) / h,
                        trail.to(r.slide[0], r.lateral_force[0]).value / h, tolerance * c.sites())
                << r.slide[0];
            ++compared;
        }
        EXPECT_GT(compared, 5);
    }
}

TEST(Slides, ThereAndBackIsNothingWhereNothingSnaps) {
    Slider c(rough(), 4);
    test::KeptPath path = c.approached(1e-6, 0.1);
    const StepRecord before = path.now();
    const long long events = path.dissipation().events;
    follow(path, {Segment::slide, 0.4, 0});
    const double there = path.work(Segment::slide);
    EXPECT_GT(there, 0.1);
    follow(path, {Segment::slide, 0.3, 1});
    follow(path, {Segment::slide, -0.3, 1});
    follow(path, {Segment::slide, -0.4, 0});
    EXPECT_NEAR(path.work(Segment::slide), -there, 1e-3 * there);
    EXPECT_EQ(path.dissipation().events, events);
    EXPECT_EQ(path.now().slide, (std::array{0.0, 0.0}));
    EXPECT_NEAR(energy(path.now()), energy(before), 1e-6 * c.sites());
    EXPECT_NEAR(path.now()[Term::work], before[Term::work], 1e-5 * c.sites());
}

TEST(Slides, OverAPeriodOfACrystalDoNoWorkButWhatIsLost) {
    // A flat crystal looks the same a spacing further on.
    Slider c(test::flat_surface(16), 4);
    test::KeptPath path = c.approached(1e-5, 0.2);
    const StepRecord before = path.now();
    follow(path, {Segment::slide, 2.6, 1});
    EXPECT_NEAR(energy(path.now()), energy(before), 1e-5 * c.sites());
    EXPECT_NEAR(path.work(Segment::slide), path.lost(Segment::slide),
                path.uncertainty(Segment::slide) + 1e-5 * c.sites() * 2.6);
    EXPECT_NEAR(path.now().lateral_force[0], 0.0, 1e-3);
}

TEST(Slides, AlongYAreThoseAlongXOfTheTransposedSurface) {
    double work[2], force[2];
    for (int axis : {0, 1}) {
        Slider c(axis == 0 ? rough() : transposed(rough()), 4);
        test::KeptPath path = c.approached(1e-5, 0.1);
        follow(path, {Segment::slide, -0.7, axis});
        work[axis] = path.work(Segment::slide);
        force[axis] = path.now().lateral_force[static_cast<std::size_t>(axis)];
        EXPECT_EQ(path.now().slide[static_cast<std::size_t>(axis)], -0.7);
    }
    EXPECT_NEAR(work[1], work[0], 1e-4 * std::abs(work[0]));
    EXPECT_NEAR(force[1], force[0], 0.02);
}

TEST(Loads, AreReachedFromBothSidesAndTheirWorkIsTheEnergy) {
    for (const auto along : {Constraint::Of::top, Constraint::Of::mean_height}) {
        Slider c(rough());
        const double tolerance = 1e-5;
        test::KeptPath path = c.approached(tolerance, 0.1, 0.0, along);
        const double area = std::pow(16 * 2.6, 2);
        for (double pressure : {500.0, 50.0, -300.0, 0.0, 0.0}) { // MPa; the last is there already
            const double load = pressure * units::megapascal * area;
            const StepRecord before = path.now();
            const auto points = follow(path, {Segment::load, load});
            EXPECT_NEAR(path.now().force, load, path.slack() + 1e-12) << pressure;
            EXPECT_NEAR(path.work(Segment::load) - path.lost(Segment::load),
                        energy(path.now()) - energy(before),
                        path.uncertainty(Segment::load) + tolerance * c.sites());
            EXPECT_LT(points.size(), 60u) << "a load is found without a search";
        }
        EXPECT_THROW(follow(path, {Segment::load, -1e3 * area}), io::PhysicsError)
            << "no attraction is that large";
    }
}

TEST(Loads, FromOutOfReachAreReachedThroughAttraction) {
    const double area = std::pow(16 * 2.6, 2);
    Slider c(rough(), 8);
    test::KeptPath path = c.path(1e-5, 0.1);
    path.start();
    for (double pressure : {-200.0, 0.0, 100.0}) {
        const double load = pressure * units::megapascal * area;
        follow(path, {Segment::load, load});
        EXPECT_NEAR(path.now().force, load, path.slack() + 1e-12) << pressure;
        EXPECT_GT(path.now().in_contact, 0) << pressure;
        follow(path, {Segment::height, 30.0});
        ASSERT_EQ(path.now().in_contact, 0);
    }
    EXPECT_THROW(follow(path, {Segment::load, -1e3 * area}), io::PhysicsError);
}

TEST(Heights, AreReachedExactly) {
    Slider c(rough());
    test::KeptPath path = c.approached(1e-4, 0.25, 0.0, Constraint::Of::mean_height);
    for (double height : {6.0, 3.5, 3.5, 14.0}) {
        follow(path, {Segment::height, height});
        EXPECT_NEAR(path.now().mean_height, height, 1e-9);
    }
    follow(path, Segment::pull_off);
    EXPECT_EQ(path.now().force, 0.0);
}

TEST(SegmentsInTime, EndWhereTheyShouldAndCloseTheBalance) {
    SimulationOptions o;
    o.block = test::paper_block(16, 8, 0);
    o.interface = sliding();
    o.drive.velocity = 4e-4;
    o.drive.ramp = 500.0;
    o.damping = 1e-3;
    const double area = std::pow(16 * 2.6, 2), load = 300.0 * units::megapascal * area;
    o.drive.path = {{Segment::approach},    {Segment::load, load},     {Segment::slide, 1.5, 0},
                    {Segment::hold, 300.0}, {Segment::slide, -0.7, 1}, {Segment::height, 30.0},
                    {Segment::pull_off}};
    const Surface surface = rough();
    test::Driven s(o, surface, Communicator(), test::serial_grid(o.block));
    s.start(s.interface().start_height());
    double held_at = 0.0;
    std::size_t ended = 0;
    test::lead(s, [&](const StepRecord& now, std::size_t segment, bool over) {
        EXPECT_LT(std::abs(now.residual), 2e-4) << "segment " << segment;
        if (segment == 2) held_at = now.time;
        ended += over;
        if (!over) return;
        switch (segment) {
        case 1:
            EXPECT_GE(now.force, load);
            EXPECT_LT(now.force, load + 1.0);
            break;
        case 2: // the step that ends it stands a step further than what it saw
            EXPECT_NEAR(now.slide[0], 1.5, 1e-6);
            EXPECT_EQ(s.drive().motion(now.time + 1e5).z, 0.0);
            break;
        case 3:
            EXPECT_NEAR(now.time, held_at + 300.0, 2.0 * o.dt);
            EXPECT_NEAR(now.slide[0], 1.5, 1e-6) << "nothing moves";
            break;
        case 4:
            EXPECT_NEAR(now.slide[1], -0.7, 1e-6);
            EXPECT_NEAR(now.slide[0], 1.5, 1e-6);
            break;
        case 5:
            EXPECT_NEAR(now.top, 30.0 - s.interface().reference_height(), 1e-6);
            break;
        default:
            break;
        }
    });
    EXPECT_EQ(ended, 7u);
}

TEST(SegmentsInTime, LoadsFromOutOfReachAreReachedThroughAttraction) {
    SimulationOptions o;
    o.block = test::paper_block(16, 8, 0);
    o.drive.velocity = 4e-4;
    o.drive.ramp = 500.0;
    o.damping = 1e-3;
    const double area = std::pow(16 * 2.6, 2);
    const Surface surface = rough();
    for (double pressure : {-200.0, 0.0, 100.0, -1e5}) {
        const double load = pressure * units::megapascal * area;
        o.drive.path = {{Segment::approach}, {Segment::height, 30.0}, {Segment::load, load}};
        test::Driven s(o, surface, Communicator(), test::serial_grid(o.block));
        s.start(s.interface().start_height());
        double strongest = 0.0;
        const auto lead = [&] {
            test::lead(s, [&](const StepRecord& now, std::size_t segment, bool) {
                if (segment == 2) strongest = std::min(strongest, now.force);
            });
        };
        if (pressure < -1e4) {
            EXPECT_THROW(lead(), io::PhysicsError) << "no attraction is that large";
            continue;
        }
        lead();
        EXPECT_LT(strongest, std::min(load, 0.0)) << pressure;
        EXPECT_GE(s.now().force, load) << pressure;
        EXPECT_LT(s.now().force, load + 2.0) << pressure;
        EXPECT_GT(s.now().in_contact, 0) << pressure;
    }
}

TEST(SegmentsInTime, APullThatIsPassedInOneStepEnds) {
    DriveOptions o;
    o.velocity = 1.0;
    o.load_force = -6.0;
    o.path = {{Segment::approach}, {Segment::load, -5.0}, {Segment::pull_off}};
    Drive drive(o);
    EXPECT_FALSE(drive.observe({1.0, -7.0, 0.0, false}));
    EXPECT_TRUE(drive.observe({2.0, -5.5, 0.0, false})); // back at the load of the approach
    EXPECT_TRUE(drive.observe({3.0, -4.9, 0.0, false})); // from beyond the pull to less in a step
    EXPECT_EQ(drive.segment(), 2u);
}

TEST(SegmentsInTime, ASlowSlideFollowsTheEquilibria) {
    // Force over place of a stiff block that does not snap: what is left goes with the speed.
    Slider c(test::reference_surface("c1_N16_T16_rms0.5", 0.3), 4);
    test::KeptPath path = c.approached(1e-6, 0.05);
    const double pressed = c.interface.start_height() + path.now().top - 0.1;
    follow(path, {Segment::height, pressed});
    const auto still = follow(path, {Segment::slide, 0.5, 0});
    ASSERT_LT(path.lost(Segment::slide), 0.01 * path.work(Segment::slide));
    const auto off = [&](double velocity) {
        SimulationOptions o;
        o.block = c.options;
        o.interface = sliding();
        o.damping = 5e-4; // its medium goes with the top plane, and resists the layers that do not
        o.drive.velocity = velocity;
        o.drive.ramp = 2000.0;
        o.drive.path = {{Segment::approach},
                        {Segment::height, pressed},
                        {Segment::hold, 15000.0},
                        {Segment::slide, 0.5, 0}};
        test::Driven s(o, c.surface, Communicator(), c.grid);
        s.start(c.interface.start_height());
        double largest = 0.0;
        test::lead(
            s,
            [&](const StepRecord& now, std::size_t, bool) {
                if (now.slide[0] > 0.05 && now.slide[0] < 0.45) {
                    const auto right =
                        std::find_if(still.begin(), still.end(), [&](const StepRecord& r) {
                            return r.slide[0] > now.slide[0];
                        });
                    const StepRecord &r = *right, &l = *std::prev(right);
                    const double part = (now.slide[0] - l.slide[0]) / (r.slide[0] - l.slide[0]);
                    const double expected =
                        l.lateral_force[0] + part * (r.lateral_force[0] - l.lateral_force[0]);
                    largest = std::max(largest, std::abs(now.lateral_force[0] - expected));
                }
            },
            false);
        return largest;
    };
    const double scale = std::abs(still.back().lateral_force[0]);
    ASSERT_GT(scale, 1.0);
    const double fast = off(8e-5), slow = off(2e-5);
    EXPECT_LT(slow, 0.05 * scale);
    EXPECT_LT(slow, 0.6 * fast);
}
