// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The relaxed state of a frictionless spectral block over a wall.
//
// Over a wall the interface is a law of each site's own gap, so a site's equation can be solved
// exactly, however stiff or steep the law is; only the elastic forces, which couple the sites, are
// taken step by step. The iteration is the accelerated proximal gradient method (Beck and Teboulle,
// SIAM J. Imaging Sci. 2, 183 (2009)) with restarts (O'Donoghue and Candès, Found. Comput. Math.
// 15, 715 (2015)):
//
//     z = u + beta (u - u_before),    u <- rest of each site under its law and a spring L to
//                                          z - (S z + load) / L,
//
// L the stiffness of the block's stiffest wave. The law's attraction, beyond the place where it is
// steepest, is taken as it is at z: that part of the law's energy lies below its tangents, so the
// energy still falls with every step of no momentum (the convex-concave procedure of Yuille and
// Rangarajan, Neural Comput. 15, 915 (2003)). A site is pulled no further than its own law and the
// spring L would take it, so it does not pass a barrier of these two; and it follows the force on
// it steadily, without a jump. So the number of iterations does not depend on how steep the law is
// beside the block: over rubber an attraction is ten thousand times as steep.
//
// If every site has come to rest, the residual force of the state u is (L - S) (z - u) and what
// the attraction at u differs by from that at z, so L |z - u| and the latter measure it. beta
// follows Nesterov's sequence and starts anew where the step turns against the gradient. The number
// of iterations goes with the root of the number of sites across the box; each takes a transform
// there and one back, in single precision until the residual is near its rounding.
//
// The uniform wave is not taken step by step: forces too small for a site's tolerance add up over
// the sites to a force on the top plane, which would have one sign as long as the block is on its
// way. In every iteration the uniform force on the sites is found by which the interface's force is
// that of the block's spring, or the load, or by which the mean height is what it is held at. So
// the mean needs no momentum, and has none: with it, a held top oscillates.
#pragma once

#include "engine/statics/relaxation.hpp"
#include "engine/waves/response.hpp"

namespace asperity {

class WallMinimiser {
public:
    WallMinimiser(Response& block, const Interface& interface, const RelaxOptions& options,
                  Phases& phases);

    /// Returns the residual after the last step, eV/Å: the largest L |z - u|.
    double residual() const { return residual_factor_ * estimate_; }
    /// Computes the residual of the state as it is reported, eV/Å, and the energies in sums().
    /// Collective.
    double conclude();
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
    double spring_ = 0.0;        ///< L, eV/Å^2
    double sequence_ = 1.0;      ///< Nesterov's t
    double momentum_ = 0.0;      ///< beta
    double mean_ = 0.0;          ///< mean of u, Å
    double next_mean_ = 0.0;     ///< mean of next_, Å
    Holder holder_;              ///< holder of the uniform wave
    double widest_ = 0.0;        ///< the largest |z - mean|, Å
    double uniform_force_ = 0.0; ///< force on each site that balances the uniform wave, eV/Å
    double fall_ = 1.0;          ///< fall of the excess over the rise of that force, as last seen
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
