// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What a file of heights holds, before a scene makes anything of it.
//
//     format       recognized by         size and unit
//     text matrix  numbers               headers of Gwyddion and SPIP, "# edge: 41.6 Å"; else none
//     XYZ          name ends in .xyz     size from the coordinates; the unit must be given
//     ESRI grid    first word is ncols   size from cellsize; the unit must be given
//     NumPy        its first bytes       none
//     HDF5         its first bytes       attributes unit, size_x, size_y
//
// Text: one row of the map a line, numbers separated by blanks, tabs, commas or semicolons; #
// starts a comment. Decimal commas are read where the separators are tabs or semicolons. Row r is
// y = r, column c is x = c. HDF5: the two-dimensional data set of the file, or the one named after
// a colon ("map.h5:/topography"); attribute origin says whose map it is. A map of n points is n
// pixels wide.
//
// Files come from elsewhere and may be damaged or made to do harm: sizes are compared with the file
// and with the memory there is before anything is allocated, and libhdf5 runs in a child process.
// What is wrong is a mistake of the scene that names the file: io::SceneError.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
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
};

/// name: a file, or file:/dataset; unit "auto": what the file says, else Å. Throws SceneError.
MapFile read_map_file(const std::string& name, const std::string& unit = "auto");

} // namespace asperity::io
