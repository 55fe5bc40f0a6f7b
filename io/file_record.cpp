// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "io/file_record.hpp"

#include "io/error.hpp"
#include "io/json.hpp"

#include <cerrno>
#include <cstdint>
#include <memory>
#include <span>
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
    const std::optional<std::string> text = contents_of({directory_, name}, O_NOFOLLOW);
    if (!text) return std::nullopt;
    std::optional<Names> names = sealed_texts(*text, "files");
    if (!names)
        throw SceneError(Problem{directory_ / name, "is no record of the files that Asperity wrote",
                                 "it does not end in its digest: it was changed or damaged",
                                 "move it away; the files that it named are not replaced then"});
    return names;
}

bool FileRecord::calls_unfinished(const std::string& file) const {
    const std::optional<Names> names = read();
    const auto known = names ? names->find(file) : Names::const_iterator();
    return names && known != names->end() && known->second == unfinished;
}

void FileRecord::remove_left_over() {
    update([&](const std::optional<Names>& before) {
        Names after = before.value_or(Names());
        std::erase_if(after, [&](const auto& entry) {
            const auto& [file, digest] = entry;
            const bool left = digest == unfinished && file.ends_with(OutputFile::suffix) &&
                              file.find('/') == std::string::npos;
            if (left) directory_.remove(file);
            return left;
        });
        return after;
    });
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
    if (known->second == unfinished)
        return status.st_nlink > 1 ? "it is a hard link: the same file has another name" : "";
    if (known->second != digest_of_file(directory_, file))
        return "it was changed after Asperity wrote it";
    return "it belongs to an earlier result, and results are not written over";
}

void FileRecord::write(const std::string& text, bool replace) const {
    const Bytes bytes = std::as_bytes(std::span(text));
    const Descriptor unnamed(
        replace ? -1 : ::openat(directory_.fd(), ".", O_TMPFILE | O_WRONLY | O_CLOEXEC, 0644));
    if (unnamed && write_all(unnamed.get(), bytes, 0) && bring_to_disk(unnamed.get()) &&
        ::linkat(AT_FDCWD, fmt::format("/proc/self/fd/{}", unnamed.get()).c_str(), directory_.fd(),
                 name, AT_SYMLINK_FOLLOW) == 0)
        return directory_.sync();
    const std::string beside = std::string(name) + OutputFile::suffix;
    if (replace) directory_.remove(beside);
    OutputFile file({directory_, name}, beside);
    file.write(bytes);
    file.commit();
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
    write(sealed_texts("files", after), before.has_value());
}

void FileRecord::claim_passing(const std::string& file) {
    update([&](const std::optional<Names>& before) {
        Names after = before.value_or(Names());
        const auto known = after.find(file);
        if (known == after.end() ? !directory_.exists(file) : known->second == unfinished) {
            after[file] = unfinished;
            passing_.push_back(file);
        }
        return after;
    });
}

void FileRecord::claim(const std::vector<std::string>& names,
                       const std::vector<std::string>& inputs) {
    std::vector<std::string> passing;
    for (const std::string& file : names)
        passing.push_back(OutputFile::temporary(file));
    update([&](const std::optional<Names>& before) {
        std::optional<Names> earlier = before;
        for (const std::string& file : passing_)
            if (earlier) earlier->erase(file);
        if (earlier && earlier->empty()) earlier.reset(); // no record but this command's own
        std::vector<Problem> problems;
        for (const std::string& file : names)
            if (const std::string why = reason_to_keep(file, earlier, inputs); !why.empty())
                problems.push_back({directory_ / file, "is there already and is not replaced", why,
                                    "move it away, or name another directory (--out)"});
        if (!problems.empty()) throw SceneError(std::move(problems));
        Names after = before.value_or(Names());
        for (const auto* const list : {&names, &std::as_const(passing)})
            for (const std::string& file : *list)
                after[file] = unfinished;
        return after;
    });
    claimed_ = names;
    passing_.insert(passing_.end(), passing.begin(), passing.end());
}

void FileRecord::release(bool finished) {
    if (claimed_.empty() && passing_.empty()) return;
    update([&](const std::optional<Names>& before) {
        Names after = before.value_or(Names());
        for (const std::string& file : std::exchange(passing_, {}))
            after.erase(file);
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
