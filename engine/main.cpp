// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The program: its commands, of the table python/asperity/commands/table.txt. One that the program
// carries out itself is made by a function in engine/commands/NAME.cpp (CMake writes
// commands_table.inc and commands.inc, the declarations). start.cpp is the program's main(); the
// Python module calls program() itself. The main loop of a run is follow() in engine/run/run.cpp.
// Every rank of mpirun runs this; how they end together is in engine/commands/exit_code.hpp.
#include "engine/commands/command_line.hpp"
#include "engine/commands/exit_code.hpp"
#include "engine/commands/program.hpp"
#include "engine/commit.hpp"
#include "engine/run/stop_signals.hpp"

#include "decomposition/communicator.hpp"
#include "io/machine.hpp"

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace asperity {

#include "commands.inc"

namespace {

/// A row of python/asperity/commands/table.txt: a command, who carries it out (the program, the
/// Python package, or the script `asperity`), its purpose, and for the program the function that
/// makes it.
struct Row {
    std::string_view name, by, purpose;
    Command (*make)();
};
constexpr Row table[] = {
#include "commands_table.inc"
};

/// Returns the commands in the order of --help.
std::vector<Command> all_commands() {
    std::vector<Command> all;
    for (const Row& row : table) {
        if (row.by == "script") continue;
        Command command = row.make ? row.make() : Command{};
        command.name = row.name;
        command.purpose = row.purpose;
        all.push_back(std::move(command));
    }
    return all;
}

/// Returns the names of the commands of the script `asperity` of the source tree.
std::vector<std::string> commands_of_script() {
    std::vector<std::string> names;
    for (const Row& row : table)
        if (row.by == "script") names.emplace_back(row.name);
    return names;
}

} // namespace

int program(int argc, char** argv) {
    const std::vector<Command> commands = all_commands();
    if (const auto failed = hand_over_to_python(commands, argc, argv)) return *failed;
        // Memory of fields goes back to the system when they go: else what a heap keeps between
        // them adds to the peak (a tenth in states without friction).
#ifdef __GLIBC__
    mallopt(M_MMAP_THRESHOLD, 1 << 17);
#endif
    stop_signals::catch_all();
    io::set_commit(build_commit);
    const ParallelSession session(argc, argv);
    const Communicator& world = session.world();
    world.share_processors();
    return exit_code_of(world, is_for_programs(commands, argc, argv), [&] {
        if (session.unconnected() > 0) return refuse_unconnected(session);
        return carry_out(commands, commands_of_script(), argc, argv, world);
    });
}

} // namespace asperity
