// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// S(q): static stiffness of the elastic block at its lowest layer (docs/explanation/model.md).
//
// The lowest layer of a lattice of `thickness` cells, its top plane clamped, responds to a static
// plane wave u exp(i q r) with the force -S(q) u, all other layers being at equilibrium. S follows
// layer by layer from the top. With a, d the matrices of a single layer of cells for its lower and
// its upper plane, and b the one between them,
//
//     S_1 = a,      S_(k+1) = a - b (d + S_k)^-1 b^T,      S = S_thickness.
//
// In a block of layers each cell has the a, b and d of its material; a plane between two materials
// has a of the material above and d of the material below.
//
// Six real numbers suffice. The stencil (elastic_cell.hpp) is even in x and y within the plane
// components and within z, and odd where it couples z with x or y: its filters are cosines, sin
// sin, or i sin. With w = i u_z in place of u_z there are no i's: for the pair (x, w)
//
//     F_x = A (i u_z(z+1) - i u_z(z-1)) = A (w(z+1) - w(z-1)),
//     F_w = i F_z = -A (x(z+1) - x(z-1)),
//
// A = 2 sin p_x (out_r + 2 out_rd cos p_y). So a, b, d are real, a and d symmetric, and the
// recursion keeps S real and symmetric in (x, y, w). In (x, y, z): S_xz = i xz, S_zx = -i xz,
// hermitian. Signs: xy is odd in both of p_x, p_y, xz odd in p_x, yz odd in p_y; x and y may be
// exchanged. Therefore an eighth of the Brillouin zone suffices, and the couplings vanish with the
// sines (on the Nyquist lines and the axes).
//
// The contribution of layers deeper than a few wavelengths decays like exp(-2 q depth): the
// recursion ends when further layers add nothing, so a whole table costs little more than its short
// waves.
#pragma once

#include "kernels/elastic_cell.hpp"

#include <span>

namespace asperity {

/// Layer of cells of one material.
struct CellLayer {
    CellElasticity elasticity;
    int cells = 0; ///< thickness in cells of edge a
};

/// A real symmetric matrix on (u_x, u_y, i u_z); a stiffness is in eV/Å^2 per site.
struct SurfaceMatrix {
    double xx = 0.0, yy = 0.0, zz = 0.0;
    double xy = 0.0, xz = 0.0, yz = 0.0;
};

/// Cosine and sine of a phase 2 pi n / sites across one cell, 0 <= n <= sites / 2. The sine is
/// exactly zero on the Nyquist line.
struct WavePhase {
    double cosine = 1.0, sine = 0.0;
};
/// Returns the phase of wave n on `sites` sites.
WavePhase wave_phase(int n, int sites);

/// Returns S at the phases along x and y, eV/Å^2. layers: in the order from the lowest plane
/// upwards; the plane above the last layer is clamped. The uniform mode (both sines zero and both
/// cosines one) is exact: the layers are springs in series, each with mu a / cells for shear and
/// (lambda + 2 mu) a / cells normally.
SurfaceMatrix surface_stiffness(std::span<const CellLayer> layers, WavePhase x, WavePhase y);

/// Returns the inverse of a positive matrix.
ASPERITY_INLINE SurfaceMatrix inverse(const SurfaceMatrix& s) {
    const double x = s.yy * s.zz - s.yz * s.yz; // cofactors
    const double y = s.xx * s.zz - s.xz * s.xz;
    const double z = s.xx * s.yy - s.xy * s.xy;
    const double xy = s.xz * s.yz - s.xy * s.zz;
    const double xz = s.xy * s.yz - s.xz * s.yy;
    const double yz = s.xy * s.xz - s.yz * s.xx;
    const double scale = 1.0 / (s.xx * x + s.xy * xy + s.xz * xz);
    return {scale * x, scale * y, scale * z, scale * xy, scale * xz, scale * yz};
}

} // namespace asperity
