// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// An open directory. Its files are named relative to it (openat and its kind), so a file is never
// written into another directory that has taken its name.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace asperity::io {

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

/// Throws FileError: what the system refused, with the reason in errno.
[[noreturn]] void fail_by_system(
    const std::string& path, const char* what,
    const char* fix = "check the permissions of its directory and the space on its disk");
/// Brings a file, or the entries of a directory, to the disk. False: errno says why not.
bool bring_to_disk(int fd);

class Directory {
public:
    /// Opens it; it must exist. Throws FileError.
    explicit Directory(const std::string& path);
    /// Makes it, and those above it, where they are missing.
    static Directory make(const std::string& path);

    const std::string& path() const { return path_; } ///< as it was given
    std::string operator/(const std::string& name) const { return path_ + "/" + name; }
    int fd() const { return fd_->get(); }

    bool exists(const std::string& name) const;
    /// Opens a file in it; an empty descriptor and errno where that fails.
    Descriptor open(const std::string& name, int flags) const;
    /// Removes a file, if it is there. Throws FileError.
    void remove(const std::string& name) const;
    /// Throws FileError.
    void rename(const std::string& from, const std::string& to) const;
    /// Names in it on the disk (fsync). Throws FileError.
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

} // namespace asperity::io
