// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A scene run as `asperity run` does it, on one rank.
#pragma once

#include "decomposition/communicator.hpp"
#include "engine/run/run.hpp"
#include "io/error.hpp"
#include "io/hdf5_file.hpp"
#include "io/json.hpp"
#include "support/scratch.hpp"

#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace asperity::test {

/// Into this directory. Returns what result.json holds.
inline io::Json run_scene(const Case& c, const std::string& directory) {
    RunOptions options;
    options.out = directory;
    options.progress = io::ProgressMode::off;
    EXPECT_EQ(run(c, options, Communicator()), io::exit_code::done);
    return io::parse_json(io::contents(directory + "/result.json"), "result.json");
}
inline io::Json run_scene(const Scene& scene, const std::string& directory) {
    return run_scene(resolve(scene), directory);
}

/// A number of a result by its path ("work_of_drive.approach"); NaN and a failure if it is not
/// there.
inline double number(const io::Json& result, const std::string& path) {
    const io::Json* value = io::find(result, path);
    if (value && value->is_number()) return value->get<double>();
    ADD_FAILURE() << path << " is missing";
    return std::nan("");
}

/// A run and what it wrote.
class Written {
public:
    explicit Written(Scene scene) : scene_(std::move(scene)) {
        json = run_scene(scene_, directory);
        file.emplace(directory + "/run.h5", io::Hdf5File::Mode::read);
    }
    explicit Written(const std::string& scene) : Written(read_scene_text(scene, "test.toml")) {}

    double operator()(const std::string& path) const { return number(json, path); }
    bool holds(const std::string& path) const { return io::find(json, path) != nullptr; }
    std::vector<double> series(const std::string& column) const {
        return file->read<double>("/series/" + column);
    }
    const Scene& scene() const { return scene_; }
    double area() const { return scene_.edge() * scene_.edge(); } ///< Å^2

private:
    io::Scratch scratch_;
    Scene scene_;

public:
    const std::string directory = scratch_ / "run";
    io::Json json;
    std::optional<io::Hdf5File> file;
};

} // namespace asperity::test
