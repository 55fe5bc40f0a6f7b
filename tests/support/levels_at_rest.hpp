// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A second way to a state of equilibrium: all nodes of a block of levels, small or finite strain,
// downhill by inertia that is taken away where it leads uphill (FIRE: Bitzek et al., Phys. Rev.
// Lett. 97, 170201 (2006)). Shares the springs and the interface with the program, and nothing of
// how it relaxes; slow, for blocks of some thousand nodes.
#pragma once

#include "engine/equilibrium/relaxation.hpp"
#include "support/cases.hpp"
#include "support/elastic_operator.hpp"

namespace asperity::test {

struct LevelsAtRest {
    ElasticOperator lattice;
    explicit LevelsAtRest(const BlockOptions& options);

    /// From where the nodes are, the top plane held where the constraint says or free under its
    /// load, to this largest force on a node, eV/Å.
    RelaxedState relax(const Interface& interface, double reference_height,
                       const Constraint& constraint, double tolerance);
};

/// The state under this load, eV/Å, from the strongest attraction.
Relaxed relax_levels(const BlockOptions& options, const InterfaceOptions& interface,
                     const Surface& surface, double tolerance, double load = 0.0);

} // namespace asperity::test
