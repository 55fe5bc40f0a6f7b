// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The commands that the Python package carries out.
#include "engine/commands/command_line.hpp"

#include "io/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>

#include <unistd.h>

namespace asperity {

namespace {

namespace fs = std::filesystem;

/// Returns the folder of the package: that of the source tree in which the program was built, or of
/// its place of installation; empty: Python may know it.
fs::path package_folder(const fs::path& program) {
    std::error_code error;
    for (fs::path at = program.parent_path(); at.has_relative_path(); at = at.parent_path())
        for (const char* place : {"python", "share/asperity/python"})
            if (fs::exists(at / place / "asperity" / "__main__.py", error)) return at / place;
    return {};
}

/// Returns the python3 of the virtual environment into which `pip install` put the program; empty
/// if there is none.
fs::path python_beside(const fs::path& program) {
    std::error_code error;
    const fs::path bin = program.parent_path();
    return fs::exists(bin.parent_path() / "pyvenv.cfg", error) ? bin / "python3" : fs::path();
}

/// Returns $ASPERITY_PYTHON, the Python of an active virtual environment, or that of the
/// distribution, whose packages the script `asperity` installs.
std::string python() {
    if (const char* chosen = std::getenv("ASPERITY_PYTHON")) return chosen;
    if (const char* environment = std::getenv("VIRTUAL_ENV"))
        return std::string(environment) + "/bin/python3";
    std::error_code error;
    return fs::exists("/usr/bin/python3", error) ? "/usr/bin/python3" : "python3";
}

} // namespace

std::optional<int> hand_over_to_python(const std::vector<Command>& commands, int argc,
                                       char** argv) {
    if (argc < 2 || std::none_of(commands.begin(), commands.end(), [&](const Command& command) {
            return !command.act && command.name == argv[1];
        }))
        return std::nullopt;
    std::error_code error;
    const fs::path program = fs::read_symlink("/proc/self/exe", error);
    const fs::path beside = python_beside(program); // knows the package
    if (const fs::path folder = package_folder(program); beside.empty() && !folder.empty()) {
        const char* known = std::getenv("PYTHONPATH");
        const std::string path = known && *known ? folder.string() + ":" + known : folder.string();
        ::setenv("PYTHONPATH", path.c_str(), 1);
    }
    ::setenv("ASPERITY_PROGRAM", program.c_str(), 1);
    const std::string interpreter =
        beside.empty() || std::getenv("ASPERITY_PYTHON") ? python() : beside.string();
    std::vector<std::string> words = {interpreter, "-m", "asperity"};
    words.insert(words.end(), argv + 1, argv + argc);
    std::vector<char*> pointers;
    pointers.reserve(words.size() + 1);
    for (std::string& word : words)
        pointers.push_back(word.data());
    pointers.push_back(nullptr);
    ::execvp(interpreter.c_str(), pointers.data());
    fmt::print(stderr, "{}\n",
               io::format({fmt::format("asperity {}", argv[1]), "cannot be started",
                           interpreter + " is not there",
                           "install python3, or set ASPERITY_PYTHON to one"}));
    return io::exit_code::input_output;
}

} // namespace asperity
