// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What a run has found so far: the numbers behind the summary and result.json.
#pragma once

#include "engine/equilibrium/dissipation.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace asperity {

/// Of the relaxed state under zero load.
struct ZeroLoad {
    double binding_energy = 0.0; ///< gamma_state = -(U_LJ + U_el) / A0, meV/Å^2
    double pairwise = 0.0;       ///< -U_LJ / A0: the atom-by-atom work, meV/Å^2
    double elastic = 0.0;        ///< U_el / A0, meV/Å^2
    double contact_fraction = 0.0;
    double repulsive_fraction = 0.0;
    double mean_height = 0.0; ///< of the lowest layer above the substrate's zero, Å
    double residual = 0.0;    ///< largest force left, eV/Å
    long long iterations = 0;
    /// Of the binding energy: what forces as large as drive.tolerance stand for in the softest wave
    /// of the box, meV/Å^2.
    double uncertainty = 0.0;

    template <class Visitor>
    void visit(Visitor& v) {
        v("binding_energy", binding_energy);
        v("pairwise", pairwise);
        v("elastic", elastic);
        v("contact_fraction", contact_fraction);
        v("pushed_fraction", repulsive_fraction);
        v("mean_height", mean_height);
        v("residual", residual);
        v("iterations", iterations);
        v("uncertainty", uncertainty);
    }
};

/// The stable states under one load that a search has passed (state_search.hpp).
struct StateList {
    struct State {
        ZeroLoad numbers;
        /// Largest force on the way to the next state inwards, over the load and the area, eV/Å^3;
        /// empty for the innermost.
        std::optional<double> barrier;
    };
    /// Why the search ended: no area is left to attract, what is left cannot make a deeper state,
    /// or no equilibrium was found further in.
    enum class End { none, contact, energy, no_equilibrium };

    std::vector<State> all; ///< from the outermost inwards
    std::size_t first = 0;  ///< of these, the one that the search started in
    double step = 0.0;      ///< of the mean height, Å
    double innermost = HUGE_VAL;
    long long points = 0, instabilities = 0;
    End end = End::none;

    const State& deepest() const {
        return *std::max_element(all.begin(), all.end(), [](const State& a, const State& b) {
            return a.numbers.binding_energy < b.numbers.binding_energy;
        });
    }
};

/// Energies of an approach or a pull-off that has ended, meV/Å^2. Works are positive where the
/// solids attract: taken up on the way in, given on the way out.
struct LegEnergies {
    /// Of the interface's force on the mean height of the lowest layer, int F dz / A0. Empty at a
    /// held top without time, where the mean height jumps at instabilities.
    std::optional<double> interface_work;
    /// Of what drives or holds the block: the top plane (in time with the medium that damps, which
    /// moves along), or the holder of the mean height.
    std::optional<double> drive_work;
    /// Damped or dissipated, or left in vibrations at the end (in time). Empty with a thermostat,
    /// and in time where the approach ends under a load, so that no state is known there.
    std::optional<double> lost;
    std::optional<double> uncertainty; ///< of each of these; without time only

    template <class Visitor>
    void visit(Visitor& v) {
        v("interface_work", interface_work);
        v("drive_work", drive_work);
        v("lost", lost);
        v("uncertainty", uncertainty);
    }
};

struct Findings {
    std::optional<ZeroLoad> zero_load; ///< where there are several: the first
    std::optional<StateList> states;   ///< where all were asked for
    LegEnergies approach, pull_off;
    std::optional<double> lost_in_cycle;   ///< meV/Å^2
    double attraction_in = 0.0;            ///< largest attraction on the way in, eV/Å
    double attraction_out = 0.0;           ///< on the way out
    std::optional<double> contact_made;    ///< when the approach ended, fs
    std::optional<Dissipation> dissipated; ///< of a quasi-static path (which lists it itself)

    /// For checkpoints; but the states and what was dissipated, which those who find them keep.
    template <class Visitor>
    void visit(Visitor& v) {
        v("approach", approach);
        v("pull_off", pull_off);
        v("lost_in_cycle", lost_in_cycle);
        v("attraction_in", attraction_in);
        v("attraction_out", attraction_out);
        v("contact_made", contact_made);
        v("zero_load", zero_load);
    }
};

} // namespace asperity
