// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Numbers of an HDF5 file that a scene names, whoever wrote it.
//
// libhdf5 crashes on some damaged files, and some make it ask for any amount of memory or time. So
// a child process opens the file, with limits on its memory and processor time, and hands the
// numbers over in a file in memory; this process opens no such file. A file that ends in a digest,
// as those of Asperity do, is refused where its bytes are others.
#pragma once

#include "io/hdf5_file.hpp"

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace asperity::io {

/// A data set of numbers.
struct NumberSet {
    Hdf5File::Shape shape;
    std::vector<double> values;               ///< none where they were not asked for
    std::map<std::string, std::string> texts; ///< attributes that are one text
    std::map<std::string, double> numbers;    ///< and those that are one number
};

/// What is wanted of a file.
struct NumbersWanted {
    const char* what; ///< "the height map"
    /// The names of data sets of numbers; or throws. Called in the child process.
    std::function<std::vector<std::string>(const Hdf5File&)> data_sets;
    std::vector<const char*> texts, numbers; ///< attributes, where they are there
    bool values = true;                      ///< false: shape and attributes alone
};

/// The data sets by name, and "/" with the attributes of the file; sizes are compared with the
/// bytes in the file and with the memory before anything is read. Throws SceneError.
std::map<std::string, NumberSet> read_numbers(const std::string& file, const NumbersWanted& wanted);

} // namespace asperity::io
