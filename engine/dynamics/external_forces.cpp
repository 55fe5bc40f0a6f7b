// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/dynamics/external_forces.hpp"

#include "decomposition/global_sum.hpp"

#include <array>

namespace asperity {

void ExternalForces::add_to(Block& block) {
    const VectorPlane<double> to = block.interface_force();
    const VectorPlane<const double> from = field_->plane(0);
    for (int y = 0; y < to.x.ny; ++y)
        for (int x = 0; x < to.x.nx; ++x) {
            to.x(x, y) += from.x(x, y);
            to.y(x, y) += from.y(x, y);
            to.z(x, y) += from.z(x, y);
        }
    before_ = power(block);
}

ExactSum ExternalForces::power(const Block& block) const {
    const VectorPlane<const double> f = field_->plane(0);
    const VectorPlane<const double> v = block.levels().front().v.plane(0);
    ExactSum power;
    for (int y = 0; y < f.x.ny; ++y) {
        for (int x = 0; x < f.x.nx; ++x)
            power.add(f.x(x, y) * v.x(x, y) + f.y(x, y) * v.y(x, y) + f.z(x, y) * v.z(x, y));
        power.carry();
    }
    return power;
}

double ExternalForces::work_of_step(const Communicator& ranks, double dt) {
    const auto [before, after] = global_sums(ranks, std::array{before_, after_});
    const double work = 0.5 * dt * (before + pending_);
    pending_ = after;
    before_ = after_ = {};
    return work;
}

} // namespace asperity
