// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// (S + k)^-1 of every wave, in single precision: approximate inverse of the stiffness of block and
// interface, for relaxations.
#pragma once

#include "engine/waves/response.hpp"

#include <vector>

namespace asperity {

/// Table of (S + k)^-1 of the waves of this rank.
class Preconditioner {
public:
    /// Computes (S + k)^-1 with the acting stiffness S of a block (Response::acting_stiffness()).
    /// k: mean stiffness of the interface per site, eV/Å^2, above 0. The entry of the uniform
    /// normal wave is zero if the mean height is prescribed.
    Preconditioner(const Response& block, double k);
    /// Recomputes the table with another k, eV/Å^2.
    void tune(const Response& block, double k);
    double k() const { return k_; } ///< returns k, eV/Å^2
    /// Sets `to` to (S + k)^-1 from + fraction to, for this rank's block b of waves; `to` may be
    /// `from`.
    void apply(int b, const float* from, double fraction, float* to) const;
    /// Replaces block b of waves by (S + k)^-1 of them.
    void operator()(int b, float* waves) const { apply(b, waves, 0.0, waves); }

private:
    TableLayout layout_;
    std::vector<float> table_; ///< Å^2/eV
    double k_ = 0.0;
};

} // namespace asperity
