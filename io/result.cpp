// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "io/result.hpp"

#include "io/build_info.hpp"
#include "io/error.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

namespace asperity::io {

namespace {

namespace fs = std::filesystem;

void put_path(JsonValue& root, std::string_view path, const JsonValue& value) {
    const std::size_t dot = path.find('.');
    if (dot == std::string_view::npos)
        root[path] = value;
    else
        put_path(root[path.substr(0, dot)], path.substr(dot + 1), value);
}

/// An object of those quantities that are there; null if none is.
JsonValue group(std::initializer_list<std::pair<const char*, Quantity>> members) {
    JsonValue object;
    for (const auto& [name, value] : members)
        object.put(name, value);
    return object;
}

void put_group(JsonValue& root, const char* name, JsonValue object) {
    if (!object.is_null()) root[name] = std::move(object);
}

} // namespace

JsonValue result_json(const ResultRecord& record) {
    JsonValue root = JsonValue::object();
    if (!record.name.empty()) root["name"] = record.name;
    if (!record.scene.is_null()) root["scene"] = record.scene;
    const auto& s = record.surface;
    put_group(root, "surface",
              group({{"rms", s.rms}, {"rms_slope", s.rms_slope}, {"min", s.min}, {"max", s.max}}));
    if (!s.origin.empty()) root["surface"]["origin"] = s.origin;
    root.put("delta_gamma", record.delta_gamma);
    root.put("binding_energy", record.binding_energy);
    const auto& w = record.work_of_adhesion;
    put_group(
        root, "work_of_adhesion",
        group({{"approach", w.approach}, {"pull_off", w.pull_off}, {"pairwise", w.pairwise}}));
    root.put("contact_fraction", record.contact_fraction);
    root.put("pushed_fraction", record.pushed_fraction);
    root.put("pull_off_force", record.pull_off_force);
    put_group(root, "jkr", group({{"in", record.jkr.in}, {"out", record.jkr.out}}));
    const auto& t = record.theory;
    put_group(root, "theory",
              group({{"gamma_eff", t.gamma_eff},
                     {"contact_fraction", t.contact_fraction},
                     {"gamma_full_contact", t.gamma_full_contact}}));
    const auto& e = record.energy;
    put_group(root, "energy",
              group({{"residual", e.residual},
                     {"work", e.work},
                     {"kinetic", e.kinetic},
                     {"elastic", e.elastic},
                     {"interface", e.interface},
                     {"damped", e.damped}}));

    JsonValue& run = root["run"];
    run.put("wall_seconds", record.run.wall_seconds);
    run.put("steps", record.run.steps);
    run.put("iterations", record.run.iterations);
    run.put("ranks", record.run.ranks);
    run.put("threads", record.run.threads);
    JsonValue phases = JsonValue::object();
    for (const ResultRecord::Phase& phase : record.run.phases) {
        phases[phase.name]["seconds"] = phase.seconds;
        phases[phase.name]["calls"] = phase.calls;
    }
    run["phases"] = std::move(phases);
    if (!record.run.stopped.empty()) run["stopped"] = record.run.stopped;
    const BuildInfo build = build_info();
    run["version"] = build.version;
    run["git"] = build.git;
    run["compiler"] = build.compiler;
    run["flags"] = build.flags;
    run["machine"] = machine();

    if (record.failure.exit_code != 0 || !record.failure.reason.empty()) {
        root["failure"]["exit_code"] = record.failure.exit_code;
        root["failure"]["reason"] = record.failure.reason;
    }
    for (const auto& [path, value] : record.extra)
        put_path(root, path, value);
    return root;
}

void write_whole(const std::string& path, const std::string& text) {
    const std::string temporary = fmt::format("{}.{}.tmp", path, ::getpid());
    const auto fail = [&](const char* what) {
        const int cause = errno;
        std::error_code ignored;
        fs::remove(temporary, ignored);
        throw FileError(path, what, std::strerror(cause),
                        "check the permissions of its directory and the space on its disk");
    };
    const int file = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
    if (file < 0) fail("cannot be written");
    std::size_t done = 0;
    while (done < text.size()) {
        const ssize_t n = ::write(file, text.data() + done, text.size() - done);
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) {
            const int cause = errno;
            ::close(file);
            errno = cause;
            fail("cannot be written");
        }
        done += static_cast<std::size_t>(n);
    }
    // The name must not point to data that a power cut could still lose.
    const bool synced = ::fsync(file) == 0 || errno == EINVAL || errno == EROFS;
    const int sync_cause = errno;
    if (::close(file) != 0) fail("cannot be written to its end");
    if (!synced) {
        errno = sync_cause;
        fail("cannot be written to its end");
    }
    if (std::rename(temporary.c_str(), path.c_str()) != 0) fail("cannot be put in its place");
}

void write_result(const std::string& directory, const ResultRecord& record) {
    make_directory(directory);
    write_whole((fs::path(directory) / "result.json").string(), result_json(record).dump() + "\n");
}

ResultPlace choose_result_directory(const std::string& asked, const std::string& name,
                                    bool resuming) {
    const auto holds_result = [](const fs::path& directory) {
        std::error_code error;
        return fs::exists(directory / "result.json", error);
    };
    std::error_code error;
    if (!asked.empty()) {
        if (fs::exists(asked, error) && !fs::is_directory(asked, error))
            throw SceneError(Problem{"--out " + asked, "is not a directory",
                                     "a file of that name is there", "name another directory"});
        if (holds_result(asked) && !resuming)
            throw SceneError(Problem{"--out " + asked, "already holds a result",
                                     "results are not written over",
                                     "name another directory, remove this one, or go on with it: "
                                     "--resume auto"});
        return {asked, ""};
    }
    const fs::path first = fs::path("results") / name;
    if (resuming) { // the last of them
        fs::path last = first;
        for (int i = 2; fs::exists(fs::path(fmt::format("{}-{}", first.string(), i)), error); ++i)
            last = fmt::format("{}-{}", first.string(), i);
        return {last.string(), ""};
    }
    fs::path place = first;
    for (int i = 2; holds_result(place); ++i)
        place = fmt::format("{}-{}", first.string(), i);
    if (place == first) return {first.string(), ""};
    return {place.string(), fmt::format("{} already holds a result; this one goes to {}",
                                        first.string(), place.string())};
}

void make_directory(const std::string& directory) {
    std::error_code error;
    fs::create_directories(directory, error);
    if (error || !fs::is_directory(directory))
        throw FileError(directory, "the directory cannot be made",
                        error ? error.message() : "a file of that name is in the way",
                        "name a directory you may write to: --out DIR");
}

} // namespace asperity::io
