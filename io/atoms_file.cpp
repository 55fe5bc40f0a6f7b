// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "io/atoms_file.hpp"

#include "io/scene_file.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace asperity::io {

namespace {

/// Coordinates beyond are no solid (1 mm), and lose the digits that forces need, Å.
constexpr double largest_coordinate = 1e7;
constexpr std::size_t most_types = 64;

Hdf5File::Shape shape_of(const Hdf5File& file, const char* dataset) {
    return file.is_dataset(dataset) && file.holds_numbers(dataset) ? file.shape(dataset)
                                                                   : Hdf5File::Shape{};
}

void check(const std::string& file, const AtomsFile& atoms) {
    const auto require = [&](bool holds, std::string what, std::string why) {
        if (!holds) refuse(file, std::move(what), std::move(why), "write it by asperity convert");
    };
    for (const double width : {atoms.width_x, atoms.width_y})
        require(width > 0.0 && width <= largest_coordinate, "the box of the atoms has no size",
                fmt::format("it is {:.6g} x {:.6g} Å wide", atoms.width_x, atoms.width_y));
    require(!atoms.types.empty() && atoms.types.size() <= most_types,
            "the types of the atoms cannot be told apart",
            fmt::format("there are {} of them, and 1 to {} can be read", atoms.types.size(),
                        most_types));
    for (std::size_t i = 0; i < atoms.x.size(); ++i) {
        const bool inside = atoms.x[i] >= 0.0 && atoms.x[i] < atoms.width_x && atoms.y[i] >= 0.0 &&
                            atoms.y[i] < atoms.width_y &&
                            std::abs(atoms.z[i]) <= largest_coordinate;
        require(inside, fmt::format("atom {} is not in the box", i + 1),
                fmt::format("it is at ({:.6g}, {:.6g}, {:.6g}) Å, and the box {:.6g} x {:.6g} Å "
                            "wide",
                            atoms.x[i], atoms.y[i], atoms.z[i], atoms.width_x, atoms.width_y));
        require(atoms.type[i] >= 0 && static_cast<std::size_t>(atoms.type[i]) < atoms.types.size(),
                fmt::format("atom {} has no type", i + 1),
                fmt::format("its number is {}, of {} types", atoms.type[i], atoms.types.size()));
    }
}

AtomsFile read(const Hdf5File& file) {
    const std::string& name = file.path();
    const Hdf5File::Shape position = shape_of(file, "/position"), type = shape_of(file, "/type");
    if (position.size() != 2 || position[1] != 3 || position[0] < 1 ||
        type != Hdf5File::Shape{position[0]} || shape_of(file, "/box") != Hdf5File::Shape{2})
        refuse(name, "holds no substrate of atoms",
               fmt::format("/position is {}, /type {}, /box {}, and n x 3, n and 2 numbers are "
                           "needed",
                           position, type, shape_of(file, "/box")),
               "write it by asperity convert");
    require_memory(name, "the file of atoms", 64.0 * static_cast<double>(position[0]));
    AtomsFile atoms;
    const std::vector<double> place = file.read<double>("/position"),
                              box = file.read<double>("/box");
    for (std::size_t i = 0; i < place.size(); i += 3) {
        atoms.x.push_back(place[i]);
        atoms.y.push_back(place[i + 1]);
        atoms.z.push_back(place[i + 2]);
    }
    atoms.type = file.read<std::int32_t>("/type");
    std::istringstream names(file.text_attribute("/type", "names").value_or(""));
    for (std::string word; names >> word;)
        atoms.types.push_back(word);
    atoms.width_x = box[0];
    atoms.width_y = box[1];
    check(name, atoms);
    return atoms;
}

} // namespace

AtomsFile read_atoms_file(const std::string& file) {
    if (!is_hdf5(file))
        refuse(file, "the file of atoms cannot be read", "it is not an HDF5 file",
               convert_first(file));
    return read_hdf5(file, read);
}

std::size_t atoms_announced(const std::string& file) {
    try {
        const Hdf5File::Shape position = shape_of(open_hdf5(file), "/position");
        return position.empty() ? 0 : position[0];
    } catch (const Error&) {
        return 0;
    }
}

} // namespace asperity::io
