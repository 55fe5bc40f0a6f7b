// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The one scalar condition of the theory: γ_eff(ζ_1) = Δγ, solved for g0 = γ_eff(1).
//
// The answer lies between two known ends. From below, at p <= 0, g0 > p²/(E* q_L), or the boundary
// would start behind the path; at p > 0, g0 >= -U_full, because U_el never exceeds its value at
// full contact. From above, g0 <= Δγ S(q1). At p <= 0 the unknown is ln(g0 - p²/E* q_L): near the
// end of the branch γ_eff falls as the fourth power of A and a linear search would see only zero.
// At p = 0 the trivial solution (no contact) always exists; the one wanted is the largest, so
// the search comes down from above.
#pragma once

#include <span>

#include "theory/integration.hpp"
#include "theory/persson.hpp"

namespace asperity::theory {

class Shooting {
public:
    Shooting(const AdhesiveContact& contact, const SolverOptions& options);

    struct Outcome {
        bool found = false;
        double x = 0;            ///< the search coordinate, see g0()
        double least_excess = 0; ///< smallest ln(γ_eff(ζ_1)/Δγ) met; if not found, how far from it
    };

    /// From nothing, on grids rebuilt for each trial.
    [[nodiscard]] Outcome search(int refinement) const;
    /// From a neighbour, on a grid that stays; falls back to search.
    [[nodiscard]] Outcome follow(const Outcome& near, int refinement) const;

    /// The limiting integration where the adhesive branch ends: g0 at its lower end.
    [[nodiscard]] double excess_at_edge(int refinement) const;

    [[nodiscard]] double g0(double x) const;
    [[nodiscard]] double lowest_g0() const { return lowest_; }
    [[nodiscard]] IntegrationGrid grid_for(double x, int refinement) const;
    [[nodiscard]] IntegrationPath integration(const IntegrationGrid& grid, double g0,
                                              int refinement) const;

    /// The value at spacing zero from values on nested grids, coarse to fine, three at least. The
    /// error is the distance to what one grid fewer gave, or, with only three, one elimination
    /// fewer.
    struct Limit {
        double value, error;
    };
    [[nodiscard]] Limit extrapolate(std::span<const double> values) const;

private:
    [[nodiscard]] IntegrationInput input(double g0) const;
    [[nodiscard]] double excess(const IntegrationGrid& grid, const IntegrationPath& path) const;
    [[nodiscard]] double excess_at(double x, int refinement, double* area = nullptr) const;

    const AdhesiveContact& contact_;
    SolverOptions options_;
    bool pressing_;
    double lowest_, highest_; // of g0
    double scale_;            // of g0 when pressing
};

} // namespace asperity::theory
