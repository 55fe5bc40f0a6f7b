// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/commands/command_line.hpp"

#include "decomposition/communicator.hpp"
#include "engine/case/case.hpp"
#include "engine/run/stress_record.hpp"
#include "io/error.hpp"
#include "io/files.hpp"
#include "io/hdf5_file.hpp"
#include "io/json.hpp"
#include "io/run_h5.hpp"
#include "io/scene_reader.hpp"

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace asperity {

namespace {

using io::Json;

std::vector<double> map_of(const io::Hdf5File& file, const std::string& name, int sites) {
    std::vector<double> values = file.read<double>(name);
    const std::size_t expected = static_cast<std::size_t>(sites) * static_cast<std::size_t>(sites);
    bool whole = values.size() == expected;
    for (const double value : values)
        whole = whole && std::isfinite(value);
    if (whole) return values;
    throw io::FileError(file.path(),
                        fmt::format("{} is no map of {} x {} sites", name, sites, sites),
                        values.size() == expected ? "it has points without a value"
                                                  : fmt::format("it has {} values", values.size()),
                        "name a state of a run over a wall without holes");
}

Json largest_json(const LargestStress& largest) {
    return {{"value", largest.value},
            {"x", largest.x},
            {"y", largest.y},
            {"depth", largest.depth},
            {"between_depths", largest.between_depths},
            {"between_points", largest.between_points},
            {"within_site", largest.within_site},
            {"images", largest.images},
            {"error", largest.error()},
            {"reason", largest.reason}};
}

struct StressArguments : Arguments {
    /// File of JSON, {"file": run.h5, "state": name of a group of /fields, "slid": true for the
    /// tractions of with_slopes()}.
    std::string points;
};

/// Computes the stresses below a state of a run. The scene has block and output.stress*. Writes the
/// group /stress/<state> to the file given.out, and prints the largest stresses of each layer as
/// one line of JSON.
int stress_below(const StressArguments& given) {
    const Case c = case_of(given, 1);
    const Json what = io::parse_json(io::read_scene_file(given.points), given.points);
    const std::string group = "/fields/" + what.at("state").get<std::string>();
    const BlockOptions& block = c.simulation.block;
    SurfaceTractions tractions;
    {
        const io::Hdf5File file(what.at("file").get<std::string>(), io::Hdf5File::Mode::read_any);
        std::vector<double> pressure = map_of(file, group + "/pressure", block.sites);
        if (what.at("slid").get<bool>()) {
            std::vector<double> height = map_of(file, group + "/u_z", block.sites);
            const std::vector<double> gap = map_of(file, group + "/gap", block.sites);
            for (std::size_t i = 0; i < height.size(); ++i)
                height[i] -= gap[i];
            tractions = with_slopes(block, std::move(pressure), height);
        } else {
            tractions = with_friction(std::move(pressure), c.output.stress.friction);
        }
    }
    const StressRecord record = record_stresses(block, tractions, c.output.stress);
    io::Hdf5File out(given.out, io::Hdf5File::Mode::create);
    const std::string to = "/stress/" + what.at("state").get<std::string>() + "/";
    for (const StressArray& array : record.arrays)
        io::write_described(out, to + array.name, array.shape, array.values);
    for (const auto& [name, value] : record.attributes)
        io::write_described_attribute(out, to.substr(0, to.size() - 1), name, value);
    out.close();
    Json answer = {{"layers", Json::array()}};
    const std::vector<Material> materials = block.materials();
    for (std::size_t i = 0; i < record.search.layers.size(); ++i) {
        const LayerStresses& layer = record.search.layers[i];
        Json one = {{"from", layer.from}, {"to", layer.to}, {"poisson", materials[i].poisson}};
        for (std::size_t m = 0; m < stress_measures.size(); ++m)
            one[stress_measures[m]] = largest_json(layer.largest[m]);
        answer["layers"].push_back(std::move(one));
    }
    fmt::print("{}\n", io::json_text(answer));
    return io::exit_code::done;
}

} // namespace

Command stress_below_command() {
    const auto given = std::make_shared<StressArguments>();
    return {.options = {takes::scene(*given),
                        takes::set(*given),
                        {"--points", "FILE",
                         "the state: {\"file\": run.h5, \"state\": name, \"slid\": false}",
                         &given->points},
                        {"--out", "FILE", "the file to write", &given->out}},
            .act =
                [given](const Communicator& world) {
                    return on_root(world, [&] { return stress_below(*given); });
                },
            .for_programs = true};
}

} // namespace asperity
