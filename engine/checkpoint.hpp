// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Checkpoints: the whole state of a run in one HDF5 file, from which it goes on as if it had never
// stopped, on any number of ranks, bit for bit.
//
// A file holds each level's displacements and half-step velocities as whole planes (so it does not
// know how the box was cut) and the scalars of the simulation, drive and run by name. It is written
// beside its place and renamed, so there is always a whole one.
#pragma once

#include "engine/simulation.hpp"

#include <string>
#include <utility>
#include <vector>

namespace asperity {

/// Named numbers of the run outside the simulation (rows written, results found so far).
using RunScalars = std::vector<std::pair<std::string, double>>;

/// Collective. fingerprint: of the scene; a checkpoint is taken up only by the scene that wrote it.
void write_checkpoint(const std::string& path, Simulation& simulation, const RunScalars& scalars,
                      const std::string& fingerprint);

/// Collective. Throws io::FileError if the file cannot be read, io::SceneError if it is of another
/// scene.
RunScalars read_checkpoint(const std::string& path, Simulation& simulation,
                           const std::string& fingerprint);

/// The last state known to be good, in memory, to be written when a guard stops the run.
class Snapshot {
public:
    void take(Simulation& simulation);
    bool empty() const { return levels_.empty(); }
    /// Puts the simulation back to the state taken.
    void restore(Simulation& simulation) const;
    long long step() const { return step_; }
    std::size_t bytes() const;

private:
    struct LevelState {
        VectorField<double> u, v;
    };
    std::vector<LevelState> levels_;
    std::vector<double> scalars_;
    long long step_ = 0;
};

} // namespace asperity
