// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// `asperity plan`: what a scene will simulate and what not, and what it will cost, before it is
// run.
//
// Memory and speed are rehearsed on small pieces of the scene (rehearsal.hpp); how many steps or
// points a run takes follows from the path. Numbers that are not known beforehand (instabilities,
// iterations of a path) are typical ones and are called that.
#pragma once

#include "engine/run/rehearsal.hpp"
#include "engine/setup/case.hpp"

#include <array>
#include <cstdio>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

namespace asperity {

/// What the top plane does along a path, as far as it is known beforehand.
struct ExpectedPath {
    std::vector<double> ways; ///< of each segment: how far it moves, or the block over the
                              ///< substrate, Å
    double deepest = 0.0;     ///< below the start, Å
    double free = 0.0;        ///< of all ways: approaches and pull-offs, which begin or end out of
                              ///< reach, Å
    double at_rest = 0.0;     ///< time of holds, fs
    double turns = 0.0;       ///< time of the ramps after the first segment, fs

    double way() const { return std::accumulate(ways.begin(), ways.end(), 0.0); }
};
/// start: height of the lowest layer at the start, Å.
ExpectedPath expected_path(const Case& c, double start);
/// Time steps of this path, at most the scene's drive.max_steps. 0 where no time passes.
long long expected_steps(const Case& c, double start);

struct Cost {
    double bytes = 0.0;   ///< at most at once, on all ranks
    double seconds = 0.0; ///< of wall time, without messages between machines
};

struct Plan {
    int threads = 1;          ///< of a rank
    long long steps = 0;      ///< expected
    long long iterations = 0; ///< expected, of relaxations
    bool typical = false;     ///< iterations are typical ones; else those of a smaller piece
    bool state_ended = true;  ///< there, within the time for a rehearsal
    Cost making;              ///< surface, tables
    Cost block;               ///< and its steps, with the interface's forces
    Cost snapshots; ///< of the energy guard, with the rows of the series; points of a path
    Cost state;     ///< relaxations
    Cost maps, checkpoints;
    Cost whole;
    double start = 0.0; ///< height of the lowest layer at the start, Å
    std::string rates;  ///< where times come from, in words
};

/// threads: of a rank.
Plan make_plan(const Case& c, int threads);
void print_plan(std::FILE* to, const Case& c, const Plan& plan);

} // namespace asperity
