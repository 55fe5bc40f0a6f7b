// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Atoms of a rigid substrate from an HDF5 file, to which `asperity convert` converts other formats:
//
//     /position   [atom][3], Å; x and y from the box's lower corner, in [0, width)
//     /type       [atom], index into the names of its attribute `names` (separated by blanks)
//     /box        [2], widths of the periodic box along x and y, Å
//
// The reader refuses files with inconsistent contents; libhdf5 opens a file only if its digest is
// right.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace asperity::io {

/// Contents of a file of atoms.
struct AtomsFile {
    /// Names of the types, in the order of their first atoms in the file.
    std::vector<std::string> types;
    std::vector<std::int32_t> type;  ///< index into `types` of each atom
    double width_x = 0, width_y = 0; ///< widths of the periodic box, Å
    /// Positions of the atoms, Å; x and y from the box's lower corner, in [0, width).
    std::vector<double> x, y, z;
};

/// Reads the atoms of a substrate. Throws SceneError if the file is damaged or inconsistent.
AtomsFile read_atoms_file(const std::string& file);

/// Returns the number of atoms from the shape of /position; 0 if the file cannot be read.
std::size_t atoms_announced(const std::string& file);

} // namespace asperity::io
