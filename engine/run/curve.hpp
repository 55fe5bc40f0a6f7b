// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What the series of run.h5 say about a path, as numbers for result.json.
#pragma once

#include "engine/scene/scene.hpp"
#include "engine/scene/segment.hpp"
#include "io/result.hpp"

#include <vector>

namespace asperity {

/// The series of a run, a value a row.
struct PathSeries {
    std::vector<double> segment; ///< number of it
    std::vector<double> time;    ///< ps; empty for a quasi-static path
    std::vector<double> force;   ///< eV/Å, positive pushes
    std::vector<double> contact_fraction;
};
/// What the last approach and pull-off of a whole path over a sphere add to a result:
/// jkr.approach_averaged, jkr.pull_off_averaged and contact_radius.pull_off.
void add_sphere_path(const PathSeries& path, const std::vector<Segment>& segments,
                     const Scene& scene, io::Result& result);

} // namespace asperity
