// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/run/run.hpp"

#include "engine/run/run_session.hpp"
#include "engine/setup/effects.hpp"
#include "engine/setup/memory.hpp"
#include "io/error.hpp"

#include <omp.h>

namespace asperity {

int run(const Scene& scene, const RunOptions& options, const Communicator& communicator) {
    io::Problems problems = scene.problems();
    not_yet(scene, problems);
    problems.throw_if_any();
    require_memory(scene, communicator, omp_get_max_threads());
    return Effects(scene).on(Effect::inertia) ? run_in_time(scene, options, communicator)
                                              : run_equilibrium(scene, options, communicator);
}

} // namespace asperity
