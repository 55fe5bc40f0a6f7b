// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A sequence of equilibria along a prescribed coordinate (the top plane or the mean height of the
// lowest layer; or, at a fixed one of these, the place of the block over the substrate along x or
// y): the last two points, and the relaxation to the next one, from the last point or from the
// linear continuation of the last two.
//
// A prediction could carry a site across a barrier, even through the substrate: none is made where
// it would move a site further than a part of the range of the interface.
#pragma once

#include "decomposition/global_largest.hpp"
#include "engine/equilibrium/zero_load.hpp"

#include <array>
#include <cmath>
#include <functional>
#include <vector>

namespace asperity {

/// Of what follows such a sequence.
struct SequenceOptions {
    double step = 0.25;     ///< of the prescribed coordinate, Å
    double tolerance = 0.0; ///< eV/Å
    Scales scales;
    double load = 0.0;             ///< eV/Å
    double reference_height = 0.0; ///< z of the undisplaced lowest layer, Å
    /// Called during relaxations with their iteration and residual. True: stop.
    std::function<bool(long long, double)> report;
};

/// As a case has them, over its interface; report: as above.
SequenceOptions sequence_options(const Case& c, const Interface& interface,
                                 std::function<bool(long long, double)> report = {});

class Continuation {
public:
    struct Options {
        Constraint::Of along = Constraint::Of::top;
        double tolerance = 0.0; ///< of points, eV/Å
        Scales scales;
        double reference_height = 0.0; ///< z of the undisplaced lowest layer, Å
    };
    Continuation(SpectralBlock& block, Interface& interface, const Options& options)
        : block_(block), interface_(interface), options_(options) {}

    /// What is prescribed along z, or the place along x or y at a fixed one.
    enum class Along { x, y, z };
    /// From now on this coordinate changes. Returns where it stands.
    double lead(Along along);
    /// What the sum of the residual forces of a point may be from now on, eV/Å (RelaxOptions).
    void balance_to(double balance) { balance_ = balance; }

    /// The block as it is becomes the last point, the only one known.
    void begin(double at);
    /// The block as it is becomes the last point, at the same coordinate.
    void replace() { last_.take(state_of(block_)); }
    /// The block as it is becomes the next point.
    void accept(double at);
    /// Puts the block back to the last point, from wherever it was taken.
    void put_back();

    /// Whether a prediction is possible.
    bool predicts(double at) const;
    /// Relaxes from the last point with the coordinate there, or from the prediction, which must be
    /// possible: that may end without an equilibrium where none is close. report and window as in
    /// RelaxOptions. Collective.
    using Report = std::function<bool(long long, double)>;
    RelaxedState relax_at(double at, bool predicted, const Report& report,
                          const ForceWindow& window = {});

    /// Along z, with the coordinate there.
    Constraint constraint(double at) const {
        return {options_.along, along_ == Along::z ? at : normal_};
    }
    long long iterations() const { return iterations_; }
    void set_iterations(long long iterations) { iterations_ = iterations; }
    /// How far a site of the lowest layer has moved since the last point, Å.
    std::function<double(int, int)> moves() const;
    /// The site that has moved most. Collective.
    LargestSite largest_move() const {
        return global_largest(block_.communicator(), interface_.tile(), moves());
    }

    /// For checkpoints: numbers, and the displacements at both points, to be read before resume().
    template <class Visitor>
    void visit(Visitor& v) {
        v("at", at_);
        v("before", before_at_);
        v("moved", moved_);
        v("along", along_);
        v("normal", normal_);
        v("place", place_);
        v("iterations", iterations_);
        v("balance", balance_);
    }
    std::vector<StateArray> states();

private:
    void place_block(double at);

    SpectralBlock& block_;
    Interface& interface_;
    Options options_;
    Phases phases_; ///< of the relaxations; their lines are not lines of the step
    StateCopy last_, before_;
    double at_ = 0.0, before_at_ = 0.0;
    Along along_ = Along::z;
    double balance_ = HUGE_VAL;     ///< eV/Å
    double normal_ = 0.0;           ///< of the last point along z, Å
    std::array<double, 2> place_{}; ///< of the block over the substrate at the last point, Å
    double moved_ = 0.0;            ///< from before_ to last_, the site that moved most, Å
    long long iterations_ = 0;
};

} // namespace asperity
