// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The readers behind map_file.hpp, one a format. Each fills in what its file says, heights still in
// the file's unit; map_file.cpp does what is common to all. They take bytes rather than files, so
// that the tests and fuzz targets can hand them any.
#pragma once

#include "io/map_file.hpp"

#include <string_view>

namespace asperity::io {

/// A map on its way: heights in the file's unit.
struct RawMap : MapFile {
    std::optional<std::string> file_unit; ///< of the heights, as the file says it
    double file_scale = 1.0;              ///< heights are that many units ("Bit2nm"), if the scene
                                          ///< does not say otherwise
    bool size_in_unit = false;            ///< width and height are in the unit of the heights too
};

/// Matrix, XYZ or ESRI grid. xyz: three columns x, y, z.
RawMap read_map_text(std::string_view text, const std::string& file, bool xyz);
RawMap read_map_numpy(std::string_view bytes, const std::string& file);
/// dataset empty: the only one with two dimensions. In a child process.
RawMap read_map_hdf5(const std::string& file, const std::string& dataset);
/// The same in this process: a damaged file may end it.
RawMap read_map_hdf5_here(const std::string& file, const std::string& dataset);

// Of lines of text: blanks at their ends are no part of them.
inline constexpr std::string_view blanks = " \t\r";
inline std::string_view trimmed(std::string_view text) {
    const std::size_t first = text.find_first_not_of(blanks);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// In lower case; ASCII alone.
inline std::string lower(std::string_view text) {
    std::string result(text);
    for (char& c : result)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return result;
}

[[noreturn]] void refuse(std::string where, std::string what, std::string why, std::string fix);
/// The bytes of a file that a scene names; `what` it is, for messages. Refused if it is larger than
/// the memory.
std::string file_contents(const std::string& file, const char* what);
/// Å per unit, refused if it is no length.
double length_unit(const std::string& unit, const std::string& where);

} // namespace asperity::io
