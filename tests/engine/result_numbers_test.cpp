// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Numbers of a result against closed forms and against the other numbers of the same run; and each
// of them is the same after a stop and a resume with instabilities behind it.
#include "engine/units.hpp"
#include "support/run_scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <vector>

using namespace asperity;

namespace {

using io::Json;

/// Where result.json lists the instabilities of a path.
constexpr const char* listed_instabilities = "dissipated.jumps";

/// A thick block, which falls in and off.
const std::string unstable = "[surface]\nsites = 16\nrms = 0.7\n"
                             "[block]\nthickness = 90\n"
                             "[drive]\nmode = \"quasistatic\"\n";
const std::string held_height = unstable + "control = \"mean-height\"\n";
const std::string slid = "[surface]\nsites = 16\nrms = 0.7\n[block]\nthickness = 16\n"
                         "[drive]\nmode = \"quasistatic\"\n"
                         "path = [\"approach\", \"load 300 MPa\", \"slide x 5 Å\"]\n";
const std::string in_time = "[surface]\nsites = 16\nrms = 0.5\n[block]\nthickness = 32\n"
                            "[drive]\nvelocity = 100\ntimestep = 20\n";

/// path -> number of everything numeric in it, but for what the run took.
void numbers(const Json& value, const std::string& path, std::map<std::string, double>& into) {
    if (path == "run" || path == "units" || path == "scene") return;
    if (value.is_object())
        for (const auto& [name, member] : value.items())
            numbers(member, path.empty() ? name : path + "." + name, into);
    else if (value.is_array())
        for (std::size_t i = 0; i < value.size(); ++i)
            numbers(value[i], path + "[" + std::to_string(i) + "]", into);
    else if (value.is_number())
        into[path] = value.get<double>();
}

std::map<std::string, double> numbers(const Json& result) {
    std::map<std::string, double> found;
    numbers(result, "", found);
    return found;
}

/// Runs the scene until so many steps or points, and then to its end.
Json run_in_two_parts(const std::string& scene, long long stop, const std::string& directory) {
    const Scene first =
        read_scene_text(scene, "s.toml", {"drive.max_steps=" + std::to_string(stop)});
    const Json part = test::run_scene(first, directory);
    EXPECT_EQ(io::find(part, "run.stopped")->get<std::string>(), "max_steps");
    RunOptions options;
    options.out = directory;
    options.resume = "auto";
    options.progress = io::ProgressMode::off;
    EXPECT_EQ(run(read_case_text(scene, "s.toml"), options, Communicator()), io::exit_code::done);
    return io::parse_json(io::contents(directory + "/result.json"), "result.json");
}

} // namespace

TEST(ResultNumbers, AreTheSameAfterAResume) {
    for (const std::string& text : {unstable, held_height, slid, in_time}) {
        SCOPED_TRACE(text);
        const io::Scratch scratch;
        const Json whole = test::run_scene(read_scene_text(text, "s.toml"), scratch / "whole");
        const auto steps = io::find(whole, "run.steps")->get<long long>();
        // Stopped late on the pull-off or the slide: what the segments' instabilities were and the
        // largest forces are behind, some of the work is to come.
        const Json parts = run_in_two_parts(text, steps - steps / 20, scratch / "parts");
        if (&text == &unstable) {
            EXPECT_GT(io::find(whole, listed_instabilities)->size(), 1u);
        }
        const auto a = numbers(whole), b = numbers(parts);
        EXPECT_GT(a.size(), 20u);
        EXPECT_EQ(a.size(), b.size());
        for (const auto& [path, value] : a) {
            ASSERT_TRUE(b.contains(path)) << path;
            EXPECT_EQ(value, b.at(path)) << path;
        }
    }
}

TEST(ResultNumbers, AnInstabilityLiesBetweenTwoRowsOfTheSeries) {
    const test::Written run(unstable);
    const auto column = [&](const char* name) { return run.series(name); };
    const auto top = column("top_displacement"), lost = column("dissipated"),
               segment = column("segment"), force = column("top_force"),
               height = column("mean_height"), contact = column("contact_fraction");
    const Json& jumps = *io::find(run.json, listed_instabilities);
    ASSERT_GT(jumps.size(), 1u);
    double strongest = 0.0;
    for (const Json& jump : jumps) {
        std::size_t row = 0; // the last one before
        const double number = jump.at("segment").get<double>();
        while (row + 1 < top.size() && !(top[row] == jump.at("top_displacement").get<double>() &&
                                         segment[row + 1] == number && lost[row + 1] > lost[row]))
            ++row;
        ASSERT_LT(row + 1, top.size()) << jump;
        EXPECT_NEAR(lost[row + 1] - lost[row], jump.at("energy").get<double>(), 1e-9 * lost.back());
        const std::pair<const char*, const std::vector<double>&> sides[] = {
            {"force", force}, {"mean_height", height}, {"contact_fraction", contact}};
        for (const auto& [name, values] : sides) {
            EXPECT_EQ(jump.at(name).at(0).get<double>(), values[row]) << name;
            EXPECT_EQ(jump.at(name).at(1).get<double>(), values[row + 1]) << name;
        }
        strongest = std::max(strongest, std::abs(force[row + 1] - force[row]));
    }
    EXPECT_GT(strongest, 1.0) << "the case must tell one side from the other";
}

TEST(ResultNumbers, TheErrorOfAStateIsThatOfTheSoftestWave) {
    // A wave of the length of the box with the pressure p = tolerance / a² has the energy p² / 2k a
    // nominal area, of a surface with the stiffness k = E* q / 2, q = 2 pi / L.
    double before = 0.0;
    for (const double tolerance : {2e-4, 2e-3}) {
        const Scene scene =
            read_scene_text("[surface]\nsites = 16\nrms = 0.7\nspacing = 3.1\n[block]\n"
                            "young = 50.0\npoisson = 0.3\n[drive]\npath = [\"relax\"]\n",
                            "s.toml", {"drive.tolerance=" + std::to_string(tolerance)});
        const test::Written run(scene);
        const double modulus = 50.0 / 160.2176634 / (1.0 - 0.3 * 0.3); // E*, eV/Å^3
        // The scale of the forces is the largest attraction of a site.
        const double pressure = tolerance * resolve(scene).flat.largest_tension * units::gigapascal;
        const double stiffness = 0.5 * modulus * 2.0 * std::numbers::pi / (16 * 3.1);
        const double expected = 1e3 * pressure * pressure / (2.0 * stiffness); // meV/Å^2
        const double stated = run("binding_energy_uncertainty");
        EXPECT_NEAR(stated, expected, 1e-6 * expected);
        EXPECT_GT(stated, 50.0 * before);
        before = stated;
    }
}

TEST(ResultNumbers, TheDensityOfGapsIsTheHistogramOfTheirMap) {
    const test::Written run("[surface]\nsites = 48\nrms = 2.0\n[block]\n"
                            "[drive]\npath = [\"relax\"]\n");
    const std::string state = "/fields/relaxed/";
    const auto gap = run.file->read<double>(state + "gap"),
               edges = run.file->read<double>(state + "gap_edges"),
               density = run.file->read<double>(state + "gap_density");
    const auto [least, greatest] = std::minmax_element(gap.begin(), gap.end());
    ASSERT_EQ(edges.size(), density.size() + 1);
    const double width = (*greatest - *least) / static_cast<double>(density.size());
    EXPECT_NEAR(edges.front(), *least, 1e-9 * width);
    EXPECT_NEAR(edges.back(), *greatest, 1e-9 * width);
    for (std::size_t i = 0; i < density.size(); ++i) {
        EXPECT_NEAR(edges[i + 1] - edges[i], width, 1e-9 * width);
        const bool last = i + 1 == density.size(); // the last bin has both its edges
        const auto inside = std::count_if(gap.begin(), gap.end(), [&](double u) {
            return u >= edges[i] && (last || u < edges[i + 1]);
        });
        EXPECT_NEAR(density[i],
                    static_cast<double>(inside) / (width * static_cast<double>(gap.size())),
                    1e-9 / width)
            << i;
    }
}
