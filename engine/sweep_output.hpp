// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What a sweep leaves behind: sweep.json, sweep.csv, plots, and the table on the terminal.
#pragma once

#include "engine/sweep.hpp"
#include "engine/theory_command.hpp"
#include "io/json_value.hpp"

#include <string>
#include <vector>

namespace asperity {

struct SweepPoint {
    SweepPoint(const Scene& scene, const std::vector<SweepAxis>& axes, TheoryCase what,
               TheoryNumbers numbers);

    std::vector<io::JsonValue> values; ///< of the swept keys, numbers in the units of the scene
    TheoryCase what;
    TheoryNumbers numbers;
};

struct SweepTable {
    std::string name;    ///< of the scene
    io::JsonValue scene; ///< the scene that the points vary
    std::vector<SweepAxis> axes;
    std::vector<SweepPoint> points;
    std::vector<std::string> notes;
    double seconds = 0.0;
};

/// One line a point under one line of names; text in quotes where it needs them.
std::string sweep_csv(const SweepTable& table);
io::JsonValue sweep_json(const SweepTable& table);

/// All files, and the table on the terminal.
void write_sweep(const std::string& directory, const SweepTable& table);

} // namespace asperity
