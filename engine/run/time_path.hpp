// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A scene's dynamic path in a loop of the caller's own (asperity.Simulation of Python): it is
// stepped, observed, led by hand, pushed and saved. It starts and turns as a run has it, with
// bitwise identical results (driven_path.hpp).
//
// All ranks of the communicator make the same calls with the same arguments, but for what is
// written to the sites of their own tiles.
#pragma once

#include "engine/equilibrium/state_array.hpp"
#include "engine/run/driven_path.hpp"

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

class TimePath : public std::enable_shared_from_this<TimePath> {
public:
    /// At its start. Throws io::SceneError for a quasi-static scene, or that a run would refuse.
    TimePath(Case c, SceneText source, const Communicator& ranks);
    /// Of a file of save(): it goes on with bitwise identical results.
    static std::shared_ptr<TimePath> resume(const std::string& file, const Communicator& ranks);

    /// n steps, or fewer: none are made past the end of the path. Returns how many were. The last
    /// one is observed, as are those of output.series and of observers. Throws io::PhysicsError
    /// where the physics fails a guard: then this path has ended.
    long long step(long long n, const Look& look);
    /// f is called after each step whose number divides by n, which is observed. Observers look and
    /// write as the program does between two steps, but do not step.
    void every(long long n, std::function<void()> f);
    /// The path has come to its end. Never while the top is led by hand.
    bool done() const { return path_.over(); }
    std::string segment() const; ///< as the scene has it; "done" after the last

    const Case& scene_case() const { return case_; }
    const Simulation& simulation() const { return simulation_; }
    const Surface& surface() const { return surface_; }
    const PathResults& results() const { return results_; }
    /// The last step; zero before the first one.
    const StepRecord& now() const { return now_; }
    /// Of all sites.
    double fraction(long long sites) const;

    // The top plane: displacement since the start, Å, and velocity in the next step, m/s.

    double top_position() const { return simulation_.block().top(); }
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
    Tile tile() const { return grid_.tile(0); }
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
    const Block::Level& lowest_level() const { return simulation_.block().levels().front(); }
    void take_copies();
    void bring_up_views();
    void take_in_writes();
    std::vector<StateArray> arrays();
    std::string description() const;
    void restore(const std::string& file);

    const Case case_;
    const SceneText source_;
    const Communicator ranks_;
    const Surface surface_;
    const ProcessGrid grid_;
    Simulation simulation_;
    PathResults results_;
    DrivenPath path_;
    const double lowest_height_; ///< below it the block has passed through the substrate, Å
    StepRecord now_;
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
