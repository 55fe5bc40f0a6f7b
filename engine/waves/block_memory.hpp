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
#include "engine/options/block_options.hpp"
#include "engine/units.hpp"

#include <functional>
#include <vector>

namespace asperity {

/// Energies of the branches, eV.
struct BranchEnergies {
    double stored = 0.0;     ///< energy stored in the branches' springs
    double dissipated = 0.0; ///< energy dissipated in the current step
    double error = 0.0;      ///< error of the time step
};

/// Extensions of the branches of a viscoelastic block, and their time step.
class BlockMemory {
public:
    /// Makes relaxed branches. components: number of moving components of the displacement. Keeps a
    /// reference to the workspace.
    BlockMemory(const std::vector<Branch>& branches, const Slab& slab, int components,
                Workspace& workspace);

    /// Begins a time step dt, fs, from the displacements w, Å. In an infinite step the branches
    /// relax completely. last: length of the step that this one continues, fs; infinite if it
    /// continues none.
    void begin(SiteField<double> w, double dt, double last);
    /// Returns the relative increase of the stiffness in the step, sum r (b + p g).
    double stiffening() const;
    /// Returns the displacement field whose elastic force is the known force: sum r (e h - (b + p
    /// g) w - p rho g d0), Å.
    SiteField<double> known_force() const;
    /// Function that returns u.(S u) of a field u, S the relaxed stiffness.
    using Square = std::function<double(const SiteField<double>&)>;
    /// Function that returns the sum over the sites of |a.(S b)| of two fields a and b.
    using Product = std::function<double(const SiteField<double>&, const SiteField<double>&)>;
    /// Returns the energies of the branches if the step ends at w' = `to`, Å.
    BranchEnergies energies(const SiteField<double>& to, const Square& square,
                            const Product& product) const;
    /// Ends the step at w' = `to`, Å.
    void end(SiteField<double> to);

    /// Returns the extensions h of each branch, Å.
    std::vector<SiteField<double>>& extensions() { return h_; }
    const std::vector<SiteField<double>>& extensions() const { return h_; }
    /// Returns d0 and c0 of the last step, Å, which the next step needs with the extensions.
    std::vector<SiteField<double>>& history() { return history_; }
    const std::vector<SiteField<double>>& history() const { return history_; }
    std::size_t bytes() const; ///< returns the memory of the fields, bytes

private:
    SiteField<double> new_field() const {
        return site_field<double>(slab_, components_, &workspace_);
    }
    /// Returns the weight p; 0 for a step that continues no other.
    double weight() const;
    /// Returns rho, the length of this step over that of the last.
    double ratio() const { return dt_ / last_; }
    /// Computes the second difference c of a step by d.
    SiteField<double> second_difference(const SiteField<double>& d) const;

    std::vector<Branch> branches_;
    Slab slab_;
    int components_;
    Workspace& workspace_;
    std::vector<SiteField<double>> h_;
    std::vector<SiteField<double>> history_; ///< d0, c0
    SiteField<double> w_;
    double dt_ = units::forever;
    double last_ = units::forever; ///< dt0, fs
};

} // namespace asperity
