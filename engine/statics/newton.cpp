// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/statics/newton.hpp"

#include "engine/statics/relaxation.hpp"

#include <utility>

namespace asperity {

Newton::Newton(const Response& block, const Preconditioner& preconditioner, const Scales& scales)
    : block_(block), preconditioner_(preconditioner),
      stiffness_(block.tile(), block.components(),
                 RelaxationConstants::stiffness_displacement * scales.length, block.workspace()),
      r_(block.new_waves<float>()), p_(block.new_waves<float>()), q_(block.new_waves<float>()) {}

bool Newton::direction(const Interface& interface, double forcing, const Waves<double>& g,
                       Waves<float>& d) {
    stiffness_.measure(interface, block_.lowest_layer(), block_.interface_force());
    combine(-1.0, g, 0.0, r_);
    d.clear();
    double rz = advance(0.0, d);
    double fraction = 0.0;
    const double enough = forcing * forcing * rz;
    for (int i = 0; i < RelaxationConstants::products_max && rz > enough; ++i) {
        const double curvature = multiply(fraction);
        if (!(curvature > 0.0)) return false;
        const double next = advance(rz / curvature, d);
        fraction = next / rz;
        rz = next;
    }
    return true;
}

double Newton::multiply(double fraction) {
    const double n = block_.slab().sites, norm = 1.0 / (n * n);
    OrderedSums sums(block_.slab(), OrderedSums::Over::blocks, 1);
    WaveBlocks<float> waves = block_.transform<float>().from_waves();
#pragma omp parallel for schedule(static) num_threads(waves.threads())
    for (int b = 0; b < p_.blocks(); ++b) {
        preconditioner_.apply(b, r_.block(b), fraction, p_.block(b));
        waves.put(b, p_.block(b));
    }
    SiteRows<float> rows = std::move(waves).to_rows();
#pragma omp parallel for schedule(static) num_threads(rows.threads())
    for (int y = 0; y < block_.slab().rows; ++y) {
        stiffness_.apply_row(y, rows.get(y));
        rows.put(y);
    }
    const WaveBlocks<float> hessian_p = std::move(rows).to_blocks(); // N^2 H p
#pragma omp parallel for schedule(static) num_threads(hessian_p.threads())
    for (int b = 0; b < p_.blocks(); ++b) {
        block_.stiffen<float>(b, p_.block(b), norm, hessian_p.get(b), q_.block(b));
        *sums.part(b) = dot_of_block(b, p_, q_);
    }
    return sums.total()[0];
}

double Newton::advance(double a, Waves<float>& d) {
    const int length = static_cast<int>(r_.length()), rows = r_.components() * r_.slab().sites;
    OrderedSums sums(block_.slab(), OrderedSums::Over::blocks, 1);
    const SurfaceTransform<float>& by = block_.transform<float>();
#pragma omp parallel for schedule(static) num_threads(by.threads())
    for (int b = 0; b < r_.blocks(); ++b) {
        combine_row(a, p_.block(b), 1.0, d.block(b), length);
        combine_row(-a, q_.block(b), 1.0, r_.block(b), length);
        // z is not kept: to make it again from r takes less time than to write it and to read it.
        float* const z = by.room();
        preconditioner_.apply(b, r_.block(b), 0.0, z);
        *sums.part(b) = block_dot(r_.block(b), z, rows, r_.slab().weights(b).data());
    }
    return sums.total()[0];
}

double Newton::mean_stiffness(const Interface& interface) {
    return stiffness_.mean(interface, block_.lowest_layer(), block_.interface_force(),
                           block_.communicator());
}

} // namespace asperity
