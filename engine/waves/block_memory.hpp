// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Memory of a viscoelastic block (docs/explanation/rate.md).
//
// The springs of the block, S, act in parallel with Maxwell branches: a spring r_k S in series with
// a dashpot of relaxation time tau_k. With w the displacement from the rigid top, and h_k that of
// branch k's spring,
//
//     force on the layer = -S (w + sum r_k h_k),        dh_k/dt = dw/dt - h_k/tau_k.
//
// Over a step dt, from w to w', let w be a parabola with second difference c, w(s) = w + d s/dt +
// c/2 (s/dt) (s/dt - 1), d = w' - w. Then, exactly,
//
//     h' = e h + b d + g c,    e = exp(-dt/tau),    b = (1 - e)/x,    x = dt/tau,
//     g = (x - (1 - e) (1 + x/2)) / x^2.
//
// A step that continues another step (dt0, over which w changed by d0) uses the parabola through
// all three places: c = p (d - rho d0), rho = dt/dt0, p = 2 rho/(1 + rho). The error of the step is
// then of order dt^4. The first step after w has changed direction has c = 0. In both cases the
// step is a static problem of stiffness (1 + sum r_k (b_k + p g_k)) S with the known force -S sum
// r_k (e_k h_k - (b_k + p g_k) w - p rho g_k d0). No factor depends on the wave; h, d0 and c0 (the
// c of the last step) are therefore kept at the sites.
//
// The error of a time step is estimated from the change of the second difference, c - rho^2 c0,
// since the step before: with y_k = g_k (c - rho^2 c0), as the energy sum r_k (|y_k|.|S h'_k| +
// y_k.(S y_k)/2). |.| is taken site by site, because w of a site that comes into contact has a
// kink, to which the h' of other sites do not contribute. If the third derivative of w is constant,
// the error of h' is half of y.
#pragma once

#include "decomposition/surface_transform.hpp"
#include "engine/energy/memory.hpp"
#include "engine/options/block_options.hpp"

#include <functional>
#include <vector>

namespace asperity {

/// Functions of their block that the branches call.
struct BranchedBlock {
    std::function<SiteField<double>()> shape; ///< returns the displacements w, Å
    /// Returns u.(S u) of a field u, S the relaxed stiffness.
    std::function<double(const SiteField<double>&)> square;
    /// Returns the sum over the sites of |a.(S b)| of two fields a and b.
    std::function<double(const SiteField<double>&, const SiteField<double>&)> product;
};

/// Extensions of the branches of a viscoelastic block, and their time step.
class BlockMemory : public Memory {
public:
    /// Makes relaxed branches. components: number of moving components of the displacement. Keeps a
    /// reference to the workspace.
    BlockMemory(const std::vector<Branch>& branches, const Slab& slab, int components,
                Workspace& workspace, BranchedBlock block);

    std::vector<RestoredArray> arrays() override;
    std::vector<RestoredArray> arrays_of_last_step() override;
    void begin(const TimeStep& step) override;
    void accept() override;
    StepEnergies energies() const override;
    std::size_t bytes() const override;

    /// Returns the relative increase of the stiffness in the step, sum r (b + p g).
    double stiffening() const;
    /// Returns the displacement field whose elastic force is the known force: sum r (e h - (b + p
    /// g) w - p rho g d0), Å.
    SiteField<double> known_force() const;
    /// Returns the extension h of a branch, Å, for writing.
    SiteField<double>& extension(std::size_t branch) { return h_[branch]; }
    /// Sets d0 and c0 to zero.
    void forget_last_step();

private:
    SiteField<double> new_field() const {
        return site_field<double>(slab_, components_, &workspace_);
    }
    /// Returns the weight p; 0 for a step that continues no other.
    double weight() const;
    /// Returns rho, the length of this step over that of the last.
    double ratio() const { return step_.dt / step_.last; }
    /// Computes the second difference c of a step by d.
    SiteField<double> second_difference(const SiteField<double>& d) const;

    std::vector<Branch> branches_;
    Slab slab_;
    int components_;
    Workspace& workspace_;
    BranchedBlock block_;
    std::vector<SiteField<double>> h_;       ///< extension of each branch, Å
    std::vector<SiteField<double>> history_; ///< d0, c0
    SiteField<double> w_;
    TimeStep step_; ///< dt and dt0
};

} // namespace asperity
