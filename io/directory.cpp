// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "io/directory.hpp"

#include "io/error.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace asperity::io {

Descriptor::~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
}

bool Descriptor::close() { return ::close(std::exchange(fd_, -1)) == 0; }

void fail_by_system(const std::string& path, const char* what, const char* fix) {
    throw FileError(path, what, std::strerror(errno), fix);
}

bool bring_to_disk(int fd) {
    // Some file systems cannot do this, for directories above all, and say so.
    return ::fsync(fd) == 0 || errno == EINVAL || errno == EROFS;
}

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
    // Non-blocking: to open a pipe of that name would wait for somebody at its other end.
    return Descriptor(::openat(fd(), name.c_str(), flags | O_CLOEXEC | O_NONBLOCK, 0644));
}

void Directory::remove(const std::string& name) const {
    if (::unlinkat(fd(), name.c_str(), 0) != 0 && errno != ENOENT)
        fail_by_system(*this / name, "cannot be removed", "check the permissions of its directory");
}

void Directory::rename(const std::string& from, const std::string& to) const {
    if (::renameat(fd(), from.c_str(), fd(), to.c_str()) != 0)
        fail_by_system(*this / to, "cannot be put in its place",
                       "check the permissions of its directory");
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
    return Descriptor(::open(name_.c_str(), flags | O_CLOEXEC, 0644));
}

} // namespace asperity::io
