// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The elastic block at finite strain (docs/explanation/model.md): the same cells as
// elastic_cell.hpp, with the springs' true lengths and the true volume,
//
//   U_cell = sum_edges 1/2 (k/4) (|r| - s)^2 + sum_face-diagonals 1/2 (k/2) (|r| - sqrt(2) s)^2
//            + 1/2 (lambda - mu) s^3 theta^2,
//   theta  = det F - 1,   F_ij = delta_ij + (1/4s) sum_corners sigma_pj u_pi,
//
// r the vector between a spring's ends. To second order in u this is the energy of
// elastic_cell.hpp.
//
// A spring pulls a node with t r, t = k (1 - r0/|r|); the force on a corner p is
//
//   F_p = -4 s kappa theta cof(F) sigma_p,   kappa = (lambda - mu) s / 16.
//
// Each inner spring is shared by four cells (edges) or two (diagonals) and is computed once, at
// full strength; springs in a surface belong to half as many cells and have half the strength. A
// cell owns the nine springs that leave its lower corner or cross the three faces at this corner.
// The computation goes by rows of cells: a row adds its forces to those of earlier rows on the four
// rows of nodes around it. A node's force is therefore a sum in a fixed order: transferred force;
// cells below, then above; in both, cells at smaller y, then larger y.
//
// Forces on a plane are complete once the cells above the plane are done: the computation goes
// upwards plane by plane through a band of rows and passes the incomplete forces on the plane above
// to the next plane. Rows of cells on the border of two bands are computed twice.
#pragma once

#include "kernels/elastic_level.hpp"
