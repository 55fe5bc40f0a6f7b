// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Nodes of blocks and fields one after the other, without their halos, and arrays compared.
#pragma once

#include "engine/block/block.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace asperity::test {

/// visit(level, x, y, z) for all nodes that move.
template <class Visit>
void each_node(const Block& block, const Visit& visit) {
    for (const Block::Level& level : block.levels())
        for (int z = 0; z < level.shape.cells; ++z)
            for (int y = 0; y < level.tile.ny; ++y)
                for (int x = 0; x < level.tile.nx; ++x)
                    visit(level, x, y, z);
}

/// The three components at a node.
template <class T>
std::array<T*, 3> components(const VectorVolume<T>& field, int x, int y, int z) {
    return {&field.x(x, y, z), &field.y(x, y, z), &field.z(x, y, z)};
}

template <class T>
std::vector<double> values_of(const PlaneView<T>& plane) {
    std::vector<double> all;
    for (int y = 0; y < plane.ny; ++y)
        all.insert(all.end(), plane.line(y), plane.line(y) + plane.nx);
    return all;
}
/// Of one component after the other.
template <class T>
std::vector<double> values_of(const VectorPlane<T>& plane) {
    std::vector<double> all;
    for (const auto& component : {plane.x, plane.y, plane.z}) {
        const std::vector<double> one = values_of(component);
        all.insert(all.end(), one.begin(), one.end());
    }
    return all;
}

inline double largest_of(const std::vector<double>& a) {
    double largest = 0.0;
    for (double value : a)
        largest = std::max(largest, std::abs(value));
    return largest;
}
/// Infinite where they are not of one length.
inline double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
    if (a.size() != b.size()) return HUGE_VAL;
    double largest = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        largest = std::max(largest, std::abs(a[i] - b[i]));
    return largest;
}

} // namespace asperity::test
