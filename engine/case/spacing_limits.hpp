// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Errors from the spacing of the sites: at the edge of a contact over a wall of short range, and
// for waves a few spacings long.
#pragma once

#include "engine/case/case.hpp"

#include <optional>
#include <string>

namespace asperity {

/// Case::edge_pinning up to which a sphere is pulled off, and errors by the spacing are stated.
constexpr double largest_edge_pinning = 1.3;
/// Computes Case::edge_pinning from the options of block and interface.
double edge_pinning(const Case& c);
/// Returns true if the tension of the wall's law ends suddenly, at its range.
bool tension_ends_suddenly(const Case& c);
/// Returns a note with Case::edge_pinning; nothing if the spacing resolves the edge of the contact.
std::optional<std::string> note_on_contact_edge(const Case& c);
/// Refuses the pull-off of a sphere if Case::edge_pinning exceeds largest_edge_pinning, unless
/// interface.edge_pinning = "allow".
void refuse_pinned_edge(const Case& c, io::Problems& refused);

/// Returns the elastic energy of full contact with the lattice's stiffness, divided by that with
/// the stiffness q E*/2 of a continuum; below 1 if the waves are a few spacings long. Lateral
/// displacements are free.
double lattice_softness(const BlockOptions& block, const SurfaceStatistics& surface);

} // namespace asperity
