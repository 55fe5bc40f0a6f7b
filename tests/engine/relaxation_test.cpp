// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The relaxation's own promises: the work of a load, an honest answer when it may not go on.
// (Loads carried, and starts elsewhere: stability/limits_test.)
#include "engine/statics/zero_load.hpp"
#include "support/path_case.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace asperity;

namespace {

struct Contact : test::PathCase {
    double height = height_of_strongest_attraction(block, interface, surface.statistics.lowest,
                                                   test::paper_scales().length);
    Phases phases;

    Contact() : PathCase(test::paper_block(8, 6, 0), test::reference_surface("n8_b_rms1.0")) {
        interface.set_reference_height(height);
    }
    RelaxedState relax_with(double tolerance, double load = 0.0, long long most = 200000) {
        RelaxOptions o;
        o.tolerance = tolerance;
        o.scales = test::paper_scales();
        o.max_iterations = most;
        return asperity::relax(block, interface, Constraint::load(load), o, phases);
    }
};

RelaxedState relax_rough(int sites, double rms, double tolerance) {
    return test::relax_spectral(test::paper_block(sites, sites, 0), test::paper_interface(),
                                test::self_affine(sites, rms), tolerance)
        .state;
}

} // namespace

TEST(Relaxation, ReleasesTheWorkOfTheLoad) {
    // d(U + F z_top)/dF = z_top (Castigliano), by symmetric differences; the error is h^2 times a
    // compliance's change, measured 2.6e-4 at h = 0.5, so near 3e-6 at 0.05.
    const auto enthalpy = [](double load) {
        Contact c;
        const auto s = c.relax_with(1e-8, load);
        return test::energy(s) + load * c.block.top();
    };
    Contact c;
    c.relax_with(1e-8);
    const double h = 0.05;
    EXPECT_NEAR((enthalpy(h) - enthalpy(-h)) / (2 * h), c.block.top(), 1e-5);
}

TEST(Relaxation, SaysWhenItHasNotConverged) {
    Contact c;
    const auto state = c.relax_with(1e-8, 0.0, 10);
    EXPECT_FALSE(state.converged);
    EXPECT_EQ(state.iterations, 10);
    EXPECT_GT(state.residual, 1e-8);
}

TEST(Relaxation, IterationsHardlyGrow) {
    // In full contact, in half of it, and held by a few summits.
    for (double rms : {1.0, 3.0, 8.0}) {
        const RelaxedState small = relax_rough(32, rms, 1e-4), large = relax_rough(128, rms, 1e-4);
        ASSERT_TRUE(small.converged && large.converged);
        EXPECT_LT(large.iterations, 2 * std::max(100LL, small.iterations));
    }
}

TEST(Relaxation, GivesUpWhereNothingGetsBetter) {
    const RelaxedState s = relax_rough(16, 1.0, 1e-18);
    EXPECT_FALSE(s.converged);
    EXPECT_LT(s.iterations, 10000);
    EXPECT_LT(s.residual, 1e-3);
}

TEST(Relaxation, WhatIsNoNumberIsNoEquilibrium) {
    Contact c;
    state_to_restore(c.block)[2].field->view()(3, 3, 0) = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(c.relax_with(1e-2).converged);
}

TEST(Relaxation, ReportsForcesAndEnergiesOfDoublePrecision) {
    // Iterations may be swept in single precision; what is told of the state is not.
    BlockOptions options = test::paper_block(32, 32, 0);
    const Surface surface = test::self_affine(32, 1.0);
    SpectralBlock block(options, Communicator());
    InterfaceOptions both = test::paper_interface();
    both.mixed_on_request = true;
    Interface interface(surface, block.tile(), options.spacing, both);
    const double height = height_of_strongest_attraction(
        block, interface, surface.statistics.lowest, test::paper_scales().length);
    interface.set_reference_height(height);
    const auto energy = [&](bool rough) {
        return interface
            .sweep(block.lowest_layer(), block.interface_force(),
                   {.observe = true, .mixed_precision = rough})
            .energy.value();
    };
    Phases phases;
    for (const bool stopped : {true, false}) { // while contact spreads, and at the end
        RelaxOptions o;
        o.tolerance = 1e-3;
        o.scales = test::paper_scales();
        if (stopped) o.report = [](long long, double) { return true; };
        const RelaxedState state = relax(block, interface, {}, o, phases);
        ASSERT_EQ(state.converged, !stopped);
        EXPECT_EQ(state[Term::interface], energy(false));
        EXPECT_NE(state[Term::interface], energy(true))
            << "the two must differ, or nothing is tested";
    }
}
