// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What the spacing does not resolve, and by how much: rows of sites that hold the edge of a contact
// over a wall of short range, and waves of a few spacings.
#include "engine/case/spacing_limits.hpp"
#include "engine/case/wall_shape.hpp"
#include "engine/units.hpp"
#include "support/message.hpp"
#include "support/run_scene.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>

namespace asperity {
namespace {

/// A smooth sphere; range in nm. finer: 10 nm over the spacing.
Case sphere(double range, const char* more, int finer = 1) {
    return read_case_text(
        fmt::format("[surface]\nkind = \"flat\"\nsites = {}\nspacing = \"{} nm\"\n"
                    "radius = \"1 µm\"\n[block]\nyoung = \"3 GPa\"\npoisson = 0.33\n[interface]\n"
                    "kind = \"wall\"\nadhesion = \"70 mJ/m²\"\nrange = \"{} nm\"\n{}\n[drive]\n"
                    "mode = \"quasistatic\"\n",
                    32 * finer, 10.0 / finer, range, more),
        "sphere.toml");
}

TEST(SpacingLimits, TheFactorOfThePullOffForceIsThatOfASphere) {
    for (const double range : {0.25, 0.4, 0.6}) {
        const Case c = sphere(range, "edge_pinning = \"allow\"");
        const io::Scratch scratch;
        const io::Json result = test::run_scene(c, scratch / "run");
        const double adhesion = 70.0 / 16.02176634 * 1e-3; // eV/Å^2
        const double found =
            test::number(result, "pull_off_force") / (1.5 * std::numbers::pi * adhesion * 1e4);
        // The contact is 7 spacings wide; of larger ones the factor is nearer.
        EXPECT_NEAR(found / c.edge_pinning, 1.0, 0.15) << range << ": " << found;
        if (c.edge_pinning > 1.05) {
            EXPECT_EQ(test::number(result, "jkr.edge_pinning"), c.edge_pinning);
        } else {
            EXPECT_EQ(io::find(result, "jkr.edge_pinning"), nullptr);
        }
    }
}

TEST(SpacingLimits, ErrorsOfTheMeshCoverHalfOfTheSpacing) {
    const auto result_of = [](double range, const char* law, int finer) {
        const io::Scratch scratch;
        const std::string keys = fmt::format("law = \"{}\"\nedge_pinning = \"allow\"", law);
        return test::run_scene(sphere(range, keys.c_str(), finer), scratch / "run");
    };
    for (const auto& [law, range] : {std::pair{"exponential", 0.6}, {"dugdale", 1.4}}) {
        const io::Json coarse = result_of(range, law, 1), fine = result_of(range, law, 2);
        for (const char* name : {"pull_off_force", "approach_force", "binding_energy",
                                 "work_of_drive.approach", "work_of_drive.pull_off"}) {
            const std::string error = std::string("mesh_error.") + name;
            const double stated = test::number(coarse, error);
            EXPECT_NEAR(test::number(coarse, name), test::number(fine, name), stated)
                << law << ": " << name;
            EXPECT_LT(test::number(fine, error), stated) << law << ": " << name;
            EXPECT_LT(stated, 0.3 * std::abs(test::number(coarse, name))) << law << ": " << name;
        }
    }
    // Single rows hold the edge.
    EXPECT_EQ(io::find(result_of(0.25, "exponential", 1), "mesh_error.pull_off_force"), nullptr);
}

TEST(SpacingLimits, TheFactorDependsOnTheLaw) {
    // A tension that ends suddenly holds the edge in wide strips too.
    struct {
        const char* law;
        double range, largest; // nm; largest tension over adhesion / range
    } const laws[] = {{"dugdale", 0.6, 1.0},
                      {"dugdale", 1.2, 1.0},
                      {"9-3", 0.6, 1.466},
                      {"8-2", 0.5, 1.026},
                      {"power", 1.2, 3.0}};
    for (const auto& [law, range, largest] : laws) {
        const std::string keys = fmt::format("law = \"{}\"\n", law);
        const Case c = sphere(range, (keys + "edge_pinning = \"allow\"").c_str());
        EXPECT_NEAR(c.simulation.interface.shape->shape().tension, largest, 0.02 * largest) << law;
        const io::Scratch scratch;
        const io::Json result = test::run_scene(c, scratch / "run");
        const double adhesion = 70.0 / 16.02176634 * 1e-3; // eV/Å^2
        const double found =
            test::number(result, "pull_off_force") / (1.5 * std::numbers::pi * adhesion * 1e4);
        EXPECT_NEAR(found / c.edge_pinning, 1.0, 0.15) << law << ", " << range << ": " << found;
    }
}

TEST(SpacingLimits, APullOffForceThatIsMuchTooLargeIsRefused) {
    const auto refusal = [](const Case& c) {
        return test::message_of<io::SceneError>([&] { c.require_runnable(); });
    };
    const Case coarse = sphere(0.3, "");
    EXPECT_GT(coarse.edge_pinning, 1.3);
    for (const char* law : {"dugdale", "power", "9-3", "8-2"}) {
        const std::string keys = fmt::format("law = \"{}\"", law);
        const std::string why = refusal(sphere(0.3, keys.c_str()));
        const std::size_t offered = why.find("interface.range = ", why.find("fix"));
        ASSERT_NE(offered, std::string::npos) << law << why;
        const Case followed = sphere(0.1 * std::stod(why.substr(offered + 18)), keys.c_str());
        EXPECT_LT(followed.edge_pinning, 1.055) << law;
    }
    const std::string said = refusal(coarse);
    EXPECT_NE(said.find("interface.range = 3 Å is not resolved"), std::string::npos) << said;
    EXPECT_NE(said.find("interface.edge_pinning = \"allow\""), std::string::npos) << said;
    EXPECT_EQ(refusal(sphere(0.3, "edge_pinning = \"allow\"")), "");
    EXPECT_EQ(refusal(sphere(0.5, "")), "") << "1.1 times";
    // What the message offers resolves the edge.
    const std::size_t at = said.find("interface.range = ", said.find("fix"));
    ASSERT_NE(at, std::string::npos) << said;
    const double enough = 0.1 * std::stod(said.substr(at + 18));
    EXPECT_LT(sphere(enough, "").edge_pinning, 1.05);
}

TEST(SpacingLimits, ALatticeIsSofterForShortWaves) {
    BlockOptions block;
    block.spacing = 2.6;
    block.young = 77.2 * units::gigapascal;
    block.poisson = 0.42;
    const auto of = [&](double spacings) {
        SurfaceStatistics surface;
        surface.spectrum = {{2.0 * std::numbers::pi / (spacings * 2.6), 1.0, 0.0, 8}};
        return lattice_softness(block, surface);
    };
    // Along the axes and the diagonals: 0.9797 and 0.9840, 0.9992 and 0.9998
    // (surface_stiffness_test).
    EXPECT_GT(of(8.0), 0.9797);
    EXPECT_LT(of(8.0), 0.9840);
    EXPECT_NEAR(of(32.0), 0.9995, 3e-4);
    EXPECT_LT(of(2.5), 0.9);
}

} // namespace
} // namespace asperity
