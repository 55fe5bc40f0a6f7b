// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// From a scene, in the units of the scene file, to what the engine computes with (Å, eV, fs).
//
// Everything that can be known to be wrong before the first step is found here.
#pragma once

#include "engine/block/flat_reference.hpp"
#include "engine/dynamics/simulation.hpp"
#include "engine/scene/scene.hpp"
#include "engine/scene/surface.hpp"
#include "engine/setup/effects.hpp"

#include <cmath>
#include <string>
#include <vector>

namespace asperity {

/// The substrate that the scene describes. Throws io::SceneError (options, map contents) or
/// io::FileError (file).
Surface scene_surface(const Scene& scene, const Communicator& ranks = Communicator());

/// The scene's interface: its pairs, or its wall.
InterfaceOptions interface_options(const Scene& scene);

/// What the numbers of the scene mean for the engine, before anything is allocated.
struct Setup {
    Effects effects; ///< that the scene calls for; what follows is built from it
    SimulationOptions simulation;
    FlatReference flat; ///< flat on flat, same cutoff and lattices
    /// Bounds: of that, and of flat layers of each type of atoms (interface.pairs).
    double site_stiffness = 0.0;    ///< eV/Å^2
    double largest_tension = 0.0;   ///< GPa
    double longest_step = HUGE_VAL; ///< of a path without time, Å: half the potential's width
    double longest_timestep = 0.0;  ///< stability limit 2/omega_max at the bottom of the well, fs
    std::vector<LevelShape> levels;
    std::vector<std::string> notes; ///< worth knowing, not wrong
};
/// Throws io::SceneError with all that is wrong, for this number of ranks.
Setup make_setup(const Scene& scene, int ranks);
/// How the scene's box is cut: slabs of rows without time, tiles in time. Throws
/// std::invalid_argument if it cannot be.
ProcessGrid make_grid(const Scene& scene, const Setup& setup, int ranks, int rank);

/// Everything that a run would refuse, found without running: contradictions, what is not available
/// yet, stability, ranks, the map. Throws io::SceneError with all of it. The notes are those of the
/// surface too. Collective over the world, whose root reads the map.
Setup examine(const Scene& scene, int ranks, const Communicator& world = Communicator());

} // namespace asperity
