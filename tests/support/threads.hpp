// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The number of OpenMP threads within a test. main() fails a test that leaves another number
// behind.
#pragma once

#include <omp.h>

namespace asperity::test {

/// Sets the number of threads, and restores the previous number at its end.
class Threads {
public:
    explicit Threads(int n) : before_(omp_get_max_threads()) { omp_set_num_threads(n); }
    ~Threads() { omp_set_num_threads(before_); }
    Threads(const Threads&) = delete;
    Threads& operator=(const Threads&) = delete;

private:
    int before_;
};

} // namespace asperity::test
