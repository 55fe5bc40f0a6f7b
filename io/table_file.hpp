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
// the units in the names how values are converted; columns that are not read are noted.
#pragma once

#include <string>
#include <vector>

namespace asperity::io {

/// Columns of a table.
struct TableColumns {
    std::vector<double> distance;   ///< Å
    std::vector<double> energy;     ///< eV
    std::vector<std::string> notes; ///< sentences on the columns that were read and that were not
};

/// Reads a table. Throws SceneError if a line is no row of numbers, if rows differ in length, or if
/// more than two columns have no names.
TableColumns read_table_columns(const std::string& file);

} // namespace asperity::io
