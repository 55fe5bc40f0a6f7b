// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Which of the mutants that planting.py writes into a copy of the sources is on: the one whose
// number the environment variable MUTANT_ON has. Every mutant that a process comes to is marked in
// the file MUTANTS_REACHED, one byte each.
#pragma once

#include <cstdlib>
#include <type_traits>

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

namespace planted {

inline constexpr int most = 4096;
inline int chosen = -1;
inline unsigned char nowhere[most];
inline unsigned char* reached = nowhere;

/// Before the first static object is made; every source file calls it.
[[gnu::constructor(101)]] inline void start() {
    if (const char* number = std::getenv("MUTANT_ON")) chosen = std::atoi(number);
    const char* const file = std::getenv("MUTANTS_REACHED");
    if (!file || reached != nowhere) return;
    const int fd = ::open(file, O_RDWR | O_CLOEXEC);
    if (fd < 0) return;
    void* const at = ::mmap(nullptr, most, PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0);
    if (at != MAP_FAILED) reached = static_cast<unsigned char*>(at);
    ::close(fd);
}

inline bool at(int number) {
    reached[number] = 1;
    return number == chosen;
}

/// What the compiler computes is never changed.
constexpr bool mutant(int number) { return std::is_constant_evaluated() ? false : at(number); }

} // namespace planted
