// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Numbers of an HDF5 file of any origin that a scene names.
//
// libhdf5 crashes on some damaged files and takes unlimited memory or time for others. Therefore a
// child process opens the file, with limits on its memory and processor time, and passes the
// numbers on in a file in memory. A file that ends in a digest, as Asperity's files do, is refused
// if the digest is wrong.
#pragma once

#include "io/hdf5_file.hpp"

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace asperity::io {

/// A data set of numbers and its attributes.
struct NumberSet {
    Hdf5File::Shape shape;
    std::vector<double> values;               ///< values in row-major order; empty if not asked for
    std::map<std::string, std::string> texts; ///< attributes that are one text
    std::map<std::string, double> numbers;    ///< attributes that are one number
};

/// Data sets and attributes to be read from a file.
struct NumbersWanted {
    const char* what; ///< name of the contents in messages: "the height map"
    /// Returns the names of the data sets to read, or throws. Called in the child process.
    std::function<std::vector<std::string>(const Hdf5File&)> data_sets;
    std::vector<const char*> texts, numbers; ///< names of the attributes to read if they exist
    bool values = true;                      ///< false: only shape and attributes are read
};

/// Reads the wanted data sets. Returns them by name, with the attributes of the file as "/".
/// Compares the sizes with the bytes in the file and with the free memory before reading. Throws
/// SceneError.
std::map<std::string, NumberSet> read_numbers(const std::string& file, const NumbersWanted& wanted);

} // namespace asperity::io
