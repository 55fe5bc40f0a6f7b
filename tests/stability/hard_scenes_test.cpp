// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The scenes of scenes/hard, run as a user runs them. Each file says in its head what stable means
// for it; here it is held to that. With ASPERITY_LONG set they are followed at a tenth of the
// speed.
#include "support/cases.hpp"
#include "support/run_scene.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace asperity;
using test::number;

namespace {

using test::at_length;

io::Json follow(const std::string& name) {
    Scene scene = read_scene(ASPERITY_SOURCE_DIR "/scenes/hard/" + name + ".toml");
    if (at_length) scene.drive.velocity *= 0.1;
    const io::Scratch scratch;
    const io::Json result = test::run_scene(scene, scratch / "run");
    EXPECT_EQ(io::find(result, "failure"), nullptr) << name;
    return result;
}

struct Hard {
    const char* name;
    double residual; ///< of the energy balance, at most
};

void PrintTo(const Hard& hard, std::ostream* out) { *out << hard.name; }

class HardScene : public testing::TestWithParam<Hard> {};

} // namespace

TEST_P(HardScene, StaysStable) {
    const io::Json result = follow(GetParam().name);
    const double residual = std::abs(number(result, "energy.balance_error"));
    EXPECT_LT(residual, GetParam().residual);
    // The state at zero load is found, no better than flat on flat and no worse than nothing.
    const double fraction = number(result, "binding_energy") / number(result, "delta_gamma");
    EXPECT_GT(fraction, 0.0);
    EXPECT_LT(fraction, 1.0 + 1e-9);
    EXPECT_GT(number(result, "contact_fraction"), 0.0);
    EXPECT_GE(number(result, "energy.elastic"), 0.0);
}

// Bounds: the energy error of Verlet at these speeds, measured (docs/reports/stability.md), times
// ten or so.
INSTANTIATE_TEST_SUITE_P(Scenes, HardScene,
                         testing::Values(Hard{"rough-25A", 1e-4}, Hard{"snap-in-50", 1e-3},
                                         Hard{"epsilon-ten", 5e-3},
                                         Hard{"epsilon-thousandth", 1e-3},
                                         Hard{"poisson-0.49", 1e-3}, Hard{"poisson-negative", 1e-3},
                                         Hard{"one-layer", 1e-3}, Hard{"deep-4096", 1e-4},
                                         Hard{"prime-31", 1e-3}, Hard{"steps-and-spikes", 1e-4},
                                         Hard{"pressed", 1e-3}, Hard{"hot", 5e-3}));

TEST(HardScenes, AFlatSnapInEndsInTheFlatMinimum) {
    const io::Json result = follow("snap-in-50");
    EXPECT_NEAR(number(result, "binding_energy") / number(result, "delta_gamma"), 1.0, 1e-7);
    EXPECT_EQ(number(result, "contact_fraction"), 1.0);
}
