// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/dynamics/approach_start.hpp"

#include "decomposition/global_largest.hpp"
#include "decomposition/global_sum.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace asperity {

namespace {

struct Height {
    ApproachStart at;
    double yielded; ///< energy, eV
};

/// Returns the energy that the block yields under the forces of the last sweep, eV. Collective.
double yielded(Block& block, double force) {
    const PlaneView<double> f = block.interface_force().z;
    const double largest =
        global_largest(block.communicator(), block.grid().tile(0), [&](int x, int y) {
            return std::abs(f(x, y));
        }).value;
    if (force == 0.0 || largest == 0.0) return 0.0;
    // Exact sums have an absolute quantum (exact_sum.hpp): their terms are shares of the largest.
    ExactSum squares;
    for (int y = 0; y < f.ny; ++y) {
        for (int x = 0; x < f.nx; ++x)
            squares.add(f(x, y) / largest * (f(x, y) / largest));
        squares.carry();
    }
    const double sum = global_sum(block.communicator(), squares);
    const BlockOptions& o = block.options();
    const double radius =
        o.spacing * std::abs(force) / (largest * std::sqrt(sum * std::numbers::pi));
    const double edge = o.sites * o.spacing, modulus = o.modulus_of_compression();
    const double compliance = 1.0 / (2.0 * o.contact_modulus() * radius) +
                              o.thickness * o.spacing / (modulus * edge * edge);
    return 0.5 * force * force * compliance;
}

} // namespace

ApproachStart approach_start(Block& block, const Interface& interface) {
    const double top = interface.start_height();
    const double stride = reach_of(interface.options()) / 100.0;
    std::vector<Height> way;
    double deepest = 0.0;
    // Down to where the block is pressed, or as deep as the highest atom.
    for (int n = 0; n <= 100; ++n) {
        const double height = top - n * stride;
        const InterfaceSums sums = interface.sweep(block.lowest_layer(), block.interface_force(),
                                                   {.observe = true, .height = height});
        const auto [energy, force] =
            global_sums(block.communicator(), std::array{sums.energy, sums.force_z});
        if (force > 0.0) break;
        deepest = std::min(deepest, energy);
        way.push_back({{height, energy, force}, yielded(block, force)});
    }
    ApproachStart start{top, 0.0, 0.0};
    for (const Height& here : way) {
        if (here.yielded > -share_at_start * deepest || deepest == 0.0) break;
        start = here.at;
    }
    return start;
}

} // namespace asperity
