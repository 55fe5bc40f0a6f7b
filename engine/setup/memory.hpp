// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The memory that a scene takes, counted from its sizes before anything is allocated, and compared
// with what the machine has. tests/engine/memory_test.cpp holds the counts against the objects.
#pragma once

#include "engine/setup/setup.hpp"

namespace asperity {

/// Bytes of one rank, or of several added up.
struct MemoryNeed {
    double making = 0.0;     ///< while the surface is made, then given back
    double surface = 0.0;    ///< its heights
    double interface = 0.0;  ///< the interface's own heights, rings and tail
    double block = 0.0;      ///< displacements and forces; without time S(q) too
    double motion = 0.0;     ///< velocities
    double snapshot = 0.0;   ///< of the energy guard; points of a path, or of a search, kept
    double relaxation = 0.0; ///< what relaxing takes beside the block; in time the root alone
    double maps = 0.0;       ///< while maps are written; nothing is relaxed meanwhile
    double finite = 0.0;     ///< finite strain's own arrays
    double absorption = 0.0; ///< absorbing seams' own planes and rows

    /// The most held at once.
    double most() const;
    MemoryNeed& operator+=(const MemoryNeed& other);
};

/// threads: of a rank.
MemoryNeed memory_of_rank(const Scene& scene, const Setup& setup, int ranks, int rank, int threads);
/// Of all ranks together.
MemoryNeed memory_of(const Scene& scene, const Setup& setup, int ranks, int threads);

/// What relaxing a spectral block takes beside it, for a tile of its surface.
std::size_t relaxation_bytes(const Tile& tile, int components, bool wall);

/// Of the device of a rank, where the scene has devices take its steps.
double device_memory_of(const Scene& scene, const Setup& setup, const ProcessGrid& grid);

/// Throws io::SceneError if a run of this scene does not fit into the memory of its machines: the
/// ranks of each machine together are held against what is available there. Collective.
void require_memory(const Scene& scene, const Communicator& ranks, int threads);
/// Throws io::SceneError if making the scene's surface alone does not fit into this machine.
void require_memory_for_surface(const Scene& scene);

} // namespace asperity
