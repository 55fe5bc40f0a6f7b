// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "support/spectral_lattice.hpp"

#include <array>
#include <cmath>
#include <complex>
#include <cstddef>

namespace asperity::test {

namespace {

using Complex = std::complex<double>;
using Matrix = std::array<std::array<Complex, 3>, 3>;

Matrix inverse(const Matrix& m) {
    const auto cofactor = [&](std::size_t i, std::size_t j) {
        const std::size_t a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
        return m[a][c] * m[b][d] - m[a][d] * m[b][c];
    };
    const Complex determinant =
        m[0][0] * cofactor(0, 0) + m[0][1] * cofactor(0, 1) + m[0][2] * cofactor(0, 2);
    Matrix result;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            result[j][i] = cofactor(i, j) / determinant;
    return result;
}

Matrix times(const Matrix& a, const Matrix& b) {
    Matrix c{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            for (std::size_t k = 0; k < 3; ++k)
                c[i][j] += a[i][k] * b[k][j];
    return c;
}

double corner(std::size_t p, std::size_t c) { return static_cast<double>(p >> c & 1u); }

} // namespace

CellStiffness cell_stiffness(double spacing, double lame, double shear) {
    // K of one cell: springs of k/4 along edges, k/2 along face diagonals, and the mean dilatation.
    CellStiffness cell{};
    const double k = shear * spacing;
    for (std::size_t p = 0; p < 8; ++p)
        for (std::size_t q = p + 1; q < 8; ++q) {
            std::array<double, 3> d{};
            double square = 0.0;
            for (std::size_t c = 0; c < 3; ++c)
                d[c] = corner(q, c) - corner(p, c), square += d[c] * d[c];
            if (square > 2.5) continue;
            const double constant = square < 1.5 ? k / 4 : k / 2;
            for (std::size_t a = 0; a < 3; ++a)
                for (std::size_t b = 0; b < 3; ++b) {
                    const double value = constant * d[a] * d[b] / square;
                    cell[3 * p + a][3 * p + b] += value;
                    cell[3 * q + a][3 * q + b] += value;
                    cell[3 * p + a][3 * q + b] -= value;
                    cell[3 * q + a][3 * p + b] -= value;
                }
        }
    for (std::size_t i = 0; i < 24; ++i)
        for (std::size_t j = 0; j < 24; ++j) {
            const double si = 2 * corner(i / 3, i % 3) - 1, sj = 2 * corner(j / 3, j % 3) - 1;
            cell[i][j] += (lame - shear) * spacing / 16 * si * sj;
        }
    return cell;
}

namespace {

/// A cell folded with the phases of a wave: low plane, coupling, high plane.
struct FoldedCell {
    Matrix low{}, across{}, high{};
};

FoldedCell fold(double qx, double qy, double spacing, double lame, double shear) {
    const CellStiffness cell = cell_stiffness(spacing, lame, shear);
    FoldedCell folded;
    for (std::size_t i = 0; i < 24; ++i)
        for (std::size_t j = 0; j < 24; ++j) {
            const auto phase = [&](std::size_t p) {
                return std::polar(1.0, spacing * (qx * corner(p, 0) + qy * corner(p, 1)));
            };
            const Complex value = std::conj(phase(i / 3)) * cell[i][j] * phase(j / 3);
            const bool upper_i = i / 3 >= 4, upper_j = j / 3 >= 4;
            Matrix* into = upper_i ? (upper_j ? &folded.high : nullptr)
                                   : (upper_j ? &folded.across : &folded.low);
            if (into) (*into)[i % 3][j % 3] += value;
        }
    return folded;
}

} // namespace

double layered_stiffness(double qx, double qy, const std::vector<LatticeLayer>& layers,
                         double spacing) {
    Matrix s{};
    bool clamped = true;
    for (std::size_t layer = layers.size(); layer-- > 0;) {
        const FoldedCell cell = fold(qx, qy, spacing, layers[layer].lame, layers[layer].shear);
        Matrix adjoint;
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j)
                adjoint[i][j] = std::conj(cell.across[j][i]);
        for (int n = 0; n < layers[layer].cells; ++n) {
            Matrix middle = cell.high, gone{};
            for (std::size_t i = 0; i < 3; ++i)
                for (std::size_t j = 0; j < 3; ++j)
                    middle[i][j] += s[i][j];
            if (!clamped) gone = times(times(cell.across, inverse(middle)), adjoint);
            clamped = false;
            for (std::size_t i = 0; i < 3; ++i)
                for (std::size_t j = 0; j < 3; ++j)
                    s[i][j] = cell.low[i][j] - gone[i][j];
        }
    }
    return 1.0 / inverse(s)[2][2].real() / (spacing * spacing);
}

double surface_stiffness_ratio(double qx, double qy, int thickness, double spacing, double lame,
                               double shear) {
    const double stiffness = layered_stiffness(qx, qy, {{thickness, lame, shear}}, spacing);
    const double poisson = lame / (2.0 * (lame + shear));
    const double contact_modulus = 2.0 * shear / (1.0 - poisson); // E / (1 - nu^2)
    return stiffness / (0.5 * contact_modulus * std::hypot(qx, qy));
}

} // namespace asperity::test
