// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The last point of a sequence of equilibria along a prescribed coordinate (the top plane or the
// mean height of the lowest layer; or, at a fixed one of these, the place of the block over the
// substrate along x or y), and the relaxation from it to the next one.
#pragma once

#include "decomposition/global_largest.hpp"
#include "engine/equilibrium/relaxation.hpp"
#include "engine/equilibrium/state_array.hpp"

#include <array>
#include <cmath>
#include <functional>
#include <vector>

namespace asperity {

class LastPoint {
public:
    struct Options {
        Constraint::Of along = Constraint::Of::top;
        double tolerance = 0.0; ///< of the first point, eV/Å
        Scales scales;
        double reference_height = 0.0; ///< z of the undisplaced lowest layer, Å
    };
    LastPoint(SpectralBlock& block, Interface& interface, const Options& options)
        : block_(block), interface_(interface), options_(options) {}

    /// The place along x or y, or what is prescribed along z, the others staying where they are; or
    /// the way that what is held would go in the time that passes (block_memory.hpp).
    enum class Along { x, y, z, time };
    /// From now on this coordinate changes. Returns where it stands.
    double lead(Along along);
    double at() const { return at_; }
    /// What the sum of the residual forces of a point may be from now on, eV/Å (RelaxOptions).
    void balance_to(double balance) { balance_ = balance; }

    /// Sets the largest residual force of points from now on, eV/Å.
    void relax_to(double tolerance) { options_.tolerance = tolerance; }
    double tolerance() const { return options_.tolerance; }

    /// The block as it is becomes the last point.
    void accept(double at);
    /// Puts the block back to the last point, from wherever it was taken.
    void put_back();
    /// Relaxes from the last point with the coordinate there, dt later (fs; infinite: at rest);
    /// report and window as in RelaxOptions. Collective.
    using Report = std::function<bool(long long, double)>;
    RelaxedState relax_at(double at, double dt, const Report& report,
                          const ForceWindow& window = {});

    long long iterations() const { return iterations_; }
    void set_iterations(long long iterations) { iterations_ = iterations; }
    /// How far a site of the lowest layer has moved since the last point, Å.
    std::function<double(int, int)> moves() const;
    /// The site that has moved most. Collective.
    LargestSite largest_move() const {
        return global_largest(block_.communicator(), interface_.tile(), moves());
    }

    /// For checkpoints: numbers, and what a state is made of, to be read before put_back().
    template <class Visitor>
    void visit(Visitor& v) {
        v("at", at_);
        v("along", along_);
        v("normal", normal_);
        v("place", place_);
        v("clock", clock_);
        v("iterations", iterations_);
        v("balance", balance_);
    }
    std::vector<StateArray> states();

private:
    /// Along z, with the coordinate there.
    Constraint constraint(double at) const {
        return {options_.along, along_ == Along::z ? at : normal_};
    }
    void place_block(double at);

    SpectralBlock& block_;
    Interface& interface_;
    Options options_;
    Phases phases_; ///< of the relaxations; their lines are not lines of the step
    StateCopy state_;
    double at_ = 0.0;
    Along along_ = Along::z;
    double balance_ = HUGE_VAL;     ///< eV/Å
    double normal_ = 0.0;           ///< along z, Å
    double clock_ = 0.0;            ///< along time, Å
    std::array<double, 2> place_{}; ///< of the block over the substrate, Å
    long long iterations_ = 0;
};

} // namespace asperity
