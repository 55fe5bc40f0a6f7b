// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What a path over a sphere says, and the curves of a smooth sphere beside it.
#include "engine/run/curve.hpp"

#include "engine/case/case.hpp"
#include "engine/units.hpp"
#include "io/json.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace asperity {
namespace {

const std::vector<Segment> cycle = {Segment{Segment::approach}, Segment{Segment::pull_off}};

TEST(Paths, OfASphereTellItsRadiusAndItsMeanForce) {
    PathSeries path;
    for (int i = 0; i < 40; ++i) {
        const bool out = i >= 15;
        path.segment.push_back(out ? 1.0 : 0.0);
        // Eight rows in 2 ps. The first row of a segment may lie anywhere between two of the
        // series.
        path.time.push_back(i == 15 ? 0.25 * 16 - 0.1 : 0.25 * i);
        path.force.push_back(i == 20 ? -90.0 : i >= 25 && i < 33 ? -50.0 : 0.0);
        path.contact_fraction.push_back(i == 20 ? 0.04 : 0.01);
    }
    io::Result result;
    add_sphere_path(path, cycle, 100.0, 1000.0, result);
    EXPECT_FALSE(result.number("contact_radius.pull_off")) << "the path has not come to its end";
    result.set("work_of_drive.pull_off", 8.0);
    add_sphere_path(path, cycle, 100.0, 1000.0, result);
    const io::Json json = result.json();
    EXPECT_NEAR(io::find(json, "contact_radius.pull_off")->get<double>(),
                std::sqrt(0.04 * 1e4 / M_PI), 1e-9);
    // The single spike of 90 counts for an eighth of it in the mean.
    EXPECT_NEAR(io::find(json, "jkr.pull_off_averaged")->get<double>(),
                1e3 * 50.0 / (1.5 * M_PI * 1000), 1e-9);
}

/// The value of `key` for a path of rows every 0.1 ps whose force is -1 eV/Å from row `from` for
/// `count` rows of the approach and, 200 rows later, of the pull-off.
double averaged(std::size_t from, std::size_t count, io::Key key) {
    PathSeries path;
    for (std::size_t i = 0; i < 400; ++i) {
        const std::size_t row = i % 200;
        path.segment.push_back(i < 200 ? 0.0 : 1.0);
        path.time.push_back(0.1 * static_cast<double>(i));
        path.force.push_back(row >= from && row < from + count ? -1.0 : 0.0);
        path.contact_fraction.push_back(0.1);
    }
    io::Result result;
    result.set("work_of_drive.pull_off", 1.0);
    add_sphere_path(path, cycle, 1331.2, 100.0, result);
    const std::optional<double> value = result.number(key);
    EXPECT_TRUE(value) << key.name << " is missing";
    return value.value_or(std::nan(""));
}

TEST(Curve, TheRunningMeanIsOverTwoPicoseconds) {
    for (const io::Key key : {io::Key("jkr.approach_averaged"), io::Key("jkr.pull_off_averaged")}) {
        // A force of JKR's pull-off, 3/2 pi w R, in meV/Å^2.
        const double whole = 1e3 / (1.5 * std::acos(-1.0) * 100.0);
        EXPECT_NEAR(averaged(0, 200, key), whole, 1e-12 * whole) << key.name;
        EXPECT_NEAR(averaged(50, 20, key), whole, 1e-12 * whole) << key.name << ": 20 rows fill it";
        EXPECT_NEAR(averaged(50, 19, key), 0.95 * whole, 1e-12 * whole) << key.name;
        EXPECT_NEAR(averaged(0, 10, key), 0.5 * whole, 1e-12 * whole)
            << key.name << ", the first rows";
        EXPECT_NEAR(averaged(190, 10, key), 0.5 * whole, 1e-12 * whole) << key.name << ", the last";
    }
}

} // namespace
} // namespace asperity
