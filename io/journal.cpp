// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "io/journal.hpp"

#include "io/error.hpp"

#include <algorithm>
#include <cerrno>
#include <stdexcept>
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
    : path_(directory / name),
      file_(directory.open(name, O_RDWR | O_CREAT | O_NOFOLLOW)), complete_{.bytes = bytes} {
    if (!file_ || ::ftruncate(file_.get(), static_cast<off_t>(bytes)) != 0)
        fail_by_system(path_, "cannot be written");
    const std::optional<std::uint32_t> digest = digest_of(file_.get(), bytes);
    if (!digest) fail_by_system(path_, "cannot be read");
    complete_.digest = *digest;
    written_ = complete_;
}

void Journal::begin(std::uint64_t kind, std::uint64_t size) {
    const Head head = {kind, size};
    missing_ = sizeof head + size;
    add(std::as_bytes(std::span(&head, 1)));
}

void Journal::add(Bytes part) {
    if (part.size() > missing_) throw std::logic_error(path_ + ": an entry gets too many bytes");
    if (failed_) errno = EIO;
    if (failed_ || !write_all(file_.get(), part, written_.bytes)) {
        failed_ = true;
        fail_by_system(path_, "cannot be appended to");
    }
    written_.digest = digest_of(part, written_.digest);
    written_.bytes += part.size();
    missing_ -= part.size();
    if (missing_ == 0) complete_ = written_;
}

void Journal::synchronize() {
    if (!bring_to_disk(file_.get())) {
        failed_ = true;
        fail_by_system(path_, "cannot be brought to the disk");
    }
}

void Journal::replay(const std::function<void(std::uint64_t, PayloadReader payload)>& take) const {
    for (std::uint64_t at = 0; at < complete_.bytes;) {
        Head head{};
        const auto first = std::as_writable_bytes(std::span(&head, 1));
        const bool read = read_some(file_.get(), first, at) == sizeof head;
        at += sizeof head;
        if (!read || head.size > complete_.bytes - at) fail_by_system(path_, "cannot be read back");
        take(head.kind, PayloadReader(file_.get(), path_, at, head.size));
        at += head.size;
    }
}

void PayloadReader::take(std::span<std::byte> to) {
    if (to.size() > left_)
        throw FileError("run.journal", "holds an entry that is too short",
                        fmt::format("{} bytes where {} are expected", left_, to.size()),
                        "this is a mistake in the program");
    left_ -= to.size();
    if (file_ < 0) {
        std::copy_n(bytes_.begin(), to.size(), to.begin());
        bytes_ = bytes_.subspan(to.size());
        return;
    }
    if (read_some(file_, to, offset_) != static_cast<std::ptrdiff_t>(to.size()))
        fail_by_system(*path_, "cannot be read back");
    offset_ += to.size();
}

} // namespace asperity::io
