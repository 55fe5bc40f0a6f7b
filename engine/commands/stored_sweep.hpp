// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A sweep read back from its sweep.json: what its report is made from. The table has every number
// that the plots ask for, under the same names; what a point's result.json holds beyond the table's
// columns is not in it.
#pragma once

#include "engine/commands/sweep_table.hpp"

#include <string>
#include <vector>

namespace asperity {

struct StoredSweep {
    std::string directory; ///< of the table; those of the points are in it
    io::JsonValue json;
    SweepTable table;
};

/// DIR's own sweep, or those of several scenes in folders of DIR; none: an empty list. Throws
/// io::FileError.
std::vector<StoredSweep> read_sweeps(const std::string& directory);

} // namespace asperity
