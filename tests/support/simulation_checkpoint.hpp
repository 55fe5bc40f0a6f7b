// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Checkpoints of a simulation alone, without the path that drives it.
#pragma once

#include "engine/path/checkpoint.hpp"
#include "support/driven.hpp"

#include <string>
#include <utility>

namespace asperity::test {

inline void write_checkpoint(const std::string& file, Driven& s, CollectNumbers numbers,
                             const std::string& scene) {
    numbers("simulation", s);
    asperity::write_checkpoint(io::FilePlace(file), s.communicator(),
                               std::as_const(s).block().grid(), state_of(std::as_const(s).block()),
                               numbers.numbers, scene);
}

inline StateNumbers read_checkpoint(const std::string& file, Driven& s, const std::string& scene) {
    const auto arrays = [&](const StateNumbers& all) {
        RestoreNumbers numbers(all);
        numbers("simulation", s);
        return state_to_restore(s.block_to_write());
    };
    StateNumbers numbers = asperity::read_checkpoint(
        io::FilePlace(file), s.communicator(), std::as_const(s).block().grid(), arrays, scene);
    s.block_to_write().exchange();
    return numbers;
}

} // namespace asperity::test
