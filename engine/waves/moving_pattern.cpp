// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/waves/moving_pattern.hpp"

#include <numbers>

namespace asperity {

MovingPattern::MovingPattern(const BlockOptions& block, int axis, double velocity) : axis_(axis) {
    const int n = block.sites;
    const double unit = 2.0 * std::numbers::pi / (n * block.spacing);
    modulus_.assign(static_cast<std::size_t>(n), 1.0);
    for (const Branch& branch : block.branches) {
        Factors factors;
        for (int k = 0; k < n; ++k) {
            const double x = unit * (2 * k > n ? k - n : k) * velocity * branch.time;
            const std::complex<double> follows =
                std::complex<double>(x * x, x) / (1.0 + x * x); // i x/(1 + i x)
            // The shortest wave has no sign: it takes the mean of both.
            factors.push_back(2 * k == n ? follows.real() : follows);
            modulus_[static_cast<std::size_t>(k)] += branch.ratio * factors.back();
        }
        branches_.push_back(std::move(factors));
    }
    for (const std::complex<double>& m : modulus_)
        stiffening_.push_back(std::norm(m) / m.real());
}

MovingPattern::Factors MovingPattern::remainder() const {
    Factors remainder = modulus_;
    for (std::size_t k = 0; k < remainder.size(); ++k)
        remainder[k] -= stiffening_[k];
    return remainder;
}

} // namespace asperity
