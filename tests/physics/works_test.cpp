// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The two works of a path and the energy that it loses (docs/explanation/model.md), as a run writes
// them:
//
//     lost in - work of the drive in = binding energy = work of the drive out - lost out
//
// in every mode, but for what still moves where approach and pull-off end (kinetic, in time), while
// the work of the interface, int F dz of the mean height, is the binding energy itself where the
// surface moves as one, however much is lost.
#include "engine/case/case.hpp"
#include "engine/units.hpp"
#include "support/run_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace asperity {
namespace {

class Path : public test::Written {
public:
    using Written::Written;
    double last(const char* column) const { return series(column).back(); }
    double state() const { return (*this)("binding_energy"); }
    /// eV as meV/Å^2.
    double per_area(double energy) const { return 1e3 * energy / area(); }

    void expect_identities(double allowed) const {
        const Path& of = *this;
        const bool moves = holds("kinetic.approach");
        const double in = moves ? of("kinetic.approach") : 0.0,
                     out = moves ? of("kinetic.pull_off") : 0.0;
        EXPECT_NEAR(-of("work_of_drive.approach") + of("lost.approach") + in, state(), allowed);
        EXPECT_NEAR(of("work_of_drive.pull_off") - of("lost.pull_off") - out + in, state(),
                    allowed);
        EXPECT_NEAR(of("work_of_drive.pull_off") + of("work_of_drive.approach"), of("lost.cycle"),
                    allowed);
        // Segments say the same.
        const auto segment = [&](std::size_t k, const char* name) {
            return json["segments"][k].at(name).get<double>();
        };
        EXPECT_NEAR(segment(0, "work_of_drive"), of("work_of_drive.approach"), 1e-9);
        EXPECT_NEAR(segment(1, "work_of_drive"), of("work_of_drive.pull_off"), 1e-9);
        EXPECT_NEAR(segment(0, "lost"), of("lost.approach"), 1e-9);
        EXPECT_NEAR(segment(1, "lost"), of("lost.pull_off"), 1e-9);
        EXPECT_GE(of("lost.approach"), 0.0);
        EXPECT_GE(of("lost.pull_off"), 0.0);
        expect_printed_balance();
    }
    /// The balance that is stated is that of the energies that are.
    void expect_printed_balance() const {
        const Path& of = *this;
        const double left = of("energy.work") - of("energy.kinetic") - of("energy.elastic") -
                            of("energy.interface") - of("energy.damped") -
                            (holds("energy.time_step") ? of("energy.time_step") : 0.0);
        double largest = 0.0;
        for (const char* column : {"work", "elastic_energy", "interface_energy", "kinetic_energy"})
            if (file->exists(std::string("/series/") + column))
                for (double energy : series(column))
                    largest = std::max(largest, std::abs(energy));
        EXPECT_NEAR(left, of("energy.balance_error") * largest, 1e-5 * largest);
    }
};

std::string scene(const char* surface, int layers, const std::string& drive) {
    return fmt::format("[surface]\nsites = 12\n{}\n[block]\nthickness = {}\n[drive]\n{}\n"
                       "[output]\nseries = 20\n",
                       surface, layers, drive);
}
const char* const flat = "kind = \"flat\"";
const char* const rough_keys = "rms = 0.5\nseed = 4";

TEST(Works, InTimeTheDrivesWorkAndTheLossesMakeTheState) {
    for (const char* surface : {flat, rough_keys})
        for (const char* drive : {"velocity = 20\ntimestep = 20\ndamping = 0.05",
                                  "velocity = 20\ntimestep = 20\ndamping = 2",
                                  "velocity = 40\ntimestep = 20\ndamping = 0"}) {
            const Path path(scene(surface, 48, drive));
            path.expect_identities(1e-3 * path("delta_gamma"));
            EXPECT_GT(path("lost.approach") + path("kinetic.approach"), 0.1 * path.state());
            EXPECT_GT(path("lost.cycle"), 0.1 * path.state());
            // The same from the series: damped, or left at the end in vibrations of a block that
            // comes to rest again where it started.
            const double left = path.last("elastic_energy") + path.last("kinetic_energy") -
                                path.series("kinetic_energy").front();
            EXPECT_NEAR(path("kinetic.pull_off"), path.per_area(left), 1e-3 * path.state());
            EXPECT_NEAR(path("lost.cycle"), path.per_area(path.last("damped") + left),
                        1e-3 * path.state());
            EXPECT_NEAR(path.per_area(-path.last("work_of_interface")),
                        -path("work_of_interface.pull_off") - path("work_of_interface.approach"),
                        1e-3 * path.state());
        }
}

TEST(Works, OfTheInterfaceOfFlatSurfacesIsTheStateWhateverIsLost) {
    const Path path(scene(flat, 96, "velocity = 20\ntimestep = 20"));
    EXPECT_NEAR(path("work_of_interface.approach"), path.state(), 0.002 * path.state());
    EXPECT_NEAR(-path("work_of_interface.pull_off"), path.state(), 0.002 * path.state());
    EXPECT_GT(path("lost.cycle"), 2.0 * path.state());
}

TEST(Works, WithoutTimeTheDrivesWorkAndTheLossesMakeTheState) {
    const std::string drive = "mode = \"quasistatic\"\ncontrol = ";
    const Path top(scene(rough_keys, 96, drive + "\"top\""));
    top.expect_identities(0.02);
    EXPECT_GT(top("lost.cycle"), 0.5 * top.state());
    EXPECT_FALSE(top.holds("work_of_interface.approach")) << "the mean height jumps";
    EXPECT_FALSE(top.holds("work_of_interface.pull_off"));

    const Path held(scene(rough_keys, 96, drive + "\"mean-height\""));
    held.expect_identities(0.02);
    // The works of both are the integral of the force over the mean height, which does not jump.
    const std::vector<double> force = held.series("force"), height = held.series("mean_height"),
                              of_segment = held.series("segment");
    std::array<double, 2> integral{};
    for (std::size_t i = 1; i < force.size(); ++i)
        integral[static_cast<std::size_t>(of_segment[i])] +=
            0.5 * (force[i] + force[i - 1]) * (height[i] - height[i - 1]);
    for (const std::size_t k : {0, 1}) {
        const char* const branch = k == 0 ? "approach" : "pull_off";
        const double expected = held.per_area(integral[k]), allowed = 0.005 * held.state();
        EXPECT_NEAR(held(fmt::format("work_of_interface.{}", branch)), expected, allowed);
        EXPECT_NEAR(held(fmt::format("work_of_drive.{}", branch)), -expected, allowed);
    }
    EXPECT_LT(held("lost.cycle"), 0.2 * top("lost.cycle"))
        << "held so, the block does not snap as a whole";
}

TEST(Works, OfTheDriveTendToThoseWithoutTime) {
    // A slow and damped drive takes up and gives what the path without time does; the work of the
    // interface does not.
    const Path still(scene(flat, 48, "mode = \"quasistatic\""));
    double before = 1.0;
    for (const char* velocity : {"20", "5"}) {
        const Path moving(
            scene(flat, 48, std::string("timestep = 40\ndamping = 0.5\nvelocity = ") + velocity));
        const double in = std::abs(
                         moving("work_of_drive.approach") / still("work_of_drive.approach") - 1.0),
                     out = std::abs(
                         moving("work_of_drive.pull_off") / still("work_of_drive.pull_off") - 1.0);
        EXPECT_LT(std::max(in, out), 0.6 * before) << velocity;
        before = std::max(in, out);
        EXPECT_NEAR(-moving("work_of_interface.pull_off"), moving.state(), 0.01 * moving.state());
    }
    EXPECT_LT(before, 0.25);
}

/// What result.json says of each segment is what the rows of the series hold of it. In time a
/// segment is concluded at the step after the one that ends it.
void expect_segments_of_the_series(const Path& run, bool in_time, bool mean_height) {
    const auto segment = run.series("segment"), force = run.series("force"),
               work = run.series("work"), height = run.series("mean_height"),
               top = run.series("top_displacement"), contact = run.series("contact_fraction"),
               slide = run.series("slide_x"), lateral = run.series("lateral_force_x"),
               lost = run.series(in_time ? "damped" : "dissipated");
    const double energy = run.per_area(1.0);
    const Case c = resolve(run.scene());
    const std::vector<Segment>& path = c.path();
    std::size_t begin = 0, first = 0;
    for (std::size_t k = 0; k < path.size(); ++k) {
        SCOPED_TRACE(path[k].text);
        const io::Json& written = run.json["segments"][k];
        const auto of = [&](const char* name) { return written.at(name).get<double>(); };
        std::size_t behind = first;
        double attraction = 0.0, hardest = 0.0;
        for (; behind < segment.size() && segment[behind] <= static_cast<double>(k); ++behind) {
            attraction = std::max(attraction, -force[behind]);
            const double against = path[k].amount > 0.0 ? -lateral[behind] : lateral[behind];
            hardest = std::max(hardest, against);
        }
        ASSERT_GT(behind, first);
        const std::size_t end = in_time && behind < segment.size() ? behind : behind - 1;
        const std::size_t at = in_time ? end - 1 : end; // the state that the segment ends in
        double interface_work = 0.0, pushed = 0.0;
        for (std::size_t i = begin + 1; i <= end; ++i) {
            interface_work += 0.5 * (force[i] + force[i - 1]) * (height[i] - height[i - 1]);
            pushed -= 0.5 * (lateral[i] + lateral[i - 1]) * (slide[i] - slide[i - 1]);
        }
        // The path starts from rest, which the first row's work is counted from. A pull-off ends at
        // rest: the block is stopped there, and taken out of reach of a tail.
        if (path[k].kind != Segment::pull_off)
            EXPECT_NEAR(of("work_of_drive"), energy * (work[end] - (k == 0 ? 0.0 : work[begin])),
                        1e-9);
        else
            EXPECT_NEAR(of("work_of_drive"), run("work_of_drive.pull_off"), 1e-9);
        EXPECT_NEAR(of("lost"), energy * (lost[end] - lost[begin]), 1e-9);
        EXPECT_NEAR(of("pressure"), force[at] / run.area() / units::megapascal, 1e-9);
        EXPECT_NEAR(of("mean_height"), height[at], 1e-9);
        EXPECT_NEAR(of("top_displacement"), top[at], 1e-9);
        EXPECT_NEAR(of("contact_fraction"), contact[end], 1e-12);
        EXPECT_NEAR(of("largest_attraction"), attraction, 1e-9);
        if (in_time || mean_height) {
            EXPECT_NEAR(of("work_of_interface"), energy * interface_work, 0.02 * run.state());
        }
        if (path[k].kind == Segment::load) { // in time passed in one step, on the way down or up
            const double asked = path[k].amount / (c.area() * units::megapascal);
            const double beyond = (of("pressure") - asked) * (k == 1 ? 1.0 : -1.0);
            EXPECT_GT(beyond, -1.0);
            EXPECT_LT(beyond, in_time ? 125.0 : 1.0);
        }
        if (path[k].kind == Segment::slide) {
            const double distance = std::abs(path[k].amount);
            EXPECT_NEAR(of("friction") * distance, pushed, 0.05 * std::abs(pushed));
            EXPECT_NEAR(of("largest_friction"), hardest, 1e-9);
            EXPECT_NEAR(written["slide"][0].get<double>(), slide[at], 1e-9);
        }
        if (path[k].kind == Segment::hold) {
            const auto time = run.series("time");
            EXPECT_NEAR(time[end] - time[begin], path[k].amount / units::picosecond, 0.05);
        }
        begin = end;
        first = behind;
    }
    EXPECT_EQ(first, segment.size());
}

TEST(Works, OfSegmentsAreThoseOfTheSeries) {
    const std::string slid =
                          "\"approach\", \"load 300 MPa\", \"slide x -1.2 Å\", \"slide x 0.9 Å\"",
                      up = "\"load 100 MPa\", \"pull-off\"]\n", each = "\n[output]\nseries = 1\n";
    const auto run = [&](const std::string& middle, const std::string& mode) {
        return Path("[surface]\nsites = 12\nrms = 0.5\nseed = 4\n[block]\nthickness = 8\n"
                    "[drive]\npath = [" +
                    slid + middle + ", " + up + mode + each);
    };
    expect_segments_of_the_series(
        run(", \"hold 2 ps\"", "velocity = 40\ntimestep = 20\ndamping = 0.5"), true, false);
    expect_segments_of_the_series(run("", "mode = \"quasistatic\"\ncontrol = \"top\""), false,
                                  false);
    expect_segments_of_the_series(run("", "mode = \"quasistatic\"\ncontrol = \"mean-height\""),
                                  false, true);
}

TEST(Works, ContactAtTheEndOfASegmentIsCountedWhateverRowsTheSeriesHas) {
    std::vector<std::vector<double>> fractions;
    for (const char* rows : {"1", "1000"}) {
        const Path run("[surface]\nsites = 12\nrms = 0.5\nseed = 4\n[block]\nthickness = 16\n"
                       "[drive]\npath = [\"approach\", \"hold 1 ps\"]\nvelocity = 100\n"
                       "timestep = 20\n[output]\nseries = " +
                       std::string(rows) + "\n");
        auto& of_run = fractions.emplace_back();
        for (const io::Json& segment : run.json["segments"])
            of_run.push_back(segment.at("contact_fraction").get<double>());
    }
    EXPECT_GT(fractions[0][0], 0.1);
    EXPECT_EQ(fractions[0], fractions[1]);
}

TEST(Works, WhatTheBlockDissipatesInACycleIsThatOfItsTwoSegments) {
    const Path run("[surface]\nsites = 12\nrms = 0.5\nseed = 4\n"
                   "[block]\nthickness = 8\nprony = [[1.0, \"1 ns\"]]\n"
                   "[drive]\nmode = \"quasistatic\"\nvelocity = \"0.1 m/s\"\n"
                   "path = [\"approach\", \"pull-off\", \"approach\", \"pull-off\"]\n");
    const auto of = [&](std::size_t k) {
        return run.json["segments"][k].at("dissipated_in_block").get<double>();
    };
    EXPECT_GT(of(0) + of(1), 0.01 * run("delta_gamma")) << "the case must tell";
    EXPECT_NEAR(run("dissipated_in_block.cycle"), of(2) + of(3), 1e-9);
}

TEST(Works, OfASecondCycleKnowWhatStillMovedAfterTheFirst) {
    // What moves when a cycle begins was paid for by the one before.
    const Path run(scene(flat, 48,
                         "path = [\"approach\", \"pull-off\", \"approach\", \"pull-off\"]\n"
                         "velocity = 40\ntimestep = 20\ndamping = 0.01"));
    const auto work = [&](std::size_t k) {
        return run.json["segments"][k].at("work_of_drive").get<double>();
    };
    const double left = run.json["segments"][1].at("kinetic").get<double>();
    EXPECT_GT(left, 0.02 * run.state()) << "the case must tell";
    EXPECT_NEAR(work(2) + work(3), run("lost.cycle"), 1e-3 * run("delta_gamma"));
}

TEST(Works, WithHeatOrALoadAreNotComparedWithTheState) {
    const Path warm(scene(flat, 4, "velocity = 100\ntimestep = 20\ntemperature = 50\ndamping = 1"));
    EXPECT_TRUE(warm.holds("work_of_drive.pull_off"));
    EXPECT_FALSE(warm.holds("lost.cycle"));
    const Path loaded(scene(flat, 4, "velocity = 50\ntimestep = 20\nload = 200"));
    EXPECT_FALSE(loaded.holds("kinetic.approach"));
    EXPECT_EQ(loaded("lost.approach"), loaded.json["segments"][0]["lost"].get<double>());
    EXPECT_NEAR(loaded("work_of_drive.pull_off") + loaded("work_of_drive.approach"),
                loaded("lost.cycle"), 1e-3 * loaded("delta_gamma"));
}

TEST(Works, AtATemperatureTheHeatIsNet) {
    // What damping takes and noise gives is each about 2 Γ t times the thermal energy: 40 times it
    // in the long hold. At rest the difference is the fluctuation of the energy.
    const Path warm("[surface]\nkind = \"flat\"\nsites = 12\n[block]\nmodel = \"lattice\"\n"
                    "thickness = 4\n[drive]\n"
                    "path = [\"approach\", \"hold 5 ps\", \"hold 5 ps\", \"hold 20 ps\"]\n"
                    "velocity = 100\ntemperature = 300\ndamping = 1\ntimestep = 5\n"
                    "[output]\nseries = 10\n");
    const double thermal = 3.0 * 12 * 12 * 4 * 300.0 * 8.617333262e-5;
    for (std::size_t hold : {2u, 3u})
        EXPECT_LT(std::abs(warm.json["segments"][hold]["lost"].get<double>()),
                  0.3 * warm.per_area(thermal))
            << hold;
    for (double error : warm.series("balance_error"))
        EXPECT_LT(std::abs(error), 2e-3);
    warm.expect_printed_balance();
}

} // namespace
} // namespace asperity
