// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Polyak's heavy ball (USSR Comp. Math. Math. Phys. 4(5), 1, 1964) for the sites of a spectral
// block, each on its own.
//
// If the interface's forces were constant and a spring k (about the interface's stiffness for a
// site) tied each site to its current place, the sites would come to rest at
//
//     target = (S + k)^-1 (k u + F + load),
//
// at the cost of one forward and one backward transform for each component. target - u is the
// negative gradient in the metric S + k, in which long and short waves relax alike. A site moves by
//
//     m <- step_size (target - u) + momentum_decay m,      |m| at most move_max.
//
// While contact spreads, some site jumps into contact in nearly every iteration. A common momentum,
// set to zero whenever the energy rises, would always be near zero; therefore each site has its own
// momentum. If the target lies behind the last move, the site has gone too far: its momentum is set
// to zero and its step size is cut; the step sizes of the other sites recover slowly. Thus the step
// sizes of sites with stiff contacts (up to 9 eV/Å^2, k being less than 1) adapt to any k.
#pragma once

#include "engine/waves/preconditioner.hpp"

namespace asperity {

/// Heavy-ball minimiser of a block at rest over an interface.
class HeavyBall {
public:
    /// Starts with zero momenta. Keeps a reference to the block.
    explicit HeavyBall(Response& block);

    /// Moves the sites, none further than move_max (Å), and then restores a held mean height.
    /// interface_force() must be up to date; the waves of the displacements are not updated
    /// (Response::apply_constraint()). Returns the largest distance of a site to its target, Å.
    /// Collective.
    double move(const Preconditioner& preconditioner, double move_max);
    /// Sets all momenta to zero and keeps the step sizes.
    void stop();

private:
    Response& block_;
    SiteField<float> momentum_;
    Field<float> step_sizes_;
};

} // namespace asperity
