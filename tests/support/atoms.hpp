// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Substrates of atoms as files.
#pragma once

#include "io/atoms_file.hpp"
#include "io/hdf5_file.hpp"

#include <string>
#include <vector>

namespace asperity {

/// The file that io::read_atoms_file() reads; returns its name.
inline std::string write_atoms(const std::string& file, const io::AtomsFile& atoms) {
    std::vector<double> place;
    for (std::size_t i = 0; i < atoms.x.size(); ++i)
        place.insert(place.end(), {atoms.x[i], atoms.y[i], atoms.z[i]});
    std::string names;
    for (const std::string& type : atoms.types)
        names += (names.empty() ? "" : " ") + type;
    io::Hdf5File out(file, io::Hdf5File::Mode::create);
    out.write<double>("/position", {atoms.x.size(), 3}, place);
    out.write<double>("/box", {2}, std::vector<double>{atoms.width_x, atoms.width_y});
    out.write<std::int32_t>("/type", {atoms.type.size()}, atoms.type);
    out.write_attribute("/type", "names", names);
    out.close();
    return file;
}

} // namespace asperity
