// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Closed forms; see the header. dφ/dd = -(2π/a⁴) d [V(d) - V(r_c)], so the minimum is where V(d) =
// V(r_c) on the steep side: with s = (r0/d)⁶, s² - s = V(r_c)/4ε.
#include "theory/wall_potential.hpp"

#include <cmath>
#include <numbers>

#include "theory/error.hpp"

namespace asperity::theory {
namespace {

/// V(r_c)/4ε, zero without a cutoff.
double shift(const WallPotential& w) {
    if (w.cutoff == 0) return 0;
    const double s = std::pow(w.r0 / w.cutoff, 6);
    return s * s - s;
}

} // namespace

double WallPotential::energy(double d) const {
    if (cutoff > 0 && d >= cutoff) return 0;
    const double density = 1 / std::pow(lattice_constant, 4);
    const double s = r0 / d, c = cutoff > 0 ? r0 / cutoff : 0;
    const double repulsion = (std::pow(s, 10) - std::pow(c, 10)) / 10;
    const double attraction_term = (std::pow(s, 4) - std::pow(c, 4)) / 4;
    const double lift = cutoff > 0 ? shift(*this) * (cutoff * cutoff - d * d) / 2 : 0;
    return 8 * std::numbers::pi * epsilon * density *
           (r0 * r0 * (repulsion - attraction_term) - lift);
}

double WallPotential::equilibrium_distance() const {
    const double s = (1 + std::sqrt(1 + 4 * shift(*this))) / 2;
    return r0 / std::pow(s, 1.0 / 6);
}

double WallPotential::depth() const { return -energy(equilibrium_distance()); }

double WallPotential::attraction(double gap) const { return -energy(equilibrium_distance() + gap); }

void check(const WallPotential& w) {
    if (!(w.epsilon > 0 && w.r0 > 0 && w.lattice_constant > 0))
        throw InvalidInput(message("wall potential: epsilon ", w.epsilon, ", r0 ", w.r0,
                                   ", lattice constant ", w.lattice_constant,
                                   " must all be positive; check them"));
    // Below its minimum the pair potential cut there would be purely repulsive.
    if (w.cutoff != 0 && !(w.cutoff > w.r0 * std::pow(2.0, 1.0 / 6)))
        throw InvalidInput(message("wall potential: cutoff ", w.cutoff,
                                   " leaves no attraction, it must lie beyond the pair minimum ",
                                   w.r0 * std::pow(2.0, 1.0 / 6), "; enlarge it, or 0 for none"));
}

} // namespace asperity::theory
