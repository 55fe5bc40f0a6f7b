// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Atoms for viewers (OVITO, ASE, VMD): extended XYZ and LAMMPS dump, frame after frame into one
// text file, which appears under its name when it is whole.
#pragma once

#include <array>
#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

namespace asperity::io {

/// Columns beside position and type; integers are written without a point.
struct AtomColumn {
    std::string name; ///< "pressure"
    int width = 1;    ///< 3: a vector
    bool integer = false;
    std::vector<double> values; ///< [atom * width]
};

struct AtomFrame {
    std::int64_t step = 0;
    double time = 0.0;              ///< ps
    std::array<double, 3> edges{};  ///< of the box, Å; periodic in x and y
    double lowest = 0.0;            ///< z where the box begins, Å
    std::vector<std::uint8_t> type; ///< 1 substrate, 2 block
    std::vector<double> position;   ///< [atom * 3], Å
    std::vector<AtomColumn> columns;
};

enum class AtomFormat { extended_xyz, lammps_dump };

class AtomsFile {
public:
    /// Throws FileError, here and below.
    AtomsFile(const std::string& path, AtomFormat format);
    ~AtomsFile();
    AtomsFile(const AtomsFile&) = delete;
    AtomsFile& operator=(const AtomsFile&) = delete;

    void append(const AtomFrame& frame);
    /// Puts the file in its place. Without it, nothing is left.
    void close();

private:
    std::string path_, temporary_;
    AtomFormat format_;
    std::ofstream file_;
};

} // namespace asperity::io
