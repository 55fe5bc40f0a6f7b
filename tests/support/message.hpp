// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What is said where something is refused.
#pragma once

#include <exception>
#include <string>

namespace asperity::test {

/// The message of the error in which this ends; "" if it ends well. Other errors go on.
template <class Error = std::exception, class Work>
std::string message_of(const Work& work) {
    try {
        work();
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}
inline bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

} // namespace asperity::test
