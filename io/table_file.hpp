// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A pair potential as columns of numbers in a text file.
//
//     two columns              distance, Å, and energy, eV
//     more columns             a line above the first row names them: "# r F V", "r(nm) E(meV) f"
//     a table of LAMMPS        (pair_write, pair_style table) index, distance, energy, force
//
// Numbers are separated by blanks; # starts a comment. The names decide which columns are read, and
// the units that stand beside them what the numbers are; a column that is not read is told.
#pragma once

#include <string>
#include <vector>

namespace asperity::io {

struct TableColumns {
    std::vector<double> distance;   ///< Å
    std::vector<double> energy;     ///< eV
    std::vector<std::string> notes; ///< columns that were read and that were not, a sentence each
};

/// Reads a table. Throws SceneError if a line is no row of numbers, if rows differ in length, or if
/// more than two columns have no names.
TableColumns read_table_columns(const std::string& file);

} // namespace asperity::io
