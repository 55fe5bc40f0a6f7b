// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What the last steps of a descent have told of the curvature: limited-memory BFGS (Nocedal, Math.
// Comp. 35, 773, 1980) whose first guess of the inverse Hessian is the preconditioner P.
//
// The textbook's two loops walk over the pairs (s, y), s a step, y the change of the gradient, with
// an inner product at each stop. Here the vectors are looked at twice an iteration and never again:
// with w = P y kept in place of y, the direction is a combination of z = P g, the s and the w,
//
//     d = -z + sum_j alpha_j w_j - sum_j (alpha_j - beta_j) s_j,
//
// and the two loops run on numbers: s.y and y.w of the pairs, s.g and w.g of the present gradient.
// Those of a new pair, y = g - g_before, are differences of s.g and w.g from this look and the one
// before; so g_before itself is not kept either. One pass takes all inner products, one makes d.
//
// Both passes cost what it takes to read the pairs, so these are kept to two bytes a number: wave
// by wave they are good to 1/256 of themselves, which is better than the model behind them.
#pragma once

#include "engine/block/spectral_block.hpp"

#include <deque>
#include <vector>

namespace asperity {

class CurvatureMemory {
public:
    CurvatureMemory(const SpectralBlock& block, const Preconditioner& preconditioner,
                    std::size_t pairs);

    /// Looks at the gradient. Returns g.g.
    double look(const Waves<double>& g);
    /// The same where a step t d has led here since the last look, and the slope d.g was
    /// slope_before there. What is learnt is left out where the energy curves down along d.
    double learn(const Waves<double>& g, double t, const Waves<float>& d, double slope_before);
    /// d <- -H g with H the inverse Hessian as far as it is known and g as last looked at.
    void direction(Waves<float>& d) const;
    /// d.g at the end of the step last learnt from.
    double slope() const { return slope_; }
    void forget() { pairs_.clear(); }
    bool empty() const { return pairs_.empty(); }
    std::size_t bytes() const;

private:
    struct Pair {
        Waves<ShortFloat> s, w;
        double sg = 0.0, wg = 0.0;  ///< at the last look
        double rho = 0.0;           ///< 1 / s.y
        double yw = 0.0;            ///< y.w
        std::vector<double> sy, wy; ///< of each older pair's s and w with this y
    };
    Pair make_pair();

    const SpectralBlock& block_;
    const Preconditioner& preconditioner_;
    std::size_t limit_;
    std::deque<Pair> pairs_; ///< oldest first
    std::vector<Pair> spare_;
    Waves<float> z_;  ///< P g
    double gz_ = 0.0; ///< g.z
    double slope_ = 0.0;
};

} // namespace asperity
