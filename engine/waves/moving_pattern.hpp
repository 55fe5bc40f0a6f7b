// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A displacement that moves past a viscoelastic block without changing its shape, w = W(x + v t):
// the steady state of a smooth slide over a wall.
//
// Each wave of the displacement oscillates with omega = q_x v, as do the extensions of the branches
// (block_memory.hpp):
//
//     h_k = m_k w,     m_k = i omega tau_k/(1 + i omega tau_k),     force on the layer = -m S w,
//
// m = 1 + sum r_k m_k: the block responds with the complex modulus at the wave's frequency, and the
// shape W balances this response with the interface. As m is complex, the balance is not the
// minimum of an energy. It is found by iteration: with the real stiffness C S and the known force
// -S (m - C) w of the last shape, the next shape is a minimum. Over a purely repulsive wall each
// iteration (a "turn") reduces the distance from the balance by |1 - m/C| or more. The smallest
// such factor is the sine of the loss angle, at C = |m|^2/Re m.
#pragma once

#include "engine/options/block_options.hpp"

#include <complex>
#include <cstddef>
#include <vector>

namespace asperity {

/// Moduli of the waves of a moving pattern, relative to the relaxed block.
class MovingPattern {
public:
    /// Computes the moduli. axis: 0 for x, 1 for y; velocity: velocity of the pattern along the
    /// axis, Å/fs, with sign.
    MovingPattern(const BlockOptions& block, int axis, double velocity);

    int axis() const { return axis_; } ///< returns 0 for x, 1 for y
    /// Returns C of the waves 0 .. N-1 along the axis.
    const std::vector<double>& stiffening() const { return stiffening_; }
    /// Returns C of a wave, 0 <= nx, ny < N.
    double stiffening(int nx, int ny) const {
        return stiffening_[static_cast<std::size_t>(axis_ == 0 ? nx : ny)];
    }
    using Factors = std::vector<std::complex<double>>;
    /// Returns m - C of the waves 0 .. N-1 along the axis.
    Factors remainder() const;
    /// Returns m_k of branch k for these waves.
    const Factors& of_branch(std::size_t k) const { return branches_[k]; }
    /// Returns the number of branches.
    std::size_t branches() const { return branches_.size(); }

private:
    int axis_;
    std::vector<Factors> branches_;
    Factors modulus_; ///< m
    std::vector<double> stiffening_;
};

} // namespace asperity
