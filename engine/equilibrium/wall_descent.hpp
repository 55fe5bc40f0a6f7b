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
// L at least the stiffness S of the block's stiffest wave and 5/4 of the law's most negative
// stiffness. The residual force of the state u is (L - S) (z - u), so L |z - u| measures it. beta
// follows Nesterov's sequence and starts anew where the step turns against the gradient. The number
// of iterations goes with the root of the number of sites across the box; each takes a transform
// there and one back, in single precision until the residual is near its rounding.
#pragma once

#include "engine/block/spectral_block.hpp"
#include "engine/equilibrium/relaxation.hpp"

namespace asperity {

class WallDescent {
public:
    WallDescent(SpectralBlock& block, const Interface& interface, double reference_height,
                const RelaxOptions& options, Phases& phases);

    /// What the last step leaves, eV/Å: the largest L |z - u|.
    double residual() const { return estimate_ / doubt_; }
    /// The residual of the state as it is reported; energies in sums().
    double conclude();
    const InterfaceSums& sums() const { return sums_; }
    /// One iteration. Collective. False from a prediction: the steps that go on from the last
    /// equilibrium are as good, and do not jump over a barrier.
    bool step();

private:
    template <class T>
    void elastic_forces(Waves<T>& waves, SiteField<T>& field);
    template <class T>
    double settle_sites(const SiteField<T>& elastic);
    void accept();

    SpectralBlock& block_;
    const Interface& interface_;
    double height_;
    const RelaxOptions& options_;
    Phases& phases_;
    double spring_ = 0.0;        ///< L, eV/Å^2
    double sequence_ = 1.0;      ///< Nesterov's t
    double momentum_ = 0.0;      ///< beta
    double mean_ = 0.0;          ///< of u, Å
    double uniform_force_ = 0.0; ///< that holds a prescribed mean height, on each site, eV/Å
    double estimate_;
    double doubt_ = 1.0; ///< halved where the estimate was below the tolerance and the residual not
    bool single_ = true;
    Waves<double> waves_;
    Waves<float> single_waves_;
    SiteField<double> field_;
    SiteField<float> single_field_;
    Field<double> next_;
    Field<float> step_;
    InterfaceSums sums_;
};

} // namespace asperity
