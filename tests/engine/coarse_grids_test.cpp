// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The grids' steps against the block's own forces: steps after forces are a map whose largest
// eigenvalue says how far a descent may go without swinging up, and which must not grow with the
// block.
#include "engine/equilibrium/coarse_grids.hpp"
#include "support/cases.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace asperity;

namespace {

/// Largest eigenvalue of steps after (minus) forces, the interface adding stiffness k to each site.
double largest_eigenvalue(const BlockOptions& options, double k) {
    Block block(options, Communicator(), test::serial_grid(options), Motion::at_rest);
    CoarseGrids grids(block);
    std::vector<VectorField<double>> nodes;
    for (const auto& level : block.levels())
        nodes.emplace_back(level.tile, level.shape.cells);
    const auto each = [&](const auto& work) {
        for (std::size_t l = 0; l < nodes.size(); ++l) {
            const auto u = block.fields(block.levels()[l]).u.view(), v = nodes[l].view();
            for (int z = 0; z < block.levels()[l].shape.cells; ++z)
                for (int y = 0; y < u.x.ny; ++y)
                    for (int x = 0; x < u.x.nx; ++x) {
                        work(u.x(x, y, z), v.x(x, y, z));
                        work(u.y(x, y, z), v.y(x, y, z));
                        work(u.z(x, y, z), v.z(x, y, z));
                    }
        }
    };
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    each([&](double& u, double) { u = any(random); });
    const PlaneView<double> stiffness = grids.site_stiffness();
    for (int y = 0; y < stiffness.ny; ++y)
        for (int x = 0; x < stiffness.nx; ++x)
            stiffness(x, y) = k;
    double value = 0.0;
    for (int i = 0; i < 200; ++i) {
        block.set_top(0.0);
        block.exchange();
        block.interpolate();
        const auto u = block.lowest_layer();
        const auto f = block.interface_force();
        for (int y = 0; y < u.x.ny; ++y)
            for (int x = 0; x < u.x.nx; ++x) {
                f.x(x, y) = -k * u.x(x, y);
                f.y(x, y) = -k * u.y(x, y);
                f.z(x, y) = -k * u.z(x, y);
            }
        block.forces(nodes);
        grids.steps(nodes);
        double before = 0.0, after = 0.0;
        each([&](double& a, double b) { before += a * a, after += b * b; });
        value = std::sqrt(after / before);
        each([&](double& a, double b) { a = -b / std::sqrt(after); });
    }
    return value;
}

} // namespace

TEST(CoarseGrids, StepsAreNoLongerThanMomentumStands) {
    struct Shape {
        int sites, thickness, layers;
    };
    for (const Shape& s : {Shape{16, 16, 0}, Shape{32, 32, 0}, Shape{32, 32, 4}, Shape{64, 64, 4},
                           Shape{64, 64, 2}, Shape{64, 64, 8}, Shape{48, 200, 5}, Shape{32, 6, 3}})
        for (double k : {0.0, 2.0, 20.0}) {
            const double largest =
                largest_eigenvalue(test::paper_block(s.sites, s.thickness, s.layers), k);
            // Stable below 2 (1 + momentum) = 3.6, of which the means of planes take one.
            EXPECT_LT(largest, 2.6);
            EXPECT_GT(largest, 1.0);
        }
}
