// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "kernels/cell_geometry.hpp"
#include "kernels/elastic_cell.hpp"

#include <cmath>

namespace asperity {

double elastic_reference(VectorVolume<const double> u, CellElasticity e, VectorVolume<double> out) {
    double energy = 0.0;
    for (int z = 0; z + 1 < u.x.nz; ++z)
        for (int y = 0; y < u.x.ny; ++y)
            for (int x = 0; x < u.x.nx; ++x) {
                const auto node = [&](int p) {
                    return z * u.x.plane + y * u.x.row + x + (p & 1) + (p >> 1 & 1) * u.x.row +
                           (p >> 2 & 1) * u.x.plane;
                };
                for (const Spring& s : cell_springs.spring) {
                    const auto a = node(s.from), b = node(s.to);
                    const double length = s.diagonal ? std::sqrt(2.0) : 1.0;
                    const double ex = s.dx / length, ey = s.dy / length, ez = s.dz / length;
                    const double stretch = ex * (u.x.origin[b] - u.x.origin[a]) +
                                           ey * (u.y.origin[b] - u.y.origin[a]) +
                                           ez * (u.z.origin[b] - u.z.origin[a]);
                    const double constant = s.diagonal ? 0.5 * e.k : 0.25 * e.k;
                    energy += 0.5 * constant * stretch * stretch;
                    const double tension = constant * stretch;
                    out.x.origin[a] += tension * ex, out.x.origin[b] -= tension * ex;
                    out.y.origin[a] += tension * ey, out.y.origin[b] -= tension * ey;
                    out.z.origin[a] += tension * ez, out.z.origin[b] -= tension * ez;
                }
                double dilatation = 0.0; // 4 s theta
                for (int p = 0; p < 8; ++p)
                    dilatation += corner_sign(p, 0) * u.x.origin[node(p)] +
                                  corner_sign(p, 1) * u.y.origin[node(p)] +
                                  corner_sign(p, 2) * u.z.origin[node(p)];
                energy += 0.5 * e.kappa * dilatation * dilatation;
                for (int p = 0; p < 8; ++p) {
                    out.x.origin[node(p)] -= e.kappa * dilatation * corner_sign(p, 0);
                    out.y.origin[node(p)] -= e.kappa * dilatation * corner_sign(p, 1);
                    out.z.origin[node(p)] -= e.kappa * dilatation * corner_sign(p, 2);
                }
            }
    return energy;
}

} // namespace asperity
