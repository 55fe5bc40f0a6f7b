// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A dynamic path (engine/path/time_path.hpp) in a loop of the caller's own (asperity.Simulation of
// Python): it is stepped, observed, led by hand, pushed and saved. It is the one that a run drives.
//
// All ranks of the communicator make the same calls with the same arguments, but for what is
// written to the sites of their own tiles.
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

/// A scene as it was given: what a saved path holds of it.
struct SceneText {
    std::string text, file; ///< the file's name is shown in messages
    std::vector<std::string> overrides;
    Case read(int ranks) const { return read_case_text(text, file, overrides, ranks); }
};

/// Called about twenty times a second between steps or iterations. What it throws ends the call
/// there; the state is whole.
using Look = std::function<void()>;
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

/// A state of force balance under a load, and its maps.
struct RestState : ZeroLoad {
    InterfaceMaps maps;
};

/// The owned nodes of a layer, to see whether they were written to.
class LayerCopy {
public:
    bool same(const VectorPlane<const double>& layer) const;
    void take(const VectorPlane<const double>& layer);

private:
    std::vector<double> values_;
};

class SteppedPath : public std::enable_shared_from_this<SteppedPath> {
public:
    /// At its start. Throws io::SceneError for a quasi-static scene, or that a run would refuse.
    SteppedPath(Case c, SceneText source, const Communicator& ranks);
    /// Of a file of save(): it goes on bitwise identically.
    static std::shared_ptr<SteppedPath> resume(const std::string& file, const Communicator& ranks);

    /// n steps, or fewer: none are made past the end of the path. Returns how many were. The last
    /// one is observed, as are those of output.series and of observers. Throws io::PhysicsError
    /// where the physics fails a guard: then this path has ended.
    long long step(long long n, const Look& look);
    /// f is called after each step whose number divides by n, which is observed. Observers look and
    /// write as the program does between two steps, but do not step.
    void every(long long n, std::function<void()> f);
    /// The path has come to its end. Never while the top is led by hand.
    bool done() const { return path_.done(); }
    std::string segment() const; ///< as the scene has it; "done" after the last
    /// That of the last step, from 0; -1 while the top is led by hand.
    int segment_number() const;

    const Case& scene_case() const { return case_; }
    const Simulation& simulation() const { return path_.simulation(); }
    const Surface& surface() const { return surface_; }
    const PathResults& results() const { return path_.results(); }
    /// The last step; zero before the first one.
    const StepRecord& now() const { return path_.now(); }

    // The top plane: displacement since the start, Å, and velocity in the next step, m/s.

    double top_position() const { return simulation().block().top(); }
    void set_top_position(double z);
    double top_velocity() const;
    /// None: back to the scene's drive, where that was.
    void set_top_velocity(std::optional<double> v);

    // Of the lowest layer, not copied, current until the next step and again after step(). What is
    // written to u or v is felt by the next step, and the energy balance then starts anew. Who
    // keeps a view keeps the lease with it, which keeps this object.

    using View = VectorPlane<double>;
    View u() { return view_to_write(&Block::Level::u); }
    View v() { return view_to_write(&Block::Level::v); }
    /// Forces of the last step, to be read. Not on a device.
    View f();
    std::shared_ptr<const void> lease();
    Tile tile() const { return path_.grid().tile(0); }
    InterfaceMaps maps(); ///< of the sites as they are now

    /// Forces on the sites beside the substrate's, eV/Å, from the next step on; they are copied.
    void set_external(const VectorPlane<const double>& field);
    void clear_external();
    /// The field that acts, to be changed in place; none where none does.
    std::optional<View> external();

    /// The state at zero load that the sites come to from where they are. A copy is relaxed.
    RestState relax(const Look& look);

    /// Everything but the observers, in one file (HDF5). Throws io::SceneError where something else
    /// than a checkpoint is there.
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
    View view_to_write(VectorField<double> Block::Level::*field);
    const Block::Level& lowest_level() const { return simulation().block().levels().front(); }
    void take_copies();
    void bring_up_views();
    void take_in_writes();
    std::vector<StateArray> own_arrays();
    std::string description() const;
    void restore(const std::string& file);

    const Case case_;
    const SceneText source_;
    const Communicator ranks_;
    const Surface surface_;
    TimePath path_;
    std::vector<Observer> observers_;
    bool stepping_ = false;
    std::string failure_; ///< why no step can follow; empty: one can
    std::unique_ptr<VectorField<double>> external_;
    std::vector<std::unique_ptr<VectorField<double>>> dropped_; ///< fields that may be viewed

    /// Held by all views. Views of u and v were given away, and may be held: what they showed last.
    std::weak_ptr<const void> lease_;
    bool viewed_ = false;
    bool moved_ = false; ///< since they were brought up to date
    LayerCopy u_, v_;
};

} // namespace asperity
