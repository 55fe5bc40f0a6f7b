// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Flat on flat: the numbers of docs/explanation/model.md.
#include "engine/case/flat_reference.hpp"
#include "support/cases.hpp"
#include "support/swept.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace asperity {
namespace {

using test::paper::a, test::paper::r0;

InterfaceOptions with_cutoff(double cutoff, bool tail = false) {
    InterfaceOptions o;
    std::get<LennardJones>(o.potential).cutoff = cutoff;
    o.tail = tail;
    return o;
}

TEST(FlatOnFlat, WorkOfAdhesionOfInfiniteReach) { // for each cutoff: physics/zero_load_test
    const struct {
        double cutoff; ///< r0
        bool tail;
        double allowed;
    } cases[] = {{20.0, false, 0.0075}, // what the cutoff leaves out is below 0.003
                                        // The tail gives back what the cutoff took.
                 {4.0, true, 0.03},
                 {8.0, true, 0.01}};
    for (const auto& c : cases)
        EXPECT_NEAR(
            flat_reference(with_cutoff(c.cutoff * r0, c.tail), a, 512, 512).work_of_adhesion,
            100.53, c.allowed)
            << c.cutoff;
}

TEST(FlatOnFlat, SeparationTensionAndStiffness) {
    const FlatReference flat = flat_reference(with_cutoff(4.0 * r0), a, 512, 512);
    EXPECT_NEAR(flat.separation, 3.11, 0.005);
    EXPECT_NEAR(flat.largest_tension, 9.1, 0.05);
    EXPECT_NEAR(flat.tension_separation - flat.separation, 0.5, 0.05);
    EXPECT_NEAR(flat.stiffness, 0.33, 0.005);
}

/// Energy per area (meV/Å^2) of the flat block, moved sideways as a whole, from the sweep itself.
double swept_energy(int n, int atoms, double ux, double uy, double z, bool tail = false) {
    Surface s = test::flat_surface(atoms);
    s.length = n * a;
    test::State state(n, 0.0, 0.0, 1);
    std::fill(state.u[0].begin(), state.u[0].end(), ux);
    std::fill(state.u[1].begin(), state.u[1].end(), uy);
    return 1e3 * test::sweep(s, state, with_cutoff(4.0 * r0, tail), z, true).sums.energy.value() /
           (n * a * n * a);
}

TEST(FlatOnFlat, OnTopSites) {
    // The least energy on top of the atoms, by a scan; with the tail, for the number is that of no
    // cutoff.
    double least = 0.0, where = 0.0;
    for (double z = 3.3; z < 3.5; z += 0.002) {
        const double energy = swept_energy(6, 6, 0.5 * a, -0.5 * a, z, true);
        if (energy < least) {
            least = energy;
            where = z;
        }
    }
    EXPECT_NEAR(where, 3.40, 0.005);
    EXPECT_NEAR(-least, 80.95, 0.03);
    EXPECT_NEAR(-swept_energy(6, 6, 0.5 * a, -0.5 * a, where), 79.30, 0.005); // at 4 r0
}

TEST(FlatOnFlat, SweepsGiveTheReference) {
    for (int atoms : {12, 19}) // 19 / 12 = 1.583: incommensurate but for the box
        for (bool tail : {false, true}) {
            const FlatReference flat = flat_reference(with_cutoff(4.0 * r0, tail), a, 12, atoms);
            EXPECT_NEAR(-swept_energy(12, atoms, 0.0, 0.0, flat.separation, tail),
                        flat.work_of_adhesion, 1e-9 * flat.work_of_adhesion);
        }
}

TEST(FlatOnFlat, IncommensurateAveragesOverRegistries) {
    // More registries than are sampled: the average has converged.
    const InterfaceOptions o = with_cutoff(4.0 * r0);
    const PairSum coarse = flat_pair_sum(o, a, 23, 37, 3.2);
    EXPECT_NEAR(coarse.energy, 1e-3 * swept_energy(23, 37, 0.0, 0.0, 3.2) * a * a, 1e-12);
    // Nearly the same lattice ratio with other registries (the box is another): 37/23 = 1.6087,
    // 74/46.
    EXPECT_NEAR(flat_pair_sum(o, a, 46, 74, 3.2).energy, coarse.energy, 1e-13);
}

TEST(FlatOnFlat, SaysSoWhereNothingBinds) {
    EXPECT_THROW(flat_reference(with_cutoff(0.5 * r0), a, 16, 16), std::invalid_argument);
}

} // namespace
} // namespace asperity
