// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Hard cases of states at rest, and of the theory: where a path cannot start, or where a limit is
// sharp. Each test says first what stable means for it.
#include "engine/theory/theory_case.hpp"
#include "io/error.hpp"
#include "support/path_case.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace asperity;

// Overlap. Stable: a relaxation from inside the wall ends in the same state as one from outside,
// for no site jumps. A site that starts below the tops of the substrate may be pushed through, for
// the wall is one layer of atoms: then the end is another state, but still one. (No run starts
// there: it comes from out of reach.)

TEST(Overlap, RelaxationComesOutOfTheWall) {
    for (const char* map : {"n8_a_rms0.4", "n8_b_rms1.0"}) {
        const Surface surface = test::reference_surface(map);
        const BlockOptions options = test::paper_block(8, 8, 0);
        const InterfaceOptions potential = test::paper_interface();
        const double outside = test::relax_levels(options, potential, surface, 1e-6).binding_energy;
        const auto from = [&](double height) {
            test::PathCase c(options, surface);
            c.block.set_uniform(height - c.interface.start_height());
            const double area = std::pow(options.sites * options.spacing, 2);
            return -1e3 * test::energy(c.relax({}, 1e-6)) / area;
        };
        for (double above : {1.0, 0.5, 0.1})
            EXPECT_NEAR(from(surface.statistics.highest + above), outside, 1e-7 * outside) << map;
        EXPECT_TRUE(std::isfinite(from(surface.statistics.lowest + 0.1))) << map;
    }
}

// Poisson's ratio, thickness, sites. Stable: lattice and spectral block find one state. (That the
// elastic energy is positive and no mode faster than the bulk's limit: engine/block_test.)

namespace {

struct Ends {
    int sites, thickness;
    double poisson = 0.42, rms = 0.4, tolerance = 1e-6, allowed = 1e-7;
    double cutoff = 3.0; ///< r0
    std::uint64_t seed = 1;
};
void PrintTo(const Ends& e, std::ostream* out) {
    *out << e.sites << " sites, " << e.thickness << " layers, Poisson's ratio " << e.poisson;
}
class AtTheEnds : public testing::TestWithParam<Ends> {};

} // namespace

TEST_P(AtTheEnds, LatticeAndSpectralBlockAgree) {
    const Ends& c = GetParam();
    BlockOptions options = test::paper_block(c.sites, c.thickness, 0);
    options.poisson = c.poisson;
    const Surface surface = test::self_affine(c.sites, c.rms, c.seed);
    const InterfaceOptions potential = test::paper_interface(c.cutoff);
    const auto lattice = test::relax_levels(options, potential, surface, c.tolerance);
    const auto spectral = test::relax_spectral(options, potential, surface, c.tolerance);
    ASSERT_TRUE(lattice.state.converged && spectral.state.converged);
    EXPECT_NEAR(lattice.binding_energy, spectral.binding_energy,
                c.allowed * spectral.binding_energy);
    EXPECT_NEAR(static_cast<double>(spectral.state.in_contact),
                static_cast<double>(lattice.state.in_contact), 0.002 * c.sites * c.sites);
    if (c.sites > 17 || c.thickness != 7) return;
    // With levels: what cannot be halved stays one level.
    options = test::paper_block(c.sites, c.thickness, 2);
    const auto levels = test::relax_levels(options, potential, surface, c.tolerance);
    ASSERT_TRUE(levels.state.converged);
    EXPECT_EQ(level_shapes(options).size(), c.sites % 2 ? 1u : 2u);
    EXPECT_NEAR(levels.binding_energy, lattice.binding_energy,
                (c.sites % 2 ? 1e-9 : 0.05) * lattice.binding_energy);
}

INSTANTIATE_TEST_SUITE_P(
    Limits, AtTheEnds,
    testing::Values(Ends{8, 6, -0.5, 0.4, 1e-5, 1e-6}, Ends{8, 6, 0.0, 0.4, 1e-5, 1e-6},
                    Ends{8, 6, 0.25, 0.4, 1e-5, 1e-6}, Ends{8, 6, 0.49, 0.4, 1e-5, 1e-6},
                    Ends{8, 6, 0.4999, 0.4, 1e-5, 1e-6}, Ends{8, 1, 0.42, 1.0, 1e-6, 1e-8},
                    Ends{8, 7}, Ends{9, 7}, Ends{11, 7}, Ends{13, 7}, Ends{15, 7}, Ends{17, 7},
                    Ends{32, 12, 0.42, 1.5, 1e-4, 1e-3, 4.0, 11},
                    Ends{48, 6, 0.42, 2.5, 1e-4, 1e-3, 3.0, 12},
                    Ends{64, 4, 0.42, 1.0, 1e-4, 1e-3, 2.5, 13}));

TEST(Thickness, FourThousandLayers) {
    // Sideways the block hangs on a spring of mu / thickness: it binds better the thicker it is,
    // and what is left to gain falls like one over the thickness.
    const Surface surface = test::reference_surface("n8_b_rms1.0");
    const auto binding = [&](int thickness) {
        return test::relax_spectral(test::paper_block(8, thickness, 0), test::paper_interface(),
                                    surface, 1e-7)
            .binding_energy;
    };
    const double first = binding(2048) - binding(1024), second = binding(4096) - binding(2048);
    EXPECT_GT(first, 0.0);
    EXPECT_NEAR(first / second, 2.0, 0.05);
}

// Load. Stable: the relaxed state carries what pulls or presses it, up to fifty times the largest
// tension.

TEST(Load, FromAPullToHuge) {
    const BlockOptions options = test::paper_block(8, 8, 2);
    const Surface surface = test::reference_surface("n8_b_rms1.0");
    const double area = std::pow(options.sites * options.spacing, 2);
    double height_before = 1e300;
    for (double gpa : {-1.0, 0.0, 1.0, 10.0, 100.0, 500.0}) {
        test::PathCase c(options, surface);
        c.block.set_uniform(4.0 - c.interface.start_height());
        const double load = gpa / 160.21766 * area;
        const RelaxedState state = c.relax(Constraint::load(load), 1e-6);
        EXPECT_NEAR(state.force, load, 1e-6 * 64) << gpa;
        EXPECT_LT(state.mean_height, height_before) << "pressed further";
        height_before = state.mean_height;
    }
}

// Bifurcation. Stable: where the state jumps, the relaxation still ends, in one of the two states,
// forces below the tolerance; either side of the jump is what it was far from it.

TEST(Bifurcation, TheRelaxationEndsOnOneBranch) {
    test::PathCase c(test::paper_block(8, 200, 0), test::flat_surface(8));
    const double start = c.interface.start_height();
    const auto state_at = [&](double top) {
        c.block.set_uniform(top);
        return c.relax(Constraint::top(top), 1e-5);
    };
    // From above, out of contact; and, further down, snapped in.
    const auto gap = [&](const RelaxedState& s) { return start + s.mean_height; };
    double above = 11.0 - start, below = 3.0 - start;
    ASSERT_GT(gap(state_at(above)), 8.0);
    ASSERT_LT(gap(state_at(below)), 4.0);
    for (int halving = 0; halving < 40; ++halving) {
        const double middle = 0.5 * (above + below);
        (gap(state_at(middle)) > 4.0 ? above : below) = middle;
    }
    const double out = gap(state_at(above)), in = gap(state_at(below));
    EXPECT_GT(out, 4.2);
    EXPECT_LT(in, 3.6);
    EXPECT_LT(above - below, 1e-10);
}

// Theory. Stable: at the ends of what a scene may say it gives a finite answer, not below nothing
// and, where the true area is not counted, not above flat; or it says which key it cannot work
// with.

TEST(Theory, AtTheEndsOfItsKeys) {
    int answers = 0, refusals = 0;
    for (const char* rms : {"0.001", "0.5", "3", "30", "300"})
        for (const char* hurst : {"0", "0.5", "1"})
            for (const char* epsilon : {"1e-4", "0.1", "10"})
                for (const char* rolloff : {"1", "3", "200"})
                    for (const char* area : {"gaussian", "none"}) {
                        const std::string what = std::string(rms) + " " + hurst + " " + epsilon +
                                                 " " + rolloff + " " + area;
                        try {
                            const Case scene =
                                read_case_text("[surface]\nsites = 512\n", "test.toml",
                                               {std::string("surface.rms=") + rms,
                                                std::string("surface.hurst=") + hurst,
                                                std::string("interface.epsilon=") + epsilon,
                                                std::string("surface.rolloff=") + rolloff,
                                                std::string("theory.area_factor=") + area});
                            const TheoryCase c = theory_case(scene);
                            const TheoryNumbers n = solve_theory(c);
                            EXPECT_TRUE(std::isfinite(n.gamma_eff)) << what;
                            EXPECT_GE(n.gamma_eff, 0.0) << what;
                            if (std::string(area) == "none") {
                                EXPECT_LE(n.gamma_eff, c.delta_gamma * (1.0 + 1e-9)) << what;
                            }
                            ++answers;
                        } catch (const io::SceneError& error) {
                            EXPECT_NE(std::string(error.what()).find("surface."), std::string::npos)
                                << what << ": " << error.what();
                            ++refusals;
                        }
                    }
    EXPECT_GT(answers, 100);
}
