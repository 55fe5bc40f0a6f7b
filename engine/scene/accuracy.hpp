// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// numerics.accuracy: the cheapest settings that keep an error, by a calibration that `asperity
// cost` has made (accuracy_table.hpp).
//
// Chosen are the time step, the layers a level and the precision of the pairs, each only where the
// scene leaves it open. What makes another solid or another
// experiment is never touched: interaction (cutoff and tail too), thickness, velocity, damping.
#pragma once

#include "engine/scene/scene.hpp"

#include <optional>

namespace asperity {

/// Sets what is chosen and scene.choice. Adds a problem where the calibration does not cover the
/// scene or the target. Nothing is done without numerics.accuracy.
void choose_accuracy(Scene& scene, io::Problems& problems);

/// What was chosen, as lines for the terminal.
std::vector<std::string> accuracy_lines(const AccuracyChoice& choice);

/// A time step that would do as well.
struct LongerStep {
    double timestep; ///< fs
    double error;    ///< largest relative error that it made in the calibration
};
/// The longest calibrated one, for a scene in time that the calibration covers and that takes less
/// than half of it. None: there is nothing to gain, or nothing is known.
std::optional<LongerStep> longer_timestep(const Scene& scene);

/// Elastic energy of full contact with a self-affine surface, meV/Å²: (E*/4) <q h²>, the spectrum
/// up to the grid's Nyquist wavevector. What adhesion has to pay, and the measure of how rough is
/// rough.
double bending_energy(const Scene& scene);

} // namespace asperity
