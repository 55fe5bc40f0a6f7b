// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// git_hash.hpp is written at build time by git_hash.cmake.
#include "engine/commit.hpp"

#include "git_hash.hpp"

namespace asperity {

const char* const build_commit = ASPERITY_GIT_HASH;

} // namespace asperity
