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

    /// Place of a path in its course, which the last advance() has come to.
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
    /// Returns true if the last advance() has made a step or point, which now() has.
    bool has_stepped() const {
        return status_ == Status::under_way || status_ == Status::at_end ||
               status_ == Status::behind_end;
    }
    /// Returns the number of segments that have been concluded: the number of the one under way or
    /// at its end.
    std::size_t concluded() const { return concluded_; }

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
    /// Goes on by one step, point, state or conclusion. Returns false if the watch has stopped a
    /// relaxation: the same call goes on. Throws io::PhysicsError if there is no next point or
    /// state, or if a segment demands a stronger pull than the attraction.
    bool advance(const Wish& wish);
    /// Returns the state of force balance that was found, with its layer; at_rest only.
    const LayerAtRest& state() const { return *state_; }
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
    /// (Simulation::set_velocities_at_step()). Dynamic paths only.
    virtual VectorPlane<const double> velocities() const { return {}; }
    /// Returns the interface as it was at now().
    virtual const Interface& interface() const = 0;
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
    /// Frees the memory that the path keeps for its next relaxation, before work that needs memory
    /// of another kind.
    virtual void free_workspace() const {}
    /// Likely reason of an error found by a guard at now(), and its remedy.
    struct Remedy {
        std::string why, fix;
    };
    virtual Remedy remedy() const = 0;

    // Checkpoints: numbers, and arrays of whole planes, at any status. The reader of a checkpoint
    // restores the numbers, reads the arrays, and calls restored(); the path then goes on bitwise
    // identically, and begins a relaxation of a copy again.

    virtual void collect(CollectNumbers& numbers) const = 0;
    virtual std::vector<StateArray> arrays() const = 0;
    virtual void restore(RestoreNumbers& numbers) = 0;
    virtual std::vector<RestoredArray> arrays_to_restore() = 0;
    virtual void restored() = 0;

protected:
    /// Makes the next step or point of the segment, or comes to its relaxation. Returns the status
    /// then; nothing if the watch stopped a relaxation.
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
    /// Sets the status after a step that advance() has not made.
    void come_to(Status status) { status_ = status; }
    /// Returns the segment that is under way or at its end.
    const Segment& segment_to_conclude() const { return case_.path()[concluded_]; }
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

/// An observer of a path during a run: the records, the maps, the line of progress. Observers only
/// look; their order does not matter.
class Observer {
public:
    virtual ~Observer() = default;
    /// Returns the data that the observer needs of the next step.
    virtual Path::Wish wish(const Path&) const { return {}; }
    /// Looks at the path after advance(): calls those of the following that its status calls for.
    void look(const Path& path);
    /// Ends the observation with the run, whether or not the path has come to its end.
    virtual void finish(const Path&) {}

protected:
    /// Looks at a step or point.
    virtual void look_at_step(const Path&) {}
    /// Looks at the end of a segment, after look_at_step() if a step or point has ended it.
    virtual void look_at_end(const Path&) {}
    /// Looks at path.state().
    virtual void look_at_state(const Path&) {}
    /// Looks at the beginning of a segment after another: path.concluded() is its number.
    virtual void look_at_beginning(const Path&) {}
};

/// Copies the owned sites of a layer.
void copy_layer(const VectorPlane<const double>& from, const VectorPlane<double>& to);

/// Returns the path that the case calls for, at its start.
std::unique_ptr<Path> path_of(const Case& c, const Surface& surface, const Communicator& ranks);

} // namespace asperity
