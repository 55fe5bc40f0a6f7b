// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Parts of resolve(). Each uses the members of the case that are already filled in.
#pragma once

#include "engine/case/case.hpp"
#include "engine/scene/scene_files.hpp"

#include <optional>

namespace asperity {

/// Fills in the types and the potentials of simulation.interface from interface.potential and
/// interface.pairs. Adds mistakes to problems.
void find_potentials(Case& c, io::Problems& problems);
/// Compares the errors of tabulated potentials with the work of adhesion. Fills in table_error and
/// adds notes. Returns false, with problems, if a table is too coarse or too noisy.
bool check_tables(Case& c, io::Problems& problems);
/// Fills in the scales except the stiffness, and the tolerance. smallest_tension: largest tension
/// of the least attractive type of atoms, GPa; 0 without attraction.
void find_scales(Case& c, double smallest_tension);
/// Adds contradictions between keys to problems.
void check_keys(const Case& c, io::Problems& problems);
/// Returns the reasons why the scene cannot run on a device.
std::vector<io::Problem> device_problems(const Case& c);
/// Adds to refused the keys that this release reads but does not support.
void refuse_unsupported(const Case& c, io::Problems& refused);
/// Adds to refused the loads under which the whole surface would yield.
void refuse_above_hardness(const Case& c, io::Problems& refused);
/// Adds to refused the values that are out of proportion with the box, the block or the step, and
/// to notes those that are nearly so.
void refuse_out_of_proportion(const Case& c, io::Problems& refused,
                              std::vector<std::string>& notes);
/// Returns the problem with a load, MPa, under which linear elasticity has no meaning; `where` is
/// empty.
std::optional<io::Problem> load_out_of_proportion(const Case& c, double megapascal);
/// Returns the problem with a way of a quasi-static path, Å, that takes more points than a run can
/// make; `where` is empty.
std::optional<io::Problem> way_out_of_proportion(const Case& c, double way);
/// Fills in the softness of the box, after the flat reference.
void find_softness(Case& c);
/// Returns the fraction of the work of adhesion that flat surfaces lose in a cycle at a prescribed
/// mean height, in a box of this softness.
double loss_of_flat(double softness);
/// Returns a note on works that are those of the box; empty if they are not.
std::optional<std::string> note_on_soft_box(const Case& c);
/// Returns notes on the keys (a block thinner than wide, keys without effect), one sentence each.
std::vector<std::string> notes_on_keys(const Case& c);
/// Returns notes on limits of validity (roughness, velocity, time step), one sentence each.
std::vector<std::string> notes_on_validity(const Case& c);

} // namespace asperity
