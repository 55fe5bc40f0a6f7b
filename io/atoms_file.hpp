// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Atoms of a rigid substrate from a file: LAMMPS data, or extended XYZ (names that end in .xyz or
// .extxyz).
//
// LAMMPS data: the header's "N atoms", "xlo xhi" and "ylo yhi", and the section Atoms of style
// atomic, charge, bond, angle, molecular or full, with or without image flags; the style from
// "Atoms # style", else from the number of columns where that tells it. Other sections are passed
// over. Extended XYZ: one frame, Lattice="..." and Properties with pos:R:3 (species:S:1:pos:R:3
// where it has none); Origin and pbc where given.
//
// The box must be orthogonal; lengths are in Å. Refused is every file from which a wrong number
// could follow: counts that differ, numbers that are none, atoms that stand twice. The error names
// file, line and remedy.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace asperity::io {

struct AtomsFile {
    std::string format;               ///< "LAMMPS data (atomic)", "extended XYZ"
    std::vector<std::string> types;   ///< as the file names them, in the order of their first atoms
    std::vector<std::int32_t> type;   ///< of each atom: which of `types`
    double width_x = 0, width_y = 0;  ///< of the periodic box, Å
    std::vector<double> x, y, z;      ///< Å; x and y from the box's lower corner, in [0, width)
    std::vector<std::string> notes{}; ///< what was folded back, one sentence each
};

/// Throws SceneError.
AtomsFile read_atoms_file(const std::string& file);
/// The same from a text in memory; file is the name shown in messages.
AtomsFile read_atoms_text(std::string_view text, const std::string& file);

/// How many atoms the head of the file announces; 0 where it does not.
std::size_t atoms_announced(const std::string& file);

} // namespace asperity::io
