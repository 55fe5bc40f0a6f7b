// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "io/error.hpp"
#include "io/result.hpp"

#include "support/scratch.hpp"

#include <limits>

namespace asperity::io {
namespace {

TEST(Result, HasTheNamesOfTheContract) {
    ResultRecord r;
    r.scene["surface"]["sites"] = 128;
    r.surface = {1, 2, 3, 4, "somebody's"};
    r.delta_gamma = r.binding_energy = 5;
    r.work_of_adhesion = {6, 7, 8};
    r.contact_fraction = r.pushed_fraction = r.pull_off_force = 0.5;
    r.jkr = {1, 2};
    r.theory = {1, 2, 3};
    r.energy = {1, 2, 3, 4, 5, 6};
    r.run.wall_seconds = 1.5;
    r.run.steps = 1000;
    r.run.iterations = 3;
    r.run.ranks = 2;
    r.run.threads = 1;
    r.run.phases = {{"advance", 0.5, 1000}};
    r.run.stopped = "max_steps";
    r.extra = {{"run.levels", 4}, {"new.deep.thing", "yes"}};
    const JsonValue json = JsonValue::parse(result_json(r).dump(), "x");
    for (const char* path : {"scene.surface.sites",
                             "surface.rms",
                             "surface.rms_slope",
                             "surface.min",
                             "surface.max",
                             "surface.origin",
                             "delta_gamma",
                             "binding_energy",
                             "work_of_adhesion.approach",
                             "work_of_adhesion.pull_off",
                             "work_of_adhesion.pairwise",
                             "contact_fraction",
                             "pushed_fraction",
                             "pull_off_force",
                             "jkr.in",
                             "jkr.out",
                             "theory.gamma_eff",
                             "theory.contact_fraction",
                             "theory.gamma_full_contact",
                             "energy.residual",
                             "energy.work",
                             "energy.kinetic",
                             "energy.elastic",
                             "energy.interface",
                             "energy.damped",
                             "run.wall_seconds",
                             "run.steps",
                             "run.iterations",
                             "run.ranks",
                             "run.threads",
                             "run.phases.advance.seconds",
                             "run.phases.advance.calls",
                             "run.version",
                             "run.git",
                             "run.compiler",
                             "run.flags",
                             "run.stopped",
                             "run.levels",
                             "new.deep.thing"})
        EXPECT_NE(json.find(path), nullptr) << path;
    EXPECT_EQ(json.find("work_of_adhesion.pairwise")->number(), 8.0);
    EXPECT_EQ(json.find("run.phases.advance.calls")->integer(), 1000);
    EXPECT_EQ(json.find("failure"), nullptr);
}

TEST(Result, LeavesOutWhatWasNotComputed) {
    ResultRecord r;
    r.work_of_adhesion.approach = 3.0;
    r.failure = {3, "the time step turned unstable"};
    const JsonValue json = result_json(r);
    EXPECT_EQ(json.find("binding_energy"), nullptr);
    EXPECT_EQ(json.find("theory"), nullptr);
    EXPECT_EQ(json.find("scene"), nullptr);
    EXPECT_EQ(json.find("work_of_adhesion.pull_off"), nullptr);
    EXPECT_EQ(json.find("failure.exit_code")->integer(), 3);
    EXPECT_EQ(json.find("run.stopped"), nullptr);
}

TEST(Result, NumbersKeepTheirBits) {
    JsonValue json;
    json["x"] = 0.1 + 0.2;
    json["big"] = 1234567890123456789LL;
    json["nan"] = std::numeric_limits<double>::quiet_NaN();
    const JsonValue back = JsonValue::parse(json.dump(-1), "x");
    EXPECT_EQ(back.find("x")->number(), 0.1 + 0.2);
    EXPECT_EQ(back.find("big")->integer(), 1234567890123456789LL);
    EXPECT_TRUE(back.find("nan")->is_null());
    EXPECT_THROW(JsonValue::parse("{\"x\": ", "f.json"), FileError);
    EXPECT_NO_THROW(JsonValue("\xff").dump());
    EXPECT_EQ(JsonValue::parse("18446744073709551615", "x").number(), 18446744073709551615.0);
    const std::string deep(50000, '[');
    EXPECT_THROW(JsonValue::parse(deep + std::string(50000, ']'), "f.json"), FileError);
    std::string objects;
    for (int i = 0; i < 50000; ++i)
        objects += "{\"a\":";
    EXPECT_THROW(JsonValue::parse(objects + "1" + std::string(50000, '}'), "f.json"), FileError);
}

TEST(Result, IsWrittenWhole) {
    const Scratch scratch;
    const Directory directory = Directory::make(scratch / "a/b");
    write_result(directory, ResultRecord{});
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(directory.path()), {}), 1);
    EXPECT_NO_THROW(JsonValue::parse(contents(directory / "result.json"), ""));
}

} // namespace
} // namespace asperity::io
