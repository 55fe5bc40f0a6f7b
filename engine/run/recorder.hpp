// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// run.h5: the series along the path, the maps of states, and the trajectory of the lowest layer
// (collective; the root writes).
#pragma once

#include "engine/dynamics/simulation.hpp"
#include "engine/scene/scene.hpp"
#include "io/h5md.hpp"
#include "io/hdf5_file.hpp"
#include "io/series.hpp"

#include <memory>
#include <optional>
#include <string>

namespace asperity {

class Recorder {
public:
    /// A new file, or (rows > 0) an old one taken up after its first rows.
    Recorder(const std::string& path, const Surface& surface, const Communicator& communicator,
             DriveMode mode, bool resume, std::uint64_t rows);

    /// One row: an observed step, or a point of a quasi-static path (which has no time, no kinetic
    /// energy and no damping, and no columns for them). sites: N.
    void row(const StepRecord& record, bool pulling, int sites);
    std::uint64_t rows() const { return rows_; }
    /// Maps of a state: gap, pressure, contact, displacement; and the distribution of gaps P(u).
    void fields(const std::string& state, const VectorPlane<const double>& layer,
                const ProcessGrid& grid, const Interface& interface, double reference_height);
    /// Makes room for frames (H5MD); a trajectory taken up from a file loses what came after the
    /// simulation's present step.
    void begin_trajectory(const Simulation& simulation, bool velocities);
    /// One frame: the lowest layer as it stands between two steps. Velocities are half a step old.
    void frame(const Simulation& simulation);
    void flush();

private:
    Communicator communicator_;
    std::unique_ptr<io::Hdf5File> file_; ///< root only
    io::Series series_;
    DriveMode mode_;
    std::optional<io::H5mdTrajectory> trajectory_; ///< root only
    bool velocities_ = false;
    std::uint64_t rows_ = 0;
};

} // namespace asperity
