// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// All stable states under one load, as far as a path at a prescribed mean height passes them.
//
// The relaxed energy U(z) at mean height z of the lowest layer has the slope -F(z), F being the
// interface's force. A state under the load P is stable with respect to z where F falls through P
// as z grows. Rough surfaces can have several: the outermost is held by the attraction of a few
// summits; further in, more of the surface is in contact.
//
// The search starts in the first state (the one that a slow approach ends in) and goes inwards,
// relaxing at each mean height to ten times the tolerance, and the states to the tolerance. Steps
// are doubled, up to four times the shortest, while the force is predicted to a tenth of its
// distance from P: no crossing is near then. Where F - P changes from attraction to repulsion, the
// block is relaxed with nothing prescribed but the load, and that is a state. Where energy is
// missing between two points (the work of the force against the change of the energy), the surface
// has become unstable and the path is on another branch. From there that branch is followed
// outwards as well, until it joins the branch that the path came on; the states on it are found
// likewise. Then the search goes on inwards. The energy D that is missing is about how far the new
// branch lies below the old one (more where smaller instabilities were below what the search can
// tell). A state on the new branch can be deeper than the deepest point passed only where the old
// branch has come back to within about D of it. Where D is less than three thousandths of the climb
// of U + P z from that point, the branch is not followed: it is taken to end before.
//
// It is assumed that what is in contact pushes the harder the closer it gets, and gets no softer.
// Then the search ends
// - where P is not met again further in: F - P is more than the area not yet in contact can attract
//   with, at the largest tension of flat on flat (in full contact at once), or
// - where no deeper state is further in: F is above P, and for every further approach d, the climb
//   and (F - P) d + K d^2 / 2 are more than can be gained by contact. K is -dF/dz in the last step,
//   none after an instability or where it is negative. A site that is not in contact, at a distance
//   s from the substrate, gains at most the greatest of V(s - d - b) - k b^2 / 2 over b: V is what
//   flat on flat gains at a distance, and to come closer by b than its surroundings the site has to
//   bulge, against the stiffness k of the softest wave at least.
//
// What may be missed: a state whose F crosses P and back within one step; a branch that no
// instability of this path leads to (also a deeper one further out, if its instability is further
// in than the search went), that is not followed, or that ends within one step of it; a state
// further in than the last point that is not the deepest.
#pragma once

#include "engine/equilibrium/continuation.hpp"
#include "engine/equilibrium/force_trail.hpp"
#include "engine/equilibrium/path_results.hpp"

#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace asperity {

/// step: of the mean height, the shortest; load: P.
struct StateSearchOptions : SequenceOptions {
    double area = 0.0;            ///< nominal, Å^2
    double largest_tension = 0.0; ///< of flat on flat, eV/Å^3
    /// Energy of flat on flat over the distance, eV/Å^2; none: a search for all states, deeper or
    /// not.
    std::function<double(double)> flat_energy{};
    double flat_depth = 0.0;   ///< what flat on flat gains at most, eV/Å^2
    double softest_wave = 0.0; ///< of the block (BlockOptions), eV/Å^4
    /// Of the climb: an instability that loses less is not followed outwards.
    double least_loss = 3e-3;
    /// The state under the load, downhill of where the block is; empty where it was stopped.
    std::function<std::optional<ZeroLoad>()> relax_free{};
};

/// As a case has them, for this block over its interface; all three must outlive the search.
StateSearchOptions search_options(const Case& c, SpectralBlock& block, const Interface& interface,
                                  std::function<bool(long long, double)> report = {});

class StateSearch {
public:
    StateSearch(SpectralBlock& block, Interface& interface, StateSearchOptions options);

    /// The block stands in the first state.
    void start(const ZeroLoad& first);

    enum class Outcome { point, done, interrupted };
    /// One more point, and the state found beside it if there is one. Interrupted: block and search
    /// are back at the last point, and the next call makes the whole point again. Collective.
    /// Throws io::PhysicsError where a state is not found to the tolerance.
    Outcome advance();

    /// What was found so far.
    StateList found() const;
    /// The block back in the first state.
    void restore_first();
    long long iterations() const { return points_.iterations(); }
    /// U + P z of the last point above the deepest point passed, eV.
    double climb() const;

    /// For checkpoints, as of a QuasistaticPath: all numbers, and the displacements.
    template <class Visitor>
    void visit(Visitor& v);
    std::vector<StateArray> states();
    void resume() { points_.put_back(); }

private:
    struct Point {
        double height = 0.0; ///< displacement of the mean height, Å
        double force = 0.0;  ///< F, eV/Å
        double energy = 0.0; ///< U, eV
        double contact = 0.0;
        int branch = 0; ///< 0: passed inwards; n: outwards, after the n-th instability
        template <class Visitor>
        void visit(Visitor& v) {
            v("height", height);
            v("force", force);
            v("energy", energy);
            v("contact", contact);
            v("branch", branch);
        }
    };
    struct Found {
        ZeroLoad state;
        int branch = 0;
        template <class Visitor>
        void visit(Visitor& v) {
            v("state", state);
            v("branch", branch);
        }
    };

    Point point(const RelaxedState& state, double height) const;
    double missing(const Point& to) const;
    bool relax_state(const Point& to, bool smooth);
    void add(const ZeroLoad& state);
    void turn_outwards();
    void turn_inwards();
    bool joined() const;
    StateList::End end();
    bool none_deeper_further_in();
    std::vector<std::int64_t> sites_by_distance();
    void tabulate_gain();
    double next_height() const;
    double inner_end(int branch) const;
    std::optional<double> largest_force(const Found& from, const Found& to) const;
    double accuracy() const { return options_.tolerance * sites_ * options_.step; } ///< eV

    SpectralBlock& block_;
    const Interface& interface_;
    StateSearchOptions options_;
    double sites_ = 0.0; ///< N^2
    Continuation points_;
    StateCopy first_, turn_; ///< displacements: first state, and where the search turned outwards
    double first_top_ = 0.0; ///< displacement of the top plane in the first state, Å
    Point now_, turned_at_;
    ForceTrail trail_, turned_trail_; ///< turned_trail_: as if there had been no instability
    bool smooth_ = false;             ///< the last step: good for a prediction
    bool outwards_ = false;
    static constexpr double bin = 0.5; ///< of distances, Å
    static constexpr int bins = 512;
    /// Made when they are first asked for: heights that distances count from, Å, and what a site
    /// can gain by contact, by its distance now, eV.
    std::vector<double> below_, gain_;
    int stride_ = 1; ///< of the next step inwards, in shortest steps
    long long instabilities_ = 0, outward_points_ = 0; ///< the latter since the last turn
    std::vector<Point> passed_;
    std::vector<Found> found_;
    StateList::End end_ = StateList::End::none;
};

template <class Visitor>
void StateSearch::visit(Visitor& v) {
    v("points", points_);
    v("first_top", first_top_);
    v("now", now_);
    v("turned_at", turned_at_);
    v("trail", trail_);
    v("turned_trail", turned_trail_);
    v("smooth", smooth_);
    v("outwards", outwards_);
    v("stride", stride_);
    v("instabilities", instabilities_);
    v("outward_points", outward_points_);
    v("passed", passed_);
    v("found", found_);
    v("end", end_);
}

} // namespace asperity
