// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A run that was interrupted goes on as if it had not been: the same bits, whatever number of ranks
// wrote the checkpoint and whatever number reads it. Reference: the uninterrupted run on one rank.
#include "engine/path/state_numbers.hpp"
#include "io/error.hpp"
#include "support/cases.hpp"
#include "support/message.hpp"
#include "support/simulation_checkpoint.hpp"
#include "support/world.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

using namespace asperity;

namespace {

using test::world;

constexpr double start_height =
    7.5; ///< Å: in the attraction, outside of the wall; contact at step 139

SimulationOptions options() {
    SimulationOptions o;
    o.block = test::paper_block(32, 32, 3);
    o.interface = test::paper_interface();
    o.interface.slides = true;
    o.drive.path = {{Segment::approach}, {Segment::slide, 0.7, 1}};
    o.drive.velocity = 2e-3;
    o.drive.ramp = 800.0;
    o.damping = 1e-3;
    o.temperature = 300.0; // the noise must go on where it was
    o.seed = 11;
    return o;
}

test::Driven make(const Communicator& ranks) {
    return test::Driven(options(), test::reference_surface("c3_N32_T32_rms1.5"), ranks,
                        test::grid_for(options().block, ranks));
}

void advance(test::Driven& s, int steps) { test::Trace().follow(s, steps); }

/// All that must not depend on the interruption, as one number.
std::uint64_t trace(test::Driven& s) {
    std::uint64_t hash = test::fingerprint(s.block());
    hash = test::mix(test::mix(hash, s.step(true)), s.balance());
    for (double value : {static_cast<double>(s.drive().now().kind), s.drive().motion(s.time()).z,
                         s.drive().motion(s.time()).slide[1]})
        hash = test::mix(hash, value);
    return hash;
}

constexpr int first_part = 170, second_part = 80; // cut while the drive turns round

std::uint64_t uninterrupted() {
    return test::from_root([] {
        test::Driven s = make(Communicator());
        s.start(start_height);
        advance(s, first_part);
        EXPECT_EQ(s.drive().now().kind, Segment::slide);
        EXPECT_LT(std::abs(s.drive().motion(s.time()).z), options().drive.velocity)
            << "in the turn";
        advance(s, second_part);
        EXPECT_GT(s.now().in_contact, 0);
        return trace(s);
    });
}

} // namespace

TEST(Checkpoint, WrittenByAllRanksAndTakenUpByOne) {
    const std::uint64_t expected = uninterrupted();
    const test::SharedScratch scratch("many_to_one");
    test::Driven before = make(world());
    before.start(start_height);
    advance(before, first_part);
    CollectNumbers more;
    std::int64_t rows = (std::int64_t{1} << 60) + 1; // more digits than a double has
    double binding = 0.1;
    more("rows", rows);
    more("binding", binding);
    EXPECT_THROW(more("rows", rows), std::logic_error) << "two of one name";
    test::write_checkpoint(scratch.file, before, more, "scene A");
    world().barrier();
    if (world().root()) {
        test::Driven after = make(Communicator());
        const StateNumbers numbers = test::read_checkpoint(scratch.file, after, "scene A");
        EXPECT_EQ(std::get<std::int64_t>(numbers.at("rows")), rows);
        EXPECT_EQ(std::get<double>(numbers.at("binding")), binding);
        EXPECT_EQ(after.steps(), first_part);
        advance(after, second_part);
        EXPECT_EQ(trace(after), expected);
        EXPECT_EQ(std::distance(std::filesystem::directory_iterator(scratch.directory), {}), 1)
            << "a temporary file is left";
    }
    // Writing has changed nothing.
    advance(before, second_part);
    EXPECT_EQ(trace(before), expected);
}

TEST(Checkpoint, WrittenByOneAndTakenUpByAllRanks) {
    const std::uint64_t expected = uninterrupted();
    const test::SharedScratch scratch("one_to_many");
    if (world().root()) {
        test::Driven before = make(Communicator());
        before.start(start_height);
        advance(before, first_part);
        test::write_checkpoint(scratch.file, before, {}, "scene A");
    }
    world().barrier();
    test::Driven after = make(world());
    advance(after, 3); // whatever it did before must be forgotten
    EXPECT_FALSE(test::read_checkpoint(scratch.file, after, "scene A").contains("rows"));
    EXPECT_EQ(after.steps(), first_part);
    advance(after, second_part);
    EXPECT_EQ(trace(after), expected);
}

namespace {

/// A run of these options goes on from its checkpoint as it would have gone on without.
void goes_on(const SimulationOptions& o, const char* name) {
    const test::SharedScratch scratch(name);
    const auto made = [&] {
        return test::Driven(o, test::reference_surface("c3_N32_T32_rms1.5"), world(),
                            test::grid_for(o.block, world()));
    };
    test::Driven before = made();
    before.start(start_height);
    advance(before, first_part);
    test::write_checkpoint(scratch.file, before, {}, "scene A");
    world().barrier();
    test::Driven after = made();
    test::read_checkpoint(scratch.file, after, "scene A");
    advance(before, second_part);
    advance(after, second_part);
    EXPECT_GT(before.now()[Term::elastic], 0.0);
    EXPECT_EQ(trace(after), trace(before));
}

} // namespace

TEST(Checkpoint, AtFiniteStrain) {
    SimulationOptions finite = options();
    finite.block.finite_strain = true;
    goes_on(finite, "finite");
}

TEST(Checkpoint, OfATopPlaneOnASpring) {
    SimulationOptions o = options();
    o.temperature = 0.0;
    o.block.top_spring.stiffness = 20.0;
    goes_on(o, "spring");
}

TEST(Checkpoint, OfAnotherSceneIsRefusedByTheKeysThatDiffer) {
    const test::SharedScratch scratch("other_scene");
    test::Driven s = make(world());
    s.start(start_height);
    test::write_checkpoint(scratch.file, s, {},
                           R"({"surface":{"rms":1,"seed":1},"drive":{"dt":10,"load":1}})");
    const auto read = [&] {
        test::read_checkpoint(
            scratch.file, s,
            R"({"surface":{"rms":1,"seed":2},"drive":{"dt":10},"output":{"fields":true}})");
    };
    if (!world().root()) {
        EXPECT_THROW(read(), RootFailure);
        return;
    }
    const std::string refused = test::message_of<io::SceneError>(read);
    EXPECT_TRUE(test::has(refused, "drive.load, output.fields, surface.seed")) << refused;
}

TEST(Checkpoint, WhatIsNoneIsRefused) {
    const test::SharedScratch scratch("no_checkpoint");
    test::Driven s = make(world());
    const auto read = [&] { test::read_checkpoint(scratch.file, s, "scene A"); };
    for (const char* content : {"", "not HDF5"}) {
        if (world().root() && *content) std::ofstream(scratch.file) << content;
        world().barrier();
        if (world().root())
            EXPECT_THROW(read(), io::FileError);
        else
            EXPECT_THROW(read(), RootFailure);
    }
}
