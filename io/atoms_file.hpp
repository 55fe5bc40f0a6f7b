// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Atoms of a rigid substrate from HDF5, as `asperity convert` writes it from other formats:
//
//     /position   [atom][3], Å; x and y from the box's lower corner, in [0, width)
//     /type       [atom]: which of the names in its attribute `names`, which are separated by
//     blanks /box        [2]: the widths of the periodic box along x and y, Å
//
// Refused is every file from which a wrong number could follow; libhdf5 opens those alone whose
// digest is right.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace asperity::io {

struct AtomsFile {
    std::vector<std::string> types;  ///< as the file names them, in the order of their first atoms
    std::vector<std::int32_t> type;  ///< of each atom: which of `types`
    double width_x = 0, width_y = 0; ///< of the periodic box, Å
    std::vector<double> x, y, z;     ///< Å; x and y from the box's lower corner, in [0, width)
};

/// Throws SceneError.
AtomsFile read_atoms_file(const std::string& file);

/// How many atoms the file holds; 0 where it cannot be read.
std::size_t atoms_announced(const std::string& file);

} // namespace asperity::io
