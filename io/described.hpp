// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Data sets of run.h5 with their units: each gets its `unit` and `description` from
// io/quantities.hpp. A path that is not described there throws std::logic_error.
#pragma once

#include "io/hdf5_file.hpp"

#include <string>
#include <vector>

namespace asperity::io {

/// Writes the attributes of a data set that is there.
void describe(Hdf5File& file, const std::string& dataset);

/// A new data set with its attributes.
template <class T>
void write_described(Hdf5File& file, const std::string& dataset, const Hdf5File::Shape& shape,
                     const std::vector<T>& data) {
    file.write<T>(dataset, shape, data);
    describe(file, dataset);
}

/// An attribute of an object, and its unit as the attribute <name>_unit.
void write_described_attribute(Hdf5File& file, const std::string& object, const std::string& name,
                               double value);

/// The attributes of "/": the scene as TOML, version and commit of the program.
void describe_origin(Hdf5File& file, const std::string& scene);

} // namespace asperity::io
