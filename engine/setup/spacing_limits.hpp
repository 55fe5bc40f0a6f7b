// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What the spacing of the sites does not resolve, and how much that matters: the edge of a contact
// over a wall of short range, and waves of a few spacings.
#pragma once

#include "engine/setup/case.hpp"

#include <optional>
#include <string>

namespace asperity {

/// Case::edge_pinning of a scene.
double edge_pinning(const Scene& scene);
/// A sentence with that factor; empty where the spacing resolves the edge.
std::optional<std::string> note_on_contact_edge(const Scene& scene);
/// Pull-off of a sphere with a factor above 1.3, unless interface.edge_pinning allows it.
void refuse_pinned_edge(const Case& c, io::Problems& refused);

/// Energy that it takes to flatten the block against all waves of the surface, over the same with
/// q E*/2 for a wave q: below 1 where they are a few spacings long. Lateral displacements are free.
double lattice_softness(const BlockOptions& block, const SurfaceStatistics& surface);

} // namespace asperity
