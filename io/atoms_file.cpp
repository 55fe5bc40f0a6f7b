// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "io/atoms_file.hpp"

#include "io/hdf5_numbers.hpp"
#include "io/scene_file.hpp"
#include "io/units.hpp"

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
constexpr const char* layout =
    "/position is [atom][3], /type [atom] a number from 0, its attribute "
    "names \"A B\", /box [2]; or write it by asperity convert";

/// Returns Å per unit of a data set's numbers; without a unit they are in Å.
double unit_of(const std::string& file, const NumberSet& set) {
    for (const char* name : {"unit", "units"})
        if (const auto found = set.texts.find(name); found != set.texts.end()) {
            const std::optional<double> factor = conversion(found->second, "Å");
            if (factor && *factor > 0.0 && std::isfinite(*factor)) return *factor;
            refuse(file, fmt::format("atoms in '{}' cannot be read", found->second.substr(0, 40)),
                   "that is no unit of length", "take \"Å\" or \"nm\"");
        }
    return 1.0;
}

/// Reads the data sets of a file of atoms; missing ones have no shape.
std::map<std::string, NumberSet> sets_of(const std::string& file, bool values) {
    const auto those_there = [](const Hdf5File& opened) {
        std::vector<std::string> names;
        for (const char* name : {"/position", "/type", "/box"})
            if (opened.is_dataset(name) && opened.holds_numbers(name)) names.emplace_back(name);
        return names;
    };
    return read_numbers(file,
                        {"the file of atoms", those_there, {"unit", "units", "names"}, {}, values});
}

void check(const std::string& file, const AtomsFile& atoms) {
    const auto require = [&](bool holds, std::string what, std::string why) {
        if (!holds) refuse(file, std::move(what), std::move(why), layout);
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

AtomsFile read(const std::string& file) {
    auto sets = sets_of(file, true);
    const NumberSet &position = sets["/position"], &type = sets["/type"], &box = sets["/box"];
    if (position.shape.size() != 2 || position.shape[1] != 3 || position.shape[0] < 1 ||
        type.shape != Hdf5File::Shape{position.shape[0]} || box.shape != Hdf5File::Shape{2})
        refuse(file, "holds no substrate of atoms",
               fmt::format("/position is {}, /type {}, /box {}, and n x 3, n and 2 numbers are "
                           "needed",
                           position.shape, type.shape, box.shape),
               layout);
    AtomsFile atoms;
    const double unit = unit_of(file, position), of_box = unit_of(file, box);
    for (std::size_t i = 0; i < position.values.size(); i += 3) {
        atoms.x.push_back(unit * position.values[i]);
        atoms.y.push_back(unit * position.values[i + 1]);
        atoms.z.push_back(unit * position.values[i + 2]);
    }
    for (const double number : type.values)
        atoms.type.push_back(number >= 0.0 && number < most_types && number == std::floor(number)
                                 ? static_cast<std::int32_t>(number)
                                 : -1); // refused below
    const auto names = type.texts.find("names");
    std::istringstream words(names == type.texts.end() ? std::string() : names->second);
    for (std::string word; words >> word;)
        atoms.types.push_back(word);
    atoms.width_x = of_box * box.values[0];
    atoms.width_y = of_box * box.values[1];
    check(file, atoms);
    return atoms;
}

} // namespace

AtomsFile read_atoms_file(const std::string& file) {
    if (!is_hdf5(file))
        refuse(file, "the file of atoms cannot be read", "it is not an HDF5 file",
               convert_first(file));
    return read(file);
}

std::size_t atoms_announced(const std::string& file) {
    try {
        const Hdf5File::Shape position = sets_of(file, false)["/position"].shape;
        return position.empty() ? 0 : position[0];
    } catch (const Error&) {
        return 0;
    }
}

} // namespace asperity::io
