// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/statics/heavy_ball.hpp"

#include "engine/statics/relaxation.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace asperity {

HeavyBall::HeavyBall(Response& block)
    : block_(block), momentum_(block.new_field<float>()), step_sizes_(block.new_map<float>()) {
    const PlaneView<float> step_size = step_sizes_.plane(0);
    for (int y = 0; y < step_size.ny; ++y)
        std::fill(step_size.line(y), step_size.line(y) + step_size.nx, 1.0f);
}

double HeavyBall::move(const Preconditioner& preconditioner, double move_max) {
    using Constants = RelaxationConstants;
    const HeavyBallRule rule{.momentum_decay = Constants::momentum_decay,
                             .step_cut = Constants::step_cut,
                             .step_growth = Constants::step_growth,
                             .step_size_max = Constants::step_size_max,
                             .move_max = static_cast<float>(move_max)};
    const int components = block_.components();
    const PlaneView<float> step_size = step_sizes_.plane(0);
    std::vector<float> of_row(static_cast<std::size_t>(step_size.ny));
    const SiteRows<float> targets = block_.respond(preconditioner.k(), std::cref(preconditioner));
#pragma omp parallel for schedule(static) num_threads(targets.threads())
    for (int y = 0; y < step_size.ny; ++y) {
        const float* const* target = targets.get(y);
        HeavyBallRow row{};
        for (int c = 0; c < components; ++c) {
            row.target[c] = target[c];
            row.momentum[c] = momentum_[static_cast<std::size_t>(c)].plane(0).line(y);
            row.u[c] = block_.moving_layer(c).line(y);
        }
        row.step_size = step_size.line(y);
        of_row[static_cast<std::size_t>(y)] = heavy_ball_row(row, rule, components, step_size.nx);
    }
    const double longest = *std::max_element(of_row.begin(), of_row.end());
    block_.restore_mean_height();
    return std::sqrt(block_.communicator().max(longest));
}

void HeavyBall::stop() { momentum_ = block_.new_field<float>(); }

} // namespace asperity
