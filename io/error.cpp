// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "io/error.hpp"

namespace asperity::io {

namespace {

/// Lines after the first are set in, so that a cause of several lines still reads as one.
std::string indented(const std::string& text) {
    std::string result;
    for (const char c : text) {
        result += c;
        if (c == '\n') result += "         ";
    }
    return result;
}

std::string format(const std::vector<Problem>& problems) {
    std::string text;
    for (const Problem& problem : problems) {
        if (!text.empty()) text += '\n';
        text += io::format(problem);
    }
    return text;
}

} // namespace

std::string format(const Problem& problem) {
    std::string text = problem.where.empty() ? problem.what : problem.where + ": " + problem.what;
    if (!problem.why.empty()) text += "\n    why: " + indented(problem.why);
    if (!problem.fix.empty()) text += "\n    fix: " + indented(problem.fix);
    return text;
}

Error::Error(int code, Problem problem) : Error(code, std::vector<Problem>{std::move(problem)}) {}

Error::Error(int code, std::vector<Problem> problems)
    : std::runtime_error(format(problems)), code_(code), problems_(std::move(problems)) {}

} // namespace asperity::io
