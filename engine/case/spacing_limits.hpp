// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Limits of the spacing of the sites, and their importance: the edge of a contact over a wall of
// short range, and waves of a few spacings.
#pragma once

#include "engine/case/case.hpp"

#include <optional>
#include <string>

namespace asperity {

/// Returns Case::edge_pinning of a case whose options of the block are known.
double edge_pinning(const Case& c);
/// Returns a sentence with that factor; nothing if the spacing resolves the edge.
std::optional<std::string> note_on_contact_edge(const Case& c);
/// Refuses the pull-off of a sphere with a factor above 1.3, unless interface.edge_pinning allows
/// it.
void refuse_pinned_edge(const Case& c, io::Problems& refused);

/// Returns the energy to flatten the block against all waves of the surface, over the same energy
/// with q E*/2 for a wave q: below 1 if the waves are a few spacings long. Lateral displacements
/// are free.
double lattice_softness(const BlockOptions& block, const SurfaceStatistics& surface);

} // namespace asperity
