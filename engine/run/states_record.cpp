// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/run/states_record.hpp"

#include "engine/units.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace asperity {

namespace {

double megapascals(double barrier) { return barrier / units::megapascal; }

std::string what_is_missed(const StateList& states) {
    return fmt::format(
        "states whose force crosses the load and back within one step ({:.4g} Å of "
        "the mean height near a crossing), branches that no instability of the path leads to, and "
        "states that pressing the solids together does not lead to",
        states.step);
}

} // namespace

void add_states(const StateList& states, io::Result& result) {
    /// Puts a state's value under the first key as a member, or under the second as an element.
    const auto add = [&](const StateList::State& state, const auto& put) {
        const ZeroLoad& z = state.numbers;
        put("states.*.binding_energy", "states.all[].binding_energy", z.binding_energy);
        put("states.*.contact_fraction", "states.all[].contact_fraction", z.contact_fraction);
        put("states.*.pushed_fraction", "states.all[].pushed_fraction", z.repulsive_fraction);
        put("states.*.mean_height", "states.all[].mean_height", z.mean_height);
        put("states.*.elastic_energy", "states.all[].elastic_energy", z.elastic);
        put("states.*.barrier", "states.all[].barrier",
            state.barrier ? megapascals(*state.barrier) : std::nan("")); // written as null
    };
    const auto add_named = [&](const char* name, const StateList::State& state) {
        add(state, [&](io::Key named, io::Key, double value) { result.set(named, name, value); });
    };
    add_named("first", states.all.front());
    add_named("deepest", states.deepest());
    for (std::size_t i = 0; i < states.all.size(); ++i)
        add(states.all[i],
            [&](io::Key, io::Key listed, double value) { result.set(listed, i, value); });
    result.set("states.search.step", states.step);
    result.set("states.search.points", states.points);
    result.set("states.search.instabilities", states.instabilities);
    result.set("states.search.innermost", states.innermost);
    result.set("states.search.ended",
               states.end == StateList::End::contact          ? "no area left to attract"
               : states.end == StateList::End::no_equilibrium ? "no equilibrium"
                                                              : "stopped");
    result.set("states.search.may_miss", what_is_missed(states));
}

void print_states(std::FILE* to, const StateList& states) {
    const ZeroLoad& deepest = states.deepest().numbers;
    fmt::print(to, "  {} stable state{} passed inwards down to a mean height of {:.2f} Å{}\n",
               states.all.size(), states.all.size() == 1 ? "" : "s", states.innermost,
               states.all.size() == 1 ? "." : ":");
    if (states.all.size() > 1) {
        for (const StateList::State& state : states.all) {
            const ZeroLoad& z = state.numbers;
            fmt::print(to, "    {:8.3f} meV/Å² at {:.2f} Å, contact {:.4f}", z.binding_energy,
                       z.mean_height, z.contact_fraction);
            if (state.barrier)
                fmt::print(to, "; {:.3g} MPa to the next", megapascals(*state.barrier));
            fmt::print(to, "\n");
        }
        fmt::print(to,
                   "  A slow approach ends in the first. The binding energy of the pair of "
                   "surfaces is the deepest's,\n  {:.3f} meV/Å².\n",
                   deepest.binding_energy);
    }
    fmt::print(to, "  May be missed: {}.\n", what_is_missed(states));
}

} // namespace asperity
