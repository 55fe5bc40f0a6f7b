// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "io/child_process.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace asperity::io {

namespace {

constexpr int failed = 111; ///< exit code of a child whose work threw

[[noreturn]] void run_child(int pipe, unsigned seconds, const std::function<void(int)>& work) {
    // Handlers are the parent's business (Open MPI prints a backtrace), and so is the terminal.
    for (const int signal : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGPIPE, SIGTERM, SIGINT})
        std::signal(signal, SIG_DFL);
    if (const int nowhere = ::open("/dev/null", O_WRONLY); nowhere >= 0) {
        ::dup2(nowhere, STDOUT_FILENO);
        ::dup2(nowhere, STDERR_FILENO);
    }
    const rlimit no_core{0, 0}, time{seconds, seconds};
    ::setrlimit(RLIMIT_CORE, &no_core);
    ::setrlimit(RLIMIT_CPU, &time);
    int code = 0;
    try {
        work(pipe);
    } catch (...) {
        code = failed;
    }
    ::_exit(code); // no destructors, no MPI_Finalize
}

} // namespace

bool write_all(int pipe, const void* data, std::size_t bytes) {
    for (const char* at = static_cast<const char*>(data); bytes > 0;) {
        const ssize_t done = ::write(pipe, at, bytes);
        if (done < 0 && errno == EINTR) continue;
        if (done <= 0) return false;
        at += done;
        bytes -= static_cast<std::size_t>(done);
    }
    return true;
}

bool read_all(int pipe, void* data, std::size_t bytes) {
    for (char* at = static_cast<char*>(data); bytes > 0;) {
        const ssize_t done = ::read(pipe, at, bytes);
        if (done < 0 && errno == EINTR) continue;
        if (done <= 0) return false;
        at += done;
        bytes -= static_cast<std::size_t>(done);
    }
    return true;
}

std::string in_child_process(unsigned seconds, const std::function<void(int)>& work,
                             const std::function<void(int)>& take) {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0)
        throw std::system_error(errno, std::generic_category(), "pipe");
    const pid_t child = ::fork();
    if (child < 0) {
        const int reason = errno;
        ::close(ends[0]);
        ::close(ends[1]);
        throw std::system_error(reason, std::generic_category(), "fork");
    }
    if (child == 0) {
        ::close(ends[0]);
        run_child(ends[1], seconds, work);
    }
    ::close(ends[1]);
    std::exception_ptr thrown;
    try {
        take(ends[0]);
    } catch (...) {
        thrown = std::current_exception();
    }
    ::close(ends[0]); // a child that still writes ends by SIGPIPE
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    if (thrown) std::rethrow_exception(thrown);
    if (WIFSIGNALED(status))
        return WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL
                   ? fmt::format("after {} s of processor time, or for want of memory", seconds)
                   : fmt::format("by signal {} ({})", WTERMSIG(status),
                                 ::strsignal(WTERMSIG(status)));
    if (WEXITSTATUS(status) != 0) return fmt::format("with code {}", WEXITSTATUS(status));
    return "";
}

} // namespace asperity::io
