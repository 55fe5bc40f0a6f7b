// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A dynamic path (engine/path/time_path.hpp) in a loop of the caller's own (asperity.Simulation of
// Python), who steps, observes, moves, pushes and saves it. The path is that of a run, except that
// the state after an approach is found only when the caller asks for it.
//
// All ranks of the communicator make the same calls with the same arguments; each writes to the
// sites of its own tile.
#pragma once

#include "engine/path/time_path.hpp"

#include <chrono>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace asperity {

/// The text of a scene and its overrides, stored in a saved path.
struct SceneText {
    std::string text, file; ///< text, and the file's name shown in messages
    std::vector<std::string> overrides;
    /// Reads the case for a number of ranks. Throws io::SceneError.
    Case read(int ranks) const { return read_case_text(text, file, overrides, ranks); }
};

/// Called about twenty times a second between steps or iterations. An exception ends the call in a
/// consistent state.
using Look = std::function<void()>;
/// Functor that calls a Look at most twenty times a second.
class ThrottledLook {
public:
    explicit ThrottledLook(const Look& look) : look_(look) {}
    void operator()() {
        if (!look_ || Clock::now() < next_) return;
        look_();
        next_ = Clock::now() + pause;
    }

private:
    using Clock = std::chrono::steady_clock;
    static constexpr std::chrono::milliseconds pause{50};
    const Look& look_;
    Clock::time_point next_ = Clock::now() + pause;
};

/// State of force balance under a load, with its maps.
struct RestState : ZeroLoad {
    InterfaceMaps maps;
};

/// Copy of the owned nodes of a layer, to detect writes.
class LayerCopy {
public:
    /// Returns true if the layer has the copied values.
    bool same(const VectorPlane<const double>& layer) const;
    /// Copies a layer.
    void take(const VectorPlane<const double>& layer);

private:
    std::vector<double> values_;
};

/// A dynamic path in a loop of the caller's own.
class SteppedPath : public std::enable_shared_from_this<SteppedPath> {
public:
    /// Places the path at its start. Throws io::SceneError for a quasi-static scene and for a scene
    /// that a run would refuse.
    SteppedPath(Case c, SceneText source, const Communicator& ranks);
    /// Resumes a path from a file of save(); it continues bitwise identically. Throws io::FileError
    /// if the file cannot be read.
    static std::shared_ptr<SteppedPath> resume(const std::string& file, const Communicator& ranks);

    /// Makes n steps, or fewer at the end of the path, and returns their number. The last step is
    /// observed, as are the steps of output.series and of observers. Throws io::PhysicsError if a
    /// guard stops the path; no step can follow.
    long long step(long long n, const Look& look);
    /// Registers f to be called after every n-th step, which is observed. f may read and write as
    /// between two steps, but not step.
    void every(long long n, std::function<void()> f);
    /// Returns true if the path is complete; false while the top plane is moved by the caller.
    bool done() const { return !hand_ && path_.status() == Path::Status::done; }
    std::string
    segment() const; ///< returns the segment's text in drive.path; "done" after the last
    /// Returns the index of the last step's segment; -1 while the top plane is moved by the caller.
    int segment_number() const;

    const Case& scene_case() const { return case_; }
    const Simulation& simulation() const { return path_.simulation(); }
    const Drive& drive() const { return path_.drive(); }
    const Surface& surface() const { return surface_; }
    const PathResults& results() const { return path_.results(); }
    /// Returns the record of the last step; zeros before the first one.
    const StepRecord& now() const { return path_.now(); }

    // The top plane.

    /// Returns the displacement since the start, Å.
    double top_position() const { return simulation().top().z; }
    /// Sets the displacement since the start, Å.
    void set_top_position(double z);
    /// Returns the velocity in the next step, m/s.
    double top_velocity() const;
    /// Sets the velocity of the top plane, m/s, in place of the scene's drive: nothing slides, and
    /// no segment ends. Without a value the scene's drive resumes; a height, a hold or a slide then
    /// ends at its planned time at any position of the top plane.
    void set_top_velocity(std::optional<double> v);

    // Views of fields of the lowest layer, without a copy, valid between calls of step(). The next
    // step uses values written to u or v, and the energy balance then starts anew. Who keeps a view
    // must keep a lease(), which keeps this object alive.

    using View = VectorPlane<double>;
    /// Returns the displacements, Å.
    View u() { return fields_to_write().u.plane(0); }
    /// Returns the velocities at the half step, Å/fs.
    View v() { return fields_to_write().v.plane(0); }
    /// Returns the forces of the last step, eV/Å, for reading. Throws io::SceneError on a device.
    View f();
    std::shared_ptr<const void> lease(); ///< returns an owner of this object for a view
    Tile tile() const { return path_.grid().tile(0); }
    InterfaceMaps maps(); ///< returns maps of the sites at their present places

    /// Copies external forces on the sites, eV/Å, which act from the next step on in addition to
    /// the substrate's.
    void set_external(const VectorPlane<const double>& field);
    void clear_external(); ///< removes the forces of set_external()
    /// Returns the field of external forces, eV/Å, for writing; nothing if none act.
    std::optional<View> external();

    /// Relaxes a copy of the sites from their present places at zero load.
    RestState relax(const Look& look);

    /// Saves the path in one file (HDF5), except the observers. Throws io::SceneError if the file
    /// exists and is no checkpoint.
    void save(const std::string& file);

private:
    struct Observer {
        long long period;
        std::function<void()> call;
    };
    struct Saved;
    void require_whole() const;
    void require_processor(const char* what) const;
    void one_step(bool last);
    void require_physical() const;
    Block::Fields fields_to_write();
    const Interface& interface_here();
    const Block::Level& lowest_level() const { return simulation().block().levels().front(); }
    void take_copies();
    void bring_up_views();
    void take_in_writes();
    std::vector<StateArray> own_arrays() const;
    std::vector<RestoredArray> own_arrays_to_restore();
    std::string description() const;
    void restore(const std::string& file);

    const Case case_;
    const SceneText source_;
    const Communicator ranks_;
    const Surface surface_;
    TimePath path_;
    std::optional<TopMotion> hand_; ///< motion of a top plane that the caller moves
    ExternalForces pushing_;        ///< forces of external_
    std::vector<Observer> observers_;
    bool stepping_ = false;
    std::string failure_; ///< reason why no step can follow; empty: one can
    std::unique_ptr<VectorField<double>> external_;
    std::vector<std::unique_ptr<VectorField<double>>> dropped_; ///< fields that may be viewed

    /// Lease of all views; expired if no view of u or v is held.
    std::weak_ptr<const void> lease_;
    bool viewed_ = false;
    bool moved_ = false; ///< the sites have moved since the views were brought up to date
    LayerCopy u_, v_;
};

} // namespace asperity
