// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The stiffness of a surface with free edges (scene: surface.boundary = "free"): no periodic
// images.
//
// Sites on a square of N x N answer a force F as those of an infinite lattice do, u = sum g F. The
// waves of a grid of 2N x 2N sites have this answer too (Hockney; Stanley and Kato, J. Tribol. 119,
// 481 (1997), for contacts): g is kept within +-N and repeated beyond, and as long as no force acts
// on the sites outside the square, no image of a force is nearer to a site of the square than N. So
// the block has the stiffness S = 1/g^ on 2N x 2N sites, and the sites outside the square have no
// law. In force balance they carry no force; what u is there means nothing. g^ is positive for all
// waves, as a stiffness is.
//
// g is a sum of two parts. Far away it is that of a half-space, 1/(pi E* r); with the core
// smoothed,
//
//     far(r) = erf(r/2s) / (pi E* r),      whose waves on the infinite lattice are
//     far^(q) = 2 erfc(s q) / (E* q a^2),
//
// without a remainder for s = 1.9 a. The rest, 1/S(q) - far^(q) with the lattice's S, falls as r^-3
// and is taken wave by wave: it repeats, which changes displacements across the box by 0.15/N^2 of
// themselves.
//
// Layers and surface stress add K(q) = 1/S - 1/S of the block's own material, which reaches as far
// as r^-3 times their thickness squared. Its long waves, K(q) G(q) with K along x and
// G = exp(-(q a/1.7)^6), belong to far,
//
//     far(r) += a^2 / (2 pi) integral of K(q) G(q) J0(q r) q over q from 0,
//
// and what is left of K falls faster than r^-3.
//
// Displacements are measured from those far away, where the top plane of a periodic block is.
#pragma once

#include "decomposition/waves.hpp"
#include "engine/options/block_options.hpp"

#include <vector>

namespace asperity {

/// Compliance of the waves of a surface with free edges.
class FreeEdges {
public:
    /// Transforms the far field on this rank. grid: number of sites along an edge of the grid, 2N.
    FreeEdges(const BlockOptions& block, int grid);

    /// Returns g^ at q = 2 pi (nx, ny) / (2N a), 0 <= nx, ny <= N, Å^2/eV.
    double compliance(int nx, int ny) const;

private:
    /// Returns 1/S - far^ at these phases, Å^2/eV.
    double near(WavePhase x, WavePhase y, double phase) const;
    /// Returns far^ without K, Å^2/eV.
    double far_wave(double phase) const;
    /// Returns K G of a wave along x with this phase q a > 0, Å^2/eV.
    double added(double phase) const;
    /// Returns a^2 / (2 pi) times the integral of K(q) G(q) J0(q r) q at r = 0, t, 2t, ...,
    /// t = table_step spacings, to beyond the corner of the box, Å^2/eV.
    std::vector<double> added_far() const;
    double near_uniform() const;

    BlockOptions block_; ///< a block without an end above
    BlockOptions plain_; ///< the same without layers and surface stress
    bool has_added_;
    int grid_;
    Waves<double> far_; ///< Å^2/eV
};

} // namespace asperity
