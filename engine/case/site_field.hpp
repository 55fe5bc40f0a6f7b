// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A field of sites from a file: a map with a value for each site, for example the heights of the
// substrate. All fields of sites are read here.
#pragma once

#include "engine/case/case.hpp"
#include "io/height_map.hpp"

#include <string>

namespace asperity {

/// File of a field, and options for reading it.
struct FieldFile {
    std::string name;     ///< file as the scene names it
    std::string file;     ///< path of the file
    io::MapOptions how{}; ///< unit, size, treatment of holes and of maps that are not square
};

/// Returns the file of the heights of a case whose surface is a map.
FieldFile heights_of(const Case& c);
/// Returns the file of the heights of the second solid of a case that has one.
FieldFile counter_heights_of(const Case& c);

/// Reads the map of a field and returns it on every rank; only the root reads the file. Collective.
/// Throws io::SceneError.
io::HeightMap read_field(const FieldFile& field, const Communicator& ranks);

} // namespace asperity
