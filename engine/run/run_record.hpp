// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What every run puts into result.json, whether it moved in time or looked for an equilibrium.
#pragma once

#include "engine/equilibrium/findings.hpp"
#include "engine/setup/setup.hpp"
#include "io/result.hpp"

namespace asperity {

/// The scene, its surface, its effects, what was found, theory, ranks and threads; without times
/// and energies of a path.
io::ResultRecord run_record(const Scene& scene, const Surface& surface, const Setup& setup,
                            const Findings& findings, int ranks);

void add_phases(const Phases& phases, io::ResultRecord& record);

} // namespace asperity
