// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "io/file_record.hpp"

#include "io/error.hpp"
#include "io/json.hpp"

#include <cerrno>
#include <cstdint>
#include <memory>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>

namespace asperity::io {

namespace {

constexpr const char* unfinished = "unfinished";

std::string digest_of_file(const Directory& directory, const std::string& name) {
    struct stat status {};
    const Descriptor file = directory.open(name, O_RDONLY | O_NOFOLLOW);
    std::optional<std::uint32_t> digest;
    if (file && ::fstat(file.get(), &status) == 0)
        digest = digest_of(file.get(), static_cast<std::uint64_t>(status.st_size));
    if (!digest) fail_by_system(directory / name, "cannot be read");
    return digest_text(*digest);
}

bool is_same_file(const struct stat& one, const std::string& path) {
    struct stat other {};
    return ::stat(path.c_str(), &other) == 0 && one.st_dev == other.st_dev &&
           one.st_ino == other.st_ino;
}

} // namespace

std::optional<FileRecord::Names> FileRecord::read() const {
    const std::string path = directory_ / name;
    const Descriptor file = directory_.open(name, O_RDONLY | O_NOFOLLOW);
    struct stat status {};
    if (!file && errno == ENOENT) return std::nullopt;
    std::string text;
    if (!file || ::fstat(file.get(), &status) != 0 ||
        !read_parts(file.get(), static_cast<std::uint64_t>(status.st_size), [&](Bytes part) {
            text.append(reinterpret_cast<const char*>(part.data()), part.size());
        }))
        fail_by_system(path, "cannot be read", "check its permissions");
    const Json json = is_sealed_json(text) ? Json::parse(text, nullptr, false) : Json();
    const Json* const files = find(json, "files");
    if (!files || !files->is_object())
        throw SceneError(Problem{path, "is no record of the files that Asperity wrote",
                                 "it does not end in its digest: it was changed or damaged",
                                 "move it away; the files that it named are not replaced then"});
    Names names;
    for (const auto& [file_name, digest] : files->items())
        if (digest.is_string()) names[file_name] = digest.get<std::string>();
    return names;
}

std::string FileRecord::reason_to_keep(const std::string& file, const std::optional<Names>& names,
                                       const std::vector<std::string>& inputs) const {
    struct stat status {
    }, target{};
    if (::fstatat(directory_.fd(), file.c_str(), &status, AT_SYMLINK_NOFOLLOW) != 0) {
        if (errno != ENOENT)
            fail_by_system(directory_ / file, "cannot be looked at",
                           "check the disk, or its connection");
        return "";
    }
    if (::fstatat(directory_.fd(), file.c_str(), &target, 0) == 0)
        for (const std::string& input : inputs)
            if (is_same_file(target, input))
                return fmt::format("it is {}, which the command reads", input);
    if (S_ISLNK(status.st_mode)) return "it is a symbolic link";
    if (!S_ISREG(status.st_mode)) return "it is no regular file";
    if (!names)
        return fmt::format("the directory has no record ({}) of the files that Asperity wrote: the "
                           "file is another program's, or of a version without records",
                           name);
    const auto known = names->find(file);
    if (known == names->end())
        return fmt::format("it is not one of the files that Asperity wrote here ({} lists them)",
                           name);
    if (known->second == unfinished) return "";
    if (known->second != digest_of_file(directory_, file))
        return "it was changed after Asperity wrote it";
    return "it belongs to an earlier result, and results are not written over";
}

void FileRecord::update(const std::function<Names(const std::optional<Names>&)>& change) const {
    // Another command may write other files of the directory at the same time. A file system that
    // has no such locks does without.
    ::flock(directory_.fd(), LOCK_EX);
    const auto unlock = [](const Directory* d) { ::flock(d->fd(), LOCK_UN); };
    const std::unique_ptr<const Directory, decltype(unlock)> lock(&directory_, unlock);
    const std::optional<Names> before = read();
    const Names after = change(before);
    if (after.empty()) return directory_.remove(name);
    if (after == before) return;
    Json json;
    json["files"] = after;
    write_whole({directory_, name}, sealed_json(json));
}

void FileRecord::claim(const std::vector<std::string>& names,
                       const std::vector<std::string>& inputs) {
    update([&](const std::optional<Names>& before) {
        std::vector<Problem> problems;
        for (const std::string& file : names)
            if (const std::string why = reason_to_keep(file, before, inputs); !why.empty())
                problems.push_back({directory_ / file, "is there already and is not replaced", why,
                                    "move it away, or name another directory (--out)"});
        if (!problems.empty()) throw SceneError(std::move(problems));
        Names after = before.value_or(Names());
        for (const std::string& file : names)
            after[file] = unfinished;
        return after;
    });
    claimed_ = names;
}

void FileRecord::release(bool finished) {
    if (claimed_.empty()) return;
    update([&](const std::optional<Names>& before) {
        Names after = before.value_or(Names());
        for (const std::string& file : std::exchange(claimed_, {})) {
            struct stat status {};
            if (::fstatat(directory_.fd(), file.c_str(), &status, AT_SYMLINK_NOFOLLOW) != 0)
                after.erase(file);
            else
                after[file] = finished ? digest_of_file(directory_, file) : unfinished;
        }
        return after;
    });
}

} // namespace asperity::io
