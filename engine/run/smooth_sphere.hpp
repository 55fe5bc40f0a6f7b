// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What a smooth sphere in the place of a curved scene's substrate would do: JKR for a single
// contact, JKR and Maugis-Dugdale with the periodic images (theory/periodic_sphere.hpp). Maugis'
// stress is the largest tension of flat on flat.
#pragma once

#include "engine/block/flat_reference.hpp"
#include "engine/scene/scene.hpp"
#include "io/hdf5_file.hpp"
#include "io/result.hpp"

#include <string>
#include <vector>

namespace asperity {

/// Pull-off forces of the smooth sphere as works of adhesion by JKR (sphere.*), and
/// contact_radius.zero_load; nothing for a scene without curvature.
void add_sphere(const Scene& scene, const FlatReference& flat, io::Result& result);

/// Force against mean height by one of the theories.
struct SphereCurve {
    std::string name;           ///< "jkr", "jkr_images", "maugis_images"
    std::string label;          ///< for a legend
    std::vector<double> height; ///< mean height above the apex, Å
    std::vector<double> force;  ///< eV/Å; repulsion is positive
};
/// Up to the contact radius at which JKR's force is a tenth above this one (eV/Å), the largest of a
/// run.
std::vector<SphereCurve> sphere_curves(const Scene& scene, const FlatReference& flat,
                                       double largest_force);

/// For a run.h5 of a curved scene that holds a path: the curves into /curves.
void write_sphere_curves(io::Hdf5File& file, const Scene& scene, const FlatReference& flat);

} // namespace asperity
