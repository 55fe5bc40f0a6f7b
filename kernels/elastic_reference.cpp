// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "kernels/cell_forces.hpp"

namespace asperity {

namespace {

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

double elastic_reference(VectorVolume<const double> u, CellElasticity e, VectorVolume<double> out) {
    return each_cell(u, out, [&](const auto& at, auto& f) { return linear_cell(at, e, f); });
}

double finite_reference(VectorVolume<const double> u, const LevelCell& c,
                        VectorVolume<double> out) {
    return each_cell(u, out, [&](const auto& at, auto& f) { return finite_cell(at, c, f); });
}

} // namespace asperity
