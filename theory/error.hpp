// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Errors of the theory module, whose messages have problem (with the values), reason and remedy.
#pragma once

#include <sstream>
#include <stdexcept>
#include <string>

namespace asperity::theory {

/// Error of invalid input (a negative modulus, an unsorted table).
struct InvalidInput : std::invalid_argument {
    using std::invalid_argument::invalid_argument;
};

/// Error of valid input without a solution (a contact beyond pull-off, a root that does not exist).
struct NoSolution : std::domain_error {
    using std::domain_error::domain_error;
};

/// Joins pieces of text and numbers to a message, "a = 3 is ...", with ten significant digits.
template <class... Parts>
[[nodiscard]] std::string message(const Parts&... parts) {
    std::ostringstream text;
    text.precision(10);
    (text << ... << parts);
    return text.str();
}

} // namespace asperity::theory
