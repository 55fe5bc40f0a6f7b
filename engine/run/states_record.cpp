// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/run/states_record.hpp"

#include "engine/units.hpp"

#include <fmt/format.h>

#include <string>
#include <utility>

namespace asperity {

namespace {

double megapascals(double barrier) { return barrier / units::megapascal; }

io::JsonValue state_json(const StateList::State& state) {
    const ZeroLoad& z = state.numbers;
    io::JsonValue s = io::JsonValue::object();
    s["binding_energy"] = z.binding_energy;
    s["contact_fraction"] = z.contact_fraction;
    s["pushed_fraction"] = z.pushed_fraction;
    s["mean_height"] = z.mean_height;
    s["elastic_energy"] = z.elastic;
    s["barrier"] = io::JsonValue();
    if (state.barrier) s["barrier"] = megapascals(*state.barrier);
    return s;
}

std::string what_is_missed(const StateList& states) {
    return fmt::format(
        "states whose force crosses the load and back within one step ({:.4g} Å of "
        "the mean height near a crossing), and branches that no instability of the path leads to",
        states.step);
}

} // namespace

io::JsonValue states_json(const StateList& states) {
    io::JsonValue all = io::JsonValue::object();
    all["first"] = state_json(states.all.front());
    all["deepest"] = state_json(states.deepest());
    all["all"] = io::JsonValue::array();
    for (const StateList::State& state : states.all)
        all["all"].push_back(state_json(state));
    io::JsonValue search = io::JsonValue::object();
    search["step"] = states.step;
    search["points"] = states.points;
    search["instabilities"] = states.instabilities;
    search["innermost"] = states.innermost;
    search["ended"] = states.end == StateList::End::contact          ? "no area left to attract"
                      : states.end == StateList::End::no_equilibrium ? "no equilibrium"
                                                                     : "stopped";
    search["may_miss"] = what_is_missed(states);
    all["search"] = std::move(search);
    return all;
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
