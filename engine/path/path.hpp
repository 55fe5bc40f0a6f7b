// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The path of a scene (drive.path): its segments one after the other, as time steps (time_path.hpp)
// or as points in force balance (static_path.hpp). A run (engine/run/run.cpp), a script and a
// rehearsal follow it in one way:
//
//     while (path.status() != Path::Status::done) {
//         ... a checkpoint ...
//         if (!path.advance(wish)) break;
//         ... path.status(), path.now(), path.layer() ...
//     }
//
// advance() has the rule of a path:
//
//     beginning, under_way      makes the next step or point of the segment
//     at_end                    a dynamic path makes the step behind the last one of the
//                               segment, so that a guard sees the energy balance of its end
//     behind_end                comes to a relaxation if the segment ends in a state of force
//                               balance: an approach, or "relax"; otherwise concludes the segment
//     relaxing                  finds the state
//     at_rest                   concludes the segment: its works and losses are in results()
//
// A quasi-static path goes from at_end or already_at_end to what follows behind_end.
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

    /// Stage of the path after the last advance().
    enum class Status {
        beginning,      ///< a segment begins
        under_way,      ///< the last step or point belongs to the segment, which goes on
        at_end,         ///< the last step or point has ended the segment
        already_at_end, ///< the segment has ended where it began, without a step or point
        behind_end,     ///< the step behind the last one of the segment has been made
        relaxing,       ///< the next advance() finds the state of force balance
        at_rest,        ///< state() has been found
        done            ///< all segments have been concluded
    };
    Status status() const { return status_; }
    /// Returns true if the last advance() has made a step or point; now() returns its record.
    bool has_stepped() const {
        return status_ == Status::under_way || status_ == Status::at_end ||
               status_ == Status::behind_end;
    }
    /// Returns the number of concluded segments, which is also the index of the segment under way
    /// or at its end.
    std::size_t concluded() const { return concluded_; }

    /// Quantities that observers request from the next time step. Quasi-static points always
    /// provide all of them.
    struct Wish {
        bool energies = false;   ///< energies and contact counts in now()
        bool layer = false;      ///< layer() at that step
        bool velocities = false; ///< velocities() at that step
        void operator|=(const Wish& more) {
            energies |= more.energies;
            layer |= more.layer;
            velocities |= more.velocities;
        }
    };
    /// Advances the path by one step, point, state or conclusion. Returns false if the watch has
    /// stopped a relaxation, which the next call continues. wish: quantities that observers need of
    /// a step. Throws io::PhysicsError if no next point or state is found, or if a segment demands
    /// more tension than the pull-off force.
    bool advance(const Wish& wish);
    /// Returns the state of force balance that was found; at_rest only.
    const LayerAtRest& state() const { return *state_; }
    /// Returns the displacements of the lowest layer in that state, Å; at_rest only.
    VectorPlane<const double> state_layer() const {
        return state_->layer.empty() ? layer() : state_->layer.plane(0);
    }
    /// Called during relaxations with the iteration and the largest residual force, eV/Å. Returns
    /// true to stop the relaxation.
    using Watch = std::function<bool(long long iteration, double residual)>;
    /// Installs a watch; {} removes the watch.
    void watch(Watch watch) { watch_ = std::move(watch); }
    /// Calls work() with the watch installed and removes the watch afterwards.
    template <class Work>
    auto while_watched(Watch watched_by, const Work& work) {
        struct Watching {
            explicit Watching(Path& path) : of(path) {}
            ~Watching() { of.watch({}); }
            Path& of;
        };
        watch(std::move(watched_by));
        const Watching until_here(*this);
        return work();
    }
    // State of the path.

    /// Returns the record of the last step or point.
    virtual const StepRecord& now() const = 0;
    /// Returns the number of time steps so far, or of points after the first one.
    virtual long long steps() const = 0;
    /// Returns the index of the segment that now() belongs to; 0 before the first step.
    virtual std::size_t segment() const = 0;
    /// Returns the displacements of the lowest layer at now(), Å, if the last wish asked for the
    /// layer.
    virtual VectorPlane<const double> layer() const = 0;
    /// Returns the velocities of the lowest layer at now(), Å/fs, if the last wish asked for
    /// velocities: the mean of the velocities half a step before and after; at a temperature the
    /// velocities before friction and noise act (Simulation::set_velocities_at_step()). Empty on
    /// quasi-static paths.
    virtual VectorPlane<const double> velocities() const { return {}; }
    /// Returns the interface in its state at now().
    virtual const Interface& interface() const = 0;
    const Case& scene_case() const { return case_; }
    const Surface& surface() const { return surface_; }
    const PathResults& results() const { return results_; }
    virtual const ProcessGrid& grid() const = 0;          ///< returns the cut of the box
    virtual const Communicator& communicator() const = 0; ///< returns the ranks
    /// Returns true if steps are many and short, so that a run attends to some of them only.
    virtual bool has_short_steps() const { return false; }
    /// Returns the position on the path for messages: "step 1200", "point 17".
    virtual std::string position() const = 0;
    /// Returns the number of iterations of the points so far; nothing for a dynamic path.
    virtual std::optional<long long> iterations() const { return std::nullopt; }
    /// Returns the wall time per phase of the time steps; nullptr for a quasi-static path.
    virtual const Phases* phases() const { return nullptr; }
    /// Returns the memory of the block and the interface on this rank, bytes.
    virtual std::size_t bytes() const = 0;
    /// Frees the memory that the path keeps for its next relaxation, so that other work can use the
    /// memory.
    virtual void free_workspace() const {}
    /// Reason and remedy of an error, for messages.
    struct Remedy {
        std::string why, fix;
    };
    /// Returns the likely reason of an error found by a guard at now(), and its remedy.
    virtual Remedy remedy() const = 0;

    // Checkpoints: numbers, and arrays of whole planes, at any status. The reader of a checkpoint
    // restores the numbers, reads the arrays, and calls restored(); the path then continues bitwise
    // identically; a relaxation of a copy begins again.

    /// Collects the numbers of the path.
    virtual void collect(CollectNumbers& numbers) const = 0;
    /// Returns the arrays of the path to be copied or written.
    virtual std::vector<StateArray> arrays() const = 0;
    /// Sets the numbers of the path.
    virtual void restore(RestoreNumbers& numbers) = 0;
    /// Returns the arrays of the path to be read; call after restore().
    virtual std::vector<RestoredArray> arrays_to_restore() = 0;
    /// Completes the restoration after the arrays have been read: fills halos and waves.
    virtual void restored() = 0;

protected:
    /// Makes the next step or point of the segment, or decides that its relaxation is next. Returns
    /// the new status; nothing if the watch stopped a relaxation.
    virtual std::optional<Status> make_next(const Wish& wish) = 0;
    /// Makes the step behind the end of a segment. Returns false if a path has none.
    virtual bool make_behind_end(const Wish&) { return false; }
    /// Finds the state of force balance at the end of the segment. Returns nothing if the watch
    /// stopped the relaxation.
    virtual std::optional<LayerAtRest> find_state() = 0;
    /// Adds works and losses of the segment to results().
    virtual void conclude() = 0;

    /// Passes the members to a visitor, for checkpoints.
    template <class Visitor>
    void visit(Visitor& v) {
        v("status", status_);
        v("concluded", concluded_);
        v("ledger", ledger_);
        v("results", results_);
    }
    /// Sets the status after a step that was made without advance().
    void come_to(Status status) { status_ = status; }
    /// Returns the segment that is under way or at its end.
    const Segment& segment_to_conclude() const { return case_.path()[concluded_]; }
    /// Tells the watch of an iteration. Returns true if the watch stops the relaxation.
    bool stopped_by_watch(long long iteration, double residual) const {
        return watch_ && watch_(iteration, residual);
    }

    const Case& case_;
    const Surface& surface_;
    PathResults results_;
    Ledger ledger_{case_, results_};

private:
    bool ends_in_state() const;

    Watch watch_;
    Status status_ = Status::beginning;
    std::size_t concluded_ = 0;
    std::optional<LayerAtRest> state_;
};

/// An observer of a path during a run: the records, the maps, the line of progress. Observers
/// change nothing; their order does not matter.
class Observer {
public:
    virtual ~Observer() = default;
    /// Returns the quantities that the observer needs of the next step.
    virtual Path::Wish wish(const Path&) const { return {}; }
    /// Looks at the path after advance(): calls the look_at_...() functions below that belong to
    /// its status.
    void look(const Path& path);
    /// Ends the observation when the run ends, on a complete or an interrupted path.
    virtual void finish(const Path&) {}

protected:
    /// Looks at a step or point.
    virtual void look_at_step(const Path&) {}
    /// Looks at the end of a segment, after look_at_step() if a step or point has ended it.
    virtual void look_at_end(const Path&) {}
    /// Looks at path.state().
    virtual void look_at_state(const Path&) {}
    /// Looks at the beginning of a segment after the first; path.concluded() is the index of the
    /// segment.
    virtual void look_at_beginning(const Path&) {}
};

/// Copies the sites of a layer that this rank owns, without halos.
void copy_layer(const VectorPlane<const double>& from, const VectorPlane<double>& to);

/// Makes the path of the case, dynamic or quasi-static, at its start. Collective.
std::unique_ptr<Path> path_of(const Case& c, const Surface& surface, const Communicator& ranks);

} // namespace asperity
