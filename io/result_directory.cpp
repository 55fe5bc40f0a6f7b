// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "io/result_directory.hpp"

#include "io/error.hpp"
#include "io/output_file.hpp"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <thread>

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace asperity::io {

namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

// What a directory holds.

enum class Holds { nothing, result, unfinished };

Holds holds(const fs::path& directory) {
    std::error_code error;
    const auto there = [&](const char* name) { return fs::exists(directory / name, error); };
    // Checkpoints: of versions that had no journal.
    const bool begun = there(run_file::journal) || there(run_file::checkpoint);
    if (!there("result.json")) return begun ? Holds::unfinished : Holds::nothing;
    if (!begun) return Holds::result;
    using nlohmann::json;
    const json result = json::parse(text_of(directory / "result.json"), nullptr, false);
    if (!result.is_object()) return Holds::result;
    const json run = result.value("run", json::object());
    const json stopped = run.is_object() ? run.value("stopped", json("")) : json("");
    const json failure = result.value("failure", json::object());
    const json code = failure.is_object() ? failure.value("exit_code", json(0)) : json(0);
    const bool goes_on =
        stopped == "wall_limit" || stopped == "signal" || code == exit_code::input_output;
    return goes_on ? Holds::unfinished : Holds::result;
}

std::string numbered(const fs::path& first, int i) {
    return i == 1 ? first.string() : fmt::format("{}-{}", first.string(), i);
}

std::string choose(const ResultRequest& request, std::vector<std::string>& notes) {
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
    const fs::path first = fs::path("results") / request.name;
    int i = 1;
    if (request.resume) // the last of them
        while (fs::exists(numbered(first, i + 1), error))
            ++i;
    else
        while (holds(numbered(first, i)) == Holds::result)
            ++i;
    if (i > 1 && !request.resume)
        notes.push_back(fmt::format("{} already holds a result; this one goes to {}",
                                    first.string(), numbered(first, i)));
    return numbered(first, i);
}

/// Throws where the request does not fit what is there.
void judge(const ResultRequest& request, const std::string& path) {
    const Holds found = holds(path);
    if (found == Holds::result && !request.resume)
        throw SceneError(Problem{path, "already holds a result", "results are not written over",
                                 "name another directory (--out), remove this one, or go on with "
                                 "it: --resume auto"});
    if (found == Holds::unfinished && !request.resume && !request.restart)
        throw SceneError(Problem{path, "holds an unfinished run",
                                 "starting anew would throw away what it has done",
                                 "go on with it: --resume auto; or name another directory: --out; "
                                 "or throw it away: --restart"});
}

/// Not the locks of others that are about to be taken.
bool is_left_over(const std::string& name) {
    return name.ends_with(OutputFile::suffix) && !name.starts_with(run_file::lock);
}

bool is_of_run(const std::string& name) {
    return name == run_file::journal || name == run_file::checkpoint ||
           name == run_file::checkpoint_before || name == "run.h5" || name == "result.json";
}

template <class Which>
void remove_files(const Directory& directory, const Which& which) {
    std::vector<std::string> names;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(directory.path(), error))
        if (which(entry.path().filename().string()))
            names.push_back(entry.path().filename().string());
    for (const std::string& name : names)
        directory.remove(name);
}

// The lock.

std::string host_name() {
    char name[256] = "";
    ::gethostname(name, sizeof name - 1);
    return name;
}

std::string boot() {
    std::string id = text_of("/proc/sys/kernel/random/boot_id");
    return id.substr(0, id.find('\n'));
}

/// When the process was started, in the system's ticks since it was booted; empty: there is none.
std::string start_of(const std::string& process) {
    const std::string stat = text_of("/proc/" + process + "/stat");
    const std::size_t name_end = stat.rfind(')');
    if (name_end == std::string::npos) return "";
    std::istringstream words(stat.substr(name_end + 1));
    std::string word;
    for (int i = 0; i < 20; ++i)
        words >> word;
    return word;
}

using Holder = std::map<std::string, std::string>;

std::string lock_text() {
    const std::string process = std::to_string(::getpid());
    const std::time_t now = std::time(nullptr);
    return fmt::format("host {}\nprocess {}\nstart {}\nboot {}\nsince {:%Y-%m-%d %H:%M:%S}\n",
                       host_name(), process, start_of(process), boot(), fmt::localtime(now));
}

Holder read_lock(const Directory& directory) {
    Holder holder;
    const Descriptor file = directory.open(run_file::lock, O_RDONLY);
    std::string text(4096, '\0');
    if (!file) return holder;
    text.resize(static_cast<std::size_t>(std::max<std::ptrdiff_t>(
        0, read_some(file.get(), std::as_writable_bytes(std::span(text)), 0))));
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
        if (const std::size_t space = line.find(' '); space != std::string::npos)
            holder[line.substr(0, space)] = line.substr(space + 1);
    return holder;
}

/// Whether some process keeps a flock on it.
bool is_kept(const Directory& directory) {
    const Descriptor file = directory.open(run_file::lock, O_RDWR);
    return file && ::flock(file.get(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
}

bool is_gone(const Directory& directory, Holder& holder) {
    if (is_kept(directory) || holder["host"] != host_name()) return false;
    return holder["boot"] != boot() || start_of(holder["process"]) != holder["start"];
}

/// Of the processes that take or break locks in this directory one at a time, where the file system
/// can do that; a process that was stopped meanwhile is not waited for.
class Turn {
public:
    explicit Turn(const Directory& directory) : fd_(directory.fd()) {
        for (int i = 0; i < 50 && ::flock(fd_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK; ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    ~Turn() { ::flock(fd_, LOCK_UN); }
    Turn(const Turn&) = delete;
    Turn& operator=(const Turn&) = delete;

private:
    int fd_;
};

} // namespace

ResultDirectory::ResultDirectory(const ResultRequest& request)
    : directory_([&] {
          const std::string path = choose(request, notes_);
          std::error_code error;
          made_ = !fs::exists(path, error);
          return Directory::make(path);
      }()) {
    lock();
    try {
        judge(request, path());
        remove_files(directory_, is_left_over);
        if (request.restart) remove_files(directory_, is_of_run);
    } catch (...) {
        unlock();
        throw;
    }
}

ResultDirectory::~ResultDirectory() {
    unlock();
    std::error_code ignored;
    if (made_) fs::remove(path(), ignored); // which removes no directory with something in it
}

void ResultDirectory::lock() {
    const Turn turn(directory_);
    // Of processes that died on the way; those that live wait for their turn.
    remove_files(directory_, [](const std::string& name) {
        return name.starts_with(run_file::lock) && name.ends_with(OutputFile::suffix);
    });
    const std::string temporary =
        fmt::format("{}.{}{}", run_file::lock, ::getpid(), OutputFile::suffix);
    const std::string text = lock_text();
    const auto fail = [&] {
        const int cause = errno;
        ::unlinkat(directory_.fd(), temporary.c_str(), 0);
        throw FileError(directory_ / run_file::lock, "cannot be written", std::strerror(cause),
                        "check the permissions of its directory and the space on its disk");
    };
    lock_ = directory_.open(temporary, O_RDWR | O_CREAT | O_TRUNC | O_NOFOLLOW);
    if (!lock_) fail();
    ::flock(lock_.get(), LOCK_EX | LOCK_NB); // some file systems cannot; then the rest must do
    if (!write_all(lock_.get(), std::as_bytes(std::span(text)), 0) || ::fsync(lock_.get()) != 0)
        fail();
    for (int i = 0;
         ::linkat(directory_.fd(), temporary.c_str(), directory_.fd(), run_file::lock, 0) != 0;
         ++i) {
        if (errno != EEXIST || i == 3) fail();
        Holder holder = read_lock(directory_);
        if (holder.empty() && !directory_.exists(run_file::lock)) continue; // given back just now
        if (!is_gone(directory_, holder)) {
            ::unlinkat(directory_.fd(), temporary.c_str(), 0);
            const std::string file = directory_ / run_file::lock;
            const bool known = holder.count("process") > 0;
            throw FileError(
                path(), "is in use by another process",
                known ? fmt::format("process {} on host {} has had it since {} ({})",
                                    holder["process"], holder["host"], holder["since"], file)
                      : file + " does not say by whom",
                holder["host"] == host_name()
                    ? "wait for its end, stop it, or name another directory: --out"
                    : "wait for its end, or name another directory (--out); where it is certain "
                      "that no such process lives, remove " +
                          file);
        }
        notes_.push_back(fmt::format("{}: process {} on {}, which has had it since {}, is gone; "
                                     "its lock is broken",
                                     path(), holder["process"], holder["host"], holder["since"]));
        directory_.remove(run_file::lock);
    }
    ::unlinkat(directory_.fd(), temporary.c_str(), 0);
}

void ResultDirectory::unlock() {
    struct stat mine {
    }, there{};
    if (::fstat(lock_.get(), &mine) == 0 &&
        ::fstatat(directory_.fd(), run_file::lock, &there, AT_SYMLINK_NOFOLLOW) == 0 &&
        mine.st_ino == there.st_ino && mine.st_dev == there.st_dev)
        ::unlinkat(directory_.fd(), run_file::lock, 0);
    lock_ = Descriptor();
}

} // namespace asperity::io
