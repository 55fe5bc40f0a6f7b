// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Newton's method for a frictionless block over a wall that starts near an equilibrium. With H the
// interface's stiffness at the sites, diagonal and zero at sites that yield, and g the gradient of
// the energy,
//
//     (S + H) d = -g,
//
// or, for a prescribed mean height that changes by l, the d with mean l that minimises this
// quadratic energy. The first step starts from the equilibrium under the earlier constraint: it
// follows the tangent of the branch. A minimiser alone does not follow the branch: its short waves
// respond before its long ones, and until the long waves have responded, sites at the edge of the
// contact carry more than in equilibrium and separate too early by a part of the step.
//
// Conjugate gradients over the sites, preconditioned by
//
//     P = D (S + k)^-1 D + (1 - D^2) / (L + max(H, 0)),    D = L / (L + max(H, 0)),
//
// with L the stiffness of the block's stiffest wave and k the mean of D H D: the response of the
// block where nothing holds a site, and the stiffness of the site where the wall does, whose
// repulsion is a thousand times as stiff as the block. A step takes one to five products with S and
// as many with (S + k)^-1, whatever the number of sites. Uniform waves are kept in double
// precision: a soft spring that holds the block lets the uniform wave move far, and its rounding
// in single precision would be a force of the stiff waves.
//
// Over a wall that yields, a step exchanges sites between three sets: those that yield, those that
// the wall holds, and those that it does not touch. A site whose pressure would exceed the hardness
// yields, deeper than the yield gap by the distance at which the block's stiffest wave would carry
// the excess: the step itself has the stiffness of the wall in it. A site that ends to yield, or
// that reaches the yield gap from outside, is put into the second set, at the yield gap: the whole
// step would send it from one end of the law to the other, and back in the next step. A held mean
// height is then met only by the steps that follow.
#pragma once

#include "engine/interface/interface.hpp"
#include "engine/phases.hpp"
#include "engine/statics/relaxation.hpp"
#include "engine/waves/preconditioner.hpp"
#include "engine/waves/spectral_block.hpp"

#include <cmath>
#include <optional>

namespace asperity {

/// Newton's method over a wall.
class WallNewton {
public:
    /// Sets the constraint of a block in equilibrium under an earlier one and makes the first step.
    /// Keeps references to the arguments. Collective.
    WallNewton(SpectralBlock& block, const Interface& interface, const Constraint& constraint,
               const RelaxOptions& options, Phases& phases);

    /// Returns the largest residual force on a site or, if that is larger, the mean one over the
    /// share of the tolerance that is allowed to it: mean forces add up over the sites; or L times
    /// what the mean height misses. eV/Å.
    double residual() const { return residual_; }
    /// Returns residual(), and computes sums(). Collective.
    double conclude();
    /// Returns the interface's sums of the state, after conclude().
    const InterfaceSums& sums() const { return sums_; }
    /// Makes one step; over a wall that attracts, no site moves further than move_max beside a
    /// prescribed change of the mean height. Collective.
    void step();
    /// Returns true if the energy has no minimum along the last step, or steps no longer help.
    bool gives_up() const;
    /// Puts the sites back to where the first step left them. Collective.
    void put_back();
    /// Returns the number of products with S so far.
    long long products() const { return products_; }

private:
    void measure();
    void linearise();
    void solve();
    bool move();
    void multiply();
    template <class Force>
    void respond(const Force& f);
    double precondition();
    double response(int x, int y, double f) const;
    double preconditioned(int x, int y) const;
    double damping(int x, int y) const { return stiffest_wave_ * weight_.plane(0)(x, y); }
    double largest(const PlaneView<const double>& of, double from) const;
    template <class Do>
    void for_sites(const Do& at) const;
    template <class Term>
    double sum(const Term& term) const;

    SpectralBlock& block_;
    const Interface& interface_;
    Phases& phases_;
    double tolerance_; ///< eV/Å
    double furthest_;  ///< largest move of a site in a step, Å
    PlaneView<double> u_;
    bool mean_is_held_;
    double sites_;
    double stiffest_wave_;           ///< L, eV/Å^2
    double uniform_stiffness_ = 0.0; ///< stiffness of the uniform wave, eV/Å^2 per site
    double lift_ = 0.0;              ///< change of the held mean height that is to be made, Å
    double force_ = 0.0;             ///< force on each site that holds the mean height, eV/Å
    double sum_of_uniform_ = 0.0;    ///< sum of of_uniform_
    double uniform_product_ = 0.0;   ///< uniform wave of S p, eV/Å
    double residual_ = 0.0;          ///< eV/Å
    long long products_ = 0;
    bool unstable_ = false;      ///< the curvature along a direction was negative
    double smallest_ = HUGE_VAL; ///< smallest residual, eV/Å
    int stalled_ = 0;            ///< whole steps since the residual halved
    int cut_ = 0;                ///< steps that were cut
    std::optional<Preconditioner> preconditioner_;
    SiteField<double> gradient_; ///< gradient of the energy at the sites, eV/Å
    SiteField<float> product_;   ///< N^2 S p without the uniform wave of p, eV/Å
    SiteField<float> response_;  ///< N^2 (S + k)^-1 D r, Å
    Field<double> h_;            ///< stiffness of the interface, eV/Å^2
    Field<double> weight_;       ///< 1 / (L + max(H, 0)), Å^2/eV
    Field<double> r_;            ///< residual of the linear equation, eV/Å
    Field<double> p_, d_;        ///< direction and step, Å
    Field<double> first_;        ///< displacements after the first step, Å
    /// P applied to a force of one on each site, Å^2/eV, if the mean height is held.
    std::optional<Field<double>> of_uniform_;
    InterfaceSums sums_;
};

} // namespace asperity
