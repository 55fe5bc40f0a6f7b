// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#pragma once

#include "io/error.hpp"

#include <string>
#include <utility>

namespace asperity {

/// Throws io::SceneError for a wrong call of a script. where: the function or attribute that was
/// used; what, why, fix: problem, reason and remedy.
[[noreturn]] inline void refuse(const char* where, std::string what, std::string why,
                                std::string fix) {
    throw io::SceneError(io::Problem{where, std::move(what), std::move(why), std::move(fix)});
}

} // namespace asperity
