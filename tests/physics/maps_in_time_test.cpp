// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A map of a run in time is of one step: energy, forces and mean height, summed anew over the
// positions that the map tells, are those of the row of that step.
#include "engine/units.hpp"
#include "support/run_scene.hpp"

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

namespace asperity {
namespace {

constexpr int n = 12;
using test::paper::a, test::paper::r0;
constexpr double epsilon = 0.1, cutoff = 4.0 * r0;

struct Sum {
    double energy = 0.0;
    std::array<double, 3> force{}; ///< of the substrate on the sites
};

/// Over all pairs of sites and atoms within the cutoff, shifted to zero there.
Sum over_pairs(const std::vector<std::array<double, 3>>& sites,
               const std::vector<double>& substrate) {
    const auto pair = [](double r) {
        const double s6 = std::pow(r0 / r, 6.0);
        return 4.0 * epsilon * s6 * (s6 - 1.0);
    };
    Sum sum;
    for (const auto& site : sites)
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i) {
                const double dx = std::remainder(site[0] - i * a, n * a),
                             dy = std::remainder(site[1] - j * a, n * a),
                             dz = site[2] - substrate[static_cast<std::size_t>(j * n + i)];
                const double r = std::sqrt(dx * dx + dy * dy + dz * dz);
                if (r >= cutoff) continue;
                const double s6 = std::pow(r0 / r, 6.0);
                const double over_r = 24.0 * epsilon * s6 * (2.0 * s6 - 1.0) / (r * r);
                sum.energy += pair(r) - pair(cutoff);
                for (std::size_t c = 0; c < 3; ++c)
                    sum.force[c] += over_r * std::array{dx, dy, dz}[c];
            }
    return sum;
}

class Maps : public test::Written {
public:
    using Written::Written;

    /// The row of the series that the map of this state belongs to.
    void expect_of_row(const std::string& state, std::size_t row) const {
        SCOPED_TRACE(state);
        const std::string group = "/fields/" + state;
        const auto heights = file->read<double>("/substrate/height");
        std::array<std::vector<double>, 3> u;
        for (std::size_t c = 0; c < 3; ++c)
            u[c] = file->read<double>(group + "/u_" + "xyz"[c]);
        const double zero = file->number_attribute(group, "reference_height").value();
        const std::array place = {file->number_attribute(group, "slide_x").value_or(0.0),
                                  file->number_attribute(group, "slide_y").value_or(0.0)};
        std::vector<std::array<double, 3>> sites;
        double mean = 0.0, pressed = 0.0;
        for (std::size_t k = 0; k < n * n; ++k) {
            sites.push_back({(static_cast<double>(k % n) + 0.5) * a + u[0][k] + place[0],
                             (static_cast<double>(k / n) + 0.5) * a + u[1][k] + place[1],
                             zero + u[2][k]});
            mean += sites.back()[2] / (n * n);
        }
        for (double pressure : file->read<double>(group + "/pressure"))
            pressed += pressure * units::gigapascal * a * a;
        const Sum sum = over_pairs(sites, heights);
        const auto of = [&](const char* column) { return series(column)[row]; };
        EXPECT_NEAR(place[0], of("slide_x"), 1e-12);
        EXPECT_NEAR(mean, of("mean_height"), 1e-12);
        EXPECT_NEAR(sum.energy, of("interface_energy"), 1e-10);
        EXPECT_NEAR(sum.force[0], of("lateral_force_x"), 1e-10);
        EXPECT_NEAR(sum.force[1], of("lateral_force_y"), 1e-10);
        EXPECT_NEAR(sum.force[2], of("force"), 1e-10);
        EXPECT_NEAR(pressed, of("force"), 1e-10);
    }
};

TEST(MapsInTime, AreOfOneStep) {
    const Maps run("[surface]\nsites = 12\nrms = 0.5\nseed = 4\n[block]\nthickness = 6\n"
                   "[drive]\npath = [\"approach\", \"slide x 3 Å\", \"pull-off\"]\n"
                   "velocity = 100\ntimestep = 20\ndamping = 0.5\n[output]\nseries = 1\n"
                   "fields = [\"every:50\", \"segments\", \"pull-off\", \"after-approach:1\"]\n");
    const auto segment = run.series("segment"), step = run.series("step"),
               force = run.series("force"), slide = run.series("slide_x"),
               time = run.series("time");
    int slid = 0;
    for (std::size_t row = 0; row < step.size(); row += 50) {
        EXPECT_EQ(step[row], static_cast<double>(row));
        run.expect_of_row("step-" + std::to_string(row), row);
        slid += slide[row] > 0.1 && slide[row] < 2.9;
    }
    EXPECT_GT(slid, 1);
    // A segment's maps are of its last step, as its numbers are; those of the pull-off of its
    // largest attraction; those after the contact was made of the first step so long after it.
    std::array<std::size_t, 3> after{};
    std::size_t strongest = 0;
    for (std::size_t row = 0; row < segment.size(); ++row) {
        if (segment[row] < 2.0) after[static_cast<std::size_t>(segment[row])] = row + 1;
        if (segment[row] == 2.0 && (strongest == 0 || force[row] < force[strongest]))
            strongest = row;
    }
    after[2] = segment.size() - 1;
    for (std::size_t k = 0; k < 3; ++k) {
        run.expect_of_row("segment-" + std::to_string(k), after[k] - 1);
        EXPECT_NEAR(run.json["segments"][k]["mean_height"].get<double>(),
                    run.series("mean_height")[after[k] - 1], 1e-12);
    }
    run.expect_of_row("pull-off", strongest);
    std::size_t later = after[0] - 1;
    while (time[later] < time[after[0] - 1] + 1.0)
        ++later;
    run.expect_of_row("after-approach:1", later);
}

/// Each kind asks for the layer of its own steps: alone it writes the maps that it writes beside
/// the others.
TEST(MapsInTime, AskedForAloneAreTheSame) {
    const auto run = [](const std::string& fields, int series) {
        return test::Written("[surface]\nsites = 12\nrms = 0.5\nseed = 4\n[block]\nthickness = 6\n"
                             "[drive]\npath = [\"approach\", \"pull-off\"]\n"
                             "velocity = 100\ntimestep = 20\ndamping = 0.5\n[output]\nseries = " +
                             std::to_string(series) + "\nfields = [" + fields + "]\n");
    };
    const auto all = run("\"every:50\", \"segments\", \"pull-off\", \"after-approach:1\"", 1);
    for (const auto& [fields, series, maps] :
         std::vector<std::tuple<std::string, int, std::vector<std::string>>>{
             {"\"every:50\"", 77, {"step-0", "step-50", "step-100"}},
             {"\"segments\"", 77, {"segment-0", "segment-1"}},
             {"\"pull-off\"", 1, {"pull-off"}},
             {"\"after-approach:1\"", 77, {"after-approach:1"}}}) {
        const auto alone = run(fields, series);
        for (const std::string& map : maps)
            for (const char* column : {"u_x", "u_z", "pressure"}) {
                const std::string name = "/fields/" + map + "/" + column;
                EXPECT_EQ(alone.file->read<double>(name), all.file->read<double>(name)) << name;
            }
    }
}

} // namespace
} // namespace asperity
