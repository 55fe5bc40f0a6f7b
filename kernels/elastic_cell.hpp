// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The stencil of the elastic block for small strain (docs/explanation/model.md).
//
// The energy is a sum over cubic cells of edge s with eight corners,
//
//   U_cell = sum_edges 1/2 (k/4) (e.du)^2 + sum_face-diagonals 1/2 (k/2) (e.du)^2
//            + 1/2 (lambda - mu) s^3 theta^2,      k = mu s,
//   theta  = 1/(4s) sum_corners sigma_p . u_p,
//
// and each level of the block is a stack of such cells. The force on a node is linear in the
// displacements of the 27 nodes around it. It is separable. With, at every (x, y),
//
//   u   the node's own plane,   P = u(z+1) + u(z-1),   M = u(z+1) - u(z-1),
//
// and the lateral filters
//
//   c  = f(0,0)        ex = f(1,0) + f(-1,0)    rx  = f(1,0) - f(-1,0)       (ey, ry alike)
//   d  = sum of the four diagonal neighbours    rxy = f(1,1)+f(-1,-1)-f(1,-1)-f(-1,1)
//   rxd = sum over y = +-1 of f(1,y) - f(-1,y)  (ryd alike)
//
// the force is, with kappa = (lambda - mu) s / 16 and w = 2 inside the level,
//
//   Fx = [own_c c + own_e ex + own_t ey + own_d d](ux)  + own_xy rxy(uy)
//      + [out_c c + out_e ex + out_t ey + out_d d](Px)  + out_xy rxy(Py)
//      + [out_r rx + out_rd rxd](Mz) - [tau_r rx + tau_rd rxd](uz)
//   Fz = [normal_..](uz) + [out_normal_..](Pz)
//      + [out_r rx + out_rd rxd](Mx) + [tau_r rx + tau_rd rxd](ux) + the same with ry, ryd of y
//
// A level's lowest plane has cells above it only: w = 1, tau = +1, P = M = u(z+1); its upper plane
// has cells below it only: w = 1, tau = -1, P = u(z-1), M = -u(z-1). A surface has no other special
// terms: its springs have the strength that their own cells give them.
//
// The sums over x come last: the column of 3 x 3 nodes at x (over y and z) contributes to each
// force component a part for x, one for x - 1 and one for x + 1. A pack of columns is read with 27
// aligned loads and reduced to these nine parts (72 operations). A buffer in the first-level cache
// holds the parts of a stretch of a row, and the outer parts are read from the buffer shifted by
// one element, so that no value is loaded twice for its x neighbours. With AVX-512, registers hold
// the parts instead if the level is read from memory.
#pragma once

#include "kernels/exact_sum.hpp"
#include "kernels/views.hpp"

namespace asperity {

/// Elastic constants of one level.
struct CellElasticity {
    double k = 0.0;     ///< spring constant mu s, eV/Å^2
    double kappa = 0.0; ///< (lambda - mu) s / 16, eV/Å^2
    bool operator==(const CellElasticity&) const = default;
};

/// Cells that a plane of nodes belongs to: above it (lower face), on both sides, or below it.
enum class Face { lower, inner, upper };

/// Coefficients of the formulae above for one kind of plane, eV/Å^2.
struct Stencil {
    double own_c, own_e, own_t, own_d, own_xy; // in-plane displacement components, own plane
    // In-plane components, sum of the planes above and below.
    double out_c, out_e, out_t, out_d, out_xy;
    double normal_c, normal_e, normal_d;             // uz -> Fz, own plane
    double out_normal_c, out_normal_e, out_normal_d; // uz -> Fz, planes above and below
    double out_r, out_rd;                            // shear coupling with M
    double tau_r, tau_rd;                            // shear coupling with the own plane (surfaces)
    double above, below;                             // 1 if there are cells on that side, else 0
};

/// Computes the coefficients for one kind of plane.
Stencil make_stencil(CellElasticity elasticity, Face face);

/// Coefficients of the kick of a node, v <- velocity_factor v + kick F. The drift u <- u + dt v
/// follows once no other force needs the old displacement (leapfrog, i.e. velocity Verlet with
/// merged half kicks). velocity_factor < 1 and drag_z describe damping against a medium that moves
/// with the top plane.
struct Kick {
    double velocity_factor = 1.0;
    double kick = 0.0;      ///< dt/m / (1 + Gamma dt/2), Å/fs per eV/Å
    double drag_z = 0.0;    ///< term added to v_z: Gamma dt V / (1 + Gamma dt/2), Å/fs
    double half_mass = 0.0; ///< m/2, for the kinetic energy, eV fs^2/Å^2
    double medium_z = 0.0;  ///< V, for the dissipated energy, Å/fs
    bool damped = false;    ///< sum the dissipated energy
    bool observed = false;  ///< sum the kinetic energy at the whole step
    double drag = 0.0;      ///< Gamma m dt, for the dissipated energy, eV fs^2/Å^2
    double per_force = 0.0; ///< -dt^2 / 8m, for the energy of the time step, Å^2/eV
};

/// Sums of a kick at the whole step n, v_n = (v_{n-1/2} + v_{n+1/2}) / 2.
struct KickSums {
    ExactSum kinetic;    ///< sum of m v_n^2 / 2, eV (observed planes)
    ExactSum of_step;    ///< sum of -dt^2 F_n^2 / 8m, eV (observed planes)
    ExactSum dissipated; ///< sum of m Gamma dt |v_n - V|^2, eV (damped planes)
    /// Sum of m Gamma dt (v_n - V)_z, eV fs/Å (damped planes): momentum given to the medium.
    ExactSum dragged;

    /// Adds the sums of other nodes.
    void merge(const KickSums& other) {
        kinetic.merge(other.kinetic);
        of_step.merge(other.of_step);
        dissipated.merge(other.dissipated);
        dragged.merge(other.dragged);
    }
};

/// Rectangle of nodes [x0, x1) x [y0, y1) of a tile.
struct Patch {
    int x0, x1, y0, y1;
};

} // namespace asperity
