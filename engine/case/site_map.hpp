// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Maps of the sites: a number for each site, from a file or a formula. Lengths are those of the
// box; a pattern repeats with it, so its period is rounded to a whole part of the edge.
//
//     stripes LOW HIGH PERIOD         half a period of each along x
//     discs LOW HIGH RADIUS DISTANCE  discs of HIGH on a square lattice, LOW between them
//     rings MEAN AMPLITUDE PERIOD     MEAN (1 + AMPLITUDE cos(2 pi r / PERIOD)), r from the middle
//                                     of the box, where the cap of surface.radius has its apex
//     patches LOW HIGH LENGTH SEED    HIGH at half of the sites: where a Gaussian random field of
//                                     autocorrelation exp(-r^2 / LENGTH^2) exceeds its median
#pragma once

#include "engine/case/case.hpp"

#include <memory>

namespace asperity {

/// Reads or computes a map of the sites that the scene has, in bands on the ranks of `world`, of
/// which the root reads the file, and adds its notes to the case. Returns null, with the mistakes
/// in problems, if it has some. Collective.
std::shared_ptr<const SiteMap> site_map(Case& c, const io::SiteQuantity& of,
                                        const Communicator& world, io::Problems& problems);

} // namespace asperity
