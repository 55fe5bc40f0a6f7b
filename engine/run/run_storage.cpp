// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/run/run_storage.hpp"

#include "io/error.hpp"
#include "io/output_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <utility>

namespace asperity {

namespace {

namespace fs = std::filesystem;
using io::run_file::checkpoint, io::run_file::checkpoint_before, io::run_file::journal;

std::string folder_of(const std::string& file) {
    const std::string folder = fs::path(file).parent_path().string();
    return folder.empty() ? "." : folder;
}

/// "auto", or a checkpoint of the directory itself.
bool goes_on_in(const RunOptions& options) {
    if (!options.resuming()) return false;
    std::error_code error;
    return options.resume == "auto" || options.out.empty() ||
           fs::equivalent(folder_of(options.resume), options.out, error);
}

io::ResultRequest request(const RunOptions& options, const std::string& name) {
    io::ResultRequest request{options.out, name, goes_on_in(options), options.restart};
    if (options.out.empty() && options.resuming() && options.resume != "auto")
        request.asked = folder_of(options.resume);
    return request;
}

double number(const RunScalars& scalars, const std::string& name) {
    // Those of a simulation have a prefix (checkpoint.cpp).
    const auto found = std::find_if(scalars.begin(), scalars.end(), [&](const auto& s) {
        return s.first == name || s.first == "run." + name;
    });
    if (found == scalars.end())
        throw io::FileError("checkpoint", "has no number \"" + name + "\"",
                            "it was written by another version of the program",
                            "run the scene from its start");
    return found->second;
}

} // namespace

void add_position(const Recorder::Position& position, RunScalars& scalars) {
    scalars.emplace_back("rows", static_cast<double>(position.rows));
    scalars.emplace_back("journal.bytes", static_cast<double>(position.mark.bytes));
    scalars.emplace_back("journal.digest", static_cast<double>(position.mark.digest));
}

Recorder::Position position_in(const RunScalars& scalars) {
    const auto integer = [&](const char* name, double most) {
        const double value = number(scalars, name);
        if (!(value >= 0.0 && value <= most))
            throw io::FileError("checkpoint", fmt::format("has {} = {}", name, value),
                                "no record of a run is there", "run the scene from its start");
        return static_cast<std::uint64_t>(value);
    };
    constexpr double exact = 9007199254740992.0; // 2^53
    return {integer("rows", exact),
            {integer("journal.bytes", exact),
             static_cast<std::uint32_t>(integer("journal.digest", 4294967295.0))}};
}

RunStorage::RunStorage(const RunOptions& options, const std::string& name,
                       const Communicator& ranks)
    : options_(options), ranks_(ranks) {
    ranks_.on_root([&] {
        owner_ = std::make_unique<io::ResultDirectory>(request(options, name));
        notes_ = owner_->notes();
        const auto there = [&](const char* file) { return directory().exists(file); };
        if (options.resume == "auto" && there("result.json") && !there(checkpoint) &&
            !there(checkpoint_before) && !there(journal))
            throw io::SceneError({"--resume auto", path() + " holds a result and no checkpoint",
                                  "the run in it has ended",
                                  "nothing is left to do; for a new run give another --out"});
    });
}

std::string RunStorage::path() const {
    const io::Directory& d = directory();
    return d.place() == io::Directory::Place::moved ? d.present_path() : d.path();
}

std::vector<std::string> RunStorage::take_notes() { return std::exchange(notes_, {}); }

std::optional<io::FilePlace> RunStorage::checkpoint_to_resume() {
    if (!options_.resuming()) return std::nullopt;
    std::optional<io::FilePlace> place;
    std::array<double, 1> found = {0.0};
    ranks_.on_root([&] {
        place = options_.resume == "auto" ? newest_whole() : named();
        found[0] = place ? 1.0 : 0.0;
    });
    ranks_.broadcast(std::span<double>(found));
    if (found[0] == 0.0) return std::nullopt;
    return place ? place : io::FilePlace("on the root");
}

std::optional<io::FilePlace> RunStorage::newest_whole() {
    std::vector<std::string> damaged;
    for (const char* name : {checkpoint, checkpoint_before}) {
        if (!directory().exists(name)) continue;
        std::string what;
        try {
            const Recorder::Position position = position_in(read_checkpoint_scalars(file(name)));
            if (io::Journal::holds(directory(), journal, position.mark)) {
                if (!damaged.empty())
                    notes_.push_back(
                        fmt::format("going on from the checkpoint before, {}", directory() / name));
                return file(name);
            }
            what = fmt::format("{}: the records that it goes on from are missing or damaged in {}",
                               directory() / name, directory() / journal);
        } catch (const io::FileError& error) {
            what = io::format({"",
                               error.problems().front().where + " " + error.problems().front().what,
                               error.problems().front().why, ""});
        }
        damaged.push_back(what);
        notes_.push_back(what);
        if (name == std::string(checkpoint) && directory().exists(checkpoint_before))
            directory().rename(checkpoint, "checkpoint-damaged.h5");
    }
    if (!damaged.empty())
        throw io::FileError(path(), "has no checkpoint to go on from",
                            fmt::format("{}", fmt::join(damaged, "\n")),
                            "start from the beginning: --restart, or another --out");
    notes_.emplace_back("no checkpoint yet: starting from the beginning");
    return std::nullopt;
}

/// A checkpoint of another directory brings its records along.
std::optional<io::FilePlace> RunStorage::named() {
    const io::FilePlace place(options_.resume);
    const Recorder::Position position = position_in(read_checkpoint_scalars(place));
    const io::Directory from(folder_of(options_.resume));
    if (!io::Journal::holds(from, journal, position.mark))
        throw io::FileError(options_.resume, "cannot be gone on from",
                            "the records before it are missing or damaged in " + from / journal,
                            "keep a checkpoint and its run.journal in one directory");
    if (!goes_on_in(options_)) io::Journal::copy(from, directory(), journal, position.mark);
    return place;
}

void RunStorage::save(const std::function<void(const io::FilePlace&)>& write_state) {
    // Whole and on the disk before the others move; what a kill leaves of it is removed later.
    const std::string next = std::string("checkpoint-next") + io::OutputFile::suffix;
    write_state(ranks_.root() ? file(next) : io::FilePlace(next));
    ranks_.on_root([&] {
        if (directory().exists(checkpoint)) directory().rename(checkpoint, checkpoint_before);
        directory().rename(next, checkpoint);
        directory().sync();
    });
}

void RunStorage::remove_checkpoints() {
    for (const char* name : {checkpoint, checkpoint_before, "checkpoint-damaged.h5"})
        directory().remove(name);
}

bool RunStorage::in_place(const Recorder& recorder) const {
    return directory().place() == io::Directory::Place::here && recorder.in_place();
}

void RunStorage::bring_back(Recorder& recorder) {
    if (directory().place() == io::Directory::Place::removed) owner_->make_again();
    if (!recorder.in_place()) recorder.move_to(directory());
}

} // namespace asperity
