// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The path of a scene (drive.path): its segments one after the other, as time steps (time_path.hpp)
// or as points in force balance (static_path.hpp). A run (engine/run/run.cpp) or a script drives
// it:
//
//     for (;;) {
//         if (path.ended()) {
//             ... path.find_state(), if the scene calls for it ...
//             path.conclude();
//         } else if (path.done()) {
//             break;
//         } else {
//             path.advance(wish);
//             ... path.now(), path.layer() ...
//         }
//     }
//
// A dynamic segment is concluded after the step behind its last one, so that a guard has seen the
// energy balance of its end; a quasi-static segment is concluded at once.
//
// All member functions are collective.
#pragma once

#include "engine/case/case.hpp"
#include "engine/path/ledger.hpp"
#include "engine/path/path_results.hpp"
#include "engine/path/state_numbers.hpp"
#include "engine/phases.hpp"
#include "engine/statics/state_array.hpp"
#include "engine/statics/zero_load.hpp"
#include "engine/step_record.hpp"
#include "io/error.hpp"

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace asperity {

/// A path of a scene and its results so far.
class Path {
public:
    /// Keeps references to both arguments.
    Path(const Case& c, const Surface& surface) : case_(c), surface_(surface) {}
    virtual ~Path() = default;
    Path(const Path&) = delete;
    Path& operator=(const Path&) = delete;

    // Course of the path.

    /// Returns true if the last segment has been concluded.
    virtual bool done() const = 0;
    /// Data that observers need of the next step; a point always has all of them.
    struct Wish {
        bool energies = false;   ///< energies and contacts in now(): an observed step
        bool layer = false;      ///< layer() at that step
        bool velocities = false; ///< velocities() at that step
        void operator|=(const Wish& more) {
            energies |= more.energies;
            layer |= more.layer;
            velocities |= more.velocities;
        }
    };
    /// Outcome of advance(). nothing: the segment ends where it began; interrupted: the watch
    /// stopped a relaxation, and the path is at its last point.
    enum class Made { step, nothing, interrupted };
    /// Makes the next step or point. Throws io::PhysicsError if there is no next point, or if a
    /// segment demands a stronger pull than the attraction.
    virtual Made advance(const Wish& wish) = 0;
    /// Returns the segment that has ended and must be concluded before the next advance().
    virtual std::optional<std::size_t> ended() const = 0;
    /// Returns true if the last step or point has ended segment().
    virtual bool at_end() const = 0;
    /// Returns true if the next step concludes a segment: it is observed, and a run does not end
    /// before it.
    virtual bool about_to_conclude() const { return false; }
    /// Finds the state of force balance under the load of the segment that has ended, with the top
    /// plane free, and adds it to results(). Returns nothing if the watch stopped the relaxation.
    virtual std::optional<LayerAtRest> find_state() = 0;
    /// Adds works and losses of the segment that has ended to results(), and begins the next
    /// segment.
    virtual void conclude() = 0;
    /// Called during relaxations with the iteration and the largest residual force, eV/Å. Returns
    /// true to stop the relaxation.
    using Watch = std::function<bool(long long iteration, double residual)>;
    void watch(Watch told) { watch_ = std::move(told); }
    /// Calls work() with the watch installed and removes the watch afterwards.
    template <class Work>
    auto while_watched(Watch told, const Work& work) {
        struct Watching {
            explicit Watching(Path& path) : of(path) {}
            ~Watching() { of.watch({}); }
            Path& of;
        };
        watch(std::move(told));
        const Watching until_here(*this);
        return work();
    }
    /// Returns true during a relaxation that can be checkpointed before it has converged.
    virtual bool relaxes_freely() const { return false; }

    // State of the path.

    virtual const StepRecord& now() const = 0;
    /// Returns the number of steps, or of points after the first one, so far.
    virtual long long steps() const = 0;
    /// Returns the segment that now() belongs to; before the first step the first one.
    virtual std::size_t segment() const = 0;
    /// Returns the displacements of the lowest layer at now(), Å, if they were wished for.
    virtual VectorPlane<const double> layer() const = 0;
    /// Returns the velocities of the lowest layer at now(), Å/fs: the mean of those half a step
    /// before and after; at a temperature those before friction and noise act
    /// (Simulation::take_to_step()). Dynamic paths only.
    virtual VectorPlane<const double> velocities() const { return {}; }
    /// Returns the interface as it was at now().
    virtual const Interface& interface() const = 0;
    virtual Interface& interface() = 0;
    /// Returns the height of the undisplaced lowest layer above the substrate's zero, Å.
    virtual double reference_height() const = 0;
    const Case& scene_case() const { return case_; }
    const Surface& surface() const { return surface_; }
    const PathResults& results() const { return results_; }
    virtual const ProcessGrid& grid() const = 0;
    virtual const Communicator& communicator() const = 0;
    /// Returns the position in words: "step 1200", "point 17".
    virtual std::string position() const = 0;
    /// Returns the number of iterations of the points so far; nothing for a dynamic path.
    virtual std::optional<long long> iterations() const { return std::nullopt; }
    /// Returns the wall time per phase of the steps. Dynamic paths only.
    virtual const Phases* phases() const { return nullptr; }
    /// Returns the memory of the block and the interface on this rank, bytes.
    virtual std::size_t bytes() const = 0;
    /// Likely reason of an error found by a guard at now(), and its remedy.
    struct Remedy {
        std::string why, fix;
    };
    virtual Remedy remedy() const = 0;
    /// Describes the state to resume from.
    using Kept = std::function<std::string()>;

    // Checkpoints: numbers, and arrays of whole planes. The reader of a checkpoint restores the
    // numbers, reads the arrays, and calls restored(); the path then goes on bitwise identically.

    virtual void collect(CollectNumbers& numbers) = 0;
    virtual void restore(RestoreNumbers& numbers) = 0;
    virtual std::vector<StateArray> arrays() = 0;
    virtual void restored() = 0;

protected:
    bool told(long long iteration, double residual) const {
        return watch_ && watch_(iteration, residual);
    }

    const Case& case_;
    const Surface& surface_;
    PathResults results_;
    Ledger ledger_{case_, results_};

private:
    Watch watch_;
};

/// An observer of a path during a run: the guard, the records, the maps, the line of progress. It
/// does not change the path.
class Observer {
public:
    virtual ~Observer() = default;
    /// Returns the data that the observer needs of the next step.
    virtual Path::Wish wish(const Path&) const { return {}; }
    /// Looks at the path after each step or point.
    virtual void look(Path& path) = 0;
    /// Looks at the path, after look(), if the step or point has ended a segment: path.at_end().
    virtual void look_at_end(Path&) {}
    /// Looks at a state of force balance that find_state() has found.
    virtual void look_at_state(Path&, const LayerAtRest&) {}
    /// Ends the observation with the run, whether or not the path has come to its end.
    virtual void finish(Path&) {}
};

/// Copies the owned sites of a layer.
void copy_layer(const VectorPlane<const double>& from, const VectorPlane<double>& to);

/// Returns the path that the case calls for, at its start.
std::unique_ptr<Path> path_of(const Case& c, const Surface& surface, const Communicator& ranks);

} // namespace asperity
