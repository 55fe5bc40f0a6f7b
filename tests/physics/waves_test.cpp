// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Speeds of sound of the block as it steps, against the isotropic solid of its moduli and density
// (docs/reports/validation.md). A standing wave is released, and its frequency follows from its own
// displacements: a mode of the lattice repeats A(n+1) + A(n-1) = 2 cos(theta) A(n), where velocity
// Verlet of frequency w has sin(theta/2) = w dt/2.
#include "engine/block/block.hpp"
#include "support/cases.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

using namespace asperity;

namespace {

using std::numbers::pi;

using Shape = std::function<std::array<double, 3>(int x, int z)>; ///< displacement, Å

/// Frequency of the standing wave of this shape, 1/fs, over a number of its expected periods.
double frequency(const BlockOptions& options, const Shape& shape, double expected, int periods) {
    Block block(options, Communicator(), test::serial_grid(options));
    block.set_uniform(0.0, 0.0);
    const Block::Level& level = block.levels().front();
    const Block::Fields fields = block.fields(level);
    const auto u = fields.u.view();
    std::vector<std::array<double, 3>> mode; // by z, x
    for (int z = 0; z < level.shape.cells; ++z)
        for (int x = 0; x < level.tile.nx; ++x) {
            mode.push_back(shape(x, z));
            for (int y = 0; y < level.tile.ny; ++y) {
                u.x(x, y, z) = mode.back()[0];
                u.y(x, y, z) = mode.back()[1];
                u.z(x, y, z) = mode.back()[2];
            }
        }
    block.exchange();
    const double dt = 40.0;
    const StepParameters parameters{dt, 0.0, 0.0, 0.0, false};
    KickSums sums;
    std::vector<double> amplitude;
    for (int n = 0; n * dt * expected < 2.0 * pi * periods; ++n) {
        double sum = 0.0; // the wave is the same along y
        for (int z = 0, i = 0; z < level.shape.cells; ++z)
            for (int x = 0; x < level.tile.nx; ++x, ++i) {
                const std::array<double, 3>& s = mode[static_cast<std::size_t>(i)];
                sum += s[0] * u.x(x, 0, z) + s[1] * u.y(x, 0, z) + s[2] * u.z(x, 0, z);
            }
        amplitude.push_back(sum);
        block.interpolate();
        block.advance(parameters, sums);
        block.exchange();
    }
    double above = 0.0, below = 0.0;
    for (std::size_t n = 1; n + 1 < amplitude.size(); ++n) {
        above += amplitude[n] * (amplitude[n + 1] + amplitude[n - 1]);
        below += 2.0 * amplitude[n] * amplitude[n];
    }
    return 2.0 / dt * std::sin(0.5 * std::acos(above / below));
}

struct LayeredSolid {
    double longitudinal, transverse; ///< speeds, Å/fs
    explicit LayeredSolid(const BlockOptions& o) {
        const double density = o.atom_mass / (o.spacing * o.spacing * o.spacing);
        longitudinal = std::sqrt((o.lame() + 2.0 * o.shear_modulus()) / density);
        transverse = std::sqrt(o.shear_modulus() / density);
    }
};

/// Rayleigh's wave of the solid, decaying upwards from the free surface at z = 0.
struct Rayleigh {
    double speed, q, p, s, d; ///< displacement ~ exp(-p z) and exp(-s z)
    Rayleigh(const LayeredSolid& solid, double wavevector) : q(wavevector) {
        const double ratio = std::pow(solid.transverse / solid.longitudinal, 2);
        double low = 0.5, high = 1.0 - 1e-12; // of (c / c_T)^2
        for (int n = 0; n < 60; ++n) {
            const double x = 0.5 * (low + high);
            const double off =
                std::pow(2.0 - x, 2) - 4.0 * std::sqrt(1.0 - x) * std::sqrt(1.0 - x * ratio);
            (off < 0.0 ? low : high) = x;
        }
        speed = solid.transverse * std::sqrt(low);
        p = q * std::sqrt(1.0 - low * ratio);
        s = q * std::sqrt(1.0 - low);
        d = 2.0 * p * q / (q * q + s * s);
    }
    double along(double z) const { return q * std::exp(-p * z) - s * d * std::exp(-s * z); }
    double upwards(double z) const { return p * std::exp(-p * z) - q * d * std::exp(-s * z); }
    /// Square of the displacement at the surface over its integral, 1/Å.
    double at_surface() const {
        const auto integral = [&](double a, double b) {
            return a * a / (2.0 * p) - 2.0 * a * b / (p + s) + b * b / (2.0 * s);
        };
        return (std::pow(along(0.0), 2) + std::pow(upwards(0.0), 2)) /
               (integral(q, s * d) + integral(p, q * d));
    }
};

/// Speed of the block's Rayleigh wave over that of the solid, less 1.
double rayleigh_error(int sites) {
    const BlockOptions o = test::paper_block(sites, 2 * sites, 0);
    const Rayleigh wave(LayeredSolid(o), 2.0 * pi / (sites * o.spacing));
    const Shape shape = [&](int x, int z) -> std::array<double, 3> {
        const double phase = 2.0 * pi * x / sites, height = z * o.spacing;
        return {1e-3 * wave.along(height) * std::sin(phase), 0.0,
                1e-3 * wave.upwards(height) * std::cos(phase)};
    };
    const double expected = wave.speed * wave.q;
    return frequency(o, shape, expected, 5) / expected - 1.0;
}

} // namespace

/// Along an axis the lattice is a chain: w = (2c/a) sin(qa/2), so the speed w/q is that of the
/// solid less (qa)²/24 of it. The lowest layer is free and full atoms: the antinode lies half a
/// spacing below it.
TEST(Waves, BodyWavesHaveTheSpeedsOfTheSolid) {
    const int layers = 60;
    const BlockOptions o = test::paper_block(4, layers, 0);
    const LayeredSolid solid(o);
    for (const int nodes : {1, 3, 6})
        for (const std::size_t component : {std::size_t{0}, std::size_t{1}, std::size_t{2}}) {
            const double phase = (2 * nodes - 1) * pi / (2 * layers + 1); // qa
            const double speed = component == 2 ? solid.longitudinal : solid.transverse;
            const Shape shape = [&](int, int z) {
                std::array<double, 3> u{};
                u[component] = 1e-3 * std::cos(phase * (z + 0.5));
                return u;
            };
            const double q = phase / o.spacing;
            const double found = frequency(o, shape, speed * q, 2) / q;
            EXPECT_NEAR(found / speed - 1.0, -phase * phase / 24.0,
                        1e-9 + std::pow(phase, 4) / 1900.0) // the next term is (qa)^4 / 1920
                << nodes << " " << component;
        }
}

/// The lowest layer's full atoms weigh half a layer more than the solid there, m'. To first order
/// they slow the wave by m' u²(0) / (2 rho int u² dz), which goes as 1/wavelength; what is left is
/// of second order, and goes with a doubled wavelength.
TEST(Waves, RayleighWavesAreSlowedByTheLowestLayersMass) {
    const BlockOptions o = test::paper_block(16, 32, 0);
    const double q = 2.0 * pi / (16 * o.spacing);
    const double first = -0.25 * o.spacing * Rayleigh(LayeredSolid(o), q).at_surface();
    const double at_16 = rayleigh_error(16), at_32 = rayleigh_error(32);
    RecordProperty("error_at_16_spacings", fmt::format("{:.4f}", at_16));
    RecordProperty("error_at_32_spacings", fmt::format("{:.4f}", at_32));
    EXPECT_NEAR(2.0 * (2.0 * at_32) - at_16, first, 0.02 * -first);
    EXPECT_LT(at_16, first);
    EXPECT_NEAR(at_16 - first, 4.0 * (at_32 - 0.5 * first), 0.3 * (first - at_16));
}
