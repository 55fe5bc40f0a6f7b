// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The relaxed state of a frictionless spectral block over a wall.
//
// Over a wall the interface is a law of each site's own gap, so a site's equation can be solved
// exactly, however stiff or steep the law is; only the elastic forces, which couple the sites, are
// linearised in each step. The iteration is the accelerated proximal gradient method (Beck and
// Teboulle, SIAM J. Imaging Sci. 2, 183 (2009)) with restarts (O'Donoghue and Candès, Found.
// Comput. Math. 15, 715 (2015)):
//
//     z = u + beta (u - u_before),    u <- rest of each site under its law and a spring L to
//                                          z - (S z + load) / L,
//
// with L the stiffness of the block's stiffest wave. Beyond its steepest place the law's attraction
// is replaced by its value at z: that part of the law's energy lies below its tangents, so that the
// energy still decreases with every step without momentum (the convex-concave procedure of Yuille
// and Rangarajan, Neural Comput. 15, 915 (2003)). A site moves no further than its own law and the
// spring L take it, so that it passes no barrier of these two, and it depends continuously on the
// force on it. The number of iterations is thus independent of the ratio of the stiffnesses of law
// and block, which reaches ten thousand over rubber.
//
// After a step the residual force of the state u is (L - S) (z - u) plus the difference of the
// attractions at u and z, and is measured by L |z - u| and this difference. beta follows Nesterov's
// sequence and restarts when the step turns against the gradient. The number of iterations scales
// as the square root of the number of sites across the box; each iteration takes one forward and
// one backward transform, in single precision until the residual is near its rounding.
//
// The uniform wave is solved in every iteration, because forces below a site's tolerance add up
// over the sites to a force on the top plane. The unknown is the uniform force on the sites at
// which the interface's force equals that of the block's spring, or the load, or at which the mean
// height has its prescribed value. The mean therefore has no momentum; with momentum, a held top
// plane would oscillate.
#pragma once

#include "engine/statics/relaxation.hpp"
#include "engine/waves/response.hpp"

namespace asperity {

/// Minimiser of a frictionless block over a wall.
class WallMinimiser {
public:
    /// Starts from the block's displacements. Keeps references to all arguments. Collective.
    WallMinimiser(Response& block, const Interface& interface, const RelaxOptions& options,
                  Phases& phases);

    /// Returns the residual after the last step, eV/Å: the largest L |z - u|.
    double residual() const { return residual_factor_ * estimate_; }
    /// Returns the residual of the final state in double precision, eV/Å, and computes sums().
    /// Collective.
    double conclude();
    /// Returns the interface's sums of the final state, after conclude().
    const InterfaceSums& sums() const { return sums_; }
    /// Makes one iteration. Collective.
    void step();

private:
    template <class T>
    void elastic_forces(SiteField<T>& field);
    template <class T>
    double relax_sites(const SiteField<T>& elastic);
    template <class Excess>
    void balance(const Excess& excess_at, double enough);
    void accept();

    Response& block_;
    const Interface& interface_;
    const RelaxOptions& options_;
    Phases& phases_;
    double stiffest_wave_ = 0.0; ///< L, eV/Å^2
    double sequence_ = 1.0;      ///< Nesterov's t
    double momentum_ = 0.0;      ///< beta
    double mean_ = 0.0;          ///< mean of u, Å
    double next_mean_ = 0.0;     ///< mean of next_, Å
    Holder holder_;              ///< force that holds the uniform wave
    double widest_ = 0.0;        ///< the largest |z - mean|, Å
    double uniform_force_ = 0.0; ///< force on each site that balances the uniform wave, eV/Å
    /// Last change of the excess divided by the change of uniform_force_, with reversed sign.
    double fall_ = 1.0;
    double estimate_;
    double residual_factor_ = 1.0; ///< doubled if the estimate was below the tolerance too early
    bool single_ = true;
    Waves<double> waves_;
    SiteField<double> field_;
    SiteField<float> single_field_;
    Field<double> next_;
    Field<float> step_;
    InterfaceSums sums_;
};

} // namespace asperity
