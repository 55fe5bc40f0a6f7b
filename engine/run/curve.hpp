// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Force against separation, after a run along a path: what the series of run.h5 say of it, as
// numbers for result.json; and the curves of a smooth sphere beside it, for plots.
//
// Separation is the mean height of the lowest layer above the substrate's zero (the apex, if it is
// curved), so that the rigid shift of the block, which depends on its thickness, is not in it.
// Beside a curved contact stand the curves of a smooth sphere: JKR, and JKR and Maugis-Dugdale with
// the periodic images (theory/periodic_sphere.hpp). Maugis' stress is the largest tension of flat
// on flat.
#pragma once

#include "engine/block/flat_reference.hpp"
#include "engine/scene/scene.hpp"
#include "io/hdf5_file.hpp"
#include "io/result.hpp"

#include <string>
#include <vector>

namespace asperity {

/// The series of a run, a value a row.
struct PathSeries {
    std::vector<double> leg;    ///< 0 approach, 1 pull-off
    std::vector<double> time;   ///< ps; empty for a quasi-static path
    std::vector<double> height; ///< Å
    std::vector<double> force;  ///< eV/Å, positive pushes
    std::vector<double> contact_fraction;
};
/// From run.h5. Throws io::FileError.
PathSeries read_path(const std::string& file);

/// What the path adds to a record:
///   hysteresis.loop      the area of the loop, -∮ F dz, eV: what a cycle turns into heat
///   hysteresis.approach  of it, what the approach fell short of the state at zero load (snap-in)
///   hysteresis.pull_off  and what the pull-off took beyond it (snap-off, local detachment)
///   jkr.in_averaged, out_averaged  from the largest attraction of a running mean over 2 ps,
///   without
///                                  the vibrations that a snap leaves behind, meV/Å² (curved, and
///                                  if output.series gives 4 rows for that)
///   contact_radius.pull_off        √(contact area/π) where the attraction is strongest, Å (curved)
void add_path(const PathSeries& path, const Scene& scene, io::ResultRecord& record);

/// What a smooth sphere would do, in the record of a curved scene: contact_radius.zero_load, and
/// sphere.{jkr, jkr_images, maugis_images}, pull-off forces as works of adhesion by JKR (meV/Å²),
/// sphere.maugis_parameter.
void add_sphere(const Scene& scene, const FlatReference& flat, io::ResultRecord& record);

/// Of a curved scene with a path in this file: what a smooth sphere would do, as /curves/{jkr,
/// jkr_images, maugis_images} of run.h5, each with height (Å, mean height of the lowest layer above
/// the apex) and force (eV/Å, positive presses). Throws io::FileError.
void write_sphere_curves(io::Hdf5File& file, const Scene& scene, const FlatReference& flat);

} // namespace asperity
