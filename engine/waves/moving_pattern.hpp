// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A displacement that moves past a viscoelastic block without changing its shape, w = W(x + v t):
// what a smooth slide over a wall comes to.
//
// Each of its waves oscillates, with omega = q_x v, and so do the extensions of the branches
// (block_memory.hpp):
//
//     h_k = m_k w,     m_k = i omega tau_k/(1 + i omega tau_k),     force on the layer = -m S w,
//
// m = 1 + sum r_k m_k: the block answers with the complex modulus of the wave's frequency, and the
// shape W is an equilibrium of its own. m is no real stiffness, so no energy has a minimum there.
// The equilibrium is found in turns: with the real stiffness C S and the known force -S (m - C) w
// of the last shape, the next one is a minimum. Over a wall that only repels the distance from the
// equilibrium falls in each turn by |1 - m/C| or more. The smallest such factor is the sine of the
// loss angle, at C = |m|^2/Re m.
#pragma once

#include "engine/options/block_options.hpp"

#include <complex>
#include <cstddef>
#include <vector>

namespace asperity {

/// Moduli of the waves of a moving pattern, relative to the relaxed block.
class MovingPattern {
public:
    /// Computes the moduli. velocity: along axis 0 (x) or 1 (y), Å/fs, with its sign.
    MovingPattern(const BlockOptions& block, int axis, double velocity);

    int axis() const { return axis_; }
    /// Returns C of the waves 0 .. N-1 along the axis.
    const std::vector<double>& stiffening() const { return stiffening_; }
    /// Returns C of a wave, 0 <= nx, ny < N.
    double stiffening(int nx, int ny) const {
        return stiffening_[static_cast<std::size_t>(axis_ == 0 ? nx : ny)];
    }
    using Factors = std::vector<std::complex<double>>;
    /// Returns m - C of the waves 0 .. N-1 along the axis.
    Factors rest() const;
    /// Returns m_k of branch k for these waves.
    const Factors& of_branch(std::size_t k) const { return branches_[k]; }
    std::size_t branches() const { return branches_.size(); }

private:
    int axis_;
    std::vector<Factors> branches_;
    Factors modulus_; ///< m
    std::vector<double> stiffening_;
};

} // namespace asperity
