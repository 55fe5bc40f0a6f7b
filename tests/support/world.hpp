// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The ranks that run the tests (support/main.cpp), and what they share.
#pragma once

#include "decomposition/communicator.hpp"

#include <filesystem>
#include <span>
#include <string>

#include <unistd.h>

namespace asperity::test {

/// The ranks of this run; one if the test was started without mpirun.
const Communicator& world();

/// What make() returns on the root, on every rank; its bytes can be copied.
template <class Make>
auto from_root(const Make& make) {
    decltype(make()) value{};
    if (world().root()) value = make();
    world().broadcast(std::as_writable_bytes(std::span(&value, 1)));
    return value;
}

/// A directory that all ranks see and no other process takes; the root removes it again.
class SharedScratch {
public:
    explicit SharedScratch(const std::string& name)
        : directory(
              std::filesystem::temp_directory_path() /
              ("asperity-" + name + "-" + std::to_string(from_root([] { return ::getpid(); })))) {
        if (world().root()) std::filesystem::create_directory(directory);
        world().barrier();
    }
    ~SharedScratch() {
        world().barrier();
        std::error_code ignored;
        if (world().root()) std::filesystem::remove_all(directory, ignored);
        world().barrier();
    }
    SharedScratch(const SharedScratch&) = delete;
    SharedScratch& operator=(const SharedScratch&) = delete;
    const std::string directory, file = directory + "/checkpoint.h5";
};

} // namespace asperity::test
