// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A dynamic path (engine/path/time_path.hpp) in a loop of the caller's own (asperity.Simulation of
// Python): it is stepped, observed, led by hand, pushed and saved. It is the same path as that of a
// run, but for the state after an approach, which is found when the caller asks for it.
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

/// A scene as it was given, which a saved path holds.
struct SceneText {
    std::string text, file; ///< text, and the file's name shown in messages
    std::vector<std::string> overrides;
    Case read(int ranks) const { return read_case_text(text, file, overrides, ranks); }
};

/// Called about twenty times a second between steps or iterations. An exception ends the call
/// there; the state is whole.
using Look = std::function<void()>;
/// Caller of a Look at most twenty times a second.
class LookNowAndThen {
public:
    explicit LookNowAndThen(const Look& look) : look_(look) {}
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
    bool same(const VectorPlane<const double>& layer) const;
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
    /// Resumes from a file of save(), bitwise identically.
    static std::shared_ptr<SteppedPath> resume(const std::string& file, const Communicator& ranks);

    /// Makes n steps, or fewer at the end of the path, and returns their number. The last one is
    /// observed, as are those of output.series and of observers. Throws io::PhysicsError if a guard
    /// stops the path, which has then ended.
    long long step(long long n, const Look& look);
    /// Calls f after each step whose number divides by n, which is observed. Observers may read and
    /// write between two steps, as the program may, but not step.
    void every(long long n, std::function<void()> f);
    /// Returns true if the path has come to its end; never while the top is led by hand.
    bool done() const { return !hand_ && path_.status() == Path::Status::done; }
    std::string segment() const; ///< returns the segment as the scene has it; "done" after the last
    /// Returns the number of the last step's segment, from 0; -1 while the top is led by hand.
    int segment_number() const;

    const Case& scene_case() const { return case_; }
    const Simulation& simulation() const { return path_.simulation(); }
    const Drive& drive() const { return path_.drive(); }
    const Surface& surface() const { return surface_; }
    const PathResults& results() const { return path_.results(); }
    /// Returns the record of the last step; zeros before the first one.
    const StepRecord& now() const { return path_.now(); }

    // The top plane: displacement since the start, Å, and velocity in the next step, m/s.

    double top_position() const { return simulation().top().z; }
    void set_top_position(double z);
    double top_velocity() const;
    /// Leads the top plane by hand, at this velocity, m/s: nothing slides, and no segment ends. The
    /// scene's drive resumes if no value is given: a height, a hold or a slide ends at its planned
    /// time, wherever the top plane is.
    void set_top_velocity(std::optional<double> v);

    // Fields of the lowest layer, not copied, current until the next step and again after step().
    // The next step uses values written to u or v, and the energy balance then starts anew. The
    // holder of a view keeps its lease, which keeps this object.

    using View = VectorPlane<double>;
    View u() { return fields_to_write().u.plane(0); }
    View v() { return fields_to_write().v.plane(0); }
    /// Returns the forces of the last step, for reading. Not available on a device.
    View f();
    std::shared_ptr<const void> lease();
    Tile tile() const { return path_.grid().tile(0); }
    InterfaceMaps maps(); ///< returns maps of the sites as they are now

    /// Copies forces on the sites, eV/Å, which act beside the substrate's from the next step on.
    void set_external(const VectorPlane<const double>& field);
    void clear_external();
    /// Returns the field of external forces, to be changed in place; nothing if none acts.
    std::optional<View> external();

    /// Relaxes a copy of the sites from their present places at zero load.
    RestState relax(const Look& look);

    /// Saves everything except the observers in one file (HDF5). Throws io::SceneError if the file
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
    std::optional<TopMotion> hand_; ///< motion of a top plane that is led by hand
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
