// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What a file of heights holds, before a scene makes anything of it.
//
//     format       recognized by         size and unit
//     HDF5         its first bytes       attributes unit, scale, size_x, size_y, size_unit
//     NumPy        its first bytes       none
//     text matrix  numbers               none
//
// HDF5: the data set /heights of a file that `asperity convert` or `asperity surface` wrote, or the
// one named after a colon ("map.h5:/NAME"); attribute origin says whose map it is. Sizes are in
// size_unit, else in the unit of the heights. Text: one row of the map a line, numbers separated by
// blanks; # starts a comment. Row r is y = r, column c is x = c. A map of n points is n pixels
// wide. Files of other formats, and HDF5 of other programs, are converted first
// (python/asperity/convert.py).
//
// Files come from elsewhere and may be damaged: sizes are compared with the file and with the
// memory there is before anything is allocated, and libhdf5, which crashes on some damaged files,
// opens those alone whose digest is right. What is wrong is a mistake of the scene that names the
// file: io::SceneError.
#pragma once

#include "io/error.hpp"
#include "io/hdf5_file.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace asperity::io {

struct MapFile {
    std::string format; ///< as in the table above
    std::string source; ///< the file (and data set)
    std::string origin; ///< whose map it is, where the file tells it
    std::size_t rows = 0, columns = 0;
    std::vector<double> heights; ///< Å, heights[y * columns + x]; NaN where one is missing
    std::optional<double> width,
        height;                     ///< of the map, along x and y, Å, where the file tells them
    std::string unit;               ///< of the heights in the file: "nm", "0.03 nm"
    bool unit_assumed = false;      ///< neither the file nor the scene says it: Å
    std::size_t missing = 0;        ///< points without a finite height
    std::string first_missing;      ///< the place of the first: file:line:column or [row, column]
    std::string first_missing_text; ///< what stands there

    // Until they are applied: the heights are in units of the file.
    std::optional<std::string> file_unit; ///< of the heights, as the file says it
    double file_scale = 1.0;   ///< heights are that many units, if the scene does not say otherwise
    bool size_in_unit = false; ///< width and height are in the unit of the heights too
};

/// name: a file, or file:/dataset; unit "auto": what the file says, else Å. Throws SceneError.
MapFile read_map_file(const std::string& name, const std::string& unit = "auto");

// The readers behind it, of bytes rather than files.
MapFile read_map_text(std::string_view text, const std::string& file);
MapFile read_map_numpy(std::string_view bytes, const std::string& file);

// For every file that a scene names.
[[noreturn]] void refuse(std::string where, std::string what, std::string why, std::string fix);
/// What to do with a file of another format: "convert it first: asperity convert X.gwy X.h5".
std::string convert_first(const std::string& file);
/// read(), whose errors of files are mistakes of the scene.
template <class Read>
auto of_scene(const Read& read) {
    try {
        return read();
    } catch (const FileError& error) {
        throw SceneError(error.problems());
    }
}
/// Whether the first bytes are those of HDF5.
bool is_hdf5(const std::string& file);
/// Refused if it has no digest: it may come from anywhere, and libhdf5 may crash on it.
Hdf5File open_hdf5(const std::string& file);
/// Refuses what is larger than the memory; what: "the height map".
void require_memory(const std::string& where, const char* what, double bytes);

} // namespace asperity::io
