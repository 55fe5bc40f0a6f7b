// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A field of sites from a file: a map with a value for each site, for example the heights of the
// substrate. All fields of sites are read here.
#pragma once

#include "engine/case/case.hpp"
#include "io/height_map.hpp"

#include <cstdint>
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

/// Field of a file.
struct FieldMap {
    /// Map of the file, with its values on the root alone.
    io::HeightMap map;
    std::uint32_t digest = 0; ///< CRC-32 of the values of the map and its width
};
/// Reads the map of a field. Only the root reads the file; every rank learns its head. Collective.
/// Throws io::SceneError on the root, RootFailure on the other ranks.
FieldMap read_field(const FieldFile& field, const Communicator& ranks);

} // namespace asperity
