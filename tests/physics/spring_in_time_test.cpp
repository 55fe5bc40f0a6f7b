// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A spring between the drive and a top plane with a mass, in time: the period of block and plane on
// the spring, the error of the energy with the time step, the balance of what the drive puts in,
// and the equilibrium in which a damped block ends.
#include "engine/path/path.hpp"
#include "support/cases.hpp"
#include "support/path_case.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace asperity;

namespace {

/// A small rough contact whose top plane a spring holds.
SimulationOptions sprung(double stiffness, double dt = 4.0) {
    SimulationOptions o = test::free_contact(dt);
    o.block.top_spring.stiffness = stiffness;
    return o;
}

test::Driven made(const SimulationOptions& o) {
    return test::simulation(o, test::reference_surface("n8_b_rms1.0"));
}

/// Mass of the nodes of the block.
double mass_of(const SimulationOptions& o) {
    const test::Driven s = made(o);
    return s.block().mass();
}

} // namespace

TEST(SpringInTime, IsTheSpringOfAMass) {
    // Far from the substrate, on a spring that is soft beside the block, the block moves as a body.
    for (const double mass_of_blocks : {1.0, 8.0}) {
        SimulationOptions o = sprung(0.05);
        const double block = mass_of(o);
        o.block.top_spring.mass = mass_of_blocks * block;
        const double period =
            2.0 * std::numbers::pi *
            std::sqrt((1.0 + mass_of_blocks) * block / o.block.top_spring.stiffness);
        o.dt = 10.0;
        test::Driven s = made(o);
        s.Simulation::start(100.0, 1e-4); // both moving
        double before = 0.0, first = 0.0, last = 0.0;
        int crossings = 0;
        for (int n = 0; o.dt * n < 2.6 * period; ++n) {
            const StepRecord& now = s.Simulation::step({}, false);
            if (before < 0.0 && now.top >= 0.0) {
                const double at = now.time - o.dt * now.top / (now.top - before);
                if (crossings++ == 0) first = at;
                last = at;
            }
            before = now.top;
        }
        ASSERT_GE(crossings, 2);
        EXPECT_NEAR((last - first) / (crossings - 1), period, 2e-3 * period) << mass_of_blocks;
    }
}

TEST(SpringInTime, EnergyErrorFallsAsTheSquareOfTheStep) {
    const auto ripple = [](double dt) {
        test::Driven s = made(sprung(5.0, dt));
        s.start(4.5);
        double least = HUGE_VAL, most = -HUGE_VAL, sprung_most = 0.0;
        for (int n = 0; n * dt < 4000.0; ++n) {
            const StepRecord& now = s.step(true);
            least = std::min(least, now.stored()), most = std::max(most, now.stored());
            sprung_most = std::max(sprung_most, now[Term::spring]);
        }
        EXPECT_GT(sprung_most, 1.0) << "the spring takes part, eV";
        return most - least;
    };
    const double coarse = ripple(8.0), middle = ripple(4.0), fine = ripple(2.0);
    EXPECT_NEAR(coarse / middle, 4.0, 0.2);
    EXPECT_NEAR(middle / fine, 4.0, 0.1);
}

TEST(SpringInTime, TheDrivesWorkIsStoredOrDamped) {
    // The balance of an approach and a pull-off with damping, its medium moving with the drive: the
    // residual falls as dt^2, and at the end all of the work is damped or in motion.
    const auto residual = [](double dt) {
        SimulationOptions o = sprung(2.0, dt);
        o.drive.velocity = 1e-3;
        o.drive.ramp = 500.0;
        o.damping = 1e-3;
        test::Driven s = made(o);
        s.start(9.0);
        double most = 0.0;
        for (int n = 0; n * dt < 24000.0; ++n) {
            const StepRecord& now = s.step(true);
            s.drive().observe({now.time, now.force, now.drive, false});
            most = std::max(most, std::abs(now.residual));
        }
        EXPECT_GT(s.balance().damped, 0.0);
        return most;
    };
    const double coarse = residual(8.0), fine = residual(4.0);
    EXPECT_LT(fine, 2e-3);
    EXPECT_NEAR(coarse / fine, 4.0, 0.6);
}

TEST(SpringInTime, ComesToRestInTheStaticState) {
    // Held in contact until nothing moves: the force of the substrate is that of the spring, and
    // the energies are those of the equilibrium with the drive at this place.
    for (const double stiffness : {2.0, 20.0}) {
        SimulationOptions o = test::free_contact(8.0, 0); // a state at rest has no coarse levels
        o.block.top_spring.stiffness = stiffness;
        o.damping = 2e-3;
        test::Driven s = made(o);
        s.start(5.0);
        for (int n = 0; n < 20000; ++n)
            s.Simulation::step({}, false);
        const StepRecord moving = s.Simulation::step({}, true);
        EXPECT_LT(moving[Term::kinetic], 1e-12);
        EXPECT_NEAR(moving.force, stiffness * (moving.top - moving.drive),
                    1e-6 * std::abs(moving.force) + 1e-9);
        EXPECT_NEAR(moving[Term::spring], 0.5 * stiffness * std::pow(moving.top - moving.drive, 2),
                    1e-12);

        test::PathCase rest(o.block, test::reference_surface("n8_b_rms1.0"));
        rest.interface.set_reference_height(5.0);
        copy_layer(std::as_const(s).block().lowest_layer(), rest.block.layer().plane(0));
        RelaxOptions near;
        near.start = Start::near;
        const RelaxedState state = rest.relax(Constraint::top(0.0), 1e-9, near);
        EXPECT_NEAR(state.force, moving.force, 1e-6);
        EXPECT_NEAR(state[Term::spring], moving[Term::spring], 1e-6);
        EXPECT_NEAR(state[Term::elastic], moving[Term::elastic], 1e-6);
        EXPECT_NEAR(state[Term::interface], moving[Term::interface], 1e-6);
    }
}

TEST(SpringInTime, AStiffOneIsARigidMachine) {
    // The plane lags by F/k: with a spring a hundred times stiffer than the block the path is that
    // of a rigid top plane to about as much.
    SimulationOptions o = sprung(0.0, 4.0);
    o.drive.velocity = 5e-4;
    o.drive.ramp = 500.0;
    o.damping = 1e-3;
    SimulationOptions stiff = o;
    const double column = (o.block.lame() + 2.0 * o.block.shear_modulus()) * o.block.spacing *
                          o.block.sites * o.block.sites / o.block.thickness;
    stiff.block.top_spring.stiffness = 100.0 * column;
    stiff.block.top_spring.mass = 1e3 * mass_of(o);
    test::Driven a = made(o), b = made(stiff);
    a.start(9.0), b.start(9.0);
    double most = 0.0, strongest = 0.0;
    for (int n = 0; n < 2500; ++n) {
        const double rigid = a.step(false).force, held = b.step(false).force;
        most = std::max(most, std::abs(rigid - held));
        strongest = std::max(strongest, std::abs(rigid));
    }
    EXPECT_GT(strongest, 0.1);
    EXPECT_LT(most, 0.03 * strongest);
}
