// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/run/interruptions.hpp"

#include "engine/run/stop_signals.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace asperity {

Interruption Interruptions::here() const {
    if (stop_signals::caught()) return Interruption::signal;
    if (!ranks_.root()) return Interruption::none;
    const double now = seconds();
    if (options_.wall_limit && now >= *options_.wall_limit) return Interruption::wall_limit;
    const bool due = checkpoint_ && now - last_checkpoint_ >= *checkpoint_;
    return due ? Interruption::checkpoint : Interruption::none;
}

Interruption Interruptions::now() const {
    return static_cast<Interruption>(std::lround(ranks_.max(static_cast<double>(here()))));
}

bool Interruptions::check_is_due() {
    if (--steps_to_check_ > 0) return false;
    // The root's clock decides how many steps are about half a second.
    constexpr double most = 1000.0;
    std::array<double, 1> stride = {1.0};
    if (ranks_.root()) {
        const double each = (seconds() - last_check_) / static_cast<double>(check_period_);
        stride[0] = std::clamp(
            std::floor(std::min(0.5, checkpoint_.value_or(0.5)) / std::max(each, 1e-9)), 1.0, most);
    }
    ranks_.broadcast(std::span<double>(stride));
    steps_to_check_ = check_period_ = static_cast<long long>(stride[0]);
    checked();
    return true;
}

} // namespace asperity
