// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The stiffness of the waves of a block of layers and with a surface stress
// (kernels/surface_stiffness.hpp): against the elimination from the definition of the cell energy,
// against coated, graded and Gibson's half-spaces of the continuum, and against the springs in
// series of the uniform wave.
#include "engine/waves/spectral_block.hpp"
#include "support/cases.hpp"
#include "support/spectral_lattice.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

using namespace asperity;

namespace {

using std::numbers::pi;

WavePhase phase(double angle) { return {std::cos(angle), std::sin(angle)}; }

/// Returns the frictionless stiffness of a wave per area, eV/Å^4; qx, qy in 1/Å.
double lattice_stiffness(const BlockOptions& o, double qx, double qy = 0.0) {
    const SurfaceMatrix s = o.stiffness(phase(qx * o.spacing), phase(qy * o.spacing));
    return 1.0 / (inverse(s).zz * o.spacing * o.spacing);
}

BlockOptions deep_block(double young, double poisson) {
    BlockOptions o;
    o.young = young;
    o.poisson = poisson;
    o.thickness = 1'000'000;
    return o;
}

} // namespace

TEST(Layers, AreTheElimination) {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    for (int n = 0; n < 40; ++n) {
        BlockOptions o = test::paper_block(64, 60, 0);
        std::vector<test::LatticeLayer> plain;
        int rest = o.thickness;
        for (int layer = 0; layer < 1 + n % 4; ++layer) {
            const Material m{o.young * std::pow(10.0, 6.0 * uniform(random) - 3.0),
                             -0.3 + 0.79 * uniform(random)};
            const int cells = 1 + static_cast<int>(14.0 * uniform(random));
            o.layers.push_back({m, cells * o.spacing});
            plain.push_back({cells, m.lame(), m.shear_modulus()});
            rest -= cells;
        }
        plain.push_back({rest, o.lame(), o.shear_modulus()});
        for (const auto& [nx, ny] :
             {std::pair{1, 0}, {3, 1}, {8, 8}, {20, 3}, {31, 30}, {32, 32}}) {
            const double dq = 2.0 * pi / (o.sites * o.spacing);
            const double wanted = test::layered_stiffness(nx * dq, ny * dq, plain, o.spacing);
            EXPECT_NEAR(lattice_stiffness(o, nx * dq, ny * dq), wanted, 1e-10 * wanted)
                << "case " << n << ", wave " << nx << ", " << ny;
        }
    }
}

TEST(Layers, CoatTheHalfSpace) {
    // S/(E2* q/2) of a half-space with a coating of another Young's modulus, Poisson's ratio 0.3 of
    // both, by a program of its own for the continuum; the lattice's coating has 32 cells.
    struct Row {
        double qt, stiff, soft; // modulus of the coating 10 and 0.1 times that of the half-space
    };
    for (const Row& row : {Row{0.1, 1.086, 0.725}, Row{0.3, 1.215, 0.468}, Row{1.0, 2.715, 0.208},
                           Row{3.0, 9.074, 0.106}, Row{10.0, 10.0, 0.1}})
        for (const double ratio : {10.0, 0.1}) {
            BlockOptions o = deep_block(0.5, 0.3);
            constexpr int cells = 32;
            o.layers = {{{ratio * o.young, 0.3}, cells * o.spacing}};
            const double q = row.qt / (cells * o.spacing);
            const double found = lattice_stiffness(o, q) / (0.5 * o.contact_modulus() * q);
            const double wanted = ratio > 1.0 ? row.stiff : row.soft;
            EXPECT_NEAR(found, wanted, 0.005 * wanted) << "q t = " << row.qt << ", " << ratio;
        }
}

namespace {

/// Returns a block whose modulus grows with depth, with its value at the middle of each cell; the
/// depth that a wave of `period` cells feels is graded.
template <class Modulus>
BlockOptions graded(double poisson, int period, const Modulus& modulus) {
    BlockOptions o = deep_block(1.0, poisson);
    const int cells = 5 * period;
    for (int k = 0; k < cells; ++k)
        o.layers.push_back({{modulus((k + 0.5) * o.spacing), poisson}, o.spacing});
    o.young = modulus(cells * o.spacing);
    return o;
}

} // namespace

TEST(Layers, OfAModulusThatGrowsAsAPower) {
    // E = E_1 z^k: 1/S ~ q^(k-1) by its dimension, less the compliance of the first cell, whose
    // modulus is that of its middle. It is the same for all waves, and differences do not have it.
    for (const double k : {0.25, 0.5, 0.75}) {
        const auto compliance = [&](int period) {
            const BlockOptions o =
                graded(0.3, period, [&](double z) { return 0.01 * std::pow(z, k); });
            return 1.0 / lattice_stiffness(o, 2.0 * pi / (period * o.spacing));
        };
        const double first = compliance(64), second = compliance(128), third = compliance(256);
        const double exponent = std::log2((third - second) / (second - first));
        EXPECT_NEAR(exponent, 1.0 - k, 0.001) << "k = " << k;
    }
}

TEST(Layers, OfGibsonAreABedOfSpringsIfIncompressible) {
    // G = m z. Incompressible: S = 2 m for all waves. Else a column of the solid, of modulus
    // 2 m z (1 - nu)/(1 - 2 nu), gives way without limit as its first cell gets thinner, and 2 m/S
    // grows by (1 - 2 nu)/(1 - nu) ln 3 if a wave is three times as long.
    constexpr double m = 1e-3;
    for (const double poisson : {0.3, 0.45, 0.49, 0.499, 0.499999}) {
        const auto compliance = [&](int period) {
            const BlockOptions o =
                graded(poisson, period, [&](double z) { return 2.0 * (1.0 + poisson) * m * z; });
            return 2.0 * m / lattice_stiffness(o, 2.0 * pi / (period * o.spacing));
        };
        const double once = compliance(96), thrice = compliance(288);
        const double grows = (1.0 - 2.0 * poisson) / (1.0 - poisson) * std::log(3.0);
        EXPECT_NEAR(thrice - once, grows, 0.001) << "nu = " << poisson;
        if (poisson > 0.4999) {
            EXPECT_NEAR(once, 1.0, 0.001);
        }
    }
}

TEST(Layers, OfOneMaterialAreOneBlock) {
    const BlockOptions plain = test::paper_block(16, 40, 0);
    BlockOptions layered = plain;
    layered.layers = {{plain, 3 * plain.spacing}, {plain, 11 * plain.spacing}};
    for (int nx = 0; nx <= 8; ++nx)
        for (int ny = 0; ny <= 8; ++ny) {
            const WavePhase x = wave_phase(nx, 16), y = wave_phase(ny, 16);
            const SurfaceMatrix a = plain.stiffness(x, y), b = layered.stiffness(x, y);
            for (const auto entry : {&SurfaceMatrix::xx, &SurfaceMatrix::yy, &SurfaceMatrix::zz,
                                     &SurfaceMatrix::xy, &SurfaceMatrix::xz, &SurfaceMatrix::yz})
                EXPECT_EQ(a.*entry, b.*entry);
        }
}

TEST(Layers, AreSpringsInSeriesForTheUniformWave) {
    BlockOptions o = test::paper_block(16, 40, 0);
    o.layers = {{{0.1 * o.young, 0.2}, 4 * o.spacing}, {{7.0 * o.young, 0.45}, 9 * o.spacing}};
    const auto modulus = [](const Material& m) { return m.lame() + 2.0 * m.shear_modulus(); };
    double normal = 0.0, shear = 0.0; // compliances of the area of a site
    const auto add = [&](const Material& m, int cells) {
        normal += cells / (modulus(m) * o.spacing);
        shear += cells / (m.shear_modulus() * o.spacing);
    };
    add(o.layers[0].material, 4);
    add(o.layers[1].material, 9);
    add(o, 27);
    const SurfaceMatrix s = o.stiffness(wave_phase(0, 16), wave_phase(0, 16));
    EXPECT_NEAR(s.zz * normal, 1.0, 1e-14);
    EXPECT_NEAR(s.xx * shear, 1.0, 1e-14);
    // As the wave grows, its stiffness becomes that of the uniform one.
    const double long_wave = lattice_stiffness(o, 1e-4 / o.spacing) * o.spacing * o.spacing;
    EXPECT_NEAR(long_wave, s.zz, 1e-4 * s.zz);
}

TEST(SurfaceStress, AddsItsEnergyToAWaveThatIsFlattened) {
    // (E* q/8 + Y q^2/4) h^2 for each area of a wave of amplitude h, q^2 that of the lattice.
    constexpr int sites = 32;
    constexpr double h = 0.7;
    const auto energy = [&](double stress) {
        BlockOptions o = test::paper_block(sites, 200, 0);
        o.surface_stress = stress;
        SpectralBlock block(o, Communicator(), true);
        block.set_uniform(0.0);
        block.constrain(Constraint::mean_height(0.0));
        const PlaneView<double> z = block.moving_layer(0);
        for (int y = 0; y < sites; ++y)
            for (int x = 0; x < sites; ++x)
                z(x, y) = h * std::cos(2.0 * pi * x / sites);
        block.apply_constraint();
        return block.energies()[Term::elastic];
    };
    const BlockOptions o = test::paper_block(sites, 200, 0);
    const double area = std::pow(sites * o.spacing, 2), q = 2.0 * pi / (sites * o.spacing);
    const double stress = 3.0 * o.contact_modulus() / q,
                 square = 2.0 * std::sin(0.5 * q * o.spacing);
    const double added = energy(stress) - energy(0.0);
    EXPECT_NEAR(added / area, 0.25 * stress * std::pow(square / o.spacing, 2) * h * h,
                1e-9 * energy(stress) / area);
    EXPECT_NEAR(energy(stress) / area, (o.contact_modulus() * q / 8 + stress * q * q / 4) * h * h,
                0.005 * energy(stress) / area);
}
