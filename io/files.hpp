// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Files that must not be lost, and the directories they are in.
//
// An open directory: its files are named relative to it (openat and its kind), so a file is never
// written into another directory that has taken its name.
//
// OutputFile is the one way to write a file that matters: beside its place, every result of the
// system checked, brought to the disk, then renamed into its place, and the directory's entry
// brought to the disk too. Until then an earlier file of that name stays as it is, whatever
// happens. HDF5 files are written through it as well (hdf5_file.hpp), and end in a digest of all
// their bytes (seal), which readers check.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>

namespace asperity::io {

using Bytes = std::span<const std::byte>;

/// A file descriptor, closed at its end.
class Descriptor {
public:
    Descriptor() = default;
    explicit Descriptor(int fd) : fd_(fd) {}
    ~Descriptor();
    Descriptor(Descriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
    Descriptor& operator=(Descriptor&& other) noexcept {
        std::swap(fd_, other.fd_); // other closes what was here
        return *this;
    }
    int get() const { return fd_; }
    explicit operator bool() const { return fd_ >= 0; }
    /// Closes now. False: the system reported an error, which is in errno.
    bool close();

private:
    int fd_ = -1;
};

class Directory {
public:
    /// Opens it; it must exist. Throws FileError.
    explicit Directory(const std::string& path);
    /// Makes it, and those above it, where they are missing.
    static Directory make(const std::string& path);

    const std::string& path() const { return path_; } ///< as it was given
    std::string operator/(const std::string& name) const { return path_ + "/" + name; }
    int fd() const { return fd_->get(); }

    /// Throws FileError where the system does not tell.
    bool exists(const std::string& name) const;
    /// Opens a file in it; an empty descriptor and errno where that fails.
    Descriptor open(const std::string& name, int flags) const;
    /// Removes a file, if it is there. Throws FileError, as the others do.
    void remove(const std::string& name) const;
    void rename(const std::string& from, const std::string& to) const;
    /// Names in it on the disk (fsync).
    void sync() const;

private:
    std::string path_;
    std::shared_ptr<const Descriptor> fd_; ///< shared by copies
};

/// A file: by its path, or by its name in an open directory.
class FilePlace {
public:
    FilePlace(const char* path) : name_(path) {}
    FilePlace(std::string path) : name_(std::move(path)) {}
    FilePlace(Directory directory, std::string name)
        : directory_(std::move(directory)), name_(std::move(name)) {}
    std::string path() const { return directory_ ? *directory_ / name_ : name_; }
    std::string name() const;    ///< in its directory
    Directory directory() const; ///< Throws FileError.
    /// An empty descriptor and errno where that fails.
    Descriptor open(int flags) const;

private:
    std::optional<Directory> directory_;
    std::string name_;
};

class OutputFile {
public:
    /// Opens a temporary file beside it. Throws FileError, as all that follows does.
    explicit OutputFile(const FilePlace& place);
    /// Not put in its place: gone.
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    int fd() const { return file_.get(); }
    /// Appends.
    void write(Bytes bytes);
    /// Appends the digest of all bytes that are in the file.
    void seal();
    /// To the disk, and into its place.
    void commit();

    /// How the names of temporary files end.
    static constexpr const char* suffix = ".part";

private:
    std::string path_;
    Directory directory_;
    std::string name_, temporary_;
    Descriptor file_;
    bool in_place_ = false;
};

/// Writes a text, whole or not at all. Throws FileError.
void write_whole(const FilePlace& place, const std::string& text);

/// What the end of a file says of it.
enum class Seal { none, whole, broken };
Seal check_seal(int fd);
/// The digest at the end of a file, as it is stated there; nothing where there is none.
std::optional<std::uint32_t> sealed_digest(const Directory& directory, const std::string& name);

/// The digest by which damage is noticed, of these bytes after those of `before`: the CRC-32 of
/// zlib, so that other programs can check it too; Python has it as zlib.crc32. A change within 32
/// neighbouring bits is always noticed, any other with a probability of 1 - 2^-32. It is no
/// protection against intent.
std::uint32_t digest_of(Bytes bytes, std::uint32_t before = 0);
/// Of the first bytes of a file; nothing where there are fewer.
std::optional<std::uint32_t> digest_of(int fd, std::uint64_t length);

// System calls, repeated until all bytes are transferred or one fails.

/// Throws FileError: what the system refused, with the reason in errno.
[[noreturn]] void fail_by_system(
    const std::string& path, const char* what,
    const char* fix = "check the permissions of its directory and the space on its disk");
/// Brings a file, or the entries of a directory, to the disk. False: errno says why not.
bool bring_to_disk(int fd);
/// All bytes to the file at this offset; false: errno says why not.
bool write_all(int fd, Bytes bytes, std::uint64_t offset);
/// Bytes of the file from this offset; fewer at its end; -1: errno says why.
std::ptrdiff_t read_some(int fd, std::span<std::byte> bytes, std::uint64_t offset);
/// Calls take with the first bytes of the file, part by part. False: there are fewer.
bool read_parts(int fd, std::uint64_t length, const std::function<void(Bytes)>& take);

} // namespace asperity::io
