// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Memory of a viscoelastic block (docs/explanation/rate.md).
//
// Beside the springs of the block, S, stand branches of Maxwell type: a spring r_k S in series with
// a dashpot of relaxation time tau_k. With w the displacement from the rigid top, and h_k that of
// branch k's spring,
//
//     force on the layer = -S (w + sum r_k h_k),        dh_k/dt = dw/dt - h_k/tau_k.
//
// Over a step dt, from w to w', let w be the parabola whose second difference is c,
// w(s) = w + d s/dt + c/2 (s/dt) (s/dt - 1), d = w' - w. Then, exactly,
//
//     h' = e h + b d + g c,    e = exp(-dt/tau),    b = (1 - e)/x,    x = dt/tau,
//     g = (x - (1 - e) (1 + x/2)) / x^2.
//
// A step that continues another one (dt0, over which w went by d0) takes the parabola through all
// three places: c = p (d - rho d0), rho = dt/dt0, p = 2 rho/(1 + rho). The error of a step is then
// of order dt^4. The first step after w has changed its course has c = 0. Either way the step is a
// static problem of stiffness (1 + sum r_k (b_k + p g_k)) S beside a force that is known,
// -S sum r_k (e_k h_k - (b_k + p g_k) w - p rho g_k d0). No factor depends on the wave: h, d0 and
// c0 are kept at the sites.
//
// The error of a step in time is judged by how far its second difference is from that of the step
// before, rho^2 c0: with y_k = g_k (c - rho^2 c0), by sum r_k (|y_k|.|S h'_k| + y_k.(S y_k)/2), an
// energy, |.| site by site: where a site comes into contact its w has a kink, and the other sites'
// h' has no part in the error. Where the third derivative of w is even, h' is wrong by half of y.
#pragma once

#include "decomposition/surface_transform.hpp"
#include "engine/options/block_options.hpp"
#include "engine/units.hpp"

#include <functional>
#include <vector>

namespace asperity {

/// Energies of the branches, eV.
struct BranchEnergies {
    double stored = 0.0;
    double dissipated = 0.0; ///< energy dissipated in the step under way
    double error = 0.0;      ///< error of the step in time
};

class BlockMemory {
public:
    /// Keeps a reference to the workspace.
    BlockMemory(const std::vector<Branch>& branches, const Slab& slab, int components,
                Workspace& workspace);

    /// Begins a step of dt (fs) from the displacements w. The branches relax completely in an
    /// infinite one. last: length of the step that this one continues, fs; infinite: it continues
    /// none.
    void begin(SiteField<double> w, double dt, double last);
    /// Returns sum r (b + p g), by which the stiffness grows.
    double stiffening() const;
    /// Returns sum r (e h - (b + p g) w - p rho g d0), Å, which stands for the known force.
    SiteField<double> known_force() const;
    /// Function that returns u.(S u) of a field u, S the relaxed stiffness.
    using Square = std::function<double(const SiteField<double>&)>;
    /// Function that returns the sum over the sites of |a.(S b)| of two fields a and b.
    using Product = std::function<double(const SiteField<double>&, const SiteField<double>&)>;
    /// Returns the energies of the step if it ends at w' = `to`.
    BranchEnergies energies(const SiteField<double>& to, const Square& square,
                            const Product& product) const;
    /// Ends the step at w' = `to`.
    void end(SiteField<double> to);

    /// Returns the extensions h of each branch, Å.
    std::vector<SiteField<double>>& extensions() { return h_; }
    const std::vector<SiteField<double>>& extensions() const { return h_; }
    /// Returns d0 and c0 of the last step, Å: the memory is these and the extensions.
    std::vector<SiteField<double>>& history() { return history_; }
    const std::vector<SiteField<double>>& history() const { return history_; }
    std::size_t bytes() const;

private:
    SiteField<double> new_field() const {
        return site_field<double>(slab_, components_, &workspace_);
    }
    /// Returns the weight p; 0 for a step that continues none.
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
