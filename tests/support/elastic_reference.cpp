// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "support/elastic_reference.hpp"

#include "kernels/cell_geometry.hpp"
#include "support/spectral_lattice.hpp"

#include <cmath>

namespace asperity::test {

namespace {

/// Energy and forces of one cubic cell, straight from the definition (docs/explanation/model.md).
/// u[p][i] is component i of the displacement of corner p (bit 0 of p is x, bit 1 y, bit 2 z), Å;
/// f[p][i] the force on it, eV/Å, overwritten; what is returned is the cell's energy, eV.
/// Finite strain: springs feel their true length, the dilatation term det F - 1.
double finite_cell(const double (&u)[8][3], const LevelCell& c, double (&f)[8][3]) {
    double F[3][3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    for (int p = 0; p < 8; ++p)
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
                F[i][j] += corner_sign(p, j) * u[p][i] / (4.0 * c.edge);
    double cofactor[3][3], det = 0.0;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            const int k = (i + 1) % 3, l = (i + 2) % 3, m = (j + 1) % 3, n = (j + 2) % 3;
            cofactor[i][j] = F[k][m] * F[l][n] - F[k][n] * F[l][m];
        }
    for (int j = 0; j < 3; ++j)
        det += F[0][j] * cofactor[0][j];
    const double theta = det - 1.0;
    // (lambda - mu) s^3 = 16 s^2 kappa; d theta / du_pi = sum_j cof_ij sigma_pj / (4s).
    double energy = 8.0 * c.edge * c.edge * c.elasticity.kappa * theta * theta;
    for (int p = 0; p < 8; ++p)
        for (int i = 0; i < 3; ++i) {
            double slope = 0.0;
            for (int j = 0; j < 3; ++j)
                slope += cofactor[i][j] * corner_sign(p, j);
            f[p][i] = -4.0 * c.edge * c.elasticity.kappa * theta * slope;
        }
    for (int a = 0; a < 8; ++a)
        for (int b = a + 1; b < 8; ++b) {
            const int axes = axes_between(a, b);
            if (axes == 3) continue;
            const double k = axes == 1 ? 0.25 * c.elasticity.k : 0.5 * c.elasticity.k;
            double r[3], square = 0.0;
            for (int i = 0; i < 3; ++i) {
                r[i] = 0.5 * c.edge * (corner_sign(b, i) - corner_sign(a, i)) + u[b][i] - u[a][i];
                square += r[i] * r[i];
            }
            const double length = std::sqrt(square);
            const double stretch = length - c.edge * std::sqrt(double(axes));
            energy += 0.5 * k * stretch * stretch;
            for (int i = 0; i < 3; ++i) {
                f[a][i] += k * stretch * r[i] / length;
                f[b][i] -= k * stretch * r[i] / length;
            }
        }
    return energy;
}

/// cell(u, f) of every cell whose lower corner is owned: forces added into out, energies returned.
template <class Cell>
double each_cell(const VectorVolume<const double>& u, const VectorVolume<double>& out,
                 const Cell& cell) {
    double energy = 0.0;
    for (int z = 0; z + 1 < u.x.nz; ++z)
        for (int y = 0; y < u.x.ny; ++y)
            for (int x = 0; x < u.x.nx; ++x) {
                double at[8][3], f[8][3];
                const auto node = [&](const auto& volume, int p) -> auto& {
                    return volume(x + (p & 1), y + (p >> 1 & 1), z + (p >> 2 & 1));
                };
                for (int p = 0; p < 8; ++p) {
                    at[p][0] = node(u.x, p);
                    at[p][1] = node(u.y, p);
                    at[p][2] = node(u.z, p);
                }
                energy += cell(at, f);
                for (int p = 0; p < 8; ++p) {
                    node(out.x, p) += f[p][0];
                    node(out.y, p) += f[p][1];
                    node(out.z, p) += f[p][2];
                }
            }
    return energy;
}

} // namespace

double elastic_reference(VectorVolume<const double> u, const LevelCell& c,
                         VectorVolume<double> out) {
    const double shear = c.elasticity.k / c.edge, lame = 16.0 * c.elasticity.kappa / c.edge + shear;
    const CellStiffness stiffness = cell_stiffness(c.edge, lame, shear);
    return each_cell(u, out, [&](const auto& at, auto& f) {
        double energy = 0.0;
        for (std::size_t i = 0; i < 24; ++i) {
            double force = 0.0;
            for (std::size_t j = 0; j < 24; ++j)
                force -= stiffness[i][j] * at[j / 3][j % 3];
            f[i / 3][i % 3] = force;
            energy -= 0.5 * force * at[i / 3][i % 3];
        }
        return energy;
    });
}

double finite_reference(VectorVolume<const double> u, const LevelCell& c,
                        VectorVolume<double> out) {
    return each_cell(u, out, [&](const auto& at, auto& f) { return finite_cell(at, c, f); });
}

} // namespace asperity::test
