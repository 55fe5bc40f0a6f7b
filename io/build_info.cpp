// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "io/build_info.hpp"

#include <fstream>
#include <thread>

#include <fmt/format.h>
#include <hdf5.h>

namespace asperity::io {

namespace {

std::string commit = "unknown";

} // namespace

void set_commit(const std::string& described) { commit = described; }

BuildInfo build_info() {
    unsigned major = 0, minor = 0, release = 0;
    H5get_libversion(&major, &minor, &release);
#if defined(__clang__)
    const std::string compiler = "clang " __clang_version__;
#else
    const std::string compiler = "g++ " __VERSION__;
#endif
    return {ASPERITY_VERSION, commit, compiler, ASPERITY_FLAGS,
            fmt::format("{}.{}.{}", major, minor, release)};
}

std::string machine() {
    std::ifstream file("/proc/cpuinfo");
    std::string line, model = "unknown processor";
    while (std::getline(file, line))
        if (line.starts_with("model name") && line.find(": ") != std::string::npos) {
            model = line.substr(line.find(": ") + 2);
            break;
        }
    const unsigned count = std::thread::hardware_concurrency();
    return fmt::format("{}, {} processor{}", model, count, count == 1 ? "" : "s");
}

} // namespace asperity::io
