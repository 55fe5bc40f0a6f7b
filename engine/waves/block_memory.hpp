// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What a block that relaxes remembers (docs/explanation/rate.md).
//
// Beside the springs of the block, S, stand branches of Maxwell type: a spring r_k S in series with
// a dashpot of relaxation time tau_k. With w the displacement from the rigid top, and h_k that of
// branch k's spring,
//
//     force on the layer = -S (w + sum r_k h_k),        dh_k/dt = dw/dt - h_k/tau_k.
//
// In a step dt, over which w goes evenly to w', this is exactly
//
//     h' = e h + b (w' - w),    e = exp(-dt/tau),    b = (1 - e) tau/dt,
//
// so that the step is a static problem of stiffness (1 + sum r_k b_k) S beside a force that is
// known, -S sum r_k (e_k h_k - b_k w). No factor depends on the wave: h is kept at the sites.
#pragma once

#include "decomposition/surface_transform.hpp"
#include "engine/block/block.hpp"

#include <functional>
#include <limits>
#include <vector>

namespace asperity {

/// Of the branches, eV.
struct BranchEnergies {
    double stored = 0.0;
    double dissipated = 0.0; ///< in the step under way
};

class BlockMemory {
public:
    BlockMemory(const std::vector<Branch>& branches, const Slab& slab, int components);

    /// From where the sites stand, w, with all that is remembered, a step of dt begins. An infinite
    /// one leaves nothing of it.
    void begin(SiteField<double> w, double dt);
    /// The sum of r b: what the stiffness grows by.
    double stiffening() const;
    /// The sum of r (e h - b w), which stands for the known force.
    SiteField<double> known() const;
    /// Where the sites have come to w'; square: of a field u.(S u), S the relaxed stiffness.
    using Square = std::function<double(const SiteField<double>&)>;
    BranchEnergies energies(const SiteField<double>& to, const Square& square) const;
    /// The step ends there.
    void end(SiteField<double> to);

    /// h of each branch: all that is to be kept.
    std::vector<SiteField<double>>& extensions() { return h_; }
    const std::vector<SiteField<double>>& extensions() const { return h_; }
    std::size_t bytes() const;

private:
    SiteField<double> new_field() const { return site_field<double>(slab_, components_); }

    std::vector<Branch> branches_;
    Slab slab_;
    int components_;
    std::vector<SiteField<double>> h_;
    SiteField<double> w_;
    double dt_ = std::numeric_limits<double>::infinity();
};

} // namespace asperity
