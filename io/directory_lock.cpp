// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "io/directory_lock.hpp"

#include "io/error.hpp"
#include "io/file_record.hpp"

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <optional>
#include <span>
#include <string_view>
#include <thread>
#include <utility>

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

namespace asperity::io {

using namespace std::chrono_literals;

namespace {

std::string host_name() {
    char name[256] = "";
    ::gethostname(name, sizeof name - 1);
    return name;
}

/// Holder of a lock.
struct Holder {
    std::string host, process, since;
};

/// Returns the text of a lock, which ends in its digest.
std::string text_of(const Holder& holder) {
    const std::string text =
        fmt::format("host {}\nprocess {}\nsince {}\n", holder.host, holder.process, holder.since);
    return text +
           fmt::format("digest {}\n", digest_text(digest_of(std::as_bytes(std::span(text)))));
}

/// Returns the holder that a file names; nothing if the file is not the whole text of a lock.
std::optional<Holder> read_lock(int fd) {
    char text[4096] = "", host[256], process[32], since[64];
    const std::ptrdiff_t n =
        read_some(fd, std::as_writable_bytes(std::span(text).first(sizeof text - 1)), 0);
    if (n < 0 ||
        std::sscanf(text, "host %255s process %31s since %63[^\n]", host, process, since) < 3)
        return std::nullopt;
    const Holder holder = {host, process, since};
    const bool whole = text_of(holder) == std::string_view(text, static_cast<std::size_t>(n));
    return whole ? std::optional(holder) : std::nullopt;
}

void refuse(const std::string& file, const std::string& why) {
    throw SceneError(Problem{file, "is there already and is not replaced", why,
                             "move it away, or name another directory (--out)"});
}

} // namespace

DirectoryLock::DirectoryLock(Directory directory, int process) : directory_(std::move(directory)) {
    const std::string file = directory_ / name;
    for (int looks = 0;;) {
        file_ = directory_.open(name, O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW);
        const bool made = static_cast<bool>(file_);
        if (!made && errno == EEXIST) file_ = directory_.open(name, O_RDWR | O_NOFOLLOW);
        if (!file_ && errno == ENOENT) continue; // given back just now
        if (!file_) fail_by_system(file, "cannot be written");
        const std::optional<Holder> holder = read_lock(file_.get());
        if (!made && !holder && !FileRecord(directory_).calls_unfinished(name)) {
            constexpr int most_looks = 20;
            if (++looks == most_looks)
                refuse(file, fmt::format(
                                 "it is not the lock of a run: it does not end in its digest, and "
                                 "the record of the directory ({}) does not name it",
                                 FileRecord::name));
            std::this_thread::sleep_for(5ms); // the process that made it may be about to write it
            continue;
        }
        struct stat status {};
        if (::fstat(file_.get(), &status) == 0 && status.st_nlink > 1)
            refuse(file, "it is a hard link: the same file has another name");
        const bool kept = ::flock(file_.get(), LOCK_EX | LOCK_NB) == 0;
        const bool by_other = !kept && errno == EWOULDBLOCK;
        if (kept && !is_in_place()) continue; // given back just now
        const bool here = holder && holder->host == host_name();
        // On a file system without such locks the process that makes the file has the lock.
        if (made && !by_other) break;
        if (made || !kept || (holder && !here))
            throw FileError(
                directory_.path(), "is in use by another process",
                holder ? fmt::format("process {} on host {} has had it since {} ({})",
                                     holder->process, holder->host, holder->since, file)
                       : file + " does not say by whom",
                by_other && here
                    ? "wait for its end, stop it, or name another directory: --out"
                    : "wait for its end, or name another directory (--out); where it is certain "
                      "that no such process lives, remove " +
                          file);
        // The lock of the dead is not written over but made anew: only new files are written.
        if (holder)
            note_ = fmt::format("{}: process {}, which has had it since {}, is gone",
                                directory_.path(), holder->process, holder->since);
        directory_.remove(name);
    }
    const std::time_t now = std::time(nullptr);
    const std::string text = text_of({host_name(), std::to_string(process),
                                      fmt::format("{:%Y-%m-%d %H:%M:%S}", fmt::localtime(now))});
    if (!write_all(file_.get(), std::as_bytes(std::span(text)), 0)) {
        const int reason = errno;
        ::unlinkat(directory_.fd(), name, 0);
        errno = reason;
        fail_by_system(file, "cannot be written");
    }
}

DirectoryLock::~DirectoryLock() {
    if (file_ && is_in_place()) ::unlinkat(directory_.fd(), name, 0);
}

bool DirectoryLock::is_in_place() const {
    struct stat mine {
    }, there{};
    return ::fstat(file_.get(), &mine) == 0 &&
           ::fstatat(directory_.fd(), name, &there, AT_SYMLINK_NOFOLLOW) == 0 &&
           mine.st_ino == there.st_ino && mine.st_dev == there.st_dev;
}

void DirectoryLock::hand_over(int socket) {
    const int fd = file_.get();
    char byte = 0; // a message without any would not be received
    iovec data{&byte, 1};
    alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof fd)> control{};
    msghdr message{};
    message.msg_iov = &data;
    message.msg_iovlen = 1;
    message.msg_control = control.data();
    message.msg_controllen = control.size();
    cmsghdr* const head = CMSG_FIRSTHDR(&message);
    head->cmsg_level = SOL_SOCKET;
    head->cmsg_type = SCM_RIGHTS;
    head->cmsg_len = CMSG_LEN(sizeof fd);
    std::memcpy(CMSG_DATA(head), &fd, sizeof fd);
    if (::sendmsg(socket, &message, MSG_NOSIGNAL) != 1)
        fail_by_system(directory_ / name, "cannot be handed over", "start the command again");
    file_ = Descriptor();
}

int process_behind(int socket) {
    ucred peer{};
    socklen_t size = sizeof peer;
    if (::getsockopt(socket, SOL_SOCKET, SO_PEERCRED, &peer, &size) != 0 || peer.pid <= 0)
        throw SceneError(Problem{"the standard input", "is no Unix socket", std::strerror(errno),
                                 "start the command with one as its standard input, as "
                                 "python/asperity/running/lock.py does"});
    return peer.pid;
}

} // namespace asperity::io
