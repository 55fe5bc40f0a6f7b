// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Hard cases of motion in time. Each test says first what stable means for it. With ASPERITY_LONG
// set, long paths are as long as in the issue (10^6 steps).
#include "engine/case/case.hpp"
#include "io/error.hpp"
#include "support/cases.hpp"
#include "support/message.hpp"
#include "support/nodes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

using namespace asperity;

namespace {

using test::at_length;

using test::free_contact;

/// Worst energy residual of some observed steps; infinite where something is no number.
double worst_residual(test::Driven& s, int steps) {
    double worst = 0.0;
    for (int n = 0; n < steps; ++n) {
        s.step(true);
        const double r = std::abs(s.now().residual);
        worst = std::isfinite(r) ? std::max(worst, r) : HUGE_VAL;
    }
    return worst;
}

} // namespace

// Overlap. Stable: a motion from inside the wall keeps its energy if the step fits the collision;
// if it does not, the balance says so at once.

TEST(Overlap, MotionKeepsItsEnergyOrSaysSo) {
    // Of the whole layer, 23 eV a site, 4.7 km/s; and of a few sites, 0.6 Å above the highest atom
    // of a rough surface, that fly off by several Å in one step. Finite strain, its cells turned
    // inside out, ends beyond all numbers ten steps later; small strain goes on, and only the
    // balance of its energies tells, within three steps.
    const struct {
        BlockOptions block;
        Surface surface;
        double height, coarse;
        int told, kept; ///< steps
    } cases[] = {{test::paper_block(8, 7, 2), test::flat_surface(8), 1.8, 20.0, 20, 1000},
                 {test::paper_block(32, 32, 3), test::reference_surface("c3_N32_T32_rms1.5"), 5.0,
                  10.0, 3, 100}};
    for (const auto& c : cases)
        for (bool finite : {false, true}) {
            const auto residual = [&](double dt, int steps) {
                SimulationOptions options = free_contact(dt);
                options.block = c.block;
                options.block.finite_strain = finite;
                test::Driven s = test::simulation(options, c.surface);
                s.start(c.height);
                return worst_residual(s, steps);
            };
            EXPECT_LT(residual(0.5, c.kept), 1e-2);
            EXPECT_GT(residual(c.coarse, c.told), 0.02) << "the guard's limit";
        }
}

// Time step. Stable: below the limit the energy of a free block stays bounded, above it diverges,
// and a scene over the limit is refused with the limit and a step to take.

TEST(TimeStep, TheLimitIsSharp) {
    BlockOptions block = test::paper_block(8, 64, 0);
    const double limit = 2.0 / block.highest_frequency(0.0);
    const auto energy_growth = [&](double dt) {
        SimulationOptions options;
        options.block = block;
        options.interface = test::paper_interface();
        options.drive.velocity = 0.0;
        options.dt = dt;
        test::Driven s = test::simulation(options, test::flat_surface(8));
        s.start(40.0); // out of reach
        Block& moving = s.block_to_write();
        test::each_node(moving, [&](const Block::Level& level, int x, int y, int z) {
            moving.fields(level).u.z.view()(x, y, z) = (z % 2 ? 1e-3 : -1e-3) * (1 + x % 3);
        });
        moving.exchange();
        double early = 0.0, late = 0.0;
        for (int n = 0; n < 4000; ++n) {
            const StepRecord& now = s.step(n < 500 || n >= 3500);
            if (!now.observed) continue;
            double& most = n < 500 ? early : late;
            most = std::max(most, now[Term::elastic]);
            if (!std::isfinite(now[Term::elastic])) return HUGE_VAL;
        }
        return late / early;
    };
    const double below = energy_growth(0.99 * limit), above = energy_growth(1.01 * limit);
    EXPECT_LT(below, 3.0);
    EXPECT_GT(above, 1e6);
}

TEST(TimeStep, ASceneOverTheLimitIsRefused) {
    const auto case_at = [](double dt) {
        return read_case_text("[surface]\nsites = 16\n", "test.toml",
                              {"drive.timestep=" + std::to_string(dt)});
    };
    const double limit = case_at(10.0).longest_timestep;
    EXPECT_NO_THROW(case_at(0.99 * limit).require_runnable());
    EXPECT_TRUE(test::has(
        test::message_of<io::SceneError>([&] { case_at(1.01 * limit).require_runnable(); }),
        "is over the stability limit of"));
}

// Long free oscillation. Stable: over 10^5 steps (10^6 at length) the means of the energy over
// tenths of the path lie together, far closer than Verlet's own ripple and than what moves. (Pairs
// that cross the cutoff, where the force has a step of 4.5e-5 eV/Å, leave a random walk some 1e-5
// eV wide.) In mixed precision the energy drifts no more than in double, but for what the means of
// tenths are known to.

namespace {

/// The energy of a free contact over so many steps, eV.
struct Drift {
    double ripple;    ///< greatest less least
    double of_tenths; ///< the same of the means over tenths
    double whole;     ///< mean of the last tenth less that of the first
    double kinetic;   ///< the largest
};

Drift drift_over(int steps, bool mixed) {
    SimulationOptions options = free_contact(10.0);
    options.interface.mixed = mixed;
    test::Driven s = test::simulation(options, test::reference_surface("n8_b_rms1.0"));
    s.start(4.5);
    std::array<double, 10> mean{};
    double least = 1e300, most = -1e300, kinetic = 0.0;
    for (int n = 0; n < steps; ++n) {
        const StepRecord& now = s.step(true);
        const double energy = now[Term::interface] + now[Term::elastic] + now[Term::kinetic];
        least = std::min(least, energy), most = std::max(most, energy);
        kinetic = std::max(kinetic, now[Term::kinetic]);
        mean[static_cast<std::size_t>(n / (steps / 10))] += 10.0 * energy / steps;
    }
    const auto [low, high] = std::minmax_element(mean.begin(), mean.end());
    return {most - least, *high - *low, mean.back() - mean.front(), kinetic};
}

} // namespace

TEST(Oscillation, DoesNotDriftOverAHundredThousandStepsInEitherPrecision) {
    const int steps = at_length ? 1000000 : 100000;
    const Drift exact = drift_over(steps, false), mixed = drift_over(steps, true);
    for (const Drift& drift : {exact, mixed}) {
        EXPECT_GT(drift.kinetic, 0.1) << "nothing moved";
        EXPECT_LT(drift.of_tenths, 0.02 * drift.ripple);
        EXPECT_LT(drift.of_tenths, 1e-3 * drift.kinetic);
    }
    EXPECT_LT(std::abs(mixed.whole), std::abs(exact.whole) + 0.01 * exact.ripple);
    EXPECT_NEAR(mixed.ripple, exact.ripple, 0.02 * exact.ripple);
}

// Levels. Stable: a path over one level or ten keeps its energy.

TEST(Levels, OneAndTen) {
    // Ten levels need 512 sites; 512 cells of 2 layers a level and more.
    const int sites = 512, thickness = 2 * 1023;
    const BlockOptions options = test::paper_block(sites, thickness, 2);
    ASSERT_EQ(level_shapes(options).size(), 10u);
    SimulationOptions s;
    s.block = options;
    s.interface = test::paper_interface();
    s.drive.velocity = 5e-4;
    s.dt = 10.0;
    test::Driven ten = test::simulation(s, test::flat_surface(sites));
    ten.start(3.3);
    const double residual = worst_residual(ten, at_length ? 500 : 30);
    EXPECT_LT(residual, 1e-3);
    s.block = test::paper_block(16, 16, 0);
    ASSERT_EQ(level_shapes(s.block).size(), 1u);
    test::Driven one = test::simulation(s, test::flat_surface(16));
    one.start(3.3);
    EXPECT_LT(worst_residual(one, 300), 1e-3);
}
