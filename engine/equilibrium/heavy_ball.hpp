// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Polyak's heavy ball (USSR Comp. Math. Math. Phys. 4(5), 1, 1964) for the sites of a spectral
// block, each on its own.
//
// If the interface's forces stayed as they are and a spring k (about what the interface is to a
// site) tied each site to where it is, the sites would come to rest at
//
//     goal = (S + k)^-1 (k u + F + load),
//
// one transform there and one back for each component; goal - u is the negative gradient in the
// metric S + k, in which long and short waves relax alike. A site moves by
//
//     m <- gain (goal - u) + keep m,      |m| at most bound.
//
// While surfaces come together, some site falls into contact at any time. A momentum that is
// stopped for all whenever the energy rises would never get anywhere; here it is a site's own
// affair. Where the goal lies behind, the site has come too far: it drops its momentum and cuts its
// gain, which elsewhere recovers slowly. So sites that are held stiffly (up to 9 eV/Å^2, k being
// less than 1) find their step by themselves, whatever k is.
#pragma once

#include "engine/block/spectral_block.hpp"

namespace asperity {

class HeavyBall {
public:
    explicit HeavyBall(SpectralBlock& block);

    /// Moves the sites, none further than bound (Å), interface_force() being up to date; their
    /// waves do not follow (SpectralBlock::settle()). Returns the longest way to a goal, Å.
    /// Collective.
    double move(const Preconditioner& preconditioner, double bound);
    /// From rest again; the gains are kept.
    void stop();

private:
    SpectralBlock& block_;
    Waves<float> waves_;
    SiteField<float> goal_, momentum_;
    Field<float> gain_;
};

} // namespace asperity
