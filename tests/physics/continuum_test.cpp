// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The stiffness of the waves of an elastic continuum (kernels/continuum_stiffness.hpp): against
// amplitudes matched at the interfaces of the layers, against half-spaces and layers in closed
// form, and as the limit of the lattice for long waves.
#include "engine/options/block_options.hpp"
#include "support/cases.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

using namespace asperity;

namespace {

using std::numbers::pi;
using Real = long double;

/// Displacements (U, w) and tractions, over q, of one of the four solutions of a layer at z: the
/// one of p = exp(-q z) and of p = exp(q (z - h)), each with its free part.
struct Solution {
    Real u, w, along, normal;
};
Solution solution(int which, const SolidLayer& layer, Real q, Real z) {
    const Real nu = layer.poisson, mu = layer.shear_modulus;
    const bool down = which < 2; // decays upwards
    const Real sign = down ? -1.0L : 1.0L;
    const Real zeta = q * (down ? z : z - static_cast<Real>(layer.thickness));
    const Real e = std::exp(sign * zeta);
    // Free part: U = e, w' = U. Forced part: p = e.
    Real u, w, u1, w1, p;
    if (which % 2 == 0) {
        u = e, w = sign * e, u1 = sign * e, w1 = e, p = 0.0L;
    } else {
        const Real b = 0.5L * (3.0L - 4.0L * nu);
        u = (0.5L * sign * zeta + b) * e, w = 0.5L * zeta * e;
        u1 = sign * u + 0.5L * sign * e, w1 = sign * w + 0.5L * e, p = e;
    }
    return {u, w, mu * q * (u1 + w), mu * q * (2.0L * w1 - 2.0L * nu * p)};
}

/// Solves a x = b in place by elimination with pivots.
std::vector<Real> solve(std::vector<std::vector<Real>> a, std::vector<Real> b) {
    const std::size_t n = b.size();
    for (std::size_t i = 0; i < n; ++i) {
        std::size_t pivot = i;
        for (std::size_t r = i; r < n; ++r)
            if (std::abs(a[r][i]) > std::abs(a[pivot][i])) pivot = r;
        std::swap(a[i], a[pivot]), std::swap(b[i], b[pivot]);
        for (std::size_t r = i + 1; r < n; ++r) {
            const Real f = a[r][i] / a[i][i];
            for (std::size_t c = i; c < n; ++c)
                a[r][c] -= f * a[i][c];
            b[r] -= f * b[i];
        }
    }
    for (std::size_t i = n; i-- > 0;) {
        for (std::size_t c = i + 1; c < n; ++c)
            b[i] -= a[i][c] * b[c];
        b[i] /= a[i][i];
    }
    return b;
}

/// Returns the forces (along, normal) on the lower surface displaced by (u, w): the amplitudes of
/// all layers, matched in displacements and tractions, zero displacement at the top.
std::array<Real, 2> matched(const std::vector<SolidLayer>& layers, Real q, Real u, Real w) {
    const std::size_t n = 4 * layers.size();
    std::vector<std::vector<Real>> a(n, std::vector<Real>(n, 0.0L));
    std::vector<Real> b(n, 0.0L);
    b[0] = u, b[1] = w;
    for (std::size_t i = 0; i < layers.size(); ++i)
        for (int k = 0; k < 4; ++k) {
            const std::size_t column = 4 * i + static_cast<std::size_t>(k);
            const Solution lower = solution(k, layers[i], q, 0.0L);
            const Solution upper = solution(k, layers[i], q, layers[i].thickness);
            const std::size_t row = 4 * i + 2; // matches layer i with i + 1
            if (i == 0) {
                a[0][column] = lower.u, a[1][column] = lower.w;
            } else {
                a[row - 4][column] = -lower.u, a[row - 3][column] = -lower.w;
                a[row - 2][column] = -lower.along, a[row - 1][column] = -lower.normal;
            }
            a[row][column] = upper.u, a[row + 1][column] = upper.w;
            if (i + 1 < layers.size())
                a[row + 2][column] = upper.along, a[row + 3][column] = upper.normal;
        }
    const std::vector<Real> amplitude = solve(a, b);
    std::array<Real, 2> force{};
    for (int k = 0; k < 4; ++k) {
        const Solution lower = solution(k, layers[0], q, 0.0L);
        force[0] -= amplitude[static_cast<std::size_t>(k)] * lower.along;
        force[1] -= amplitude[static_cast<std::size_t>(k)] * lower.normal;
    }
    return force;
}

/// Returns the frictionless stiffness of a wave along x per area, eV/Å^4.
double normal_stiffness(const BlockOptions& o, double q) {
    return 1.0 / inverse(continuum_stiffness(o.solid(), q, 0.0)).zz;
}

BlockOptions half_space(double young, double poisson) {
    BlockOptions o;
    o.young = young;
    o.poisson = poisson;
    o.thickness = 1 << 30;
    return o;
}

} // namespace

TEST(Continuum, MatchesAmplitudesAtTheInterfaces) {
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    for (int n = 0; n < 400; ++n) {
        std::vector<SolidLayer> layers;
        for (int i = 0; i <= n % 5; ++i)
            layers.push_back({std::pow(10.0, 4.0 * uniform(random) - 2.0),
                              n % 3 ? -0.8 + 1.3 * uniform(random) : 0.5,
                              std::pow(10.0, 3.0 * uniform(random) - 2.0)});
        const SurfaceMatrix s = continuum_stiffness(layers, 1.0, 0.0);
        const auto along = matched(layers, 1.0L, 1.0L, 0.0L),
                   normal = matched(layers, 1.0L, 0.0L, 1.0L);
        const double scale = std::sqrt(s.xx * s.zz);
        EXPECT_NEAR(s.xx / static_cast<double>(along[0]), 1.0, 1e-10) << "case " << n;
        EXPECT_NEAR(s.zz / static_cast<double>(normal[1]), 1.0, 1e-10) << "case " << n;
        EXPECT_NEAR(s.xz, static_cast<double>(along[1]), 1e-10 * scale) << "case " << n;
        EXPECT_NEAR(s.xz, static_cast<double>(normal[0]), 1e-10 * scale) << "case " << n;
    }
}

TEST(Continuum, GivesWavesOfEveryLengthTheContactModulus) {
    BlockOptions o = half_space(0.5, 0.3);
    o.continuum = true;
    for (const double poisson : {-0.5, 0.0, 0.3, 0.49999, 0.5}) {
        o.poisson = poisson;
        for (const auto& [nx, ny] :
             {std::pair{1, 0}, {16, 0}, {16, 16}, {32, 0}, {32, 32}, {7, 29}}) {
            const SurfaceMatrix s = o.stiffness(wave_phase(nx, 64), wave_phase(ny, 64));
            const double q = 2.0 * pi / (64 * o.spacing) * std::hypot(nx, ny);
            const double found = 1.0 / (inverse(s).zz * o.spacing * o.spacing);
            EXPECT_NEAR(found / (0.5 * o.contact_modulus() * q), 1.0, 1e-12)
                << "nu = " << poisson << ", wave " << nx << ", " << ny;
        }
    }
}

TEST(Continuum, OfALayerOnARigidBase) {
    BlockOptions o = half_space(0.5, 0.42);
    o.thickness = 10;
    const double h = o.thickness * o.spacing;
    for (const double nu : {-0.4, 0.0, 0.42, 0.499, 0.5})
        for (const double x : {0.003, 0.05, 0.5, 1.0, 2.0, 5.0, 30.0}) {
            o.poisson = nu;
            const double k = 3.0 - 4.0 * nu;
            const double closed =
                (k * std::cosh(2.0 * x) + 2.0 * x * x + 5.0 - 12.0 * nu + 8.0 * nu * nu) /
                (2.0 * (1.0 - 2.0 * nu) * std::sinh(2.0 * x) + (std::sinh(2.0 * x) - 2.0 * x));
            const double found = normal_stiffness(o, x / h) / (0.5 * o.contact_modulus() * x / h);
            EXPECT_NEAR(found / closed, 1.0, 1e-9) << "nu = " << nu << ", q h = " << x;
        }
}

TEST(Continuum, CoatsAHalfSpace) {
    // S/(E2* q/2) of a half-space with a coating of another Young's modulus, Poisson's ratio 0.3 of
    // both, by a program of its own.
    struct Row {
        double qt, stiff, soft; // modulus of the coating 10 and 0.1 times that of the half-space
    };
    for (const Row& row : {Row{0.1, 1.086, 0.725}, Row{0.3, 1.215, 0.468}, Row{1.0, 2.715, 0.208},
                           Row{3.0, 9.074, 0.106}, Row{10.0, 10.0, 0.1}})
        for (const bool stiff : {true, false}) {
            BlockOptions o = half_space(0.5, 0.3);
            o.layers = {{{(stiff ? 10.0 : 0.1) * o.young, 0.3}, 0.37 * o.spacing}};
            const double q = row.qt / o.layers[0].thickness;
            const double found = normal_stiffness(o, q) / (0.5 * o.contact_modulus() * q);
            EXPECT_NEAR(found, stiff ? row.stiff : row.soft, 6e-4) << "q t = " << row.qt;
        }
}

TEST(Continuum, BendsAThinFilmAsAPlate) {
    // A stiff film on a soft half-space, long waves: E* t^3 q^4 / 12 beside E2* q / 2.
    BlockOptions o = half_space(1e-7, 0.45);
    const Material film{0.5, 0.3};
    o.layers = {{film, 5.2}};
    for (const double qt : {0.02, 0.05, 0.1}) {
        const double q = qt / 5.2;
        const double plate = film.contact_modulus() * std::pow(5.2, 3) * std::pow(q, 4) / 12.0;
        const double bending = normal_stiffness(o, q) - 0.5 * o.contact_modulus() * q;
        EXPECT_NEAR(bending / plate, 1.0, 0.02 + qt * qt) << "q t = " << qt;
    }
}

TEST(Continuum, IsTheLatticeOfLongWaves) {
    // All entries, with their signs, to the order (q a)^2.
    BlockOptions o = test::paper_block(256, 200, 0);
    o.layers = {{{3.0 * o.young, 0.2}, 20 * o.spacing}, {{0.2 * o.young, 0.45}, 31 * o.spacing}};
    BlockOptions continuum = o;
    continuum.continuum = true;
    for (const auto& [nx, ny] : {std::pair{2, 0}, {4, 1}, {3, 5}, {0, 6}, {0, 0}}) {
        const WavePhase x = wave_phase(nx, o.sites), y = wave_phase(ny, o.sites);
        const SurfaceMatrix a = o.stiffness(x, y), b = continuum.stiffness(x, y);
        const double order = std::pow(2.0 * pi * std::hypot(nx, ny) / o.sites, 2);
        for (const auto entry : {&SurfaceMatrix::xx, &SurfaceMatrix::yy, &SurfaceMatrix::zz,
                                 &SurfaceMatrix::xy, &SurfaceMatrix::xz, &SurfaceMatrix::yz})
            EXPECT_NEAR(a.*entry, b.*entry, (0.3 * order + 1e-12) * b.zz)
                << "wave " << nx << ", " << ny;
    }
}
