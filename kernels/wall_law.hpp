// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A wall in place of the substrate's atoms (scene: interface.kind = "wall"): laws of the gap g
// between a site and the height of the substrate below it. No lateral forces.
//
// The Lennard-Jones atoms of density n smeared over the plane below the site, cut and shifted like
// the pairs, V0 the unshifted pair potential:
//
//     U(g) = 2 pi n int_g^r_c [V0(r) - V0(r_c)] r dr,      -U' = 2 pi n g [V0(g) - V0(r_c)].
//
// Exponential attraction over a linear repulsion (Müser et al., Tribol. Lett. 65, 118 (2017), have
// the same attraction over a hard wall; stiffness -> infinity is that limit):
//
//     U(g) = -A exp(-g/rho)                   g > 0,
//     U(g) = -A (1 - g/rho) + K g^2 / 2       g <= 0,
//
// deepest at g = -A / (rho K), by A + A^2 / (2 rho^2 K). A is such that this is the work of
// adhesion W, however soft the repulsion: A = 2 W / (1 + sqrt(1 + 2 W / (rho^2 K))).
//
// Each law is one text for a number and for a SIMD register: V is double or a Pack of the variant
// that compiles it. A gap that is not a number gives a force that is none.
//
// Units: Å, eV, eV/Å, for each site.
#pragma once

#include "kernels/annotations.hpp"
#include "kernels/lennard_jones.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <variant>

namespace asperity {

// What simd.hpp has for packs.
ASPERITY_INLINE double select(bool mask, double a, double b) { return mask ? a : b; }
ASPERITY_INLINE double min(double a, double b) { return a < b ? a : b; }
ASPERITY_INLINE double max(double a, double b) { return a > b ? a : b; }

/// Of a site that comes to rest under its own law and a spring.
struct SiteDescent {
    /// Newton's steps, from where the site was an iteration before.
    static constexpr int steps = 3;
};

class LennardJonesWall {
public:
    LennardJonesWall() = default;
    /// density: atoms per Å^2. tail: neither cut nor shifted.
    LennardJonesWall(const LennardJones& pair, double density, bool tail)
        : r0_squared_(pair.r0 * pair.r0),
          reach_(tail ? std::numeric_limits<double>::infinity() : pair.cutoff),
          shift_(tail ? 0.0 : pair.shift()), floor_(0.5 * pair.r0), plane_(two_pi * density),
          well_(4.0 * pair.epsilon) {
        contact_ = std::pow(2.2, 1.0 / 6.0) * pair.r0;
        at_reach_ = integral(tail ? 0.0 : r0_squared_ / (pair.cutoff * pair.cutoff));
        // Where well s6 (11 s6 - 5) + shift = 0.
        const double s6 = (5.0 + std::sqrt(25.0 - 44.0 * shift_ / well_)) / 22.0;
        steepest_ = pair.r0 * std::pow(s6, -1.0 / 6.0);
        force_there_ = force(steepest_);
        const double h = 1e-4 * floor_;
        stiffness_ = (force(floor_) - force(floor_ + h)) / h;
    }

    template <class V>
    ASPERITY_INLINE V force(V gap) const {
        const V g = max(V(floor_), gap);
        const V s2 = V(r0_squared_) / (g * g), s6 = s2 * s2 * s2;
        const V plane = V(plane_) * g * (V(well_) * s6 * (s6 - V(1.0)) - V(shift_));
        return select(gap > V(reach_), V(0.0), plane + V(stiffness_) * (g - gap));
    }
    template <class V>
    ASPERITY_INLINE V energy(V gap) const {
        const V g = max(V(floor_), gap), below = g - gap;
        const V s2 = V(r0_squared_) / (g * g);
        V plane = V(plane_) * (integral(s2) - V(at_reach_));
        // With the tail there is no shift, and no cutoff to square.
        if (shift_ != 0.0)
            plane = plane - V(0.5 * plane_ * shift_) * (V(reach_) * V(reach_) - g * g);
        const V deeper = below * (force(g) + V(0.5 * stiffness_) * below);
        return select(gap > V(reach_), V(0.0), plane + deeper);
    }
    /// Where a spring to the gap `goal` lets a site come to rest: spring (goal - g) + force(g) = 0,
    /// the attraction's decay beyond its steepest place taken as it is at `gap`. By Newton's
    /// method, of which a few steps are taken.
    template <class V>
    ASPERITY_INLINE V settle(V gap, V goal, V spring) const {
        const V steepest(steepest_), floor(floor_), from = max(steepest, gap);
        const V outside = goal + force(from) / spring; // if the site ends in the decay
        const V pull = force(from) - V(force_there_);
        V g = max(floor, min(steepest, gap));
        for (int i = 0; i < SiteDescent::steps; ++i) {
            const V s2 = V(r0_squared_) / (g * g), s6 = s2 * s2 * s2;
            const V stiffness = V(plane_) * (V(well_) * s6 * (V(11.0) * s6 - V(5.0)) + V(shift_));
            const V way = (spring * (goal - g) + force(g) + pull) / (spring + stiffness);
            g = max(floor, min(steepest, g + way));
        }
        // Below the floor the law is linear.
        const V push = spring * (goal - floor) + force(floor) + pull;
        const V inside = select(push < V(0.0), floor + push / (spring + V(stiffness_)), g);
        return select(outside > steepest, outside, inside);
    }
    /// The least stiffness -dF/dg of a site, eV/Å^2: negative.
    double softest() const { return plane_ * (shift_ - 25.0 / 44.0 * well_); }
    /// Over which the attraction fades, Å: about the largest tension over -softest().
    double range() const { return 0.5 * std::sqrt(r0_squared_); }
    /// Sites nearer than this, the largest tension, are in contact: (11/5)^(1/6) r0.
    ASPERITY_INLINE double contact_gap() const { return contact_; }
    double reach() const { return reach_; }

private:
    /// int_g^infinity V0(r) r dr, s2 = (r0/g)^2.
    template <class V>
    ASPERITY_INLINE V integral(V s2) const {
        const V s4 = s2 * s2;
        return V(well_ * r0_squared_) * s4 * (s4 * s2 * V(0.1) - V(0.25));
    }
    static constexpr double two_pi = 2.0 * std::numbers::pi;

    double r0_squared_ = 1.0, reach_ = 0.0, shift_ = 0.0;
    double floor_ = 0.5;                        ///< below this the force goes on linearly
    double stiffness_ = 0.0;                    ///< there
    double steepest_ = 0.0, force_there_ = 0.0; ///< of the attraction's largest
    double plane_ = 0.0, well_ = 0.0, at_reach_ = 0.0, contact_ = 0.0;
};

class ExponentialWall {
public:
    ExponentialWall() = default;
    /// adhesion: W, eV; range: rho, Å; stiffness: K, eV/Å^2.
    ExponentialWall(double adhesion, double range, double stiffness)
        : adhesion_(2.0 * adhesion /
                    (1.0 + std::sqrt(1.0 + 2.0 * adhesion / (range * range * stiffness)))),
          range_(range), stiffness_(stiffness), tension_(adhesion_ / range) {}

    template <class V>
    ASPERITY_INLINE V force(V gap) const {
        const V into = min(V(0.0), gap);
        return -(V(stiffness_) * into) - V(tension_) * decay(gap);
    }
    template <class V>
    ASPERITY_INLINE V energy(V gap) const {
        const V into = min(V(0.0), gap);
        return into * (V(tension_) + V(0.5 * stiffness_) * into) - V(adhesion_) * decay(gap);
    }
    /// As above, exactly.
    template <class V>
    ASPERITY_INLINE V settle(V gap, V goal, V spring) const {
        const V pull = spring * goal - V(tension_) * decay(gap);
        return select(pull > V(0.0), pull / spring, pull / (spring + V(stiffness_)));
    }
    double softest() const { return -tension_ / range_; }
    double range() const { return range_; }
    /// Sites that touch the repulsion are in contact.
    ASPERITY_INLINE double contact_gap() const { return 0.0; }
    double reach() const { return adhesion_ > 0.0 ? ranges * range_ : 0.0; }
    double stiffness() const { return stiffness_; }
    double tension() const { return tension_; } ///< the largest, at g = 0

private:
    static constexpr double ranges = 32.0; ///< e^-32 = 1.3e-14: nothing beyond
    /// exp(-g/rho), 1 for g < 0: Taylor's series of the 256th root, to 2e-14.
    template <class V>
    ASPERITY_INLINE V decay(V gap) const {
        const V x = V(1.0 / range_) * max(V(0.0), gap);
        const V y = V(-1.0 / 256.0) * min(V(ranges), x);
        V e(1.0 / 362880.0);
        constexpr double inverse_factorials[] = {1.0 / 40320.0, 1.0 / 5040.0, 1.0 / 720.0,
                                                 1.0 / 120.0,   1.0 / 24.0,   1.0 / 6.0,
                                                 0.5,           1.0,          1.0};
        for (const double c : inverse_factorials)
            e = e * y + V(c);
        for (int i = 0; i < 8; ++i)
            e = e * e;
        return select(x > V(ranges), V(0.0), e);
    }

    double adhesion_ = 0.0; ///< A
    double range_ = 1.0, stiffness_ = 0.0, tension_ = 0.0;
};

using WallLaw = std::variant<LennardJonesWall, ExponentialWall>;

} // namespace asperity
