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
#include <string_view>

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

/// Lines that Python carries out first. Its options -c and -m put the current folder before all
/// others into the search path, where a numpy.py beside the user's data would be run as code.
/// Python without that folder (-P) is of 3.11; sys is part of the interpreter.
constexpr const char* start = "import sys; sys.path[:] = filter(None, sys.path); "
                              "from asperity.__main__ import start; start()";

/// Returns the places of a search path without empty ones, which would be the current folder.
/// "PYTHONPATH=$PYTHONPATH:/a" makes such a place of a variable that was not set.
std::string without_empty(std::string_view path) {
    std::string kept;
    while (!path.empty()) {
        const std::size_t end = std::min(path.find(':'), path.size());
        if (end > 0) kept.append(kept.empty() ? "" : ":").append(path.substr(0, end));
        path.remove_prefix(std::min(end + 1, path.size()));
    }
    return kept;
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
    const char* const known = std::getenv("PYTHONPATH");
    std::string path = without_empty(known ? known : "");
    if (const fs::path folder = package_folder(program); beside.empty() && !folder.empty())
        path = folder.string() + (path.empty() ? "" : ":" + path);
    ::setenv("PYTHONPATH", path.c_str(), 1);
    ::setenv("ASPERITY_PROGRAM", program.c_str(), 1);
    const std::string interpreter =
        beside.empty() || std::getenv("ASPERITY_PYTHON") ? python() : beside.string();
    std::vector<std::string> words = {interpreter, "-c", start};
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
