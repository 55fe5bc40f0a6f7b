// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The natural scales of a quasi-static scene. The force is the smallest on a site that decides the
// state:
//
// - the largest attraction of a site; over several types of atoms, of the one that attracts least;
// - over a block so soft that forces far below the attraction bend it: that which bends its longest
//   wave by an energy of 450 W, W the work of adhesion. The tolerance, squared, is the fraction of
//   that energy which it lets pass: at its default 3e-5 W;
// - without an attraction, the smallest load on a site that the path asks for; without a load, that
//   which displaces the block's longest wave by drive.displacement_step.
//
// A path and a state under a load that presses with more than this on each site take a site's part
// of that load in its place (statics/quasistatic.hpp). Without an attraction no length of the
// interface bounds a move: that is drive.displacement_step, or what the smallest load displaces the
// longest wave by.
#include "engine/case/resolving.hpp"

#include "engine/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace asperity {

namespace {

/// Returns the smallest load that the path asks for, MPa; 0 if there is none.
double smallest_load(const Case& c) {
    double smallest = 0.0;
    const auto consider = [&](double load) {
        const double size = std::abs(load);
        if (size > 0.0 && (smallest == 0.0 || size < smallest)) smallest = size;
    };
    if (c.has(Segment::approach) || c.has(Segment::relax)) consider(c.scene.drive.load);
    for (const Segment& segment : c.path())
        if (segment.kind == Segment::load)
            consider(segment.amount / (units::megapascal * c.area()));
    return smallest;
}

} // namespace

void find_scales(Case& c, double smallest_tension) {
    const BlockOptions& block = c.simulation.block;
    const double area = block.spacing * block.spacing;
    const double softest = block.softest_wave() * area; // stiffness for a site, eV/Å^2
    Scales& scales = c.scales;
    if (smallest_tension > 0.0) {
        constexpr double energy = 450.0; // works of adhesion
        const double work = c.flat.work_of_adhesion / units::milli_per_unit * area;
        const double bends = std::sqrt(2.0 * energy * work * softest);
        scales.force = smallest_tension * units::gigapascal * area;
        scales.length = work / (c.flat.largest_tension * units::gigapascal * area);
        c.force_scale = "the largest attraction of a site";
        if (bends < scales.force) {
            scales.force = bends;
            c.force_scale = "the block is soft compared with the attraction";
        }
    } else {
        const double load = smallest_load(c);
        if (load > 0.0) {
            scales.force = load * units::megapascal * area;
            c.force_scale = fmt::format("a site's part of the smallest load, {:.6g} MPa", load);
        } else {
            scales.force = softest * c.scene.drive.displacement_step;
            c.force_scale = "displaces the block's longest wave by drive.displacement_step";
        }
        scales.length = std::max(scales.force / softest, c.scene.drive.displacement_step);
    }
    c.tolerance = c.scene.drive.tolerance * scales.force;
}

} // namespace asperity
