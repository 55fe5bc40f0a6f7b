// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The course of a path, dynamic and quasi-static: what comes after what, and that a checkpoint at
// any place of it goes on to the same bits.
#include "engine/path/checkpoint.hpp"
#include "engine/path/path.hpp"
#include "engine/scene/scene.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace asperity {
namespace {

using Status = Path::Status;
using Course = std::vector<Status>;

/// A path of a scene, with the surface that it stands on.
struct Walk {
    explicit Walk(Case of)
        : c(std::move(of)), surface(surface_of(c)), path(path_of(c, surface, Communicator())) {}
    Case c;
    Surface surface;
    std::unique_ptr<Path> path;
};

/// Statuses from the present one to the end, each as often as it is come to anew.
Course course_of(Path& path) {
    Course course = {path.status()};
    while (path.status() != Status::done) {
        EXPECT_TRUE(path.advance({}));
        if (path.status() != course.back()) course.push_back(path.status());
        if (path.steps() > 100000) throw std::runtime_error("a path has no end");
    }
    return course;
}

StateNumbers numbers_of(const Path& path) {
    CollectNumbers collect;
    path.collect(collect);
    return collect.numbers;
}

const std::string small_scene = "surface.sites = 16\nsurface.rms = 0.7\nblock.thickness = 8\n";
const std::string quick = "drive.velocity = 100\ndrive.timestep = 40\n";
const std::string still = "drive.mode = \"quasistatic\"\n";

Case case_of(const std::string& keys) {
    return resolve(read_scene_text(small_scene + keys, "test.toml"));
}

const Course dynamic_leg = {Status::under_way, Status::at_end, Status::behind_end};
const Course state = {Status::relaxing, Status::at_rest};

Course joined(const std::vector<Course>& parts) {
    Course all;
    for (const Course& part : parts)
        all.insert(all.end(), part.begin(), part.end());
    return all;
}

TEST(PathCourse, ASegmentIsMadeEndedAndConcluded) {
    const Course begins = {Status::beginning}, done = {Status::done};
    Walk dynamic(case_of(quick + "drive.path = [\"approach\", \"pull-off\"]\n"));
    EXPECT_EQ(course_of(*dynamic.path),
              joined({begins, dynamic_leg, state, begins, dynamic_leg, done}));

    const Course leg = {Status::under_way, Status::at_end};
    // A load that is there already ends where it begins.
    Walk at_rest(case_of(still + "drive.path = [\"approach\", \"load 0 MPa\", \"pull-off\"]\n"));
    EXPECT_EQ(course_of(*at_rest.path),
              joined({begins, leg, state, begins, {Status::already_at_end}, begins, leg, done}));

    Walk from_state(case_of(still + "drive.path = [\"relax\", \"pull-off\"]\n"));
    EXPECT_EQ(course_of(*from_state.path), joined({begins, state, begins, leg, done}));
}

TEST(PathCourse, ACheckpointAtAnyPlaceGoesOnToTheSameBits) {
    // Between the last step of a segment and its conclusion too.
    for (const std::string& keys :
         {quick, still + "drive.path = [\"approach\", \"load 0 MPa\", \"pull-off\"]\n",
          still + "drive.path = [\"relax\", \"pull-off\"]\n"}) {
        const Case c = case_of(keys);
        Walk whole(c);
        std::vector<std::pair<Status, Snapshot>> kept;
        std::set<std::pair<Status, std::size_t>> seen;
        while (whole.path->status() != Status::done) {
            const Status status = whole.path->status();
            if (seen.emplace(status, whole.path->concluded()).second)
                kept.emplace_back(status, Snapshot()).second.take(*whole.path);
            whole.path->advance({});
        }
        ASSERT_GE(kept.size(), 6u);
        const StateNumbers end = numbers_of(*whole.path);
        for (const auto& [status, snapshot] : kept) {
            Walk resumed(c);
            snapshot.restore(*resumed.path);
            ASSERT_EQ(resumed.path->status(), status);
            course_of(*resumed.path);
            EXPECT_EQ(numbers_of(*resumed.path), end) << keys << static_cast<int>(status);
        }
    }
}

} // namespace
} // namespace asperity
