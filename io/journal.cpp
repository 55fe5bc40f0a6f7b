// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "io/journal.hpp"

#include "io/error.hpp"

#include <algorithm>
#include <cerrno>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

namespace asperity::io {

namespace {

/// Head of each entry.
struct Head {
    std::uint64_t kind;
    std::uint64_t size; ///< size of the payload, bytes
};

} // namespace

bool Journal::holds(const Directory& directory, const std::string& name, const Mark& mark) {
    const Descriptor file = directory.open(name, O_RDONLY);
    return file && digest_of(file.get(), mark.bytes) == mark.digest;
}

void Journal::copy(const Directory& from, const Directory& to, const std::string& name,
                   const Mark& mark) {
    const Descriptor source = from.open(name, O_RDONLY);
    OutputFile target({to, name});
    if (!source || !read_parts(source.get(), mark.bytes, [&](Bytes part) { target.write(part); }))
        fail_by_system(from / name, "cannot be copied",
                       "keep a checkpoint and its run.journal in one directory");
    target.commit();
}

Journal::Journal(const Directory& directory, const std::string& name, std::uint64_t bytes)
    : path_(directory / name), file_(directory.open(name, O_RDWR | O_CREAT | O_NOFOLLOW)),
      bytes_(bytes) {
    if (!file_ || ::ftruncate(file_.get(), static_cast<off_t>(bytes)) != 0)
        fail_by_system(path_, "cannot be written");
    const std::optional<std::uint32_t> digest = digest_of(file_.get(), bytes);
    if (!digest) fail_by_system(path_, "cannot be read");
    digest_ = *digest;
}

void Journal::append(std::uint64_t kind, Bytes payload) {
    const Head head = {kind, payload.size()};
    const auto first = std::as_bytes(std::span(&head, 1));
    if (failed_) errno = EIO;
    if (failed_ || !write_all(file_.get(), first, bytes_) ||
        !write_all(file_.get(), payload, bytes_ + first.size())) {
        failed_ = true;
        fail_by_system(path_, "cannot be appended to");
    }
    digest_ = digest_of(payload, digest_of(first, digest_));
    bytes_ += first.size() + payload.size();
}

void Journal::synchronize() {
    if (!bring_to_disk(file_.get())) {
        failed_ = true;
        fail_by_system(path_, "cannot be brought to the disk");
    }
}

void Journal::replay(const std::function<void(std::uint64_t, Bytes)>& take) const {
    std::vector<std::byte> payload;
    for (std::uint64_t at = 0; at < bytes_;) {
        Head head{};
        const auto first = std::as_writable_bytes(std::span(&head, 1));
        const bool read = read_some(file_.get(), first, at) == sizeof head;
        at += sizeof head;
        if (!read || head.size > bytes_ - at) fail_by_system(path_, "cannot be read back");
        payload.resize(head.size);
        if (read_some(file_.get(), payload, at) != static_cast<std::ptrdiff_t>(head.size))
            fail_by_system(path_, "cannot be read back");
        take(head.kind, payload);
        at += head.size;
    }
}

void PayloadReader::take(std::span<std::byte> to) {
    if (to.size() > bytes_.size())
        throw FileError("run.journal", "holds an entry that is too short",
                        fmt::format("{} bytes where {} are expected", bytes_.size(), to.size()),
                        "this is a mistake in the program");
    std::copy_n(bytes_.begin(), to.size(), to.begin());
    bytes_ = bytes_.subspan(to.size());
}

} // namespace asperity::io
