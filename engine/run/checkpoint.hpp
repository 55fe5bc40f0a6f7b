// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Checkpoints: the whole state of a run in one HDF5 file, from which it goes on, on any number of
// ranks: a simulation or a quasi-static path as if it had never stopped, bit for bit (the spectral
// block on the same number of ranks); a relaxation from the same state.
//
// A file holds the state's arrays (of a simulation: each level's displacements and half-step
// velocities) as whole planes, so it does not know how the box was cut, and scalars by name. It
// ends in a digest of all its bytes, without which it is not read. Which files a run keeps:
// run_storage.hpp.
#pragma once

#include "engine/dynamics/simulation.hpp"
#include "engine/equilibrium/state_array.hpp"
#include "io/directory.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace asperity {

/// Named numbers, in an order of their own.
using RunScalars = std::vector<std::pair<std::string, double>>;

/// Visitors of everything that lists its numbers by name (visit()): they are kept as doubles, which
/// hold integers below 2^53 exactly.
struct CollectScalars {
    RunScalars values;
    template <class T>
    void operator()(const char* name, T& value) {
        values.emplace_back(name, static_cast<double>(value));
    }
};
struct RestoreScalars {
    const RunScalars& values;
    std::size_t at = 0;
    /// Throws io::FileError where the next number has another name.
    double next(const char* name);
    /// Throws io::FileError as well where it is no integer between these.
    double next_integer(const char* name, double least, double most);

    void operator()(const char* name, double& value) { value = next(name); }
    /// The length of a list, whose elements follow.
    void operator()(const char* name, std::size_t& count) {
        count =
            static_cast<std::size_t>(next_integer(name, 0.0, static_cast<double>(values.size())));
    }
    template <class T>
    requires std::is_integral_v<T>
    void operator()(const char* name, T& value) {
        using Limits = std::numeric_limits<T>;
        constexpr double exact = 9007199254740992.0; // 2^53
        value = static_cast<T>(next_integer(name,
                                            std::max(-exact, static_cast<double>(Limits::lowest())),
                                            std::min(exact, static_cast<double>(Limits::max()))));
    }
    template <class T>
    requires std::is_enum_v<T>
    void operator()(const char* name, T& value) {
        std::underlying_type_t<T> number{};
        (*this)(name, number);
        value = static_cast<T>(number);
    }
};

/// Writes arrays, each as whole planes, and scalars. Collective. fingerprint: of the scene; only
/// the scene that wrote a checkpoint goes on from it.
void write_checkpoint(const io::FilePlace& place, const Communicator& ranks,
                      const ProcessGrid& grid, const std::vector<StateArray>& arrays,
                      const RunScalars& scalars, const std::string& fingerprint);
/// Reads them back; halos are left to the caller. Collective. Throws io::FileError if the file is
/// damaged or cannot be read, io::SceneError if it is of another scene.
RunScalars read_checkpoint(const io::FilePlace& place, const Communicator& ranks,
                           const ProcessGrid& grid, const std::vector<StateArray>& arrays,
                           const std::string& fingerprint);
/// The scalars alone, of whatever scene. Not collective. Throws io::FileError.
RunScalars read_checkpoint_scalars(const io::FilePlace& place);

/// A simulation with its fields, and of the run outside it: arrays and numbers (rows recorded,
/// results found so far). Collective.
void write_checkpoint(const io::FilePlace& place, Simulation& simulation, const RunScalars& scalars,
                      const std::string& fingerprint,
                      const std::vector<StateArray>& run_arrays = {});
RunScalars read_checkpoint(const io::FilePlace& place, Simulation& simulation,
                           const std::string& fingerprint,
                           const std::vector<StateArray>& run_arrays = {});

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
    RunScalars scalars_;
    long long step_ = 0;
};

} // namespace asperity
