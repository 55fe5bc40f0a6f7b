// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What a run leaves in its files against each other and against symmetry. The substrate is a ridge:
// its height depends on x alone, so that nothing moves along y and every column of a map is
// constant.
#include "engine/scene/scene.hpp"
#include "support/run_scene.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace asperity {
namespace {

constexpr std::size_t n = 16;
using test::paper::a;

double ridge(double x) { // in units of the box
    return 1.2 * std::sin(2.0 * std::numbers::pi * x) + 0.6 * std::cos(4.0 * std::numbers::pi * x);
}

/// A scene over the ridge, run.
test::Written run_over_ridge(const std::string& drive, const std::string& output) {
    const io::Scratch scratch;
    std::ofstream map(scratch / "ridge.txt");
    for (std::size_t y = 0; y < n; ++y)
        for (std::size_t x = 0; x < n; ++x)
            map << ridge(static_cast<double>(x) / n) << (x + 1 < n ? ' ' : '\n');
    map.close();
    return test::Written(read_scene(
        scratch.write("ridge.toml", "[surface]\nkind = \"file\"\nfile = \"ridge.txt\"\nsites = 16\n"
                                    "[block]\nmodel = \"lattice\"\nthickness = 8\n"
                                    "[interface]\ncutoff = 5.0\ntail = true\n[drive]\n" +
                                        drive + "[output]\n" + output)));
}

TEST(RunFiles, TheVelocityOfAFrameIsThatOfItsStep) {
    // Frames of every step: the velocity of one is the central difference of its neighbours, whose
    // error is of the order dt^2, to the single precision of positions. That of half a step before
    // is another.
    const test::Written run = run_over_ridge(
        "velocity = \"800 m/s\"\ntimestep = \"10 fs\"\nramp = \"0 ps\"\nmax_steps = 300\n",
        "trajectory = 1\nvelocities = true\n");
    const io::Hdf5File& file = *run.file;
    const auto position = file.read<float>("/particles/trajectory/position/value");
    const auto velocity = file.read<float>("/particles/trajectory/velocity/value");
    const auto time = file.read<double>("/particles/trajectory/position/time");
    constexpr std::size_t frame = 3 * n * n;
    ASSERT_EQ(position.size(), 300 * frame);
    ASSERT_EQ(velocity.size(), 300 * frame);
    double central = 0.0, backward = 0.0;
    for (std::size_t k = 1; k + 1 < 300; ++k) {
        const double dt = time[k] - time[k - 1];
        EXPECT_NEAR(dt, 0.01, 1e-12);
        for (std::size_t i = k * frame; i < (k + 1) * frame; ++i) {
            const auto at = [&](std::size_t place) { return static_cast<double>(position[place]); };
            const auto off = [&](double speed) { return std::abs(speed - velocity[i]); };
            central = std::max(central, off((at(i + frame) - at(i - frame)) / (2.0 * dt)));
            backward = std::max(backward, off((at(i) - at(i - frame)) / dt));
        }
    }
    EXPECT_LT(central, 5e-4) << "Å/ps; a last digit of 42 Å over 20 fs is 2e-4";
    EXPECT_GT(backward, 20.0 * central);
}

TEST(RunFiles, TheMapsOfAPullOffAreOfTheLastOneWhereItAttractedMost) {
    const auto run = [](const std::string& path) {
        return test::Written("[surface]\nsites = 16\nrms = 1\nseed = 4\n[block]\nthickness = 16\n"
                             "[drive]\nmode = \"quasistatic\"\ncontrol = \"mean-height\"\n"
                             "path = [" +
                             path + "]\n[output]\nfields = [\"pull-off\"]\n");
    };
    const std::string cycle = "\"approach\", \"pull-off\"", slide = "\"slide x 1.3 Å\"";
    const auto gap = [](const test::Written& of) {
        return of.file->read<double>("/fields/pull-off/gap");
    };
    // What comes after it changes nothing.
    const auto once = run(cycle), slid = run(cycle + ", \"approach\", " + slide);
    EXPECT_EQ(gap(once), gap(slid));
    // Of two it is the last one, whichever attracted more; the map says where it was made.
    const auto twice = run(cycle + ", \"approach\", " + slide + ", \"pull-off\"");
    const auto attraction = [&](std::size_t segment) {
        return twice.json["segments"][segment].at("largest_attraction").get<double>();
    };
    ASSERT_GT(attraction(1), attraction(4)) << "the case must tell";
    EXPECT_EQ(twice.file->number_attribute("/fields/pull-off", "slide_x"), 1.3);
}

TEST(RunFiles, ThePathOverARidgeMovesAcrossItAndNotAlong) {
    const test::Written run =
        run_over_ridge("velocity = \"50 m/s\"\ntimestep = \"20 fs\"\n",
                       "series = 10\ntrajectory = 20\nvelocities = true\nfields = [\"relaxed\"]\n");
    const io::Hdf5File& file = *run.file;
    const auto position = file.read<float>("/particles/trajectory/position/value");
    const auto velocity = file.read<float>("/particles/trajectory/velocity/value");
    ASSERT_EQ(position.size() % (3 * n * n), 0u);
    ASSERT_EQ(position.size(), velocity.size());
    double across = 0.0, along = 0.0, across_speed = 0.0, along_speed = 0.0;
    for (std::size_t i = 0; i < position.size() / 3; ++i) {
        const std::size_t site = i % (n * n);
        const double x = (static_cast<double>(site % n) + 0.5) * a;
        const double y = (static_cast<double>(site / n) + 0.5) * a;
        across = std::max(across, std::abs(position[3 * i] - x));
        along = std::max(along, std::abs(position[3 * i + 1] - y));
        across_speed = std::max<double>(across_speed, std::abs(velocity[3 * i]));
        along_speed = std::max<double>(along_speed, std::abs(velocity[3 * i + 1]));
    }
    EXPECT_LT(along, 1e-5) << "single precision of 42 Å";
    EXPECT_GT(across, 0.05);
    EXPECT_LT(across, 1.0);
    EXPECT_LT(along_speed, 1e-6);
    EXPECT_GT(across_speed, 0.01);
    // The maps likewise: constant along y, and the gap follows the ridge.
    for (const char* name : {"gap", "pressure", "u_x", "u_z"}) {
        const auto map = file.read<double>(std::string("/fields/relaxed/") + name);
        const auto [least, most] = std::minmax_element(map.begin(), map.begin() + n);
        EXPECT_GT(*most - *least, 1e-2) << name;
        for (std::size_t i = 0; i < map.size(); ++i)
            EXPECT_NEAR(map[i], map[i % n], 1e-6) << name; // steps are in single precision
    }
    for (double uy : file.read<double>("/fields/relaxed/u_y"))
        EXPECT_NEAR(uy, 0.0, 1e-6);
}

} // namespace
} // namespace asperity
