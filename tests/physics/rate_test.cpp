// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A viscoelastic block: the modulus in time, energies of a step, limits of slow and fast paths, a
// layer on a spring that yields (integrated here on its own) and the loss of an oscillation, each
// against its closed form.
#include "engine/options/branches_in_series.hpp"

#include "support/path_case.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <memory>
#include <numbers>
#include <numeric>
#include <random>
#include <stdexcept>
#include <utility>
#include <vector>

using namespace asperity;

namespace {

using test::held::top, test::held::height, test::points_of;
const std::vector<Branch> two = {{1.5, 1000.0}, {0.5, 20000.0}}; // fs
const ExponentialWall hard_law(0.7, 1.3, 1000.0);

BlockOptions relaxing(int sites, int thickness, const std::vector<Branch>& branches) {
    BlockOptions o = test::paper_block(sites, thickness, 0);
    o.branches = branches;
    return o;
}

/// The same, without branches, so much stiffer.
BlockOptions elastic(BlockOptions o, double factor) {
    o.branches.clear();
    o.young *= factor;
    return o;
}

QuasistaticPath path_of(test::PathCase& c, double velocity, double tolerance, double step,
                        Constraint::Of along) {
    PathOptions p;
    p.along = along;
    p.step = step;
    p.tolerance = tolerance;
    p.scales = test::paper_scales();
    p.velocity = velocity;
    return {c.block, c.interface, p};
}

std::vector<StepRecord> lead(QuasistaticPath& path, double to) {
    path.begin_to(to);
    return points_of(path);
}

} // namespace

/// Compliances add up at every frequency, 1/(S0 M) = 1/(S m) + 1/S', and the energy after a jump is
/// that of the springs of both solids.
TEST(Rate, BranchesOfTwoSolidsInSeries) {
    const auto modulus = [](const std::vector<Branch>& branches, std::complex<double> s) {
        std::complex<double> m = 1.0;
        for (const auto& [ratio, time] : branches)
            m += ratio * s * time / (1.0 + s * time);
        return m;
    };
    for (const std::vector<Branch>& own :
         {two, {{4.0, 30.0}}, {{1e-3, 1.0}, {500.0, 1.01}, {3.0, 1e6}}})
        for (double share : {1e-6, 0.1, 0.5, 0.99}) {
            const std::vector<Branch> both = branches_in_series(own, share);
            ASSERT_EQ(both.size(), own.size());
            for (std::size_t k = 0; k < own.size(); ++k) {
                EXPECT_GT(both[k].time, own[k].time);
                if (k + 1 < own.size()) {
                    EXPECT_LT(both[k].time, own[k + 1].time);
                }
            }
            for (double omega = 1e-9; omega < 1e4; omega *= 3.0) { // S = share, S' = 1 - share
                const std::complex<double> s(0.0, omega), softness = 1.0 - share;
                const std::complex<double> sum = softness / modulus(own, s) + share;
                EXPECT_LT(std::abs(1.0 / modulus(both, s) - sum), 1e-12 * std::abs(sum)) << omega;
            }
        }
    // One branch r S with a spring of extension h, after a jump by 1 of both solids.
    const double r = 4.0, tau = 30.0, own = 0.3, other = 0.7, relaxed = own * other;
    const Branch both = branches_in_series({{r, tau}}, own).front();
    for (double t : {0.0, 5.0, 80.0}) {
        const double left = std::exp(-t / both.time);
        const double force = relaxed * (1.0 + both.ratio * left);
        const double second = force / other, first = 1.0 - second, h = (force / own - first) / r;
        EXPECT_NEAR(force * second + own * (first * first + r * h * h),
                    relaxed * (1.0 + both.ratio * left * left), 1e-14)
            << t;
    }
}

/// Stretched at once and held, in steps of any length: E(t)/E = 1 + sum r exp(-t/tau).
TEST(Rate, TheModulusFallsByItsSeries) {
    SpectralBlock block(relaxing(8, 4, two), Communicator(), true);
    SpectralBlock rest(elastic(block.options(), 1.0), Communicator(), true);
    std::mt19937 random(3);
    std::normal_distribution<double> displacement(0.0, 0.1);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x)
            block.layer().z.plane(0)(x, y) = rest.layer().z.plane(0)(x, y) = displacement(random);
    rest.hold(Constraint::top(-0.2));
    Waves<double> g = block.new_waves<double>(), expected = rest.new_waves<double>();
    rest.gradient(expected);
    const double lift =
        rest.acting_stiffness(0, 0).zz * (0.3 + 0.2); // of the jump of the top, relaxed
    // At rest there, and from here moved by the top.
    block.constrain(Constraint::top(0.3));
    block.begin_step(units::forever);
    block.end_step();
    double time = 0.0;
    block.begin_step(1e-12);
    block.constrain(Constraint::top(-0.2));
    for (const double dt : {1e-12, 1.0, 300.0, 300.0, 7.0, 5000.0, 1e5}) {
        if (time > 0.0) block.begin_step(dt);
        block.apply_constraint();
        time += dt;
        double series = 0.0;
        for (const Branch& b : two)
            series += b.ratio * std::exp(-time / b.time);
        block.gradient(g);
        const double uniform = expected.uniform(0) + lift * series;
        EXPECT_NEAR(g.uniform(0), uniform, 1e-12 * std::abs(uniform)) << time;
        EXPECT_NEAR(g.wave(0, 2, 3)[0], expected.wave(0, 2, 3)[0], 1e-12) << time; // did not move
        EXPECT_NEAR(block.top_force(), 64.0 * uniform, 1e-11 * std::abs(uniform)) << time;
        block.end_step();
    }
}

/// The work on the layer in a step, by the formula for what a branch's spring does on average, is
/// stored and dissipated; from steps of a millionth of a relaxation time to a million.
TEST(Rate, WorkIsStoredOrDissipatedInEveryStep) {
    SpectralBlock block(relaxing(8, 4, two), Communicator(), true);
    block.constrain(Constraint::top(0.0));
    const double spring = 64.0 * block.acting_stiffness(0, 0).zz;
    std::mt19937 random(5);
    std::uniform_real_distribution<double> place(-1.0, 1.0), exponent(-6.0, 6.0);
    std::vector<double> h(two.size(), 0.0);
    double w = 0.0, stored = 0.0;
    for (int i = 0; i < 200; ++i) {
        const double dt = 4000.0 * std::pow(10.0, exponent(random)), next = place(random);
        const double scale = i % 2 ? 1.0 : 1e-3;
        block.begin_step(dt);
        block.set_uniform(scale * next);
        const StepEnergies energies = block.energies();
        const double rate = (scale * next - w) / dt;
        double work = 0.5 * spring * (scale * scale * next * next - w * w), energy = 0.0;
        for (std::size_t k = 0; k < two.size(); ++k) {
            const auto& [r, tau] = two[k];
            const long double left = -std::expm1(-static_cast<long double>(dt) / tau); // 1 - e
            work += static_cast<double>(spring * r * rate *
                                        (h[k] * tau * left + rate * tau * (dt - tau * left)));
            h[k] = static_cast<double>(h[k] * (1 - left) + rate * tau * left);
            energy += 0.5 * spring * r * h[k] * h[k];
        }
        EXPECT_NEAR(energies[Term::branches], energy, 1e-12 * (1.0 + energy));
        EXPECT_GE(energies[Term::in_block], 0.0);
        const double now = energies[Term::elastic];
        EXPECT_NEAR(now - stored + energies[Term::in_block], work, 1e-11 * (1.0 + std::abs(work)))
            << "dt " << dt;
        stored = now;
        w = scale * next;
        block.end_step();
    }
}

/// A step that continues another one: the layer goes along the parabola through three places. The
/// branches' springs by their closed form, works and losses by Simpson's rule.
TEST(Rate, AStepThatContinuesAnotherFollowsTheParabola) {
    SpectralBlock block(relaxing(8, 4, two), Communicator(), true);
    block.constrain(Constraint::top(0.0));
    const double spring = 64.0 * block.acting_stiffness(0, 0).zz;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(-1.0, 1.0), exponent(-3.0, 1.3);
    for (int i = 0; i < 40; ++i) {
        const double first = 3000.0 * std::pow(10.0, exponent(random)),
                     dt = first * std::pow(2.0, place(random));
        const double d0 = place(random), d = place(random);
        block.set_uniform(0.0);
        block.begin_step(units::forever);
        block.end_step();
        block.begin_step(first);
        block.set_uniform(d0);
        block.end_step();
        const double curvature = 2.0 * (d / dt - d0 / first) / (dt + first); // Å/fs^2
        const auto rate = [&](double s) { return d / dt + curvature * (s - 0.5 * dt); };
        block.begin_step(dt, first);
        block.set_uniform(d0 + d);
        const StepEnergies energies = block.energies();
        double stored = 0.0, dissipated = 0.0, force = spring * (d0 + d);
        for (const auto& [r, tau] : two) {
            const double h0 = d0 * tau / first * -std::expm1(-first / tau);
            const auto h = [&, tau = tau](double s) {
                const double left = -std::expm1(-s / tau);
                return h0 * (1.0 - left) + rate(0.0) * tau * left +
                       curvature * tau * (s - tau * left);
            };
            const int panels = 20000;
            double loss = 0.0;
            for (int j = 0; j <= panels; ++j) {
                const double weight = j == 0 || j == panels ? 1.0 : j % 2 ? 4.0 : 2.0;
                loss += weight * std::pow(h(dt * j / panels), 2) * dt / panels / 3.0;
            }
            stored += 0.5 * spring * r * h(dt) * h(dt);
            dissipated += spring * r * loss / tau;
            force += spring * r * h(dt);
        }
        EXPECT_NEAR(block.top_force(), force, 1e-9 * (1.0 + std::abs(force))) << dt;
        EXPECT_NEAR(energies[Term::branches], stored, 1e-9 * (1.0 + stored)) << dt;
        EXPECT_NEAR(energies[Term::in_block], dissipated, 1e-9 * (1.0 + dissipated)) << dt;
        block.end_step();
    }
}

/// Along w = (t/T)^3 from rest: what is wrong with h, against its closed form, falls with the third
/// power of the step, and so does twice the sum of the errors that the steps state, which holds it.
TEST(Rate, TheErrorOfStepsInTimeFallsWithTheThirdPower) {
    const std::vector<Branch> one = {{2.0, 1000.0}};
    SpectralBlock block(relaxing(8, 4, one), Communicator(), true);
    block.constrain(Constraint::top(0.0));
    const double spring = 64.0 * block.acting_stiffness(0, 0).zz, tau = 1000.0;
    for (const double span : {500.0, 3000.0, 20000.0}) {
        const double x = span / tau;
        // of dh/ds + x h = 3 s^2 at s = 1
        const double h = 3.0 * (1.0 / x - 2.0 / (x * x) - 2.0 * std::expm1(-x) / (x * x * x));
        std::vector<double> wrong, judged;
        for (const int n : {40, 80, 160}) {
            block.set_uniform(0.0);
            block.begin_step(units::forever);
            block.end_step();
            double error = 0.0;
            StepEnergies energies;
            for (int i = 1; i <= n; ++i) {
                block.begin_step(span / n, i == 1 ? units::forever : span / n);
                block.set_uniform(std::pow(static_cast<double>(i) / n, 3));
                energies = block.energies();
                error += energies.error;
                block.end_step();
            }
            const double there =
                std::sqrt(energies[Term::branches] / spring); // ratio 2: 1/2 S r h^2
            wrong.push_back(2.0 * spring * h * std::abs(there - h));
            judged.push_back(error);
            EXPECT_LT(wrong.back(), 2.0 * judged.back()) << span << " " << n;
        }
        for (std::size_t i = 1; i < wrong.size(); ++i) {
            EXPECT_LT(wrong[i], 0.16 * wrong[i - 1]) << span;
            EXPECT_LT(judged[i], 0.16 * judged[i - 1]) << span;
        }
    }
}

/// A flat layer under the top over a wall: u' from the force balance in time, by Runge and Kutta.
TEST(Rate, APathIsTheMotionOfOneCoordinate) {
    const double velocity = 1e-3, time = 15000.0; // Å/fs, fs
    const SmearedWall smooth(LennardJones{0.1, 3.28, 13.12}, 1.0 / (2.6 * 2.6), false);
    test::PathCase reference(relaxing(8, 3, two), test::flat_surface(8), smooth);
    const double start = reference.interface.start_height();
    const double spring = reference.stretch_stiffness() / 64.0, down = start - 2.0;
    const SmearedWall<LennardJones>::Terms<double> law(smooth);
    struct State {
        double u;
        std::vector<double> h;
    } s{0.0, {0.0, 0.0}};
    for (int i = 0; i < 100; ++i)
        s.u = law.force(start + s.u) / spring;
    const auto rate = [&](const State& at, double v) {
        const double d = 1e-6, z = start + at.u;
        const double stiffness = (law.force(z + d) - law.force(z - d)) / (2.0 * d);
        double all = spring, relaxing = 0.0;
        for (std::size_t k = 0; k < two.size(); ++k) {
            all += spring * two[k].ratio;
            relaxing += spring * two[k].ratio * at.h[k] / two[k].time;
        }
        State r{(all * v + relaxing) / (all - stiffness), {}};
        for (std::size_t k = 0; k < two.size(); ++k)
            r.h.push_back(r.u - v - at.h[k] / two[k].time);
        return r;
    };
    const auto plus = [](State a, const State& b, double dt) {
        a.u += dt * b.u;
        for (std::size_t k = 0; k < a.h.size(); ++k)
            a.h[k] += dt * b.h[k];
        return a;
    };
    const auto integrate = [&](double span, double v) {
        const int steps = 20000;
        const double dt = span / steps;
        for (int i = 0; i < steps; ++i) {
            const State a = rate(s, v), b = rate(plus(s, a, dt / 2), v),
                        c = rate(plus(s, b, dt / 2), v), d = rate(plus(s, c, dt), v);
            for (const auto& [slope, weight] :
                 {std::pair(a, 1.0), std::pair(b, 2.0), std::pair(c, 2.0), std::pair(d, 1.0)})
                s = plus(s, slope, dt * weight / 6.0);
        }
        return start + s.u;
    };
    const double at_end = integrate(down / velocity, -velocity), held = integrate(time, 0.0);

    std::vector<double> errors, held_errors;
    for (const double step : {0.2, 0.1}) {
        test::PathCase c(reference.options, test::flat_surface(8), smooth);
        QuasistaticPath path = path_of(c, velocity, 1e-3 * step * step, step, top);
        path.start();
        lead(path, -down);
        EXPECT_NEAR(path.now().time, down / velocity, 1e-9 * path.now().time);
        errors.push_back(std::abs(path.now().mean_height - at_end));
        path.begin({Segment::hold, time});
        points_of(path);
        EXPECT_NEAR(path.now().time, down / velocity + time, 1e-9 * path.now().time);
        held_errors.push_back(std::abs(path.now().mean_height - held));
        EXPECT_EQ(path.dissipation().events, 0);
    }
    EXPECT_LT(errors.back(), 1e-5);
    EXPECT_LT(held_errors.back(), 1e-5);
    for (std::size_t i = 1; i < errors.size(); ++i)
        EXPECT_LT(errors[i], 0.5 * errors[i - 1]) << i;
}

/// Far slower than it relaxes it is the path at the relaxed modulus, far faster one at the
/// instantaneous; over atoms and a wall, at a held top and a held mean height.
TEST(Rate, SlowAndFastPathsAreElasticOnes) {
    const std::vector<Branch> one = {{2.0, 1000.0}};
    for (const auto along : {top, height})
        for (const bool wall : {false, true}) {
            const Surface rough = test::self_affine(16, 0.5);
            const auto case_of = [&](const BlockOptions& o) {
                return wall ? std::make_unique<test::PathCase>(o, rough, hard_law)
                            : std::make_unique<test::PathCase>(o, rough);
            };
            const BlockOptions block = relaxing(16, 4, one);
            for (const double velocity : {1e-12, 1e6}) { // Å/fs
                const bool fast = velocity > 1.0;
                const auto moving = case_of(block);
                const auto still = case_of(elastic(block, fast ? 3.0 : 1.0));
                QuasistaticPath path = path_of(*moving, velocity, 1e-4, 0.25, along),
                                law = path_of(*still, 0.0, 1e-4, 0.25, along);
                for (QuasistaticPath* p : {&path, &law}) {
                    p->start();
                    lead(*p, 3.0 - moving->interface.start_height());
                }
                EXPECT_NEAR(path.now().force, law.now().force, 2e-3 * std::abs(law.now().force))
                    << wall << fast;
                EXPECT_NEAR(path.now()[Term::elastic], law.now()[Term::elastic],
                            2e-3 * law.now()[Term::elastic])
                    << wall << fast;
                EXPECT_LT(path.now()[Term::in_block], 1e-3 * std::abs(path.now()[Term::interface]));
            }
        }
}

/// If the block cannot jump, the work is stored or dissipated by the block, which gives nothing
/// back: to the stated uncertainty, which falls with the tolerance.
TEST(Rate, WorkIsEnergyPlusWhatTheBlockTook) {
    std::vector<double> stated;
    for (const double tolerance : {1e-3, 1e-4, 1e-5}) {
        test::PathCase c(relaxing(16, 4, two), test::self_affine(16, 0.5), hard_law);
        QuasistaticPath path = path_of(c, 1e-3, tolerance, 0.25, top);
        path.start();
        double uncertainty = 0.0;
        std::vector<StepRecord> points = lead(path, 2.0 - c.interface.start_height());
        uncertainty += path.uncertainty();
        path.begin({Segment::hold, 5000.0});
        for (const StepRecord& r : points_of(path))
            points.push_back(r);
        uncertainty += path.uncertainty();
        for (const StepRecord& r : lead(path, 0.0))
            points.push_back(r);
        uncertainty += path.uncertainty();
        for (std::size_t i = 1; i < points.size(); ++i)
            EXPECT_GE(points[i][Term::in_block], points[i - 1][Term::in_block]);
        const StepRecord& end = points.back();
        EXPECT_EQ(path.dissipation().events, 0);
        EXPECT_GT(end[Term::in_block], 0.1 * std::abs(end[Term::work]));
        const double gap = end[Term::work] - test::energy(end) - end[Term::in_block];
        EXPECT_LT(std::abs(gap), tolerance * c.sites() * 40.0);
        EXPECT_LT(std::abs(gap), uncertainty);
        EXPECT_LT(std::abs(gap), 5e-3 * end[Term::in_block]);
        stated.push_back(uncertainty / end[Term::in_block]);
    }
    EXPECT_LT(stated[1], 0.75 * stated[0]);
    EXPECT_LT(stated[2], 0.75 * stated[1]);
}

/// Pressed to and fro by u0 it loses n pi a_n^2 S''(n w) in a cycle, of each harmonic of a
/// triangle, a_n = 8 u0 / (pi n)^2; S* is that of the block in series with the wall's.
TEST(Rate, ASmallOscillationLosesByTheLossModulus) {
    const double u0 = 0.01, pi = std::numbers::pi;
    for (const double period : {2000.0, 8000.0, 60000.0}) { // fs
        test::PathCase c(relaxing(4, 4, two), test::flat_surface(4), hard_law);
        const double velocity = 4.0 * u0 / period;
        const double pressed = -2.0 - c.interface.start_height();
        c.block.constrain(Constraint::top(pressed));
        c.block.set_uniform(-c.interface.start_height());
        QuasistaticPath path = path_of(c, velocity, 1e-7, u0 / 20.0, top);
        path.start_here({});
        double before = 0.0;
        const int cycles = 2 + static_cast<int>(std::ceil(5.0 * two.back().time / period));
        for (int i = 0; i < cycles; ++i) {
            before = path.now()[Term::in_block];
            lead(path, pressed + u0);
            lead(path, pressed - u0);
        }
        double expected = 0.0;
        for (int n = 1; n < 400; n += 2) {
            const std::complex<double> iw(0.0, 2.0 * pi * n / period);
            std::complex<double> s = c.stretch_stiffness() / 16.0;
            for (const Branch& b : two)
                s += c.stretch_stiffness() / 16.0 * b.ratio * iw * b.time / (1.0 + iw * b.time);
            const std::complex<double> both = 1000.0 * s / (1000.0 + s);
            const double a = 8.0 * u0 / (pi * pi * n * n);
            expected += 16.0 * n * pi * a * a * both.imag(); // n times in a period
        }
        EXPECT_NEAR(path.now()[Term::in_block] - before, expected, 2e-3 * expected) << period;
    }
}

/// What an instability dissipates is told from what the block does where the step over it is short
/// beside the shortest time of the block: on a path that is slow, but not so slow that its shortest
/// step is long.
TEST(Rate, LossesInStepsThatAreLongInTimeAreNotFollowed) {
    BlockOptions options = relaxing(8, 24, {{3.0, 1000.0}, {1.0, 10000.0}});
    options.young *= 0.2;
    for (const double velocity : {1e-7, 1e-16}) {
        test::PathCase c(options, test::self_affine(8, 0.6));
        QuasistaticPath path = path_of(c, velocity, 1e-3, 0.5, top);
        path.start();
        for (const Segment& segment : {Segment{Segment::approach}, Segment{Segment::pull_off}}) {
            path.begin(segment);
            points_of(path);
        }
        const Dissipation& lost = path.dissipation();
        ASSERT_GT(lost.events, 0) << velocity;
        if (velocity < 1e-10)
            EXPECT_NEAR(lost.not_followed, lost.total, 1e-12 * lost.total);
        else
            EXPECT_EQ(lost.not_followed, 0.0);
    }
}

/// Approach, rest and pull-off over a flat and a rough surface, at both controls and velocities
/// over six decades: works, what the block dissipated and what was lost differ from those at a
/// hundredth of the tolerance by less than their standard errors in the root mean square, and never
/// by twice as much; what they add up to is what is stored; and no velocity takes many more points
/// than another, for the block goes through an instability in the same number of steps however
/// slowly it is led.
TEST(Rate, WorksAreKnownToTheirUncertaintyAtAnyVelocity) {
    struct Sums {
        double work = 0.0, losses = 0.0, uncertainty = 0.0, gap = 0.0, scale = 0.0;
        long long points = 0;
    };
    const std::vector<Branch> branches = {{3.0, 1000.0}, {1.0, 10000.0}};
    std::vector<double> off; // differences over their standard errors
    for (const auto along : {top, height})
        for (const bool rough : {false, true}) {
            BlockOptions options = relaxing(8, along == top ? 24 : 8, branches);
            options.young *= 0.2;
            const Surface surface = rough ? test::self_affine(8, 0.6) : test::flat_surface(8);
            const auto cycle = [&](double velocity, double tolerance) {
                test::PathCase c(options, surface);
                QuasistaticPath path = path_of(c, velocity, tolerance, 0.5, along);
                path.start();
                Sums sums;
                for (const Segment& segment :
                     {Segment{Segment::approach}, Segment{Segment::hold, 3e4},
                      Segment{Segment::pull_off}}) {
                    path.begin(segment);
                    sums.points += static_cast<long long>(points_of(path).size()) - 1;
                    const double losses = path.in_segment().losses();
                    const double gap = path.work() - path.stored() - losses;
                    sums.work += path.work();
                    sums.losses += losses;
                    sums.uncertainty += path.uncertainty();
                    sums.gap = std::max(sums.gap, std::abs(gap) - path.uncertainty());
                    sums.scale = std::max(sums.scale, std::abs(path.work()));
                }
                return sums;
            };
            for (const double velocity : {1e-7, 1e-5, 1e-3, 1e-1}) {
                const Sums usual = cycle(velocity, 1e-3), close = cycle(velocity, 1e-5);
                const double may = std::hypot(usual.uncertainty, close.uncertainty);
                off.push_back((usual.work - close.work) / may);
                off.push_back((usual.losses - close.losses) / may);
                EXPECT_LT(std::abs(off.end()[-2]), 2.0) << velocity << rough;
                EXPECT_LT(std::abs(off.back()), 2.0) << velocity << rough;
                EXPECT_LT(usual.gap, 1e-9 * usual.scale) << velocity << rough;
                EXPECT_LT(usual.points, rough ? 3000 : 600) << velocity;
            }
        }
    const double squares = std::inner_product(off.begin(), off.end(), off.begin(), 0.0);
    EXPECT_LT(std::sqrt(squares / static_cast<double>(off.size())), 1.0);
}
