// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What `asperity cost` leaves behind: cost.csv, cost.json, a plot of error against time for each
// question, and the table on the terminal.
#pragma once

#include "engine/commands/cost.hpp"

#include <string>
#include <vector>

namespace asperity {

std::string cost_csv(const CostTable& table);
io::JsonValue cost_json(const CostTable& table);

/// Names of the files written. Throws io::FileError.
std::vector<std::string> write_cost(const std::string& directory, const CostTable& table);
void print_cost(const CostTable& table);

} // namespace asperity
