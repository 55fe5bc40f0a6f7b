// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The path of a scene (drive.path): its segments one after the other, as time steps
// (time_path.hpp) or as points in force balance (static_path.hpp). Who drives it, a run
// (engine/run/run.cpp) or a script, does:
//
//     for (;;) {
//         if (path.ended()) {
//             ... path.find_state(), where the scene calls for it ...
//             path.conclude();
//         } else if (path.done()) {
//             break;
//         } else {
//             path.advance(wish);
//             ... path.now(), path.layer() ...
//         }
//     }
//
// A segment in time is concluded after the step behind its last one, so that a guard has seen the
// energy balance of its end; one of points at once.
//
// All member functions are collective.
#pragma once

#include "engine/equilibrium/state_array.hpp"
#include "engine/equilibrium/zero_load.hpp"
#include "engine/path/ledger.hpp"
#include "engine/path/path_results.hpp"
#include "engine/path/state_numbers.hpp"
#include "engine/phases.hpp"
#include "engine/setup/case.hpp"
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

class Path {
public:
    /// Both must outlive it.
    Path(const Case& c, const Surface& surface) : case_(c), surface_(surface) {}
    virtual ~Path() = default;
    Path(const Path&) = delete;
    Path& operator=(const Path&) = delete;

    // The way along the path.

    /// The last segment has been concluded.
    virtual bool done() const = 0;
    /// What observers want of the next step; a point has all of it.
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
    /// nothing: the segment ends where it began; interrupted: the watch asked for an end within a
    /// relaxation, and the path is at its last point.
    enum class Made { step, nothing, interrupted };
    /// The next step or point. Throws io::PhysicsError where there is no next point, or where a
    /// pull that a segment leads to is not there.
    virtual Made advance(const Wish& wish) = 0;
    /// The segment that has ended and is to be concluded before the next advance().
    virtual std::optional<std::size_t> ended() const = 0;
    /// The last step or point has ended segment().
    virtual bool at_end() const = 0;
    /// The next step concludes a segment: it is observed, and a run does not end before it.
    virtual bool about_to_conclude() const { return false; }
    /// Of a segment that has ended, the state of force balance under its load with the top plane
    /// free, which results() then holds. Empty where the watch asked for an end.
    virtual std::optional<LayerAtRest> find_state() = 0;
    /// Works and losses of the segment that has ended; the next one is under way.
    virtual void conclude() = 0;
    /// Told of the iterations of relaxations and of the largest force left, eV/Å. True: the
    /// relaxation ends.
    using Watch = std::function<bool(long long iteration, double residual)>;
    void watch(Watch told) { watch_ = std::move(told); }
    /// Does the work with this watch, and then without any.
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
    /// Under way is a relaxation that goes on from where the block is: it can be saved within.
    virtual bool relaxes_freely() const { return false; }

    // Where it is.

    virtual const StepRecord& now() const = 0;
    /// Steps, or points after the first one, made so far.
    virtual long long steps() const = 0;
    /// The segment that now() belongs to; before the first step the first one.
    virtual std::size_t segment() const = 0;
    /// Displacements of the lowest layer at now(), Å, if they were wanted.
    virtual VectorPlane<const double> layer() const = 0;
    /// Returns its velocities at now(), Å/fs: the mean of those half a step before and after; at a
    /// temperature those before friction and noise act (Simulation::take_to_step()). Not of points.
    virtual VectorPlane<const double> velocities() const { return {}; }
    /// As it was at now().
    virtual const Interface& interface() const = 0;
    virtual Interface& interface() = 0;
    /// Height of the undisplaced lowest layer above the substrate's zero, Å.
    virtual double reference_height() const = 0;
    const Case& scene_case() const { return case_; }
    const Surface& surface() const { return surface_; }
    const PathResults& results() const { return results_; }
    virtual const ProcessGrid& grid() const = 0;
    virtual const Communicator& communicator() const = 0;
    /// "step 1200", "point 17".
    virtual std::string position() const = 0;
    /// Iterations of the points so far; none in time.
    virtual std::optional<long long> iterations() const { return std::nullopt; }
    /// Of the steps.
    virtual const Phases* phases() const { return nullptr; }
    /// Of the block and the interface on this rank.
    virtual std::size_t bytes() const = 0;
    /// Why a guard may have found something wrong at now(), and what to do.
    struct Remedy {
        std::string why, fix;
    };
    virtual Remedy remedy() const = 0;
    /// Says what is left to go on from.
    using Kept = std::function<std::string()>;

    // Checkpoints: numbers, and arrays of whole planes. Who reads one restores the numbers, reads
    // the arrays, and calls restored(); the path then goes on bitwise identically.

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

/// What looks at a path while a run drives it: the guard, the records, the maps, the line of
/// progress. It changes nothing of the path.
class Observer {
public:
    virtual ~Observer() = default;
    /// What it needs of the next step.
    virtual Path::Wish wish(const Path&) const { return {}; }
    /// After each step or point.
    virtual void look(Path& path) = 0;
    /// Where the step or point has ended a segment, after look(): path.at_end().
    virtual void look_at_end(Path&) {}
    /// Of a state of force balance that find_state() has found.
    virtual void look_at_state(Path&, const LayerAtRest&) {}
    /// When the run ends, whether or not the path has come to its end.
    virtual void finish(Path&) {}
};

/// The owned sites.
void copy_layer(const VectorPlane<const double>& from, const VectorPlane<double>& to);

/// The path that the case calls for, at its start.
std::unique_ptr<Path> path_of(const Case& c, const Surface& surface, const Communicator& ranks);

} // namespace asperity
