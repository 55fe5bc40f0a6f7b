// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A scene run as `asperity run` does it, on one rank.
#pragma once

#include "decomposition/communicator.hpp"
#include "engine/run/run.hpp"
#include "io/error.hpp"
#include "io/json.hpp"
#include "support/scratch.hpp"

#include <string>

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

} // namespace asperity::test
