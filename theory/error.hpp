// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Errors of the theory module: what is wrong (with the values), why, and what to do.
#pragma once

#include <sstream>
#include <stdexcept>
#include <string>

namespace asperity::theory {

/// The request itself makes no sense (a negative modulus, an unsorted table).
struct InvalidInput : std::invalid_argument {
    using std::invalid_argument::invalid_argument;
};

/// The request is sound but has no answer (a contact past pull-off, a root that does not exist).
struct NoSolution : std::domain_error {
    using std::domain_error::domain_error;
};

/// "a = 3 is ..." from pieces of text and numbers, with enough digits to act upon.
template <class... Parts>
[[nodiscard]] std::string message(const Parts&... parts) {
    std::ostringstream text;
    text.precision(10);
    (text << ... << parts);
    return text.str();
}

} // namespace asperity::theory
