// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Checkpoints of a simulation alone, without the path that drives it.
#pragma once

#include "engine/dynamics/simulation.hpp"
#include "engine/path/checkpoint.hpp"

#include <string>
#include <utility>

namespace asperity::test {

inline std::vector<StateArray> arrays_of(const Simulation& s) {
    return state_of(const_cast<Block&>(s.block()));
}

inline void write_checkpoint(const std::string& file, Simulation& s, CollectNumbers numbers,
                             const std::string& scene) {
    numbers("simulation", s);
    asperity::write_checkpoint(io::FilePlace(file), s.communicator(),
                               std::as_const(s).block().grid(), arrays_of(s), numbers.numbers,
                               scene);
}

inline StateNumbers read_checkpoint(const std::string& file, Simulation& s,
                                    const std::string& scene) {
    const auto arrays = [&](const StateNumbers& all) {
        RestoreNumbers numbers(all);
        numbers("simulation", s);
        return arrays_of(s);
    };
    StateNumbers numbers = asperity::read_checkpoint(
        io::FilePlace(file), s.communicator(), std::as_const(s).block().grid(), arrays, scene);
    s.block_to_write().exchange();
    return numbers;
}

} // namespace asperity::test
