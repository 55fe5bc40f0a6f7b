// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A library to be preloaded: the n-th call that changes a file below a directory fails, or kills the
// process.
//
//     ASPERITY_FAULT_BELOW   the directory (absolute, without links); other calls are not counted
//     ASPERITY_FAULT_AT      n, from 1; 0: none
//     ASPERITY_FAULT_HOW     an error number: that call alone; negative: that call and all after it
//                            that would write; kill: SIGKILL just before the call;
//                            half: a write takes half of its bytes, then SIGKILL;
//                            slow: none fails, and each takes n milliseconds longer
//     ASPERITY_FAULT_LOG     a file that gets a line for each call counted ("3 pwrite run.journal")
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <signal.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

static atomic_long calls;

static const char* below(void) { return getenv("ASPERITY_FAULT_BELOW"); }

/* Whether the path of this descriptor (and of a name relative to it) is below the directory. */
static int counted(int fd, const char* name) {
    const char* root = below();
    if (!root) return 0;
    char path[2 * PATH_MAX] = "";
    if (!name || name[0] != '/') {
        char link[64];
        if (name && fd == AT_FDCWD)
            snprintf(link, sizeof link, "/proc/self/cwd");
        else
            snprintf(link, sizeof link, "/proc/self/fd/%d", fd);
        const ssize_t n = readlink(link, path, PATH_MAX);
        if (n < 0) return 0;
        path[n] = '\0';
        if (name) {
            strcat(path, "/");
            strncat(path, name, PATH_MAX);
        }
    } else {
        strncpy(path, name, PATH_MAX);
    }
    return strncmp(path, root, strlen(root)) == 0;
}

enum fate { go_on, fail, half_then_die };

static enum fate decide(const char* call, const char* what, int writes) {
    const long n = atomic_fetch_add(&calls, 1) + 1;
    const int before = errno;
    const char* log = getenv("ASPERITY_FAULT_LOG");
    if (log) {
        char line[PATH_MAX + 64];
        const int length = snprintf(line, sizeof line, "%ld %s %s\n", n, call, what);
        const int file = (int)syscall(SYS_openat, AT_FDCWD, log, O_WRONLY | O_CREAT | O_APPEND, 0644);
        if (file >= 0) {
            if (syscall(SYS_write, file, line, (size_t)length) < 0) { /* the log is a help, no more */
            }
            syscall(SYS_close, file);
        }
    }
    errno = before;
    const char *at = getenv("ASPERITY_FAULT_AT"), *how = getenv("ASPERITY_FAULT_HOW");
    if (!at || !how || atol(at) == 0) return go_on;
    if (strcmp(how, "slow") == 0) {
        usleep(1000 * (useconds_t)atol(at));
        errno = before;
        return go_on;
    }
    const int error = atoi(how);
    if (error < 0 ? n < atol(at) || (n > atol(at) && !writes) : n != atol(at)) return go_on;
    if (strcmp(how, "kill") == 0) kill(getpid(), SIGKILL);
    if (strcmp(how, "half") == 0) return half_then_die;
    errno = abs(error);
    return fail;
}

static void* next(const char* name) { return dlsym(RTLD_NEXT, name); }

#define DESCRIPTOR_CALL(name, writes, parameters, arguments)                                       \
    int name parameters {                                                                          \
        static int(*real) parameters;                                                              \
        if (!real) real = (int(*) parameters)next(#name);                                          \
        if (counted(fd, NULL) && decide(#name, "", writes) != go_on) return -1;                     \
        return real arguments;                                                                     \
    }
DESCRIPTOR_CALL(fsync, 1, (int fd), (fd))
DESCRIPTOR_CALL(ftruncate, 1, (int fd, off_t size), (fd, size))
DESCRIPTOR_CALL(ftruncate64, 1, (int fd, off64_t size), (fd, size))

/* A close that fails has closed all the same. */
int close(int fd) {
    static int (*real)(int);
    if (!real) real = (int (*)(int))next("close");
    const int fails = fcntl(fd, F_GETFL) != -1 && (fcntl(fd, F_GETFL) & O_ACCMODE) != O_RDONLY &&
                      counted(fd, NULL) && decide("close", "", 0) != go_on;
    const int cause = errno, result = real(fd);
    if (!fails) return result;
    errno = cause;
    return -1;
}

#define WRITE_CALL(name, parameters, arguments, short_arguments)                                   \
    ssize_t name parameters {                                                                      \
        static ssize_t(*real) parameters;                                                          \
        if (!real) real = (ssize_t(*) parameters)next(#name);                                      \
        if (counted(fd, NULL)) {                                                                   \
            const enum fate fate = decide(#name, "", 1);                                           \
            if (fate == fail) return -1;                                                           \
            if (fate == half_then_die) {                                                           \
                real short_arguments;                                                              \
                kill(getpid(), SIGKILL);                                                           \
            }                                                                                      \
        }                                                                                          \
        return real arguments;                                                                     \
    }
WRITE_CALL(write, (int fd, const void* data, size_t size), (fd, data, size), (fd, data, size / 2))
WRITE_CALL(pwrite, (int fd, const void* data, size_t size, off_t at), (fd, data, size, at),
           (fd, data, size / 2, at))
WRITE_CALL(pwrite64, (int fd, const void* data, size_t size, off64_t at), (fd, data, size, at),
           (fd, data, size / 2, at))

#define OPEN_CALL(name, fd, path, parameters)                                                      \
    int name parameters {                                                                          \
        static int(*real)(int, const char*, int, ...);                                             \
        if (!real) real = (int (*)(int, const char*, int, ...))next("openat");                     \
        va_list list;                                                                              \
        va_start(list, flags);                                                                     \
        const mode_t mode = va_arg(list, mode_t);                                                  \
        va_end(list);                                                                              \
        if ((flags & O_CREAT) && counted(fd, path) && decide(#name, path, 1) != go_on) return -1;  \
        return real(fd, path, flags, mode);                                                        \
    }
OPEN_CALL(open, AT_FDCWD, path, (const char* path, int flags, ...))
OPEN_CALL(open64, AT_FDCWD, path, (const char* path, int flags, ...))
OPEN_CALL(openat, fd, path, (int fd, const char* path, int flags, ...))
OPEN_CALL(openat64, fd, path, (int fd, const char* path, int flags, ...))

int renameat(int from_fd, const char* from, int to_fd, const char* to) {
    static int (*real)(int, const char*, int, const char*);
    if (!real) real = (int (*)(int, const char*, int, const char*))next("renameat");
    if (counted(to_fd, to) && decide("renameat", to, 1) != go_on) return -1;
    return real(from_fd, from, to_fd, to);
}

int rename(const char* from, const char* to) {
    static int (*real)(const char*, const char*);
    if (!real) real = (int (*)(const char*, const char*))next("rename");
    if (counted(AT_FDCWD, to) && decide("rename", to, 1) != go_on) return -1;
    return real(from, to);
}

int unlinkat(int fd, const char* path, int flags) {
    static int (*real)(int, const char*, int);
    if (!real) real = (int (*)(int, const char*, int))next("unlinkat");
    if (counted(fd, path) && decide("unlinkat", path, 0) != go_on) return -1;
    return real(fd, path, flags);
}

int mkdir(const char* path, mode_t mode) {
    static int (*real)(const char*, mode_t);
    if (!real) real = (int (*)(const char*, mode_t))next("mkdir");
    if (counted(AT_FDCWD, path) && decide("mkdir", path, 1) != go_on) return -1;
    return real(path, mode);
}
