// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "io/result_directory.hpp"

#include "io/error.hpp"
#include "io/files.hpp"
#include "io/json.hpp"

#include <cerrno>
#include <exception>
#include <filesystem>

#include <fmt/format.h>
#include <unistd.h>

namespace asperity::io {

namespace {

namespace fs = std::filesystem;

// Contents of a directory.

/// Returns the contents of result.json; null if it is damaged. Throws FileError if it is no regular
/// file.
Json result_in(const std::string& file) {
    const std::optional<std::string> text = contents_of(file);
    try {
        return text ? parse_json(*text, file) : Json();
    } catch (const FileError&) {
        return {};
    }
}

enum class Holds { nothing, result, unfinished_run };

Holds holds(const fs::path& directory) {
    std::error_code error;
    const auto there = [&](const char* name) { return fs::exists(directory / name, error); };
    // Checkpoints: of versions that had no journal.
    const bool begun = there(run_file::journal) || there(run_file::checkpoint);
    if (!there("result.json")) return begun ? Holds::unfinished_run : Holds::nothing;
    if (!begun) return Holds::result;
    const Json result = result_in(directory / "result.json");
    const Json* const stopped = find(result, "run.stopped");
    const Json* const code = find(result, "failure.exit_code");
    const bool goes_on = (stopped && (*stopped == "wall_limit" || *stopped == "signal")) ||
                         (code && *code == exit_code::input_output);
    return goes_on ? Holds::unfinished_run : Holds::result;
}

fs::path first_place(const ResultRequest& request) { return fs::path("results") / request.name; }

std::string numbered(const fs::path& first, int i) {
    return i == 1 ? first.string() : fmt::format("{}-{}", first.string(), i);
}

std::string choose(const ResultRequest& request) {
    std::error_code error;
    if (!request.asked.empty()) {
        if (fs::exists(request.asked, error) && !fs::is_directory(request.asked, error))
            throw SceneError(Problem{"--out " + request.asked, "is not a directory",
                                     "a file of that name is there", "name another directory"});
        if (fs::equivalent(request.asked, "/", error))
            throw SceneError(Problem{"--out " + request.asked, "is the root of all directories",
                                     "a result has a directory of its own",
                                     "name another directory"});
        return request.asked;
    }
    const fs::path first = first_place(request);
    int i = 1;
    if (request.resume) // the last of them
        while (fs::exists(numbered(first, i + 1), error))
            ++i;
    else
        while (holds(numbered(first, i)) == Holds::result)
            ++i;
    return numbered(first, i);
}

/// Throws where the request does not fit what is there.
void check(const ResultRequest& request, const Directory& directory) {
    const std::string& path = directory.path();
    const Holds found = holds(path);
    const auto there = [&](const char* name) { return directory.exists(name); };
    const bool resumable = there(run_file::checkpoint) || there(run_file::checkpoint_before);
    if (found == Holds::result && request.resume && !resumable && !there(run_file::journal))
        throw SceneError(Problem{"--resume auto", path + " holds a result and no checkpoint",
                                 "the run in it has ended",
                                 "nothing is left to do; for a new run give another --out"});
    if (found == Holds::result && !request.resume)
        throw SceneError(Problem{path, "already holds a result, result.json",
                                 "results are not written over",
                                 std::string("name another directory (--out), or remove this one") +
                                     (resumable ? "; or go on with it: --resume auto" : "")});
    if (found == Holds::unfinished_run && !request.resume && !request.restart)
        throw SceneError(Problem{
            path,
            fmt::format("holds an unfinished run, {}",
                        there(run_file::journal) ? run_file::journal : run_file::checkpoint),
            "starting anew would throw away what it has done",
            "go on with it: --resume auto; or name another directory: --out; "
            "or throw it away: --restart"});
}

} // namespace

ResultDirectory::ResultDirectory(const ResultRequest& request, const std::string& path)
    : made_(::access(path.c_str(), F_OK) != 0), directory_(Directory::make(path)),
      record_(directory_) {
    const std::string first = first_place(request).string();
    if (request.asked.empty() && !request.resume && path != first)
        notes_.push_back(
            fmt::format("{} already holds a result; this one goes to {}", first, path));
}

// If this constructor throws, the destructor undoes its work: the other constructor has ended.
ResultDirectory::ResultDirectory(const ResultRequest& request)
    : ResultDirectory(request, choose(request)) {
    record_.claim_passing(DirectoryLock::name);
    lock_.emplace(directory_, ::getpid());
    if (!lock_->note().empty()) notes_.push_back(lock_->note());
    record_.remove_left_over(); // also of a run that had come to its end
    check(request, directory_);
    record_.claim(request.files, request.inputs);
    if (request.restart)
        for (const std::string& file : request.files)
            directory_.remove(file);
}

void ResultDirectory::require_in_place() const {
    std::error_code error;
    const std::string handle = fmt::format("/proc/self/fd/{}", directory_.fd());
    if (fs::equivalent(path(), handle, error)) return;
    const fs::path now = fs::read_symlink(handle, error);
    throw FileError(path(), "is not where it was when the run began",
                    error ? std::string("it was moved or replaced")
                          : fmt::format("it is {} now", now.string()),
                    "look for the result there");
}

ResultDirectory::~ResultDirectory() {
    try {
        record_.release(std::uncaught_exceptions() == 0 && !directory_.exists(run_file::journal));
    } catch (const std::exception&) { // the files stay unfinished in the record
    }
    lock_.reset(); // removes its file
    std::error_code ignored;
    if (made_) fs::remove(path(), ignored); // an empty directory alone is removed
}

} // namespace asperity::io
