// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What a smooth sphere in the place of a curved scene's substrate would do: JKR for a single
// contact, JKR and Maugis-Dugdale with the periodic images (theory/periodic_sphere.hpp). Maugis'
// stress is the largest tension of flat on c.flat. Of a rough sphere also Maugis-Dugdale with the
// work of adhesion, the largest tension and the separation of the renormalised theory.
#pragma once

#include "engine/run/renormalised_case.hpp"
#include "engine/setup/case.hpp"
#include "io/hdf5_file.hpp"
#include "io/result.hpp"

#include <optional>
#include <string>
#include <vector>

namespace asperity {

/// Pull-off forces of the smooth sphere as works of adhesion by JKR (sphere.*), jkr.zero_load and
/// contact_radius.zero_load; nothing for a scene without curvature. After the theory, whose
/// numbers in the result it uses.
void add_sphere(const Case& c, io::Result& result);

/// Force against mean height by one of the theories.
struct SphereCurve {
    std::string name;           ///< "jkr", "jkr_images", "maugis_images", "renormalised"
    std::string label;          ///< for a legend
    std::vector<double> height; ///< mean height above the apex, Å
    std::vector<double> force;  ///< eV/Å; repulsion is positive
};
/// Up to the contact radius at which JKR's force is a tenth above this one (eV/Å), the largest of a
/// run. rough: what the renormalised theory says of the roughness, if there is any.
std::vector<SphereCurve>
sphere_curves(const Case& c, const std::optional<RenormalisedNumbers>& rough, double largest_force);

/// What the renormalised theory says of a rough sphere's interface; none where the scene has no
/// curvature or no roughness, leaves the theory out, or nothing binds.
std::optional<RenormalisedNumbers> rough_sphere(const Case& c, const Surface& surface);

/// For a run.h5 of a curved scene that holds a path: the curves into /curves.
void write_sphere_curves(io::Hdf5File& file, const Case& c,
                         const std::optional<RenormalisedNumbers>& rough);

} // namespace asperity
