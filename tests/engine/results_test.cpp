// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What a run writes, against itself: the same quantity in result.json, in the series and in the
// maps of run.h5, each converted by the unit that the file states.
#include "decomposition/global_sum.hpp"
#include "engine/case/case.hpp"
#include "engine/path/path.hpp"
#include "engine/run/recorder.hpp"
#include "engine/run/run_result.hpp"
#include "engine/scene/scene.hpp"
#include "engine/units.hpp"
#include "io/hdf5_file.hpp"
#include "io/quantities.hpp"
#include "io/units.hpp"
#include "support/cases.hpp"
#include "support/run_scene.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <numeric>

using namespace asperity;

namespace {

using io::Json;

double factor(const std::string& from, const std::string& to) {
    if (from == to) return 1.0;
    const auto by = io::conversion(from, to);
    EXPECT_TRUE(by) << from << " is not in " << to;
    return by.value_or(NAN);
}

/// With the units that the files state.
class Written : public test::Written {
public:
    using test::Written::Written;

    /// A number of result.json ("energy.elastic") in this unit.
    double number(const std::string& path, const char* unit) const {
        const Json* stated = io::find(json, "units." + path);
        if (stated) return test::number(json, path) * factor(stated->get<std::string>(), unit);
        ADD_FAILURE() << path << " has no unit";
        return NAN;
    }
    /// A data set of run.h5 in this unit.
    std::vector<double> data(const std::string& path, const char* unit) const {
        std::vector<double> values = file->read<double>(path);
        const double by = factor(file->text_attribute(path, "unit").value(), unit);
        for (double& value : values)
            value *= by;
        return values;
    }
};

double mean(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Paths of the values that have no unit.
void without_unit(const Json& value, const Json& unit, const std::string& path,
                  std::vector<std::string>& list) {
    if (value.is_object())
        for (const auto& [name, member] : value.items()) {
            if (path.empty() && name == "units") continue;
            without_unit(member, unit.contains(name) ? unit.at(name) : Json(), path + "/" + name,
                         list);
        }
    else if (value.is_array() && (value.empty() ? unit.is_object() : value.front().is_object()))
        for (const Json& element : value)
            without_unit(element, unit, path + "[]", list);
    else if (!unit.is_string() || (value.is_number() && unit == ""))
        list.push_back(path);
}

void datasets(const io::Hdf5File& file, const std::string& group, std::vector<std::string>& list) {
    for (const std::string& name : file.members(group.empty() ? "/" : group)) {
        const std::string path = group + "/" + name;
        if (path == "/h5md" || path == "/particles") continue; // described by H5MD
        if (file.is_dataset(path))
            list.push_back(path);
        else
            datasets(file, path, list);
    }
}

void expect_units_in_json(const Written& run) {
    std::vector<std::string> bare;
    without_unit(run.json, run.json.at("units"), "", bare);
    EXPECT_EQ(bare, std::vector<std::string>());
}

void expect_units_everywhere(const Written& run) {
    expect_units_in_json(run);
    std::vector<std::string> all;
    datasets(*run.file, "", all);
    EXPECT_GT(all.size(), 15u);
    for (const std::string& path : all)
        EXPECT_TRUE(run.file->text_attribute(path, "unit") &&
                    run.file->text_attribute(path, "description"))
            << path;
    const std::string scene = run.file->text_attribute("/", "scene").value();
    EXPECT_EQ(scene_toml(read_scene_text(scene, "attribute"), false),
              scene_toml(run.scene(), false));
    EXPECT_EQ(run.file->text_attribute("/", "version"),
              run.json.at("run").at("version").get<std::string>());
}

const char* const quasistatic = R"(
[surface]
sites = 16
rms = 0.7
[block]
thickness = 60
[drive]
mode = "quasistatic"
[output]
fields = ["relaxed", "pull-off"]
)";

} // namespace

TEST(Results, OfAQuasiStaticPathAgreeWithEachOther) {
    const Written run(quasistatic);
    expect_units_everywhere(run);
    const double area = run.area(), gpa = 1.0 / 160.2176634; // eV/Å^3
    const auto energy = [&](const char* path) { return area * run.number(path, "eV/Å^2"); };

    // Per area and as a whole.
    EXPECT_NEAR(run.number("dissipated.energy", "eV"), energy("lost.cycle"), 1e-9);
    EXPECT_NEAR(energy("lost.cycle"), energy("lost.approach") + energy("lost.pull_off"), 1e-9);
    EXPECT_NEAR(energy("binding_energy"),
                energy("pair_binding_energy") - energy("relaxed.elastic_energy"), 1e-9);

    // The series.
    const auto force = run.data("/series/force", "eV/Å"),
               segment = run.data("/series/segment", "1"),
               top = run.data("/series/top_displacement", "Å");
    double strongest[2] = {0.0, 0.0}, work[2] = {0.0, 0.0};
    for (std::size_t i = 0; i < force.size(); ++i) {
        const std::size_t out = segment[i] == 1.0;
        strongest[out] = std::max(strongest[out], -force[i]);
        if (i > 0) work[out] += 0.5 * (force[i] + force[i - 1]) * (top[i] - top[i - 1]);
    }
    EXPECT_EQ(run.number("approach_force", "eV/Å"), strongest[0]);
    EXPECT_EQ(run.number("pull_off_force", "eV/Å"), strongest[1]);
    EXPECT_GT(strongest[1], strongest[0]);
    // Points where the step was halved do not see the same trapezia: to a percent.
    EXPECT_NEAR(-energy("work_of_drive.approach"), work[0], 0.01 * std::abs(work[0]));
    EXPECT_NEAR(-energy("work_of_drive.pull_off"), work[1], 0.01 * std::abs(work[1]));
    EXPECT_EQ(run.number("energy.work", "eV"), run.data("/series/work", "eV").back());
    EXPECT_EQ(run.number("energy.damped", "eV"), run.data("/series/dissipated", "eV").back());
    EXPECT_EQ(run.number("run.steps", "1"), run.data("/series/step", "1").back());

    // The maps.
    const std::string state = "/fields/relaxed/";
    const auto pressure = run.data(state + "pressure", "GPa");
    const auto repulsive =
        std::count_if(pressure.begin(), pressure.end(), [](double p) { return p > 0.0; });
    EXPECT_EQ(run.number("repulsive_fraction", "1"),
              static_cast<double>(repulsive) / static_cast<double>(pressure.size()));
    EXPECT_EQ(run.number("contact_fraction", "1"), mean(run.data(state + "contact", "1")));
    const auto distance = run.data(state + "distance", "Å");
    const double inflection = std::pow(26.0 / 7.0, 1.0 / 6.0) * 3.28; // of 4 eps (s^12 - s^6)
    const auto touching =
        std::count_if(distance.begin(), distance.end(), [&](double d) { return d < inflection; });
    EXPECT_EQ(run.number("contact_fraction", "1"), static_cast<double>(touching) / 256.0);
    EXPECT_NE(run.number("contact_fraction", "1"), run.number("repulsive_fraction", "1"));
    // The last point of the approach is the state.
    const auto turn = static_cast<std::size_t>(std::find(segment.begin(), segment.end(), 1.0) -
                                               segment.begin() - 1);
    for (const char* name : {"contact_fraction", "repulsive_fraction"})
        EXPECT_EQ(run.data(std::string("/series/") + name, "1")[turn], run.number(name, "1"));
    EXPECT_NEAR(run.number("relaxed.mean_height", "Å"),
                run.file->number_attribute("/fields/relaxed", "reference_height").value() +
                    mean(run.data(state + "u_z", "Å")),
                1e-9);
    EXPECT_NEAR(area * gpa * mean(pressure), 0.0, 1e-2);
    EXPECT_NEAR(area * gpa * mean(run.data("/fields/pull-off/pressure", "GPa")), -strongest[1],
                1e-6 * strongest[1]);
    const auto edges = run.data(state + "gap_edges", "Å"),
               density = run.data(state + "gap_density", "1/Å");
    EXPECT_NEAR(mean(density) * (edges.back() - edges.front()), 1.0, 1e-12);
}

TEST(Results, OfAPathWithoutInstabilitiesListNone) {
    const Written run("[surface]\nsites = 16\nrms = 0.7\n[block]\nthickness = 60\n"
                      "[drive]\nmode = \"quasistatic\"\nmax_steps = 2\n");
    const Json& lost = run.json.at("dissipated");
    EXPECT_EQ(lost.at("events"), 0);
    EXPECT_EQ(lost.at("jumps"), Json::array());
    EXPECT_EQ(run.json.at("units").at("dissipated").at("jumps").at("energy"), "eV");
    expect_units_in_json(run);
}

TEST(Results, OfAStateAreEnergiesPerArea) {
    const Written run("[surface]\nsites = 16\nrms = 0.7\n[drive]\npath = [\"relax\"]\n"
                      "[block]\nthickness = 16\n");
    expect_units_in_json(run);
    EXPECT_NEAR(run.number("energy.elastic", "eV"),
                run.area() * run.number("relaxed.elastic_energy", "eV/Å^2"), 1e-9);
    EXPECT_NEAR(run.number("energy.interface", "eV"),
                -run.area() * run.number("pair_binding_energy", "eV/Å^2"), 1e-9);
    EXPECT_GT(run.number("energy.elastic", "eV"), 0.0);
}

TEST(Results, OfACurvedSceneInTimeHaveUnits) {
    const Written run("[surface]\nsites = 32\nrms = 0.2\nradius = 300\n[block]\nthickness = 16\n"
                      "[drive]\nmax_steps = 40\n[output]\nseries = 10\nfields = [\"every:20\"]\n"
                      "trajectory = 20\n");
    expect_units_everywhere(run);
}

TEST(Results, AStateIsTheOneBelowTheStrongestAttraction) {
    const Case c = read_case_text("[surface]\nsites = 32\nrms = 1.5\n[drive]\ntolerance = 1e-6\n"
                                  "path = [\"relax\"]\n",
                                  "s.toml");
    const io::Scratch scratch;
    const Json json = test::run_scene(c, scratch / "run");
    const test::Relaxed alone =
        test::relax_spectral(c.simulation.block, c.simulation.interface, surface_of(c), 1e-6);
    EXPECT_GT(alone.binding_energy, 1.0);
    EXPECT_NEAR(json.at("binding_energy").get<double>(), alone.binding_energy,
                1e-9 * alone.binding_energy);
}

namespace {

/// The force on the lowest layer, summed anew.
double force_of_sites(const Path& path, const StepRecord&) {
    VectorField<double> force(path.grid().tile(0), 1);
    const InterfaceSums sums = path.interface().sweep(path.layer(), force.plane(0));
    return global_sum(path.communicator(), sums.force_z);
}

} // namespace

TEST(Results, AColumnOfSitesIsOfItsOwnStep) {
    constexpr auto all = [](const Effects&) { return true; };
    const SeriesColumn sites = {all, {"series/f", "eV/Å", "", ""}, force_of_sites, "", true};
    const SeriesColumn step = {all,
                               {"series/g", "eV/Å", "", ""},
                               [](const Path&, const StepRecord& now) { return now.force; }};
    for (const char* mode : {"dynamic", "quasistatic"}) {
        const Case c = resolve(read_scene_text(
            "surface.sites = 16\nblock.thickness = 8\ndrive.velocity = 100\ndrive.timestep = 40\n"
            "drive.mode = \"" +
                std::string(mode) + "\"\n",
            "test.toml"));
        const Surface surface = surface_of(c);
        const std::unique_ptr<Path> path = path_of(c, surface, Communicator());
        const io::Scratch scratch;
        Recorder recorder(io::Directory(scratch / ""), surface, Communicator(), {&sites, &step}, {},
                          [](io::Hdf5File&) {});
        for (int n = 0; n < 400 && path->concluded() == 0; ++n) {
            path->advance(recorder.wish_of_row());
            if (path->has_stepped()) recorder.row(*path);
        }
        recorder.write();
        auto series = recorder.series();
        ASSERT_GT(recorder.rows(), 20u);
        EXPECT_NE(series["g"].back(), 0.0) << "beyond the interaction range throughout";
        EXPECT_EQ(series["f"], series["g"]) << mode;
    }
}
