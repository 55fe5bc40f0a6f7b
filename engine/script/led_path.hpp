// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A quasi-static path (engine/path/static_path.hpp) by hand (asperity.Statics of Python): its
// solids in force balance, where they are led. What is found depends on the way there, as on a path
// of a run; what is lost on it is counted. It starts beyond the interaction range.
//
// The mean height is held, or the top plane; the first one that is set decides, or a load, which
// then holds what drive.control says. Of a dynamic scene the same solids are taken, as if
// drive.mode were "quasistatic".
#pragma once

#include "engine/path/static_path.hpp"
#include "engine/script/stepped_path.hpp"

#include <exception>
#include <optional>
#include <vector>

namespace asperity {

class LedPath {
public:
    explicit LedPath(const Case& c);
    const Case& scene_case() const { return case_; }
    const Surface& surface() const { return surface_; }

    // Where the next relax() goes. Throw io::SceneError where the other one is held.

    void set_mean_height(double z); ///< Å above the substrate's zero
    void set_top(double z);         ///< displacement since the start, Å
    /// MPa; positive presses. Reached where the force comes to it, from below on the way in, from
    /// above on the way out.
    void set_load(double pressure);
    /// Stays where it is for so many ps; of a block that relaxes.
    void set_hold(double time);

    /// Force balance at what is held. Work, damped (dissipated at instabilities), instabilities and
    /// step (points) count from where the path began: beyond the interaction range, or the last
    /// restore() or release().
    struct Point : StepRecord {
        long long instabilities = 0;
        double contact_fraction = 0.0, repulsive_fraction = 0.0;
        double energy() const { return interface_energy + elastic_energy; }
    };
    /// Goes there, point by point; without a target: where it is. After what look throws, the same
    /// call goes on. Throws io::PhysicsError if no equilibrium is found, or if the solids part
    /// before a pull is reached; the path is then at its last point again, without a target.
    Point relax(const Look& look);
    Point now() const; ///< of the last relax()
    InterfaceMaps maps() const;

    /// The state that the sites come to from where they are with nothing held but drive.load; from
    /// beyond the interaction range the one that the segment "relax" of a run leads to. The next
    /// relax() begins a new path there. Where none is found (io::PhysicsError), or look throws, the
    /// sites stay where they were.
    RestState release(const Look& look);

    /// All that a state depends on.
    struct State {
        int sites = 0;         ///< across
        std::vector<double> u; ///< displacements of the lowest layer, [component][y][x], Å
        double top = 0.0;      ///< displacement of the top plane, Å
        /// Of a block that relaxes, extensions of the branches' springs, [branch][moving
        /// component][y][x], Å; empty: the block has relaxed there.
        std::vector<double> branches{};
    };
    State copy() const;
    /// Puts the sites, a held top plane and the branches there; the next relax() begins a new path
    /// there, at the mean height that they have where that is held. Throws io::SceneError for
    /// another number of sites and for values that are no numbers.
    void restore(const State& state);

private:
    using Held = Constraint::Of;
    void go_to(Held held, double at);
    void hold(Held held);
    void begin();
    void place(const State& state);
    template <class Work>
    auto while_looking(const Look& look, const Work& work);

    const Case case_;
    const Surface surface_;
    StaticPath path_;
    std::optional<Held> held_;
    /// It begins where the block is, not beyond the interaction range: relaxed, or with what
    /// branches remember.
    std::optional<bool> remembers_;
    Point before_; ///< the last of the path before
    struct Goal {
        std::optional<double> at{}, load{}, hold{}; ///< Å, eV/Å, fs
    };
    Goal target_; ///< where the next relaxation leads it
};

} // namespace asperity
