// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Safe writing of files, and directories.
//
// A Directory accesses its files relative to an open directory (openat and similar calls), so that
// no file is written into another directory that has received the same path.
//
// OutputFile writes a file completely or not at all. It writes a temporary file in the same
// directory, checks every result of the system, flushes the bytes to the disk, renames the file to
// its final name, and flushes the directory's entry. An earlier file of that name is unchanged
// until the renaming. HDF5 files are written through OutputFile as well (hdf5_file.hpp) and end in
// a digest of all their bytes (seal), which readers check.
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

/// A file descriptor that its destructor closes.
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
    /// Closes the descriptor. Returns false, with errno set, on failure.
    bool close();

private:
    int fd_ = -1;
};

/// An open directory.
class Directory {
public:
    /// Opens an existing directory. Throws FileError.
    explicit Directory(const std::string& path);
    /// Creates the directory and its parents if they are missing, and opens it. Throws FileError.
    static Directory make(const std::string& path);

    const std::string& path() const { return path_; } ///< returns the path as it was given
    std::string operator/(const std::string& name) const { return path_ + "/" + name; }
    int fd() const { return fd_->get(); }

    /// Returns true if the directory has an entry of this name. Throws FileError if the entry
    /// cannot be examined.
    bool exists(const std::string& name) const;
    /// Opens a regular file of the directory. Returns an empty descriptor, with errno set, if that
    /// fails. Throws FileError for a folder, a pipe, a socket or a device.
    Descriptor open(const std::string& name, int flags) const;
    /// Removes a file if it exists. Throws FileError.
    void remove(const std::string& name) const;
    /// Renames a file within the directory. Throws FileError.
    void rename(const std::string& from, const std::string& to) const;
    /// Flushes the entries of the directory to the disk (fsync). Throws FileError.
    void sync() const;

private:
    std::string path_;
    std::shared_ptr<const Descriptor> fd_; ///< open directory, shared by copies
};

/// Place of a file: a path, or a name in an open directory.
class FilePlace {
public:
    FilePlace(const char* path) : name_(path) {}
    FilePlace(std::string path) : name_(std::move(path)) {}
    FilePlace(Directory directory, std::string name)
        : directory_(std::move(directory)), name_(std::move(name)) {}
    std::string path() const { return directory_ ? *directory_ / name_ : name_; }
    std::string name() const;    ///< returns the name in its directory
    Directory directory() const; ///< opens the directory of the file; throws FileError
    /// Opens the file as Directory::open() does.
    Descriptor open(int flags) const;

private:
    std::optional<Directory> directory_;
    std::string name_;
};

/// A file that is written completely or not at all.
class OutputFile {
public:
    /// Makes a temporary file in the directory of the place; a file or link that is there is not
    /// touched. This and all other functions throw FileError.
    explicit OutputFile(const FilePlace& place) : OutputFile(place, temporary(place.name())) {}
    /// Makes a temporary file of this name.
    OutputFile(const FilePlace& place, const std::string& temporary);
    /// Deletes the temporary file, unless commit() has renamed it.
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    int fd() const { return file_.get(); }
    /// Appends bytes.
    void write(Bytes bytes);
    /// Appends the digest of all bytes so far.
    void seal();
    /// Flushes the file to the disk and renames it to its final name.
    void commit();

    /// Ending of the names of temporary files.
    static constexpr const char* suffix = ".part";
    /// Returns the name of this process's temporary file for a file of this name.
    static std::string temporary(const std::string& name);

private:
    std::string path_;
    Directory directory_;
    std::string name_, temporary_;
    Descriptor file_;
    bool in_place_ = false;
};

/// Returns the contents of a regular file; nothing if there is none. The flags are those of open(),
/// O_NOFOLLOW for example. Throws FileError, also for a file of more than 256 MB.
std::optional<std::string> contents_of(const FilePlace& place, int flags = 0);
/// Writes a text to a file, completely or not at all. Throws FileError.
void write_whole(const FilePlace& place, const std::string& text);

/// State of the digest at the end of a file: missing, equal to that of the bytes, or different.
enum class Seal { none, whole, broken };
/// Compares the digest at the end of a file with its bytes.
Seal check_seal(int fd);
/// Returns the digest stated at the end of a file; nothing if the file has none.
std::optional<std::uint32_t> sealed_digest(const Directory& directory, const std::string& name);

/// Returns the CRC-32 of zlib (zlib.crc32 in Python) of these bytes, continued from the digest
/// `before`. The digest detects every change within 32 neighbouring bits, and other changes with a
/// probability of 1 - 2^-32; it does not protect against manipulation.
std::uint32_t digest_of(Bytes bytes, std::uint32_t before = 0);
/// Returns a digest as text: "crc32:" and eight hexadecimal digits.
std::string digest_text(std::uint32_t digest);
/// Returns the digest of the first `length` bytes of a file; nothing if the file is shorter.
std::optional<std::uint32_t> digest_of(int fd, std::uint64_t length);

// System calls, repeated until all bytes are transferred or one of them fails.

/// Throws FileError for a failed system call. what: the failed action; errno: its reason.
[[noreturn]] void fail_by_system(
    const std::string& path, const char* what,
    const char* fix = "check the permissions of its directory and the space on its disk");
/// Flushes a file, or the entries of a directory, to the disk. Returns false, with errno set, on
/// failure.
bool bring_to_disk(int fd);
/// Writes all bytes to the file at this offset. Returns false, with errno set, on failure.
bool write_all(int fd, Bytes bytes, std::uint64_t offset);
/// Reads bytes of the file from this offset. Returns their number, smaller at the end of the file,
/// or -1 with errno set.
std::ptrdiff_t read_some(int fd, std::span<std::byte> bytes, std::uint64_t offset);
/// Calls take with consecutive parts of the first `length` bytes of the file. Returns false if the
/// file is shorter.
bool read_parts(int fd, std::uint64_t length, const std::function<void(Bytes)>& take);

} // namespace asperity::io
