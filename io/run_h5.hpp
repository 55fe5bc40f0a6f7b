// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Units and descriptions of the data sets of run.h5, and the parts of H5MD 1.1 (nongnu.org/h5md)
// that a run uses: the author of the file, and a trajectory of particles. engine/run/recorder.cpp
// decides which data sets are written.
//
//     /particles/trajectory/box          dimension 3, periodic in x and y; edges of each frame
//     /particles/trajectory/position     value [frame][particle][3], step [frame], time [frame]
//     /particles/trajectory/velocity     as position, if it is asked for
//
// All elements of a frame share their step and time; numbers are single precision, in Å, ps and
// Å/ps (units as MDAnalysis reads them: "Angstrom", "ps"). Particles keep their order.
#pragma once

#include "io/hdf5_file.hpp"
#include "io/quantities.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace asperity::io {

/// Writes the attributes `unit` and `description` of a data set from io/quantities.hpp. Throws
/// std::logic_error if the table does not describe the path.
void describe(Hdf5File& file, const std::string& dataset);
/// Writes the attributes `unit` and `description` of a data set from a quantity.
void describe(Hdf5File& file, const std::string& dataset, const Quantity& quantity);

/// Tells whether a map is worth compressing: at least a quarter of its values equal the value
/// before, as in maps of pressure and contact. Compression reduces such maps to a tenth or less, at
/// several hundred MB/s; heights and gaps are reduced to 0.75 to 0.86, four times as slowly.
template <class T>
class Repetition {
public:
    /// Adds the next values of the map.
    void add(std::span<const T> values) {
        for (const T& value : values) {
            repeats_ += count_ > 0 && value == last_;
            last_ = value;
            ++count_;
        }
    }
    /// Returns true if the values so far are worth compressing.
    bool is_large() const { return 4 * repeats_ >= count_ && repeats_ > 0; }

private:
    std::size_t count_ = 0, repeats_ = 0;
    T last_{};
};

/// Writes a new data set with its unit and description; compresses repetitive maps.
template <class T>
void write_described(Hdf5File& file, const std::string& dataset, const Hdf5File::Shape& shape,
                     const std::vector<T>& data) {
    Repetition<T> repetition;
    repetition.add(data);
    file.write<T>(dataset, shape, data, shape.size() > 1 && repetition.is_large());
    describe(file, dataset);
}

/// Writes an attribute of an object, and its unit as the attribute <name>_unit.
void write_described_attribute(Hdf5File& file, const std::string& object, const std::string& name,
                               double value);

/// Writes the attributes of "/": the scene as TOML, version and commit of the program.
void describe_origin(Hdf5File& file, const std::string& scene);

/// Writes the group /h5md with version, author and creator.
void write_h5md_head(Hdf5File& file);

/// Group of the trajectory.
inline constexpr const char* trajectory = "/particles/trajectory";
/// Creates the group of the trajectory with its box.
void describe_trajectory(Hdf5File& file);

} // namespace asperity::io
