// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What a sweep leaves behind: sweep.json, sweep.csv, sweep.h5, and the table on the terminal. The
// plots are sweep_plots.hpp.
#pragma once

#include "engine/commands/sweep_table.hpp"

#include <string>
#include <vector>

namespace asperity {

/// One line a point under one line of names; text in quotes where it needs them.
std::string sweep_csv(const SweepTable& table);
/// One line for all seeds: mean and standard deviation of every column.
std::string sweep_mean_csv(const SweepTable& table);
io::JsonValue sweep_json(const SweepTable& table);

/// The tables as they are at this moment; their paths. sweep.json is written last.
std::vector<std::string> write_tables(const std::string& directory, const SweepTable& table);
/// The table in words: a row for all seeds of a point, as sweep_groups() gives them.
struct SweepText {
    std::string meaning; ///< of its numbers; empty where the heads say all
    std::vector<std::string> heads;
    std::vector<std::vector<std::string>> rows;
};
SweepText sweep_text(const SweepTable& table);
/// It, on the terminal.
void print_table(const SweepTable& table);

} // namespace asperity
