// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The last point of a sequence of equilibria along a prescribed coordinate (the top plane or the
// mean height of the lowest layer; or, with one of these fixed, the place of the block over the
// substrate along x or y, or time), and the relaxation from it to the next one.
#pragma once

#include "decomposition/global_largest.hpp"
#include "engine/statics/relaxation.hpp"
#include "engine/statics/state_array.hpp"
#include "engine/units.hpp"

#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <vector>

namespace asperity {

/// The last point of a quasi-static path.
class LastPoint {
public:
    /// Options of a sequence of equilibria.
    struct Options {
        Constraint::Of along = Constraint::Of::top; ///< quantity prescribed along z
        double tolerance = 0.0;                     ///< tolerance of the first point, eV/Å
        Scales scales;
    };
    /// Keeps references to block and interface.
    LastPoint(SpectralBlock& block, Interface& interface, const Options& options)
        : block_(block), interface_(interface), options_(options) {}

    /// Coordinate of the path: the place along x or y; the prescribed quantity along z, with the
    /// place fixed; or time at a fixed place and prescribed quantity, expressed as the distance
    /// that the drive would move in that time, Å (block_memory.hpp).
    enum class Along { x, y, z, time };
    /// Selects the coordinate that changes from now on. Returns the value of this coordinate, Å.
    double select(Along along);
    /// Returns the coordinate of the last point, Å.
    double at() const { return at_; }
    /// Prescribes a load along z, eV/Å, from now on; without a load prescribes the quantity at its
    /// present value again. The coordinate must be the place or time.
    void prescribe_load(std::optional<double> load) { load_ = load; }
    /// Sets the largest sum of the residual forces of a point from now on, eV/Å (RelaxOptions).
    void balance_to(double balance) { balance_ = balance; }

    /// Sets the largest residual force of points from now on, eV/Å.
    void relax_to(double tolerance) { options_.tolerance = tolerance; }
    double tolerance() const { return options_.tolerance; }

    /// Makes the present state of the block the last point. at: its coordinate, Å.
    void accept(double at);
    /// Returns the sum of the displacements of the sites of the lowest layer since the last point,
    /// Å. Collective.
    double all_moves() const;
    /// Puts the block back to the last point.
    void put_back();
    /// Called with iteration and largest residual force, eV/Å. Returns true to stop.
    using Report = std::function<bool(long long, double)>;
    /// Relaxes from the last point to the coordinate `at`, Å, over a time step dt, fs (infinite:
    /// the branches relax completely). The time step continues the one before unless turn() was
    /// called in between. report, window: as in RelaxOptions. Collective.
    RelaxedState relax_at(double at, double dt, const Report& report,
                          const ForceWindow& window = {});

    /// Brings a viscoelastic block at the last point, with its branches, into the shape in which it
    /// slides steadily, without a time step (moving_pattern.hpp); the iteration may end before the
    /// shape is exact. velocity: velocity along the coordinate (x or y), Å/fs, with sign. The
    /// caller then calls accept(), unless the relaxation was interrupted. Collective.
    RelaxedState settle(double velocity, const Report& report);
    /// Notes that the displacements have changed direction: the next time step does not continue
    /// the last one.
    void turn() { last_dt_ = units::forever; }
    /// Returns the length of the time step that the next one continues, fs; infinite if it
    /// continues none.
    double last_dt() const { return last_dt_; }

    /// Returns the number of iterations of all relaxations so far.
    long long iterations() const { return iterations_; }
    void set_iterations(long long iterations) { iterations_ = iterations; }
    /// Returns a function of (x, y): the distance that a site of the lowest layer has moved since
    /// the last point, Å; zero for sites beside the substrate.
    std::function<double(int, int)> moves() const;
    /// Returns the site that has moved furthest since the last point. Collective.
    LargestSite largest_move() const {
        return global_largest(block_.communicator(), interface_.tile(), moves());
    }
    /// Returns the number of sites that have moved more than half as far. Collective.
    std::int64_t sites_moved() const;

    /// Passes the numbers to a visitor, for checkpoints.
    template <class Visitor>
    void visit(Visitor& v) {
        v("at", at_);
        v("along", along_);
        v("normal", normal_);
        v("load", load_);
        v("place", place_);
        v("clock", clock_);
        v("iterations", iterations_);
        v("balance", balance_);
        v("last_dt", last_dt_);
    }
    /// Returns the arrays of the last point to be written.
    std::vector<StateArray> arrays() const;
    /// Returns the arrays of the last point to be read; the caller then calls put_back().
    std::vector<RestoredArray> arrays_to_restore();

private:
    /// Returns the constraint along z with the coordinate at this value.
    Constraint constraint(double at) const {
        if (load_ && options_.along == Constraint::Of::top) return Constraint::load(*load_);
        if (load_) return Constraint::load_without_stretch(*load_);
        return {options_.along, along_ == Along::z ? at : normal_};
    }
    std::vector<RestoredArray> arrays_of_memories() const;
    void place_block(double at);
    RelaxOptions relax_options(const Report& report) const;

    SpectralBlock& block_;
    Interface& interface_;
    Options options_;
    Phases phases_; ///< clocks of the relaxations, apart from those of the step
    StateCopy state_;
    double at_ = 0.0;
    Along along_ = Along::z;
    double balance_ = HUGE_VAL;     ///< eV/Å
    double normal_ = 0.0;           ///< prescribed value along z, Å
    std::optional<double> load_;    ///< load held instead of normal_, eV/Å
    double clock_ = 0.0;            ///< coordinate along time, Å
    std::array<double, 2> place_{}; ///< place of the block over the substrate, Å
    long long iterations_ = 0;
    double dt_ = units::forever;      ///< length of the step under way, fs
    double last_dt_ = units::forever; ///< length of the step that this one continues, fs
};

} // namespace asperity
