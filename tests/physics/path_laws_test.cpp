// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What holds of every path, thin block or thick, top plane or mean height held, in time or without:
// its pull-off ends apart, with nothing left of contact, force and energy; its stated errors cover
// what the balance of energy lacks, and how far its works are from exact ones; with the energy that
// is bound beyond the reach of its ends, its works in time are those from out of reach.
#include "support/path_case.hpp"
#include "support/run_scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

using namespace asperity;
using test::energy;
using test::follow;
using Solids = test::PathCase;

TEST(PathEnd, NothingIsLeftOfTheContact) {
    // The thicker the block, the further it is stretched before its surface lets go: 68 Å of 512
    // layers, while the reach of the atoms is 13 Å.
    for (const auto along : {Constraint::Of::top, Constraint::Of::mean_height})
        for (const int thickness : {3, 60, 512}) {
            const bool held_top = along == Constraint::Of::top;
            SCOPED_TRACE(std::to_string(thickness) + (held_top ? ", top" : ", mean height"));
            Solids c(test::paper_block(10, thickness, 0), test::flat_surface(10));
            test::KeptPath path = c.approached(1e-3, 0.5, 0.0, along);
            const double bound = -energy(path.now());
            const double strongest = test::strongest_of(follow(path, Segment::pull_off));
            const StepRecord& end = path.now();
            EXPECT_GT(strongest, 30.0);
            EXPECT_EQ(end.in_contact, 0);
            EXPECT_LE(std::abs(end.force), 1e-6 * strongest);
            EXPECT_LE(std::abs(end[Term::interface]), 1e-6 * bound);
            EXPECT_LE(end[Term::elastic], 1e-6 * bound);
            EXPECT_GE(end.mean_height, c.interface.start_height() - 1e-3);
        }
}

TEST(PathEnd, InTimeNothingIsLeftOfTheContact) {
    const test::Written run("[surface]\nkind = \"flat\"\nsites = 16\n[block]\nthickness = 128\n"
                            "[drive]\nvelocity = 100\ntimestep = 20\ndamping = 1\n"
                            "[output]\nseries = 10\n");
    const auto last = [&](const char* column) { return run.series(column).back(); };
    const auto energies = run.series("interface_energy");
    const double deepest = *std::min_element(energies.begin(), energies.end());
    EXPECT_EQ(last("segment"), 1.0);
    EXPECT_EQ(last("contact_fraction"), 0.0);
    // The run ends at a step between two rows, as close as the approach began.
    EXPECT_LE(std::abs(last("interface_energy")), 1e-3 * std::abs(deepest));
    const double reached = last("mean_height"), begun = run.series("mean_height").front();
    EXPECT_GE(reached, begun - 0.2);
}

TEST(PathErrors, CoverTheBalance) {
    for (const auto along : {Constraint::Of::top, Constraint::Of::mean_height}) {
        Solids c(test::paper_block(32, 200, 0), test::reference_surface("c3_N32_T32_rms1.5"));
        test::KeptPath path = c.path(2e-4, 0.25, 0.0, along);
        path.start();
        const double start = energy(path.now());
        follow(path, Segment::approach);
        const double in = path.uncertainty(Segment::approach);
        follow(path, Segment::pull_off);
        if (along == Constraint::Of::top) {
            EXPECT_GT(path.dissipation().events, 1);
        }
        EXPECT_EQ(path.uncertainty(Segment::approach), in) << "the other kind's";
        // The gaps in the balance of all steps add up to that of the cycle.
        const double lacks =
            path.now()[Term::work] - (energy(path.now()) - start) - path.dissipation().total;
        EXPECT_LE(std::abs(lacks),
                  path.uncertainty(Segment::approach) + path.uncertainty(Segment::pull_off) + 1e-9);
    }
}

TEST(PathErrors, CoverTheDistanceToTheExactWorks) {
    // A block that falls in and off as a whole, in one coordinate: the work of the approach is the
    // energy of its end and what the fall from the turning point loses, that of the pull-off the
    // other way round. A smaller tolerance leaves smaller errors.
    Solids c(test::paper_block(10, 40, 0), test::flat_surface(10));
    const test::OneDimension one{c};
    const double outer = one.turning_point(3.62, 9.0, 1.0);
    const double inner = one.turning_point(3.0, outer, -1.0);
    const auto lost = [&](double from, double low, double high) {
        const double top = one.top(from);
        return one.total(from, top) - one.total(one.other(top, low, high), top);
    };
    const double lost_in = lost(outer, 2.9, inner), lost_out = lost(inner, outer, 14.0);
    double before_in = HUGE_VAL, before_out = HUGE_VAL;
    for (const double tolerance : {1e-2, 1e-3, 1e-4}) {
        test::KeptPath path = c.path(tolerance, 0.25);
        path.start();
        follow(path, Segment::approach);
        const double end = energy(path.now());
        follow(path, Segment::pull_off);
        const double in = path.uncertainty(Segment::approach),
                     out = path.uncertainty(Segment::pull_off);
        EXPECT_NEAR(path.work(Segment::approach), end + lost_in, in) << tolerance;
        EXPECT_NEAR(path.work(Segment::pull_off), lost_out - end, out) << tolerance;
        EXPECT_LT(in, before_in);
        EXPECT_LT(out, before_out);
        before_in = in;
        before_out = out;
    }
    EXPECT_LT(before_in, 1e-2 * lost_in);
    EXPECT_LT(before_out, 1e-2 * lost_out);
}

TEST(WorkInTime, WithATailIsThatFromOutOfReach) {
    // Flat on flat, the block stiffer than the interface anywhere: nothing is lost but what is
    // damped on the way, and both works are the flat reference. Where the pull-off ends, the tail
    // still binds a tenth of it.
    const test::Written run(
        "[surface]\nkind = \"flat\"\nsites = 8\n[block]\nmodel = \"lattice\"\nthickness = 3\n"
        "[interface]\ncutoff = 6.56\ntail = true\n"
        "[drive]\nvelocity = 10\ntimestep = 10\n[output]\nseries = 1\n");
    const double flat = run("delta_gamma");
    const double left = -1e3 * run.series("interface_energy").back() / run.area(); // meV/Å^2
    EXPECT_GT(left, 0.002 * flat) << "the case must tell";
    EXPECT_NEAR(run("work_of_interface.approach"), flat, 5e-4 * flat);
    EXPECT_NEAR(run("work_of_interface.pull_off"), -flat, 5e-4 * flat);
}

TEST(PathOverLoads, MeetsThemWithTheContactsOfAnExactPath) {
    // Loads of four decades over a wall that only repels. The tolerance is a fraction of what a
    // site in contact bears: pressures are met to 1e-3, as asked, and one site at most differs from
    // a path relaxed a hundred times further, for which Newton's method takes less than twice the
    // products.
    for (const int seed : {1, 2, 3}) {
        const auto run = [&](const char* tolerance) {
            return test::Written(
                "[surface]\nsites = 32\nrms = 2\nq_max = 8\nseed = " + std::to_string(seed) +
                "\n[block]\nyoung = 10\n[interface]\nkind = \"wall\"\nadhesion = 0\n"
                "[drive]\nmode = \"quasistatic\"\n"
                "path = [\"load 0.02\", \"load 0.2\", \"load 2\", \"load 20\", \"load 200\"]\n"
                "tolerance = " +
                tolerance);
        };
        const test::Written usual = run("2.5e-4"), exact = run("2.5e-6");
        double load = 0.02;
        for (std::size_t i = 0; i < 5; ++i, load *= 10.0) {
            const auto segment = [&](const test::Written& of, const char* what) {
                return of.json.at("segments").at(i).at(what).get<double>();
            };
            EXPECT_NEAR(segment(usual, "pressure"), load, 1e-3 * load);
            EXPECT_NEAR(segment(usual, "contact_fraction"), segment(exact, "contact_fraction"),
                        1.01 / 1024)
                << load << " MPa, seed " << seed;
            // The work follows the load that was met: twice as far off, relatively, as it.
            const double work = segment(exact, "work_of_drive");
            EXPECT_NEAR(segment(usual, "work_of_drive"), work, 4e-3 * work);
        }
        EXPECT_LT(usual("run.iterations"), exact("run.iterations"));
        EXPECT_LT(exact("run.iterations"), 2.0 * usual("run.iterations"));
    }
}
