// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Sweeps without their processes: where axes come from, what a point's directory says, means over
// seeds, and what a path says of its hysteresis.
#include "engine/commands/stored_sweep.hpp"
#include "engine/commands/sweep_output.hpp"
#include "engine/commands/sweep_plots.hpp"
#include "engine/commands/sweep_points.hpp"
#include "engine/commands/sweep_table.hpp"
#include "engine/run/curve.hpp"
#include "io/error.hpp"
#include "io/hdf5_file.hpp"
#include "io/plot.hpp"
#include "support/scratch.hpp"

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

namespace asperity {
namespace {

const std::string swept = "[surface]\nsites = 16\ncutoff = 8\n[sweep]\n"
                          "surface.rms = [1, \"0.2 nm\", 3.5]\n"
                          "\"surface.seed\" = \"1:3:1\"\n";

TEST(SweepOfAScene, IsReadAndReplaced) {
    const Scene scene = read_scene_text(swept, "s.toml");
    std::vector<std::string> fixed;
    auto axes = sweep_axes({}, fixed, scene.sweep);
    ASSERT_EQ(axes.size(), 2u);
    EXPECT_EQ(axes[0].key, "surface.rms");
    EXPECT_EQ(axes[0].values, (std::vector<std::string>{"1", "0.2 nm", "3.5"}));
    EXPECT_EQ(axes[1].values, (std::vector<std::string>{"1", "2", "3"}));
    EXPECT_TRUE(axes[1].is_seed());
    EXPECT_FALSE(axes[0].is_seed());
    EXPECT_TRUE(axes[0].where.starts_with("s.toml:5:")) << axes[0].where;
    axes = sweep_axes({"surface.seed=4", "drive.load=1,2"}, fixed, scene.sweep);
    ASSERT_EQ(axes.size(), 2u);
    EXPECT_EQ(axes[0].key, "drive.load");
    EXPECT_EQ(fixed, (std::vector<std::string>{"surface.seed=4"}));
    // It is no part of what a run is given.
    EXPECT_EQ(scene_json(scene).find("sweep"), nullptr);
}

TEST(SweepOfAScene, SaysWhatIsWrongAndWhere) {
    const auto complaint = [](const std::string& text) -> std::string {
        try {
            read_scene_text(text, "s.toml");
        } catch (const io::SceneError& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_NE(complaint("[sweep]\nsurface.rsm = [1]\n").find("did you mean surface.rms?"),
              std::string::npos);
    EXPECT_NE(complaint("[sweep]\nrms = [1, 2]\n").find("s.toml:2:"), std::string::npos);
    std::vector<std::string> fixed;
    const Scene list = read_scene_text("[sweep]\ndrive.path = [\"approach\"]\n", "s.toml");
    EXPECT_THROW(sweep_axes({}, fixed, list.sweep), io::SceneError);
}

/// A table of three roughnesses with three seeds, the last of which lacks a run.
SweepTable table_of_nine() {
    const Scene base = read_scene_text(swept, "s.toml");
    std::vector<std::string> fixed;
    SweepTable table;
    table.name = "s";
    table.simulated = true;
    table.axes = sweep_axes({}, fixed, base.sweep);
    table.scene = scene_json(base);
    double value = 10.0;
    for (const auto& overrides : sweep_grid(table.axes)) {
        const Scene scene = read_scene_text(swept, "s.toml", overrides);
        const TheoryCase what = theory_case(scene);
        SweepPoint point(scene, table.axes, what, solve_theory(what));
        point.outcome.state = PointState::finished;
        point.outcome.result["delta_gamma"] = 50.0;
        point.outcome.result["binding_energy"] = value;
        value = value * 1.25 + 1.0;
        table.points.push_back(std::move(point));
    }
    table.points.back().outcome = {};
    return table;
}

TEST(SweepTables, AverageOverSeeds) {
    const SweepTable table = table_of_nine();
    const auto groups = sweep_groups(table.axes, table.points);
    ASSERT_EQ(groups.size(), 3u);
    EXPECT_EQ(shown(groups[1].values.at(0)), "2"); // 0.2 nm
    const auto energy = [](const SweepPoint& p) { return result_number(p, "binding_energy"); };
    // 10, 13.5, 17.875: mean 13.791666..., squared deviations 14.377..., 0.085..., 16.673...
    const Spread first = spread_of(groups[0], energy);
    EXPECT_EQ(first.count, 3);
    EXPECT_NEAR(first.mean, 41.375 / 3, 1e-12);
    EXPECT_NEAR(first.deviation, std::sqrt((100 + 182.25 + 319.515625 - 41.375 * 41.375 / 3) / 2),
                1e-12);
    const Spread last = spread_of(groups[2], energy);
    EXPECT_EQ(last.count, 2);
    const Spread none = spread_of(
        groups[0], [](const SweepPoint& p) { return result_number(p, "pull_off_force"); });
    EXPECT_EQ(none.count, 0);
    EXPECT_TRUE(std::isnan(none.mean));

    const io::JsonValue json = sweep_json(table);
    EXPECT_EQ(json.find("points")->items().size(), 9u);
    const auto& means = json.find("means")->items();
    ASSERT_EQ(means.size(), 3u);
    EXPECT_NEAR(means[0].find("binding_energy")->find("mean")->number(), 41.375 / 3, 1e-12);
    EXPECT_NEAR(means[0].find("binding_energy_ratio")->find("mean")->number(), 41.375 / 150, 1e-12);
    EXPECT_EQ(means[2].find("binding_energy")->find("count")->integer(), 2);
    EXPECT_EQ(json.find("points")->items()[8].find("status")->text(), "waiting");
}

TEST(SweepTables, GoToCsvAndHdf5Alike) {
    const io::Scratch scratch;
    const SweepTable table = table_of_nine();
    const auto written = write_tables(scratch / "out", table);
    EXPECT_EQ(written.size(), 4u);
    const std::string csv = io::contents(scratch / "out/sweep.csv");
    EXPECT_TRUE(csv.starts_with("surface.rms,surface.seed,delta_gamma,binding_energy,"
                                "binding_energy_ratio,theory.delta_gamma,"))
        << csv;
    EXPECT_NE(csv.find("\n3.5,2,50,"), std::string::npos);
    EXPECT_TRUE(csv.ends_with("waiting\n"));
    const io::Hdf5File file(scratch / "out/sweep.h5", io::Hdf5File::Mode::read);
    EXPECT_EQ(file.read<double>("/points/surface.seed"),
              (std::vector<double>{1, 2, 3, 1, 2, 3, 1, 2, 3}));
    EXPECT_EQ(file.read<double>("/means/surface.rms"), (std::vector<double>{1, 2, 3.5}));
    EXPECT_EQ(file.read<double>("/means/binding_energy.count"), (std::vector<double>{3, 3, 2}));
    EXPECT_EQ(file.read_text_attribute("/points/binding_energy", "unit"), "meV/Å^2");
    EXPECT_TRUE(std::isnan(file.read<double>("/points/binding_energy").back()));
}

TEST(SweepTables, ReadBackGiveTheSamePlots) {
    const io::Scratch scratch;
    SweepTable table = table_of_nine();
    table.notes = {"a note"};
    for (SweepPoint& p : table.points) {
        p.name = "somewhere";
        table.theory.push_back(p); // some curve
    }
    write_tables(scratch / "out", table);
    const std::vector<StoredSweep> sweeps = read_sweeps(scratch / "out");
    ASSERT_EQ(sweeps.size(), 1u);
    const SweepTable& back = sweeps[0].table;
    EXPECT_EQ(back.name, table.name);
    EXPECT_EQ(back.notes, table.notes);
    EXPECT_EQ(sweep_text(back).rows, sweep_text(table).rows);
    std::string note;
    const auto here = sweep_plots({table}, note), there = sweep_plots({back}, note);
    ASSERT_EQ(here.size(), there.size());
    ASSERT_EQ(here.size(), 1u); // no contact, no cycle
    for (std::size_t i = 0; i < here.size(); ++i)
        EXPECT_EQ(io::plot_svg(here[i]), io::plot_svg(there[i]));
    EXPECT_EQ(read_sweeps(scratch / "").size(), 1u); // in a folder of its own
}

TEST(SweepPoints, AreKnownByTheirResult) {
    const io::Scratch scratch;
    SweepJob job{"rms=1", scratch / "point", {}, read_scene_text(swept, "s.toml")};
    EXPECT_EQ(look_at(job).state, PointState::waiting); // no directory
    io::ResultRecord record;
    record.scene = scene_json(job.scene);
    record.binding_energy = 12.5;
    const auto look_again = [&] {
        io::write_result(job.directory, record);
        return look_at(job);
    };
    EXPECT_EQ(look_again().state, PointState::finished);
    EXPECT_EQ(look_again().result.find("binding_energy")->number(), 12.5);
    record.run.stopped = "max_steps";
    EXPECT_EQ(look_again().state, PointState::finished);
    for (const char* reason : {"signal", "wall_limit"}) {
        record.run.stopped = reason;
        EXPECT_EQ(look_again().state, PointState::waiting) << reason;
    }
    record.run.stopped = "";
    record.failure = {io::exit_code::physics, "the balance is off\n    why: ..."};
    EXPECT_EQ(look_again().state, PointState::failed);
    EXPECT_EQ(look_again().reason, "the balance is off");
    record.failure.exit_code = io::exit_code::input_output; // the disk may have room by now
    EXPECT_EQ(look_again().state, PointState::waiting);
    job.scene.drive.velocity *= 2.0;
    EXPECT_THROW(look_at(job), io::SceneError);
}

TEST(Paths, TellWhatTheyLose) {
    const Scene scene = read_scene_text(
        "[surface]\nsites = 10\nspacing = 10\nradius = 1000\n[interface]\ncutoff = 10\n", "s.toml");
    PathSeries path;
    for (int i = 0; i < 40; ++i) {
        const bool out = i >= 15;
        path.leg.push_back(out ? 1.0 : 0.0);
        path.time.push_back(0.25 * i); // eight rows in 2 ps
        path.height.push_back(0.1 * i);
        path.force.push_back(i == 20 ? -90.0 : i >= 25 && i < 33 ? -50.0 : 0.0);
        path.contact_fraction.push_back(i == 20 ? 0.04 : 0.01);
    }
    io::ResultRecord record;
    record.work_of_adhesion = {5.0, 8.0, {}};
    record.binding_energy = 6.0;
    add_path(path, scene, record);
    const io::JsonValue json = io::result_json(record);
    EXPECT_NEAR(json.find("hysteresis.loop")->number(), 3.0 * 100 * 100 / 1000, 1e-12);
    EXPECT_NEAR(json.find("hysteresis.approach")->number(), 10.0, 1e-12);
    EXPECT_NEAR(json.find("hysteresis.pull_off")->number(), 20.0, 1e-12);
    EXPECT_NEAR(json.find("contact_radius.pull_off")->number(), std::sqrt(0.04 * 1e4 / M_PI), 1e-9);
    // The single spike of 90 counts for an eighth of it in the mean.
    EXPECT_NEAR(json.find("jkr.out_averaged")->number(), 1e3 * 50.0 / (1.5 * M_PI * 1000), 1e-9);
}

TEST(Plot, ShowsSpreadsAsBars) {
    io::Plot plot;
    plot.series.push_back({.label = "simulated",
                           .x = {0, 1, 2},
                           .y = {1, 2, 3},
                           .style = io::PlotSeries::Style::rings,
                           .spread = {0.5, std::nan(""), 0.0}});
    const std::string svg = io::plot_svg(plot);
    std::size_t bars = 0;
    for (std::size_t at = svg.find("h8M"); at != std::string::npos; at = svg.find("h8M", at + 1))
        ++bars;
    EXPECT_EQ(bars, 1u);
    EXPECT_EQ(svg.find("nan"), std::string::npos);
}

} // namespace
} // namespace asperity
