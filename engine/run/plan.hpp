// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// `asperity plan`: what a scene will cost, effect by effect, before it is run.
//
// Memory follows from sizes. Time follows from the work (node-steps, site-steps, iterations) and
// the rates of the real kernels, measured for some 0.3 s on a smaller piece of the scene: the same
// layers, the same interface and a part of the same surface. Numbers that are not known beforehand
// (instabilities, iterations of a relaxation) are typical ones and are called that.
#pragma once

#include "engine/run/plan_rates.hpp"
#include "engine/scene/surface.hpp"
#include "engine/setup/case.hpp"

#include <array>
#include <cstdio>
#include <optional>
#include <string>

namespace asperity {

/// Distances that the top plane moves along a path, as far as they are known beforehand.
struct ExpectedPath {
    double approach = 0.0; ///< from the start to contact, Å
    double pull_off = 0.0; ///< from there until the contact has separated, Å
    double turn = 0.0;     ///< duration of the turn between them, fs
};
/// start: height of the lowest layer at the start, Å.
ExpectedPath expected_path(const Case& c, double start);
/// Time steps of this path, at most the scene's drive.max_steps. 0 where no time passes.
long long expected_steps(const Case& c, double start);

struct EffectCost {
    double bytes = 0.0; ///< on all ranks
    double seconds = 0.0;
};

struct Plan {
    int threads = 1;          ///< of a rank
    long long steps = 0;      ///< expected
    long long iterations = 0; ///< expected, of the relaxation
    std::array<EffectCost, effect_count> costs;
    EffectCost interface; ///< the sweep, without its tail
    EffectCost making;    ///< surface, tables, block
    double bytes = 0.0;   ///< at most held at once, on all ranks
    double seconds = 0.0; ///< expected wall time, without communication between machines
    std::string rates;    ///< where they come from, in words
    const EffectCost& cost(Effect effect) const { return costs[static_cast<std::size_t>(effect)]; }
};

/// threads: of a rank. rates: of a process with omp_get_max_threads() threads; none: measured on
/// this process alone.
Plan make_plan(const Case& c, int threads, const std::optional<Rates>& rates = std::nullopt);
void print_plan(std::FILE* to, const Case& c, const Plan& plan);

} // namespace asperity
