// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Checkpoints: the whole state of a run in one HDF5 file, from which it goes on, on any number of
// ranks: a simulation or a quasi-static path as if it had never stopped, bit for bit; a relaxation
// from the same state.
//
// A file holds the state's arrays (of a simulation: each level's displacements and half-step
// velocities) as whole planes, so it does not know how the box was cut, and numbers by name. It
// ends in a digest of all its bytes, without which it is not read. Which files a run keeps:
// run_storage.hpp.
#pragma once

#include "engine/dynamics/simulation.hpp"
#include "engine/equilibrium/state_array.hpp"
#include "engine/run/state_numbers.hpp"
#include "io/files.hpp"

#include <string>
#include <vector>

namespace asperity {

/// Writes arrays, each as whole planes, and numbers. Collective. fingerprint: of the scene; only
/// the scene that wrote a checkpoint goes on from it.
void write_checkpoint(const io::FilePlace& place, const Communicator& ranks,
                      const ProcessGrid& grid, const std::vector<StateArray>& arrays,
                      const StateNumbers& numbers, const std::string& fingerprint);
/// Reads them back; halos are left to the caller. Collective. Throws io::FileError if the file is
/// damaged or cannot be read, io::SceneError if it is of another scene.
StateNumbers read_checkpoint(const io::FilePlace& place, const Communicator& ranks,
                             const ProcessGrid& grid, const std::vector<StateArray>& arrays,
                             const std::string& fingerprint);
/// The numbers alone, of whatever scene. Not collective. Throws io::FileError.
StateNumbers read_checkpoint_numbers(const io::FilePlace& place);

/// The same with a simulation: its fields, and its numbers as "simulation.*".
void write_checkpoint(const io::FilePlace& place, Simulation& simulation, CollectNumbers numbers,
                      const std::string& fingerprint, const std::vector<StateArray>& arrays = {});
StateNumbers read_checkpoint(const io::FilePlace& place, Simulation& simulation,
                             const std::string& fingerprint,
                             const std::vector<StateArray>& arrays = {});

/// The last state known to be good, in memory, to be written when a guard stops the run.
class Snapshot {
public:
    void take(Simulation& simulation);
    bool empty() const { return fields_.empty(); }
    /// Puts the simulation back to the state taken.
    void restore(Simulation& simulation) const;
    long long step() const { return step_; }

private:
    StateCopy fields_;
    StateNumbers numbers_;
    long long step_ = 0;
};

} // namespace asperity
