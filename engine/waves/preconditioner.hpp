// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// (S + k)^-1 of every wave, in single precision: what relaxations take for the inverse of the
// block's and the interface's stiffness together.
#pragma once

#include "engine/waves/response.hpp"

#include <vector>

namespace asperity {

class Preconditioner {
public:
    /// Computes (S + k)^-1 of a block as it acts (Response::acting_stiffness()); k > 0, eV/Å^2,
    /// stands for the interface's stiffness of a site. The entry of the uniform normal wave is zero
    /// if the mean height is held.
    Preconditioner(const Response& block, double k);
    /// Computes the matrices anew with another k.
    void tune(const Response& block, double k);
    double k() const { return k_; }
    /// Sets `to` to (S + k)^-1 from + fraction to, for block b; the two may be the same.
    void apply(int b, const float* from, double fraction, float* to) const;

private:
    TableLayout layout_;
    int first_block_;
    std::vector<float> table_; ///< Å^2/eV
    double k_ = 0.0;
};

} // namespace asperity
