// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The parts of H5MD 1.1 (nongnu.org/h5md) that a run of rough solids has: who wrote the file, and a
// trajectory of particles.
//
//     /particles/trajectory/box          dimension 3, periodic in x and y; edges of each frame
//     /particles/trajectory/position     value [frame][particle][3], step [frame], time [frame]
//     /particles/trajectory/velocity     the same, where asked for
//
// All elements of a frame share their step and time; numbers are single precision, in Å, ps and
// Å/ps (units as MDAnalysis reads them: "Angstrom", "ps"). Particles keep their order.
#pragma once

#include "io/hdf5_file.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <string>

namespace asperity::io {

/// The head of the file: /h5md with version, author and creator.
void write_h5md_head(Hdf5File& file, const std::string& creator_version);

class H5mdTrajectory {
public:
    static constexpr const char* group = "/particles/trajectory";

    /// Makes the group. The file must outlive it.
    H5mdTrajectory(Hdf5File& file, std::uint64_t particles, std::array<double, 3> edges,
                   bool velocities);

    /// One frame: [particle][3] each; velocity is empty without velocities. time in ps.
    void append(std::int64_t step, double time, std::span<const float> position,
                std::span<const float> velocity);

private:
    Hdf5File* file_;
    std::array<float, 9> edges_; ///< a matrix
    bool velocities_;
};

} // namespace asperity::io
