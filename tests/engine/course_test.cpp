// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The course of a path over its own steps or iterations, which stand for seconds: the part that is
// done never falls, the time left does not jump, and the end of a run is foretold.
#include "engine/path/course.hpp"

#include "decomposition/communicator.hpp"
#include "engine/path/path.hpp"
#include "engine/scene/surface.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

using namespace asperity;

namespace {

struct Look {
    double seconds, fraction, left;
};

std::vector<Look> looks_at(const std::vector<std::string>& keys) {
    const Communicator self;
    const Case c = read_case_text("[surface]\nsites = 32\nrms = 1.0\n[block]\nthickness = 32\n",
                                  "test.toml", keys, 1);
    const Surface surface = surface_of(c, self);
    const auto path = path_of(c, surface, self);
    Course course(c, surface.statistics.rms, path->interface().reference_height());
    std::vector<Look> told;
    while (path->status() != Path::Status::done) {
        path->advance({});
        if (!path->has_stepped() || (c.effects.dynamic && path->now().step % 8 != 0)) continue;
        const double seconds =
            0.01 * static_cast<double>(path->iterations().value_or(path->steps()));
        course.look(path->segment(), path->now(), seconds);
        told.push_back({seconds, course.fraction(), course.left()});
    }
    return told;
}

void expect_fair(const std::vector<Look>& told, double by) {
    const double all = told.back().seconds;
    double worst = 0.0;
    for (std::size_t i = 1; i < told.size(); ++i) {
        const Look &now = told[i], &before = told[i - 1];
        EXPECT_GE(now.fraction, before.fraction);
        EXPECT_LE(now.fraction, 0.99);
        if (before.left >= 0.0) {
            EXPECT_LE(now.left, before.left + 3.01 * (now.seconds - before.seconds))
                << "jumps at " << now.seconds << " of " << all;
        }
        if (now.seconds > 0.7 * all)
            worst = std::max(worst, std::abs(now.left - (all - now.seconds)) / all);
    }
    EXPECT_LT(worst, by);

    EXPECT_GT(told.back().fraction, 0.8);
}

} // namespace

TEST(Course, OfADynamicPath) {
    expect_fair(looks_at({"drive.velocity=200", "drive.timestep=20"}), 0.2);
}

TEST(Course, OfAQuasiStaticPathWithAJump) {
    expect_fair(looks_at({"drive.mode=quasistatic"}), 0.1);
    expect_fair(looks_at({"drive.mode=quasistatic", "surface.rms=3"}), 0.3);
}

TEST(Course, OfASoftSolidOverAWall) {
    expect_fair(
        looks_at({"drive.mode=quasistatic", "drive.control=mean-height", "interface.kind=wall",
                  "interface.adhesion=50 mJ/m2", "block.young=20", "surface.rms=3"}),
        0.3);
}

TEST(Course, OfASecondCycleLikeTheFirst) {
    expect_fair(looks_at({"drive.mode=quasistatic",
                          "drive.path=[\"approach\",\"pull-off\",\"approach\",\"pull-off\"]"}),
                0.1);
}

TEST(Course, OfASlide) {
    expect_fair(
        looks_at({"drive.mode=quasistatic",
                  "drive.path=[\"approach\",\"load 300 MPa\",\"slide x 6 Å\",\"pull-off\"]"}),
        0.25);
}
