// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "kernels/elastic_cell.hpp"

namespace asperity {

Stencil make_stencil(CellElasticity e, Face face) {
    const double w = face == Face::inner ? 2.0 : 1.0;
    const double tau = face == Face::lower ? 1.0 : face == Face::upper ? -1.0 : 0.0;
    const double k = e.k, kappa = e.kappa;
    Stencil s{};
    s.own_c = -w * (4.0 * kappa + 3.0 * k);
    s.own_e = w * (2.0 * kappa + 0.5 * k);
    s.own_t = -w * 2.0 * kappa;
    s.own_d = w * (kappa + 0.25 * k);
    s.own_xy = w * (kappa + 0.25 * k);
    s.out_c = -4.0 * kappa;
    s.out_e = 2.0 * kappa + 0.5 * k;
    s.out_t = -2.0 * kappa;
    s.out_d = kappa;
    s.out_xy = kappa;
    s.normal_c = -w * (4.0 * kappa + 3.0 * k);
    s.normal_e = -w * 2.0 * kappa;
    s.normal_d = -w * kappa;
    s.out_normal_c = 4.0 * kappa + k;
    s.out_normal_e = 2.0 * kappa + 0.5 * k;
    s.out_normal_d = kappa;
    s.out_r = 2.0 * kappa + 0.5 * k;
    s.out_rd = kappa;
    s.tau_r = tau * 2.0 * kappa;
    s.tau_rd = tau * kappa;
    s.above = face == Face::upper ? 0.0 : 1.0;
    s.below = face == Face::lower ? 0.0 : 1.0;
    return s;
}

} // namespace asperity
