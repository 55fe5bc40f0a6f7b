// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What ends a path, in time and without: nothing that is no physics leaves a result without a word.
#include "engine/path/guard.hpp"

#include "engine/case/case.hpp"
#include "engine/scene/scene.hpp"
#include "support/message.hpp"
#include "support/run_scene.hpp"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

namespace asperity {
namespace {

const std::string rough = "surface.sites = 16\nsurface.rms = 0.7\nblock.thickness = 16\n";
const std::string still = rough + "drive.mode = \"quasistatic\"\n";

io::Json result_of(const std::string& scene) {
    const io::Scratch scratch;
    return test::run_scene(read_scene_text(scene, "scene.toml"), scratch / "run");
}
/// What a run that must not end well says.
template <class Error>
std::string refusal(const std::string& scene) {
    return test::message_of<Error>([&] { result_of(scene); });
}
using test::has, test::number;

TEST(Guard, SeesWhatIsNoPhysics) {
    StepRecord good;
    good.observed = true;
    good.residual = 0.9 * largest_energy_error;
    good.mean_height = -3.0;
    EXPECT_FALSE(violation(good, -4.0, "step 7"));
    for (double residual : {1.1, -1.1, double{NAN}}) {
        StepRecord off = good;
        off.residual = residual * largest_energy_error;
        const auto what = violation(off, -4.0, "step 7");
        ASSERT_TRUE(what) << residual;
        EXPECT_TRUE(has(*what, "energy balance") && has(*what, "step 7")) << *what;
        off.observed = false; // the energies are of an earlier step
        EXPECT_FALSE(violation(off, -4.0, "step 7"));
    }
    for (double StepRecord::*value :
         {&StepRecord::force, &StepRecord::mean_height, &StepRecord::top_force}) {
        StepRecord off = good;
        off.*value = NAN;
        EXPECT_TRUE(violation(off, -4.0, "step 7"));
    }
    EXPECT_TRUE(has(violation(good, -2.0, "point 3").value_or(""), "passed through"));
    // Waves beyond the stability limit have more energy of the time step than any other.
    StepRecord warm = good;
    warm[Term::kinetic] = 3.0, warm[Term::elastic] = 2.0, warm[Term::interface] = -1.0;
    warm[Term::time_step] = -2.9;
    EXPECT_FALSE(violation(warm, -4.0, "step 7"));
    warm[Term::time_step] = -3.1;
    EXPECT_TRUE(has(violation(warm, -4.0, "step 7").value_or(""), "too long for the motion"));
}

TEST(Guard, NoStepJumpsOverThePotential) {
    for (const char* hold : {"top", "mean-height"}) {
        const std::string scene = still + "drive.control = \"" + hold + "\"\n";
        const io::Json as_ever = result_of(scene),
                       huge = result_of(scene + "drive.displacement_step = 1e6\n");
        for (const char* name : {"work_of_drive.approach", "work_of_drive.pull_off"}) {
            EXPECT_GT(std::abs(number(as_ever, name)), 60.0);
            EXPECT_NEAR(number(huge, name), number(as_ever, name), 0.05) << hold << " " << name;
        }
    }
    EXPECT_TRUE(has(refusal<io::SceneError>(rough + "drive.velocity = 1e5\n"), "drive.velocity"));
    // The width is the depth over the largest force: of the exponential law its range.
    const std::string wall = still + "interface.kind = \"wall\"\ninterface.law = \"exponential\"\n"
                                     "interface.range = 1.25\n";
    EXPECT_NEAR(resolve(read_scene_text(wall, "wall.toml")).longest_step, 0.5 * 1.25, 0.01);
}

TEST(Guard, APathWithoutTimeEndsWhereItsEnergyIsOff) {
    EXPECT_TRUE(
        has(refusal<io::PhysicsError>(still + "drive.tolerance = 0.9\n"), "energy balance"));
}

TEST(Guard, AFailedRunGoesOnFromItsLastGoodState) {
    const Case c =
        resolve(read_scene_text("surface.sites = 32\nsurface.rms = 1.5\nblock.thickness = 32\n"
                                "drive.velocity = 60\ndrive.timestep = 73\ndrive.load = 25000\n"
                                "output.series = 5\n",
                                "scene.toml"));
    const io::Scratch scratch;
    RunOptions options;
    options.out = scratch / "run";
    options.progress = io::ProgressMode::off;
    const auto fails = [&] {
        return test::message_of<io::PhysicsError>([&] { run(c, options, Communicator()); });
    };
    const std::string first = fails();
    ASSERT_TRUE(has(first, "is in last-good.h5")) << first;
    options.resume = options.out + "/last-good.h5";
    const std::string second = fails(); // in the same step, to the same bits
    EXPECT_EQ(first.substr(0, first.find("fix:")), second.substr(0, second.find("fix:")));
}

TEST(Guard, APullThatNothingReachesIsNoZeroLoad) {
    const std::string quick = "drive.velocity = 50\ndrive.timestep = 40\n";
    for (const std::string& scene : {rough + quick, still}) {
        EXPECT_TRUE(has(refusal<io::SceneError>(scene + "drive.load = -20000\n"), "drive.load"));
        EXPECT_TRUE(has(refusal<io::PhysicsError>(scene + "drive.load = -8500\n"), "drive.load"));
        EXPECT_GT(number(result_of(scene + "drive.load = -500\n"), "work_of_drive.approach"),
                  -200.0);
    }
    EXPECT_TRUE(has(refusal<io::PhysicsError>(rough + "drive.path = [\"relax\"]\n"
                                                      "drive.load = -8500\n"),
                    "smaller pull"));
}

} // namespace
} // namespace asperity
