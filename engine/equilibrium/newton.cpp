// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/equilibrium/newton.hpp"

#include "engine/equilibrium/relaxation.hpp"

namespace asperity {

Newton::Newton(const SpectralBlock& block, const Preconditioner& preconditioner,
               const Scales& scales)
    : block_(block), preconditioner_(preconditioner),
      stiffness_(block.tile(), block.components(), RelaxationConstants::difference * scales.length),
      r_(block.new_waves<float>()), z_(block.new_waves<float>()), p_(block.new_waves<float>()),
      q_(block.new_waves<float>()) {}

bool Newton::direction(const Interface& interface, double reference_height, double forcing,
                       const Waves<double>& g, Waves<float>& d) {
    stiffness_.measure(interface, block_.lowest_layer(), block_.interface_force(),
                       reference_height);
    combine(-1.0, g, 0.0, r_);
    d.clear();
    double rz = advance(0.0, d);
    combine(1.0, z_, 0.0, p_);
    const double enough = forcing * forcing * rz;
    for (int i = 0; i < RelaxationConstants::most_products && rz > enough; ++i) {
        const double curvature = multiply();
        if (!(curvature > 0.0)) return false;
        const double next = advance(rz / curvature, d);
        combine(1.0, z_, next / rz, p_);
        rz = next;
    }
    return true;
}

double Newton::multiply() {
    block_.through_sites(
        p_, [&](int y, float* const* rows) { stiffness_.apply_row(y, rows); }, q_);
    const double n = block_.options().sites, norm = 1.0 / (n * n);
    RowSums sums(block_.slab(), 1);
#pragma omp parallel for schedule(static)
    for (int y = 0; y < p_.rows(); ++y) {
        block_.stiffen_row(y, p_, norm, q_);
        for (int c = 0; c < p_.components(); ++c)
            *sums.row(y) += row_dot(p_.row(c, y), q_.row(c, y), p_.slab().sites);
    }
    return sums.total()[0];
}

double Newton::advance(double a, Waves<float>& d) {
    RowSums sums(block_.slab(), 1);
#pragma omp parallel for schedule(static)
    for (int y = 0; y < r_.rows(); ++y) {
        for (int c = 0; c < r_.components(); ++c) {
            combine_row(a, p_.row(c, y), 1.0, d.row(c, y), r_.length());
            combine_row(-a, q_.row(c, y), 1.0, r_.row(c, y), r_.length());
        }
        preconditioner_.apply_row(y, r_, z_);
        for (int c = 0; c < r_.components(); ++c)
            *sums.row(y) += row_dot(r_.row(c, y), z_.row(c, y), r_.slab().sites);
    }
    return sums.total()[0];
}

double Newton::mean_stiffness(const Interface& interface, double reference_height) {
    return stiffness_.mean(interface, block_.lowest_layer(), block_.interface_force(),
                           reference_height, block_.communicator());
}

} // namespace asperity
