// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// All states at zero load in result.json and in the summary.
#pragma once

#include "engine/equilibrium/findings.hpp"
#include "io/result.hpp"

#include <cstdio>

namespace asperity {

/// "states": first, deepest, all from the outermost inwards, and how they were searched for.
void add_states(const StateList& states, io::Result& result);
/// As lines of the summary.
void print_states(std::FILE* to, const StateList& states);

} // namespace asperity
