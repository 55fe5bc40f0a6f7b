// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/run/run.hpp"

#include "engine/run/plan.hpp"
#include "engine/run/run_session.hpp"

namespace asperity {

int run(const Case& c, const RunOptions& options, const Communicator& communicator) {
    c.require_runnable();
    require_memory(c, communicator);
    return c.in_time ? run_in_time(c, options, communicator)
                     : run_equilibrium(c, options, communicator);
}

} // namespace asperity
