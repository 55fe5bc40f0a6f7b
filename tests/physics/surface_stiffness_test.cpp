// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The block's answer to a frictionless normal wave: the lattice against plane-by-plane elimination
// from the definition of the cell energy, and the multiscale block against the lattice
// (docs/explanation/model.md).
//
// Numbers named "reference" come from an independent program in another language
// (tests/physics/data/README.md). The prescribed wave is relaxed to a relative force of 1e-7; the
// stiffness is stationary, so its error is near the square of that, and what is compared is limited
// by 1e-9 at most.
#include "support/cases.hpp"
#include "support/elastic_operator.hpp"
#include "support/spectral_lattice.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace asperity;

namespace {

using std::numbers::pi;

double lattice_ratio(const BlockOptions& o, double qx, double qy) {
    return test::surface_stiffness_ratio(qx, qy, o.thickness, o.spacing, o.lame(),
                                         o.shear_modulus());
}

/// Stiffness over E* q/2 of the block for the wave with nx by ny periods in the box.
double block_ratio(const BlockOptions& options, int nx, int ny) {
    test::ElasticOperator k(options);
    const double q = 2.0 * pi / (options.sites * options.spacing) * std::hypot(nx, ny);
    const auto response = test::press(
        k, [&](int x, int y) { return std::cos(2.0 * pi * (nx * x + ny * y) / options.sites); });
    EXPECT_LT(response.residual, 1e-7);
    return response.stiffness / (0.5 * options.contact_modulus() * q);
}

} // namespace

TEST(SurfaceStiffness, EliminationGivesTheNumbersOfTheModel) {
    // Over E* q/2 along x and, with the same wavelength, along the diagonal; thickness eight
    // wavelengths.
    struct Row {
        int period;
        double along_x, along_diagonal; // reference
    };
    for (const Row& row :
         {Row{4, 0.8713020761, 0.8797987306}, Row{8, 0.9797060798, 0.9840229401},
          Row{16, 0.9964538307, 0.9983142609}, Row{32, 0.9992299794, 0.9997759922}}) {
        const BlockOptions o = test::paper_block(32, 8 * row.period, 0);
        const double q = 2.0 * pi / (row.period * o.spacing);
        EXPECT_NEAR(lattice_ratio(o, q, 0.0), row.along_x, 1e-9);
        EXPECT_NEAR(lattice_ratio(o, q / std::sqrt(2.0), q / std::sqrt(2.0)), row.along_diagonal,
                    1e-9);
    }
}

TEST(SurfaceStiffness, TheLatticeBlockIsTheElimination) {
    // Waves along x (8, 16 and 32 a), the diagonal (two wavelengths) and askew; the thickness is in
    // both.
    struct Wave {
        int sites, thickness, nx, ny;
    };
    for (const Wave& w :
         {Wave{8, 64, 1, 0}, Wave{16, 32, 1, 0}, Wave{32, 48, 1, 0}, Wave{8, 16, 1, 1},
          Wave{16, 24, 1, 1}, Wave{16, 12, 3, -2}, Wave{8, 6, 4, 0}}) {
        const BlockOptions o = test::paper_block(w.sites, w.thickness, 0);
        const double q = 2.0 * pi / (w.sites * o.spacing);
        EXPECT_NEAR(block_ratio(o, w.nx, w.ny), lattice_ratio(o, w.nx * q, w.ny * q), 1e-9)
            << w.nx << ", " << w.ny << " in " << w.sites;
    }
}

TEST(SurfaceStiffness, TheMultiscaleBlockOverTheLattice) {
    // Worst wave along x for each number of layers a level; full levels, thickness >= L.
    // Reference: 1.0813448, 1.0325772, 1.0172317, 1.0072904, 1.0039282.
    struct Row {
        int layers, thickness, worst;
        double ratio;
    };
    for (const Row& row : {Row{2, 126, 9, 1.081344815537519}, Row{3, 93, 6, 1.0325771686414678},
                           Row{4, 124, 5, 1.0172317157365214}, Row{6, 186, 3, 1.0072903829673818},
                           Row{8, 120, 2, 1.0039282255083757}}) {
        const BlockOptions o = test::paper_block(64, row.thickness, row.layers);
        const double q = 2.0 * pi / (o.sites * o.spacing);
        const double ratio = block_ratio(o, row.worst, 0) / lattice_ratio(o, row.worst * q, 0.0);
        EXPECT_NEAR(ratio, row.ratio, 1e-8) << row.layers << " layers a level";
    }
}

TEST(SurfaceStiffness, EveryWaveLiesBetweenTheLatticeAndTheWorst) {
    // Constraining nodes can only stiffen, and the table's worst wave is the worst.
    struct Row {
        int layers, thickness;
        double worst;
    };
    for (const Row& row : {Row{2, 62, 1.0814}, Row{4, 60, 1.0174}, Row{8, 56, 1.0040}}) {
        const BlockOptions o = test::paper_block(32, row.thickness, row.layers);
        const double q = 2.0 * pi / (o.sites * o.spacing);
        constexpr int waves[][2] = {{1, 0},  {2, 0}, {3, 0}, {4, 0}, {6, 0}, {10, 0},
                                    {16, 0}, {1, 1}, {2, 2}, {3, 3}, {2, 1}, {5, -3}};
        for (const auto& [nx, ny] : waves) {
            const double ratio = block_ratio(o, nx, ny) / lattice_ratio(o, nx * q, ny * q);
            EXPECT_GE(ratio, 1.0 - 1e-9) << nx << ", " << ny;
            EXPECT_LE(ratio, row.worst) << nx << ", " << ny;
        }
    }
}

/// Towards Poisson's ratio 1/2 the stiffness of each wave comes to that of an incompressible block,
/// of one material or with a layer of it, as 1 - 2 nu: for thick blocks and thin ones.
TEST(SurfaceStiffness, HasALimitAtPoissonsRatioOneHalf) {
    const auto normal = [](double poisson, bool layered, int thickness, int nx, int ny) {
        BlockOptions o = test::paper_block(16, thickness, 0);
        const Material soft{o.young, poisson};
        if (layered)
            o.layers = {{soft, 3}};
        else
            o.poisson = poisson;
        return 1.0 / inverse(o.stiffness(wave_phase(nx, 16), wave_phase(ny, 16))).zz;
    };
    for (const bool layered : {false, true})
        for (const int thickness : {2, 5, 16, 200})
            for (const auto& [nx, ny] : {std::pair{1, 0}, {1, 1}, {3, 2}, {8, 0}, {8, 8}, {8, 3}}) {
                if (layered && thickness < 5) continue;
                const auto at = [&, x = nx, y = ny](double less) {
                    return normal(0.5 - less, layered, thickness, x, y);
                };
                const double limit = at(1e-12), slope = (at(1e-5) - limit) / 1e-5;
                ASSERT_TRUE(std::isfinite(limit)) << thickness << " " << nx << " " << ny;
                for (const double less : {1e-15, 1e-10, 1e-8, 1e-7, 1e-6, 2e-5, 4e-4, 6e-4}) {
                    const double first = slope / limit * less;
                    EXPECT_NEAR(at(less) / limit, 1.0 + first, 1e-9 + 10.0 * first * first)
                        << layered << " " << thickness << " " << nx << " " << ny << " " << less;
                }
            }
}
