// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Checkpoints: the whole state of a run in one HDF5 file. A run resumes from it on any number of
// ranks: a simulation or a quasi-static path bitwise as if it had never stopped, a relaxation from
// the same state.
//
// A file holds the state's arrays (of a simulation: each level's displacements and half-step
// velocities) as whole planes, so it is independent of the cut of the box, and numbers by name. It
// ends in a digest of all its bytes and is refused without it. run_storage.hpp describes the files
// that a run keeps.
#pragma once

#include "engine/block/block.hpp"
#include "engine/path/state_numbers.hpp"
#include "engine/statics/state_array.hpp"
#include "io/files.hpp"

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace asperity {

/// Writes the arrays, each as whole planes, and the numbers. fingerprint: physics of the scene as
/// text (physics_of()); only a scene with the same fingerprint can resume from the checkpoint.
/// Collective. Throws io::FileError.
void write_checkpoint(const io::FilePlace& place, const Communicator& ranks,
                      const ProcessGrid& grid, const std::vector<StateArray>& arrays,
                      const StateNumbers& numbers, const std::string& fingerprint);
/// Function that returns the arrays to fill from a checkpoint with these numbers.
using ArraysOf = std::function<std::vector<RestoredArray>(const StateNumbers&)>;
/// Reads the arrays and returns the numbers; the caller fills halos. arrays: called with the
/// numbers; returns the arrays to fill. Collective. Throws io::FileError if the file is damaged or
/// cannot be read, io::SceneError if another scene wrote it.
StateNumbers read_checkpoint(const io::FilePlace& place, const Communicator& ranks,
                             const ProcessGrid& grid, const ArraysOf& arrays,
                             const std::string& fingerprint);
/// Reads the numbers alone, of a checkpoint of any scene. Not collective. Throws io::FileError.
StateNumbers read_checkpoint_numbers(const io::FilePlace& place);

/// Returns the displacements and half-step velocities of each level of a block, for checkpoints.
std::vector<StateArray> state_of(const Block& block);
/// Returns the arrays of state_of() to be overwritten; the caller then calls exchange().
std::vector<RestoredArray> state_to_restore(Block& block);
/// Returns two lists as one.
template <class Array>
std::vector<Array> joined(std::vector<Array> list, const std::vector<Array>& more) {
    list.insert(list.end(), more.begin(), more.end());
    return list;
}

/// A copy of a path's state in memory: of a Path, or of the points of a quasi-static path.
class Snapshot {
public:
    /// Copies the arrays and numbers of the path.
    void take(const auto& path) {
        fields_.take(path.arrays());
        CollectNumbers collect;
        path.collect(collect);
        numbers_ = std::move(collect.numbers);
    }
    bool empty() const { return fields_.empty(); }
    /// Puts the path back to the copied state.
    void restore(auto& path) const {
        RestoreNumbers restore(numbers_);
        path.restore(restore);
        fields_.restore(path.arrays_to_restore()); // the numbers decide which ones
        path.restored();
    }

private:
    StateCopy fields_;
    StateNumbers numbers_;
};

} // namespace asperity
