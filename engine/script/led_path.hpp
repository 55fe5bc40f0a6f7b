// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A quasi-static path led by hand (asperity.Statics of Python): the caller, in place of the scene's
// segments, moves the solids from one state of force balance to the next. As in a run, a state
// depends on the states before, and dissipated energy is counted. The path starts beyond the
// interaction range.
//
// The first of the mean height and the top plane to be set is held; a load holds the quantity of
// drive.control. A dynamic scene is treated as if drive.mode were "quasistatic".
#pragma once

#include "engine/script/stepped_path.hpp"
#include "engine/statics/quasistatic.hpp"

#include <functional>
#include <optional>
#include <vector>

namespace asperity {

/// A quasi-static path led by hand.
class LedPath {
public:
    /// Places the block beyond the interaction range. Throws io::SceneError for a scene that a run
    /// would refuse.
    explicit LedPath(const Case& c);
    const Case& scene_case() const { return case_; }
    const Surface& surface() const { return surface_; }

    // Goal of the next relax(). The setters throw io::SceneError if the other quantity is held.

    void set_mean_height(double z); ///< sets the mean height above the substrate's zero, Å
    void set_top(double z);         ///< sets the displacement of the top plane since the start, Å
    /// Sets the load, MPa; positive presses. The path ends at the first point whose force is the
    /// load, from below while moving down, from above while moving up.
    void set_load(double pressure);
    /// Sets a rest at the present position for a time, ps, of a viscoelastic block.
    void set_hold(double time);

    /// A point in force balance. Works and losses, instabilities and step (number of points) count
    /// from the beginning of the path: from beyond the interaction range, or from the last
    /// restore() or release().
    struct Point : StepRecord {
        long long instabilities = 0;
        double contact_fraction = 0.0, repulsive_fraction = 0.0;
    };
    /// Moves the block to the goal, point by point; without a goal relaxes it in place. After an
    /// exception of look, the next call continues. Throws io::PhysicsError if no equilibrium is
    /// found, or if the solids separate before a tensile load is reached; the path is then at its
    /// last point, without a goal.
    Point relax(const Look& look);
    Point now() const;          ///< returns the point of the last relax()
    InterfaceMaps maps() const; ///< returns maps of the sites at the point of the last relax()

    /// Relaxes the sites from their present places under drive.load, with top plane and mean height
    /// free; from beyond the interaction range the result is the state of the segment "relax" of a
    /// run. The next relax() begins a new path at the state. Throws io::PhysicsError if no state is
    /// found; after this error, or an exception of look, the sites are unchanged.
    RestState release(const Look& look);

    /// All numbers that determine a state.
    struct State {
        int sites = 0;    ///< number of sites across
        double top = 0.0; ///< displacement of the top plane, Å
        /// Displacements of the lowest layer, [component][y][x], Å, and the arrays of the block's
        /// memories, [array][y][x]; without these the block has relaxed there.
        std::vector<double> values;
        std::size_t displacements() const { return 3 * std::size_t(sites) * std::size_t(sites); }
        bool remembers() const { return values.size() > displacements(); }
    };
    State copy(); ///< returns the present state
    /// Sets the sites, a held top plane and the memories to a state. The next relax() begins a new
    /// path there, at the state's mean height if the mean height is held. Throws io::SceneError for
    /// another number of sites and for values that are not finite.
    void restore(const State& state);

private:
    using Held = Constraint::Of;
    void go_to(Held held, double at);
    void hold(Held held);
    void begin();
    void place(const State& state);
    void lead_to_goal(const Look& look);
    std::vector<RestoredArray> arrays();

    const Case case_;
    const Surface surface_;
    const ProcessGrid grid_;
    Interface interface_;
    SpectralBlock block_;
    std::optional<QuasistaticPath> points_; ///< empty until a path begins
    std::optional<Held> held_;
    /// Start of the next path: true with its memories, false relaxed in place, empty
    /// beyond the interaction range.
    std::optional<bool> remembers_;
    /// Called during relaxations with the iteration and the residual, eV/Å. Returns true to stop.
    std::function<bool(long long, double)> watch_;
    Point before_; ///< last point of the previous path
    struct Goal {
        std::optional<double> at{}, load{}, hold{}; ///< Å, eV/Å, fs
    };
    Goal target_; ///< goal of the next relaxation
};

} // namespace asperity
