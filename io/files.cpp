// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "io/files.hpp"

#include "io/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <vector>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

namespace asperity::io {

namespace {

constexpr char seal_name[17] = "asperity digest\n";

/// The last bytes of a sealed file.
struct SealBytes {
    char name[16];
    std::uint64_t length; ///< length of the preceding bytes
    std::uint64_t digest; ///< digest of the preceding bytes
};
static_assert(sizeof(SealBytes) == 32);

std::uint64_t size_of(int fd) {
    struct stat status {};
    return ::fstat(fd, &status) == 0 ? static_cast<std::uint64_t>(status.st_size) : 0;
}

/// Opens a regular file relative to a directory.
Descriptor open_regular(int directory, const std::string& name, int flags,
                        const std::string& path) {
    // Non-blocking: to open a pipe of that name would wait for somebody at its other end.
    Descriptor file(
        ::openat(directory, name.c_str(), flags | O_CLOEXEC | O_NONBLOCK | O_NOCTTY, 0644));
    struct stat status {};
    if (file && ::fstat(file.get(), &status) == 0 && !S_ISREG(status.st_mode))
        throw FileError(path, "is no regular file",
                        S_ISDIR(status.st_mode)    ? "it is a directory"
                        : S_ISFIFO(status.st_mode) ? "it is a pipe"
                                                   : "it is a device or a socket",
                        "move it away, or name another file");
    return file;
}

std::optional<SealBytes> seal_at_end(int fd) {
    const std::uint64_t size = size_of(fd);
    SealBytes end{};
    if (size < sizeof end ||
        read_some(fd, std::as_writable_bytes(std::span(&end, 1)), size - sizeof end) !=
            static_cast<std::ptrdiff_t>(sizeof end) ||
        std::memcmp(end.name, seal_name, sizeof end.name) != 0)
        return std::nullopt;
    return end;
}

} // namespace

Descriptor::~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
}

bool Descriptor::close() { return ::close(std::exchange(fd_, -1)) == 0; }

Directory::Directory(const std::string& path)
    : path_(path), fd_(std::make_shared<const Descriptor>(
                       ::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC))) {
    if (!*fd_)
        fail_by_system(path, "cannot be opened as a directory",
                       "check the path and its permissions");
}

Directory Directory::make(const std::string& path) {
    std::error_code error;
    std::filesystem::create_directories(path, error);
    if (error || !std::filesystem::is_directory(path))
        throw FileError(path, "the directory cannot be made",
                        error ? error.message() : "a file of that name is in the way",
                        "name a directory you may write to: --out DIR");
    return Directory(path);
}

bool Directory::exists(const std::string& name) const {
    struct stat status {};
    if (::fstatat(fd(), name.c_str(), &status, 0) == 0) return true;
    // A disk that does not answer must not pass for one without the file.
    if (errno != ENOENT && errno != ENOTDIR && errno != ELOOP)
        fail_by_system(*this / name, "cannot be looked at", "check the disk, or its connection");
    return false;
}

Descriptor Directory::open(const std::string& name, int flags) const {
    return open_regular(fd(), name, flags, *this / name);
}

void Directory::remove(const std::string& name) const {
    if (::unlinkat(fd(), name.c_str(), 0) != 0 && errno != ENOENT)
        fail_by_system(*this / name, "cannot be removed", "check the permissions of its directory");
}

void Directory::rename(const std::string& from, const std::string& to) const {
    if (::renameat(fd(), from.c_str(), fd(), to.c_str()) != 0)
        fail_by_system(*this / to, "cannot be put in its place");
}

void Directory::sync() const {
    if (!bring_to_disk(fd()))
        fail_by_system(path_, "its entries cannot be brought to the disk", "check the disk");
}

std::string FilePlace::name() const {
    return directory_ ? name_ : name_.substr(name_.rfind('/') + 1); // npos + 1 is 0
}

Directory FilePlace::directory() const {
    if (directory_) return *directory_;
    const std::size_t slash = name_.rfind('/');
    if (slash == std::string::npos) return Directory(".");
    return Directory(slash == 0 ? "/" : name_.substr(0, slash));
}

Descriptor FilePlace::open(int flags) const {
    if (directory_) return directory_->open(name_, flags);
    return open_regular(AT_FDCWD, name_, flags, name_);
}

std::string OutputFile::temporary(const std::string& name) {
    return fmt::format("{}.{}{}", name, ::getpid(), suffix);
}

OutputFile::OutputFile(const FilePlace& place, const std::string& temporary)
    : path_(place.path()), directory_(place.directory()), name_(place.name()),
      temporary_(temporary) {
    constexpr int new_file = O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW;
    file_ = directory_.open(temporary_, new_file);
    // A file or link of that name is somebody else's, or of a killed process of the same number.
    for (int i = 2; !file_ && errno == EEXIST && i < 1000; ++i) {
        temporary_ = fmt::format("{}-{}", temporary, i);
        file_ = directory_.open(temporary_, new_file);
    }
    if (!file_) fail_by_system(path_, "cannot be written");
}

OutputFile::~OutputFile() {
    if (!in_place_) ::unlinkat(directory_.fd(), temporary_.c_str(), 0);
}

void OutputFile::write(Bytes bytes) {
    if (!write_all(fd(), bytes, size_of(fd()))) fail_by_system(path_, "cannot be written");
}

void OutputFile::seal() {
    SealBytes end{};
    std::memcpy(end.name, seal_name, sizeof end.name);
    end.length = size_of(fd());
    const std::optional<std::uint32_t> digest = digest_of(fd(), end.length);
    if (!digest) fail_by_system(path_, "cannot be read back");
    end.digest = *digest;
    write(std::as_bytes(std::span(&end, 1)));
}

void OutputFile::commit() {
    // The name must not point to data that a power cut could still lose.
    if (!bring_to_disk(fd())) fail_by_system(path_, "cannot be brought to the disk");
    if (!file_.close()) fail_by_system(path_, "cannot be closed");
    directory_.rename(temporary_, name_);
    in_place_ = true;
    directory_.sync();
}

std::optional<std::string> contents_of(const FilePlace& place, int flags) {
    constexpr std::uint64_t longest = std::uint64_t{1} << 28;
    const Descriptor file = place.open(O_RDONLY | flags);
    if (!file && (errno == ENOENT || errno == ENOTDIR)) return std::nullopt;
    const std::uint64_t length = file ? size_of(file.get()) : 0;
    if (length > longest)
        throw FileError(place.path(), "cannot be read",
                        fmt::format("it has {} bytes, and {} are the limit", length, longest),
                        "move it away");
    std::string text;
    if (!file || !read_parts(file.get(), length, [&](Bytes part) {
            text.append(reinterpret_cast<const char*>(part.data()), part.size());
        }))
        fail_by_system(place.path(), "cannot be read", "check its permissions");
    return text;
}

void write_whole(const FilePlace& place, const std::string& text) {
    OutputFile file(place);
    file.write(std::as_bytes(std::span(text)));
    file.commit();
}

Seal check_seal(int fd) {
    const std::optional<SealBytes> end = seal_at_end(fd);
    if (!end) return Seal::none;
    const bool whole =
        end->length == size_of(fd) - sizeof *end && digest_of(fd, end->length) == end->digest;
    return whole ? Seal::whole : Seal::broken;
}

std::optional<std::uint32_t> sealed_digest(const Directory& directory, const std::string& name) {
    const Descriptor file = directory.open(name, O_RDONLY);
    const std::optional<SealBytes> end = file ? seal_at_end(file.get()) : std::nullopt;
    return end ? std::optional(static_cast<std::uint32_t>(end->digest)) : std::nullopt;
}

std::uint32_t digest_of(Bytes bytes, std::uint32_t before) {
    if (bytes.empty()) return before; // a null pointer would start zlib's sum anew
    return static_cast<std::uint32_t>(
        ::crc32_z(before, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

std::string digest_text(std::uint32_t digest) { return fmt::format("crc32:{:08x}", digest); }

std::optional<std::uint32_t> digest_of(int fd, std::uint64_t length) {
    std::uint32_t digest = 0;
    if (!read_parts(fd, length, [&](Bytes part) { digest = digest_of(part, digest); }))
        return std::nullopt;
    return digest;
}

void fail_by_system(const std::string& path, const char* what, const char* fix) {
    throw FileError(path, what, std::strerror(errno), fix);
}

bool bring_to_disk(int fd) {
    // Some file systems cannot do this, for directories above all, and say so.
    return ::fsync(fd) == 0 || errno == EINVAL || errno == EROFS;
}

bool write_all(int fd, Bytes bytes, std::uint64_t offset) {
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

bool read_parts(int fd, std::uint64_t length, const std::function<void(Bytes)>& take) {
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

} // namespace asperity::io
