// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Parts of resolve(): each looks at what the case holds so far.
#pragma once

#include "engine/setup/case.hpp"

namespace asperity {

/// interface.potential and interface.pairs: fills in the types and the potentials of
/// simulation.interface.
void find_potentials(Case& c, io::Problems& problems);
/// The file that a key names, beside the scene or in the working directory; empty: there is none.
std::string find_beside_scene(const Scene& scene, const std::string& file, const std::string& key);
/// Compares the errors of tables of potentials with the work of adhesion: fills in table_error, adds
/// notes. Returns false, with problems, if a table is too coarse or too noisy.
bool check_tables(Case& c, io::Problems& problems);
/// Fills in the scales but for the stiffness, and the tolerance; smallest_tension: the largest one
/// of the type of atoms that attracts least, GPa (0: nothing attracts).
void find_scales(Case& c, double smallest_tension);
/// Contradictions between keys.
void check_keys(const Case& c, io::Problems& problems);
/// What keeps the scene from a device.
std::vector<io::Problem> device_problems(const Case& c);
/// What this release reads but cannot act upon yet: refused by a run.
void refuse_what_is_not_there_yet(const Case& c, io::Problems& refused);
/// Values out of proportion with the box, the block or the step: refused by a run.
void refuse_out_of_proportion(const Case& c, io::Problems& refused);
/// What the keys alone tell (a block thinner than wide, keys without effect): one sentence each.
std::vector<std::string> notes_on_keys(const Case& c);
/// Where results mean little: roughness, velocity, time step; one sentence each.
std::vector<std::string> notes_on_validity(const Case& c);

} // namespace asperity
