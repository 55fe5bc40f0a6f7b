// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The memories of a body beside its displacements: arrays of numbers that change at the end of a
// step, and energies that depend on it. A body has a list of memories (Response::memories());
// steps, copies of a state, checkpoints and paths that a script leads go over the list.
//
// A memory changes in accept() alone, so that a step that is tried and given up leaves it as it
// was.
#pragma once

#include "decomposition/field.hpp"
#include "engine/energy/energies.hpp"
#include "engine/units.hpp"

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace asperity {

/// One component of a field of a level, of which the first `planes` planes belong to the state.
template <class Values>
struct ArrayOf {
    std::string name; ///< name of its data set in a checkpoint
    int level = 0;
    Values* field = nullptr;
    int planes = 0;

    /// Returns the same array, to be read only.
    operator ArrayOf<const Values>() const { return {name, level, field, planes}; }
};
using StateArray = ArrayOf<const Field<double>>; ///< array to be copied or written to a checkpoint
using RestoredArray = ArrayOf<Field<double>>;    ///< array to be restored

/// Length of a step in time.
struct TimeStep {
    double dt = units::forever;   ///< fs; infinite: the body relaxes completely
    double last = units::forever; ///< length of the step that this one continues; infinite: none
};

/// Energies of a body at a place where a step may end, eV: the losses are those of the step.
struct StepEnergies : Energies {
    double error = 0.0; ///< error of the time step, eV
    StepEnergies& operator+=(const StepEnergies& more) {
        Energies::operator+=(more);
        error += more.error;
        return *this;
    }
};

/// A memory of a body beside its displacements.
class Memory {
public:
    virtual ~Memory() = default;
    /// Returns the arrays that determine, with the displacements, how the body goes on from a
    /// state. Arrays of zeros are those of a body that remembers nothing.
    virtual std::vector<RestoredArray> arrays() = 0;
    /// Returns the arrays of the last step that a step which continues it needs beside arrays().
    virtual std::vector<RestoredArray> arrays_of_last_step() { return {}; }
    /// Begins a step from the present displacements.
    virtual void begin(const TimeStep& step) = 0;
    /// Ends the step at the present displacements.
    virtual void accept() = 0;
    /// Returns the energies if the step ends at the present displacements. Collective.
    virtual StepEnergies energies() const = 0;
    /// Returns true if a state at rest has the arrays too: they outlive a relaxation.
    virtual bool stays_at_rest() const { return false; }
    virtual std::size_t bytes() const = 0; ///< returns the memory of the fields, bytes
};
using Memories = std::vector<std::unique_ptr<Memory>>; ///< memories of a body

/// Returns true if a memory of a body stays at rest.
inline bool any_stays_at_rest(const Memories& memories) {
    return std::ranges::any_of(memories,
                               [](const auto& memory) { return memory->stays_at_rest(); });
}

} // namespace asperity
