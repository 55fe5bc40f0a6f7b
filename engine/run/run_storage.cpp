// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/run/run_storage.hpp"

#include "io/error.hpp"
#include "io/files.hpp"

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

/// Returns true for "auto", or a checkpoint of the directory itself.
bool goes_on_in(const RunOptions& options) {
    if (!options.resuming()) return false;
    std::error_code error;
    return options.resume == "auto" || options.out.empty() ||
           fs::equivalent(folder_of(options.resume), options.out, error);
}

io::ResultRequest request(const RunOptions& options, const Case& c) {
    io::ResultRequest request{options.out,
                              c.scene.name,
                              goes_on_in(options),
                              options.restart,
                              {io::run_file::all.begin(), io::run_file::all.end()},
                              c.inputs()};
    if (options.out.empty() && options.resuming() && options.resume != "auto")
        request.asked = folder_of(options.resume);
    return request;
}

} // namespace

Recorder::Position position_in(const StateNumbers& numbers) {
    Recorder::Position position;
    RestoreNumbers restore(numbers);
    restore("run.records", position);
    return position;
}

RunStorage::RunStorage(const RunOptions& options, const Case& c, const Communicator& ranks)
    : options_(options), ranks_(ranks) {
    ranks_.on_root([&] {
        owner_ = std::make_unique<io::ResultDirectory>(request(options, c));
        notes_ = owner_->notes();
    });
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
            const Recorder::Position position = position_in(read_checkpoint_numbers(file(name)));
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
            directory().rename(checkpoint, io::run_file::checkpoint_damaged);
    }
    if (!damaged.empty())
        throw io::FileError(path(), "has no checkpoint to go on from",
                            fmt::format("{}", fmt::join(damaged, "\n")),
                            "start from the beginning: --restart, or another --out");
    notes_.emplace_back("no checkpoint yet: starting from the beginning");
    return std::nullopt;
}

/// Returns the named checkpoint; one of another directory brings its journal along.
std::optional<io::FilePlace> RunStorage::named() {
    const io::FilePlace place(options_.resume);
    const Recorder::Position position = position_in(read_checkpoint_numbers(place));
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
    const char* next = io::run_file::checkpoint_next;
    write_state(ranks_.root() ? file(next) : io::FilePlace(next));
    ranks_.on_root([&] {
        if (directory().exists(checkpoint)) directory().rename(checkpoint, checkpoint_before);
        directory().rename(next, checkpoint);
        directory().sync();
    });
}

void RunStorage::remove_checkpoints() {
    for (const char* name : {checkpoint, checkpoint_before, io::run_file::checkpoint_damaged})
        directory().remove(name);
}

} // namespace asperity
