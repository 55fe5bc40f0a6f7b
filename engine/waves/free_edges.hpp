// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The stiffness of a surface with free edges (scene: surface.boundary = "free"): no periodic
// images.
//
// The displacement of sites on a square of N x N under forces F is that of an infinite lattice, u =
// sum g F. A periodic grid of M x M sites, M >= 2N (BlockOptions::grid()), gives the same
// displacement (Hockney; Stanley and Kato, J. Tribol. 119, 481 (1997), for contacts): g is cut at
// +-M/2 and repeated, and as long as no force acts on the sites outside the square, no image of a
// force is nearer to a site of the square than N. The block therefore has the stiffness S = 1/g^ on
// M x M sites. Sites outside the square have no interface and carry no force in equilibrium; their
// u has no meaning. g^ is positive for all waves, as for any stiffness.
//
// g is a sum of two parts. The far part is that of a half-space, 1/(pi E* r), with a smoothed core,
//
//     far(r) = erf(r/2s) / (pi E* r),      whose waves on the infinite lattice are
//     far^(q) = 2 erfc(s q) / (E* q a^2),
//
// without a remainder for s = 1.9 a. The near part, 1/S(q) - far^(q) with the lattice's S, decays
// as r^-3 and is computed wave by wave; its periodic images change displacements across the box by
// a relative 0.6/M^2.
//
// Layers and surface stress add K(q), the difference of 1/S with and without them, which decays as
// r^-3 times their thickness squared. Its long waves, K(q) G(q) with K along x and G = exp(-(q
// a/1.7)^6), belong to far,
//
//     far(r) += a^2 / (2 pi) integral of K(q) G(q) J0(q r) q over q from 0,
//
// and the remainder of K decays faster than r^-3.
//
// Displacements are relative to those at infinite distance, which corresponds to the top plane of a
// periodic block.
#pragma once

#include "decomposition/waves.hpp"
#include "engine/options/block_options.hpp"

#include <cstddef>
#include <vector>

namespace asperity {

/// Compliance of the waves of a surface with free edges.
class FreeEdges {
public:
    /// Computes the transform of the far field in the slabs of the grid.
    /// Collective.
    FreeEdges(const BlockOptions& block, const Slab& slab);

    /// Returns g^ at q = 2 pi (nx, ny) / (M a), 0 <= nx, ny <= M/2, Å^2/eV. This rank must hold the
    /// column nx or ny.
    double compliance(int nx, int ny) const;

private:
    /// Returns the place of a wave of this rank in far_.
    std::size_t at(int nx, int ny) const {
        return static_cast<std::size_t>(nx - slab_.first_column()) *
                   static_cast<std::size_t>(slab_.columns()) +
               static_cast<std::size_t>(ny);
    }
    /// Replaces the waves ny > nx of the far field by their mirror images. Collective.
    void mirror();
    /// Returns the near part, 1/S - far^, at these phases, Å^2/eV.
    double near(WavePhase x, WavePhase y, double phase) const;
    /// Returns far^ without K, Å^2/eV.
    double far_wave(double phase) const;
    /// Returns K G of a wave along x with this phase q a > 0, Å^2/eV.
    double added(double phase) const;
    /// Returns a^2 / (2 pi) times the integral of K(q) G(q) J0(q r) q at r = 0, t, 2t, ...,
    /// t = table_step spacings, to beyond the corner of the box, Å^2/eV.
    std::vector<double> added_far() const;
    double near_uniform() const;

    BlockOptions block_; ///< the block as a half-space
    BlockOptions plain_; ///< block_ without layers and surface stress
    bool has_added_;
    Slab slab_;
    /// Waves of the far field, [column of this rank][ny], ny = 0 .. M/2, Å^2/eV; real, because the
    /// field is even.
    std::vector<double> far_;
};

} // namespace asperity
