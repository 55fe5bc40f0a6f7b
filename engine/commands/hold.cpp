// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/commands/command_line.hpp"

#include "decomposition/communicator.hpp"
#include "io/directory_lock.hpp"
#include "io/error.hpp"

#include <memory>
#include <string>

#include <unistd.h>

namespace asperity {

namespace {

/// Locks a result directory and sends the lock's file descriptor through the Unix socket at
/// standard input. Throws io::SceneError if the standard input is no socket, and io::FileError if
/// the directory is in use.
int hold(const std::string& directory) {
    const int owner = io::process_behind(STDIN_FILENO);
    io::DirectoryLock(io::Directory(directory), owner).hand_over(STDIN_FILENO);
    return io::exit_code::done;
}

} // namespace

Command hold_command() {
    const auto given = std::make_shared<Arguments>();
    return {.options = {{.name = "DIR",
                         .value = "",
                         .explanation = "the directory",
                         .into = &given->out,
                         .needed = true}},
            .act =
                [given](const Communicator& world) {
                    return on_root(world, [&] { return hold(given->out); });
                },
            .for_programs = true};
}

} // namespace asperity
