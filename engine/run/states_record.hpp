// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// All states at zero load in result.json and in the summary.
#pragma once

#include "engine/equilibrium/findings.hpp"
#include "io/json_value.hpp"

#include <cstdio>

namespace asperity {

/// "states": first, deepest, all from the outermost inwards, and how they were looked for. Energies
/// in meV/Å^2, heights in Å, barriers in MPa.
io::JsonValue states_json(const StateList& states);
/// As lines of the summary.
void print_states(std::FILE* to, const StateList& states);

} // namespace asperity
