// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "io/output_file.hpp"

#include "io/digest.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace asperity::io {

namespace {

constexpr char seal_name[17] = "asperity digest\n";

/// The last bytes of a sealed file.
struct SealBytes {
    char name[16];
    std::uint64_t length; ///< of what comes before
    std::uint64_t digest; ///< of what comes before
};
static_assert(sizeof(SealBytes) == 32);

std::uint64_t size_of(int fd) {
    struct stat status {};
    return ::fstat(fd, &status) == 0 ? static_cast<std::uint64_t>(status.st_size) : 0;
}

} // namespace

bool write_all(int fd, std::span<const std::byte> bytes, std::uint64_t offset) {
    while (!bytes.empty()) {
        const ssize_t n = ::pwrite(fd, bytes.data(), bytes.size(), static_cast<off_t>(offset));
        if (n < 0 && errno == EINTR) continue;
        if (n == 0) errno = ENOSPC;
        if (n <= 0) return false;
        bytes = bytes.subspan(static_cast<std::size_t>(n));
        offset += static_cast<std::uint64_t>(n);
    }
    return true;
}

std::ptrdiff_t read_some(int fd, std::span<std::byte> bytes, std::uint64_t offset) {
    std::ptrdiff_t done = 0;
    while (!bytes.empty()) {
        const ssize_t n = ::pread(fd, bytes.data(), bytes.size(), static_cast<off_t>(offset));
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) return -1;
        if (n == 0) break;
        bytes = bytes.subspan(static_cast<std::size_t>(n));
        offset += static_cast<std::uint64_t>(n);
        done += n;
    }
    return done;
}

bool read_parts(int fd, std::uint64_t length,
                const std::function<void(std::span<const std::byte>)>& take) {
    std::vector<std::byte> buffer(std::size_t{1} << 20);
    for (std::uint64_t at = 0; at < length;) {
        const std::span<std::byte> part(buffer.data(),
                                        std::min<std::uint64_t>(buffer.size(), length - at));
        if (read_some(fd, part, at) != static_cast<std::ptrdiff_t>(part.size())) return false;
        take(part);
        at += part.size();
    }
    return true;
}

Seal check_seal(int fd) {
    const std::uint64_t size = size_of(fd);
    SealBytes end{};
    if (size < sizeof end ||
        read_some(fd, std::as_writable_bytes(std::span(&end, 1)), size - sizeof end) !=
            static_cast<std::ptrdiff_t>(sizeof end) ||
        std::memcmp(end.name, seal_name, sizeof end.name) != 0)
        return Seal::none;
    Digest digest;
    const bool whole = end.length == size - sizeof end &&
                       read_parts(fd, end.length, [&](auto part) { digest.update(part); }) &&
                       digest.value() == end.digest;
    return whole ? Seal::whole : Seal::broken;
}

OutputFile::OutputFile(const FilePlace& place)
    : path_(place.path()), directory_(place.directory()), name_(place.name()),
      temporary_(name_ + "." + std::to_string(::getpid()) + suffix),
      file_(directory_.open(temporary_, O_RDWR | O_CREAT | O_TRUNC | O_NOFOLLOW)) {
    if (!file_) fail_by_system(path_, "cannot be written");
}

OutputFile::~OutputFile() {
    if (!in_place_) ::unlinkat(directory_.fd(), temporary_.c_str(), 0);
}

void OutputFile::write(std::span<const std::byte> bytes) {
    if (!write_all(fd(), bytes, size_of(fd()))) fail_by_system(path_, "cannot be written");
}

void OutputFile::seal() {
    SealBytes end{};
    std::memcpy(end.name, seal_name, sizeof end.name);
    end.length = size_of(fd());
    Digest digest;
    if (!read_parts(fd(), end.length, [&](auto part) { digest.update(part); }))
        fail_by_system(path_, "cannot be read back");
    end.digest = digest.value();
    write(std::as_bytes(std::span(&end, 1)));
}

void OutputFile::commit() {
    // The name must not point to data that a power cut could still lose.
    if (!bring_to_disk(fd())) fail_by_system(path_, "cannot be brought to the disk");
    if (!file_.close()) fail_by_system(path_, "cannot be closed");
    if (::renameat(directory_.fd(), temporary_.c_str(), directory_.fd(), name_.c_str()) != 0)
        fail_by_system(path_, "cannot be put in its place");
    in_place_ = true;
    directory_.sync();
}

void write_whole(const FilePlace& place, const std::string& text) {
    OutputFile file(place);
    file.write(std::as_bytes(std::span(text)));
    file.commit();
}

} // namespace asperity::io
