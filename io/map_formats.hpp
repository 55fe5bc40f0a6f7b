// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The readers behind map_file.hpp and atoms_file.hpp, and what they share. Those of bytes take
// bytes rather than files, so that the tests and fuzz targets can hand them any.
#pragma once

#include "io/hdf5_file.hpp"
#include "io/map_file.hpp"

#include <string_view>

namespace asperity::io {

/// A map on its way: heights in the file's unit.
struct RawMap : MapFile {
    std::optional<std::string> file_unit; ///< of the heights, as the file says it
    double file_scale = 1.0;   ///< heights are that many units, if the scene does not say otherwise
    bool size_in_unit = false; ///< width and height are in the unit of the heights too
};

RawMap read_map_text(std::string_view text, const std::string& file);
RawMap read_map_numpy(std::string_view bytes, const std::string& file);

[[noreturn]] void refuse(std::string where, std::string what, std::string why, std::string fix);
/// What to do with a file of another format: "convert it first: asperity convert X.gwy X.h5".
std::string convert_first(const std::string& file);
/// The bytes of a file that a scene names, and whether those of one start so.
std::string file_contents(const std::string& file);
bool starts_with(const std::string& file, std::string_view bytes);
/// An HDF5 file that a scene names. Refused if it has no digest: it may come from anywhere, and
/// libhdf5 may crash on it.
Hdf5File open_hdf5(const std::string& file);
/// Refuses what is larger than the memory; what: "the height map".
void require_memory(const std::string& where, const char* what, double bytes);

} // namespace asperity::io
