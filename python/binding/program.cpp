// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The command line in the module: the program of a wheel, so that a wheel holds the engine once.
#include "binding.hpp"

#include "engine/commands/program.hpp"

#include <csignal>
#include <cstdio>

namespace asperity::binding {

namespace {

/// Carries out a command line and returns the exit code. Signals act as in a program of its own:
/// Python would only note them until program() returns.
int carry_out_words(std::vector<std::string> words) {
    words.insert(words.begin(), "asperity");
    std::vector<char*> pointers;
    for (std::string& word : words)
        pointers.push_back(word.data());
    pointers.push_back(nullptr);
    for (const int number : {SIGINT, SIGPIPE})
        std::signal(number, SIG_DFL);
    const int code =
        working([&] { return asperity::program(static_cast<int>(words.size()), pointers.data()); });
    std::fflush(stdout);
    return code;
}

} // namespace

void bind_program(py::module_& m) {
    m.def("program", &carry_out_words, py::arg("words"),
          "Carries out a command line of asperity and returns its exit code; once a process.");
}

} // namespace asperity::binding
