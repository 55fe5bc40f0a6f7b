// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "io/machine.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <thread>

#include <fmt/format.h>
#include <hdf5.h>
#include <sys/resource.h>

namespace asperity::io {

namespace {

namespace fs = std::filesystem;

std::string commit = "unknown";

/// Returns the bytes behind a name in a file of "name: value kB" or "name value" lines, or of the
/// number alone; nothing if there is none ("max").
std::optional<double> entry(const fs::path& path, const std::string& name) {
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
        if (!line.starts_with(name)) continue;
        std::istringstream words(line.substr(name.size()));
        double value = 0.0;
        if (!(words >> value)) return std::nullopt;
        return line.ends_with(" kB") ? 1024.0 * value : value;
    }
    return std::nullopt;
}

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

namespace {

/// The smallest of several limits.
class LeastMemory {
public:
    void limit(std::optional<double> bytes, const char* because) {
        if (bytes && *bytes < least_.bytes) least_ = {std::max(0.0, *bytes), because};
    }
    const AvailableMemory& get() const { return least_; }

private:
    AvailableMemory least_{HUGE_VAL, "nothing"};
};

} // namespace

AvailableMemory memory_of_machine() {
    LeastMemory least;
    least.limit(entry("/proc/meminfo", "MemAvailable:"), "MemAvailable");

    // "0::/a/b" (version 2) or "5:memory:/a/b" (version 1); every group above counts too. Inside of
    // a container the path may not be there, and the root then is the container's own.
    std::ifstream groups("/proc/self/cgroup");
    for (std::string line; std::getline(groups, line);) {
        const std::size_t first = line.find(':'), second = line.find(':', first + 1);
        if (second == std::string::npos) continue;
        const bool v2 = second == first + 1;
        if (!v2 && line.substr(first + 1, second - first - 1) != "memory") continue;
        const fs::path root = v2 ? "/sys/fs/cgroup" : "/sys/fs/cgroup/memory";
        fs::path group = root / line.substr(std::min(line.size(), second + 2));
        for (int depth = 0; depth < 64; ++depth, group = group.parent_path()) {
            const auto most = entry(group / (v2 ? "memory.max" : "memory.limit_in_bytes"), "");
            const auto used = entry(group / (v2 ? "memory.current" : "memory.usage_in_bytes"), "");
            // File pages count as used and are given back on demand.
            const double files =
                entry(group / "memory.stat", v2 ? "inactive_file " : "total_inactive_file ")
                    .value_or(0.0);
            if (most && used)
                least.limit(*most - *used + files,
                            v2 ? "the control group's memory.max" : "the control group's limit");
            if (group == root || !group.has_relative_path()) break;
        }
    }
    return least.get();
}

AvailableMemory memory_of_process() {
    LeastMemory least;
    const auto resource = [&](auto which, const char* used, const char* because) {
        rlimit r{};
        if (::getrlimit(which, &r) == 0 && r.rlim_cur != RLIM_INFINITY)
            least.limit(static_cast<double>(r.rlim_cur) -
                            entry("/proc/self/status", used).value_or(0.0),
                        because);
    };
    resource(RLIMIT_AS, "VmSize:", "ulimit -v");
    resource(RLIMIT_DATA, "VmData:", "ulimit -d");
    return least.get();
}

std::string AvailableMemory::shortage(double needed, std::string_view of) const {
    return fmt::format("{:.3g} GB are needed {}, and {:.3g} GB are available ({})", needed / 1e9,
                       of, bytes / 1e9, because);
}

AvailableMemory available_memory() {
    const AvailableMemory machine = memory_of_machine(), process = memory_of_process();
    return process.bytes < machine.bytes ? process : machine;
}

} // namespace asperity::io
