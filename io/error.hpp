// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Errors and their messages.
//
// Every error has the exit code of the command and a message of one form:
//
//     <where>: what is wrong
//         why: the reason, with the values
//         fix: what to do about it
//
// An error in a scene holds all mistakes of the scene, so that a user sees them at once. Only main
// prints and exits.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace asperity::io {

/// Exit codes of the commands. The numbers are a contract with scripts.
namespace exit_code {
inline constexpr int done = 0;
inline constexpr int internal = 1;     ///< error of the program itself
inline constexpr int scene = 2;        ///< usage or scene
inline constexpr int physics = 3;      ///< energy, NaN, time step
inline constexpr int input_output = 4; ///< files
inline constexpr int stopped = 75;     ///< stopped early with a valid checkpoint
} // namespace exit_code

/// One mistake in a scene, a command line or a file. where, why and fix may be empty.
struct Problem {
    std::string where; ///< place: file:line:column, option or key
    std::string what;  ///< problem
    std::string why;   ///< reason, with the values
    std::string fix;   ///< remedy
};
/// Returns a problem in the form above, without a newline at the end.
std::string format(const Problem& problem);
/// Returns the candidate closest to a misspelt word; empty if none is close.
std::string nearest(std::string_view word, const std::vector<std::string>& candidates);

/// Base of all errors: problems, and the exit code of the command that fails with them.
class Error : public std::runtime_error {
public:
    Error(int code, Problem problem);
    Error(int code, std::vector<Problem> problems);

    int code() const { return code_; }
    const std::vector<Problem>& problems() const { return problems_; }

private:
    int code_;
    std::vector<Problem> problems_;
};

/// Error in the scene, in the command line or in an input that the scene names (exit 2).
struct SceneError : Error {
    explicit SceneError(Problem p) : Error(exit_code::scene, std::move(p)) {}
    explicit SceneError(std::vector<Problem> p) : Error(exit_code::scene, std::move(p)) {}
};
/// Error of the physics: a guard stopped the run (exit 3).
struct PhysicsError : Error {
    PhysicsError(std::string what, std::string why, std::string fix)
        : Error(exit_code::physics, Problem{"", std::move(what), std::move(why), std::move(fix)}) {}
};
/// Error of a file that could not be read or written (exit 4).
struct FileError : Error {
    FileError(std::string path, std::string what, std::string why, std::string fix = "")
        : Error(exit_code::input_output,
                Problem{std::move(path), std::move(what), std::move(why), std::move(fix)}) {}
};

} // namespace asperity::io
