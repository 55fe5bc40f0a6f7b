// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/path/expected_path.hpp"

#include "engine/units.hpp"

#include <algorithm>
#include <cmath>

namespace asperity {

ExpectedPath expected_path(const Case& c, double start) {
    const BlockOptions& block = c.simulation.block;
    const double contact = c.flat.separation - start; // displacement of the top plane
    // Deformation of the block and of the spring that holds it, under a pressure.
    double yields = block.thickness * block.spacing / block.modulus_of_compression();
    if (block.top_spring) yields += c.area() / block.top_spring.stiffness;
    ExpectedPath path;
    path.time = c.simulation.drive.ramp * static_cast<double>(c.path().size() - 1); // turns
    double at = 0.0, pressure = 0.0;
    for (const Segment& segment : c.path()) {
        double to = at, way = 0.0;
        if (segment.kind == Segment::approach) {
            to = contact;
            pressure = 0.0;
        } else if (segment.kind == Segment::pull_off) {
            // The block separates when it is stretched by half of the pull-off of smooth surfaces.
            way = std::max(-at, 0.5 * c.smooth_pull_off() / c.area() * yields);
            to = 0.0;
        } else if (segment.kind == Segment::load) {
            const double asked = segment.amount / c.area();
            to = std::min(at, contact) + (pressure - asked) * yields;
            pressure = asked;
        } else if (segment.kind == Segment::height) {
            to = segment.amount - start;
        } else if (segment.kind == Segment::slide) {
            way = std::abs(segment.amount);
        } else if (segment.kind == Segment::hold) {
            path.time += segment.amount;
        }
        way = std::max(way, std::abs(to - at));
        at = to;
        path.ways.push_back(way);
        path.time += way / c.simulation.drive.velocity;
        path.deepest = std::max(path.deepest, -at);
    }
    return path;
}

} // namespace asperity
