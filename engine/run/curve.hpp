// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Numbers of result.json that follow from the series of run.h5.
#pragma once

#include "engine/options/segment.hpp"
#include "io/result.hpp"

#include <vector>

namespace asperity {

/// The series of a run, one value a row.
struct PathSeries {
    std::vector<double> segment; ///< number of the segment
    std::vector<double> time;    ///< ps; empty for a quasi-static path
    std::vector<double> force;   ///< normal force, eV/Å; repulsion is positive
    std::vector<double> contact_fraction;
};
/// Adds the numbers of the last approach and pull-off of a whole path over a sphere to a result:
/// jkr.approach_averaged, jkr.pull_off_averaged and contact_radius.pull_off. edge: edge of the box,
/// Å; radius: radius of the sphere, Å.
void add_sphere_path(const PathSeries& path, const std::vector<Segment>& segments, double edge,
                     double radius, io::Result& result);

} // namespace asperity
