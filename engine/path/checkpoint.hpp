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

#include "engine/block/block.hpp"
#include "engine/equilibrium/state_array.hpp"
#include "engine/path/state_numbers.hpp"
#include "io/files.hpp"

#include <functional>
#include <string>
#include <vector>

namespace asperity {

class Path;

/// Writes arrays, each as whole planes, and numbers. Collective. fingerprint: of the scene; only
/// the scene that wrote a checkpoint goes on from it.
void write_checkpoint(const io::FilePlace& place, const Communicator& ranks,
                      const ProcessGrid& grid, const std::vector<StateArray>& arrays,
                      const StateNumbers& numbers, const std::string& fingerprint);
/// Reads them back; halos are left to the caller. arrays: those to be read, which the numbers may
/// decide. Collective. Throws io::FileError if the file is damaged or cannot be read,
/// io::SceneError if it is of another scene.
using ArraysOf = std::function<std::vector<StateArray>(const StateNumbers&)>;
StateNumbers read_checkpoint(const io::FilePlace& place, const Communicator& ranks,
                             const ProcessGrid& grid, const ArraysOf& arrays,
                             const std::string& fingerprint);
/// The numbers alone, of whatever scene. Not collective. Throws io::FileError.
StateNumbers read_checkpoint_numbers(const io::FilePlace& place);

/// Displacements and half-step velocities of each level.
std::vector<StateArray> state_of(Block& block);
/// One list behind another.
std::vector<StateArray> joined(std::vector<StateArray> list, const std::vector<StateArray>& more);

/// The last state known to be good, in memory, to be written when a guard stops the run.
class Snapshot {
public:
    void take(Path& path);
    bool empty() const { return fields_.empty(); }
    /// Puts the path back to the state taken.
    void restore(Path& path) const;

private:
    StateCopy fields_;
    StateNumbers numbers_;
};

} // namespace asperity
