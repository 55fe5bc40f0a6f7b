// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What every run puts into result.json, whether it moved in time or looked for an equilibrium.
#pragma once

#include "engine/equilibrium/findings.hpp"
#include "engine/setup/effects.hpp"
#include "engine/setup/setup.hpp"
#include "io/result.hpp"

namespace asperity {

/// The scene, its surface, what was found, theory, ranks and threads; without times and energies of
/// a path.
io::ResultRecord run_record(const Scene& scene, const Surface& surface, const Setup& setup,
                            const Findings& findings, int ranks);

/// What both kinds of run count alike: curvature, interface, theory, relaxation.
EffectBooks common_books(const Surface& surface, const Interface& interface,
                         const Findings& findings);
/// Puts planned beside done into the record (run.effects). Returns the differences, which it notes
/// there too.
std::vector<std::string> add_effects(const Effects& planned, EffectBooks done, bool complete,
                                     io::ResultRecord& record);

void add_phases(const Phases& phases, io::ResultRecord& record);

} // namespace asperity
