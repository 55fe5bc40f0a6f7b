// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A wall in place of the substrate's atoms (scene: interface.kind = "wall"): laws of the gap g
// between a site and the height of the substrate below it. No lateral forces.
//
// Smeared wall: n atoms per area smeared over the plane below the site, with the cut and shifted
// pair potential of V0 (pair_potential.hpp):
//
//     U(g) = 2 pi n int_g^r_c [V0(r) - V0(r_c)] r dr,      -U' = 2 pi n g [V0(g) - V0(r_c)].
//
// Exponential wall: exponential attraction and linear repulsion (a hard wall, as in Müser et al.,
// Tribol. Lett. 65, 118 (2017), in the limit of infinite stiffness):
//
//     U(g) = -A exp(-g/rho)                   g > 0,
//     U(g) = -A (1 - g/rho) + K g^2 / 2       g <= 0,
//
// with the minimum -A - A^2 / (2 rho^2 K) at g = -A / (rho K). A = 2 W / (1 + sqrt(1 + 2 W / (rho^2
// K))) makes the depth equal to the work of adhesion W for any stiffness K.
//
// Other shapes of the attraction are in shaped_wall.hpp.
//
// If the work of adhesion differs from site to site, the attraction is multiplied by a factor of
// the site (scaled(), law_factors.hpp). The law is then that of the largest work, and factor_of()
// returns the factor for a smaller work.
//
// Terms<V> has the formulas of a law for values of type V (number.hpp). A NaN gap gives a NaN
// force.
//
// Units: Å, eV, eV/Å, for each site.
#pragma once

#include "kernels/law_factors.hpp"
#include "kernels/pair_potential.hpp"
#include "kernels/shaped_wall.hpp"

#include <boost/math/tools/minima.hpp>

#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>

namespace asperity {

/// Smeared wall of a pair potential P.
template <class P>
class SmearedWall {
public:
    /// Makes the law of a site. density: atoms per Å^2; tail: neither cut nor shift the potential.
    SmearedWall(const P& potential, double density, bool tail)
        : potential_(potential), plane_(2.0 * std::numbers::pi * density),
          floor_(std::fmax(0.5 * potential.zero(), potential.closest())) {
        const Pair<P> pair(potential);
        contact_ = steepest();
        if (tail) {
            reach_ = HUGE_VAL;
        } else {
            reach_ = potential.cutoff;
            shift_ = pair.shift;
            at_reach_ = pair.moment(reach_ * reach_);
        }
        steepest_ = steepest();
        force_there_ = force(steepest_);
        const double h = 1e-4 * floor_;
        stiffness_ = (force(floor_) - force(floor_ + h)) / h;
        softest_ = least_stiffness();
    }

    /// Formulas for values of type V.
    template <class V>
    struct Terms {
        explicit Terms(const SmearedWall& w)
            : terms(w.potential_, 1.0), plane(same<V>(w.plane_)),
              scale(same<V>(terms.energy_scale)), force_scale(same<V>(terms.force_scale)),
              shift(same<V>(w.shift_)), reach(same<V>(w.reach_)), floor(same<V>(w.floor_)),
              stiffness(same<V>(w.stiffness_)), steepest(same<V>(w.steepest_)),
              force_there(same<V>(w.force_there_)), at_reach(same<V>(w.at_reach_)),
              shifted(same<V>(w.shift_ != 0.0 ? 0.5 * w.shift_ : 0.0)),
              reach2(same<V>(w.shift_ != 0.0 ? w.reach_ * w.reach_ : 0.0)) {}

        ASPERITY_INLINE V force(V gap) const {
            const V g = max(floor, gap), g2 = g * g;
            const V of_plane = plane * g * (scale * terms.energy(terms.begin(g2), g2) - shift);
            return select(gap > reach, same<V>(0.0), of_plane + stiffness * (g - gap));
        }
        ASPERITY_INLINE V energy(V gap) const {
            const V g = max(floor, gap), below = g - gap, g2 = g * g;
            const V of_plane = plane * (scale * terms.moment(terms.begin(g2), g2) - at_reach -
                                        shifted * (reach2 - g2));
            const V deeper = below * (force(g) + same<V>(0.5) * stiffness * below);
            return select(gap > reach, same<V>(0.0), of_plane + deeper);
        }
        /// Returns the gap at which a spring to the gap `target` holds a site in equilibrium, Å:
        /// spring (target - g) + force(g) = 0. Beyond its steepest place the attraction is fixed at
        /// its value at `gap`, the gap of the iteration before, from which Newton's method starts.
        ASPERITY_INLINE V equilibrium(V gap, V target, V spring) const {
            constexpr int newton_steps = 3;
            const V from = max(steepest, gap);
            const V outside = target + force(from) / spring; // if the site ends in the decay
            const V pull = force(from) - force_there;
            V g = max(floor, min(steepest, gap));
            for (int i = 0; i < newton_steps; ++i) {
                const V way = (spring * (target - g) + force(g) + pull) / (spring + slope(g));
                g = max(floor, min(steepest, g + way));
            }
            // The law is linear below the floor.
            const V push = spring * (target - floor) + force(floor) + pull;
            const V inside = select(push < same<V>(0.0), floor + push / (spring + stiffness), g);
            return select(outside > steepest, outside, inside);
        }
        /// Returns -dF/dg for gaps between floor and reach.
        ASPERITY_INLINE V slope(V g) const {
            const V g2 = g * g, begun = terms.begin(g2);
            const auto difference = [](V a, V b, V c) { return fms(a, b, c); };
            return plane * (shift - scale * terms.energy(begun, g2) +
                            g2 * (force_scale * terms.force(begun, g2, difference)));
        }

        typename P::template Terms<V> terms;
        V plane, scale, force_scale, shift, reach, floor, stiffness, steepest, force_there,
            at_reach;
        V shifted, reach2;
    };
    double force(double gap) const { return Terms<double>(*this).force(gap); }
    double energy(double gap) const { return Terms<double>(*this).energy(gap); }
    /// Returns -dF/dg at this gap, eV/Å^2.
    double stiffness_at(double gap) const {
        if (gap > reach_) return 0.0;
        return gap < floor_ ? stiffness_ : Terms<double>(*this).slope(gap);
    }
    /// Returns the depth of a site below the wall under a pressing force (eV/Å), Å.
    double depth_under(double force) const {
        return std::fmax(0.0, (force - this->force(floor_)) / stiffness_ - floor_);
    }
    /// Returns the least stiffness -dF/dg of a site, eV/Å^2: negative.
    double softest() const { return softest_; }
    /// Returns the decay length of the attraction, Å: about the largest tension divided by
    /// -softest().
    double range() const { return 0.5 * potential_.zero(); }
    /// Returns the gap below which a site is in contact, Å: the gap of the largest tension without
    /// a cutoff.
    double contact_gap() const { return contact_; }
    double reach() const { return reach_; }

private:
    /// Returns the gap of the largest attraction, -dF/dg = 0, by bisection.
    double steepest() const {
        const Terms<double> law(*this);
        double low = potential_.zero(), high = potential_.inflection();
        while (law.slope(high) > 0.0)
            high *= 1.5;
        while (true) {
            const double middle = 0.5 * (low + high);
            if (middle == low || middle == high) return middle;
            (law.slope(middle) > 0.0 ? low : high) = middle;
        }
    }
    /// Returns the minimum of the stiffness, eV/Å^2, of which only one exists beyond the steepest
    /// place.
    double least_stiffness() const {
        const Terms<double> law(*this);
        return boost::math::tools::brent_find_minima([&](double gap) { return law.slope(gap); },
                                                     steepest_, 2.0 * steepest_,
                                                     std::numeric_limits<double>::digits)
            .second;
    }

    P potential_;
    double plane_; ///< 2 pi n, 1/Å^2
    double floor_; ///< gap below which the force is continued linearly
    double reach_ = 0.0, shift_ = 0.0;
    double stiffness_ = 0.0;                    ///< stiffness at the floor
    double steepest_ = 0.0, force_there_ = 0.0; ///< gap and value of the largest attraction
    double at_reach_ = 0.0, contact_ = 0.0, softest_ = 0.0;
};

/// Exponential attraction over a linear repulsion.
class ExponentialWall {
public:
    ExponentialWall() = default;
    /// Makes the law of a site. adhesion: W, eV; range: rho, Å; stiffness: K, eV/Å^2.
    ExponentialWall(double adhesion, double range, double stiffness)
        : work_(adhesion),
          adhesion_(2.0 * adhesion /
                    (1.0 + std::sqrt(1.0 + 2.0 * adhesion / (range * range * stiffness)))),
          range_(range), stiffness_(stiffness), tension_(adhesion_ / range) {}

    /// Formulas for values of type V.
    template <class V>
    struct Terms {
        explicit Terms(const ExponentialWall& w)
            : adhesion(same<V>(w.adhesion_)), rate(same<V>(1.0 / w.range_)),
              stiffness(same<V>(w.stiffness_)), tension(same<V>(w.tension_)) {}

        /// Returns the law with its attraction times the factor of a site.
        ASPERITY_INLINE Terms scaled(const LawFactors<V>& factors) const {
            const V factor = factors[LawFactor::attraction];
            Terms law = *this;
            law.adhesion = factor * adhesion;
            law.tension = factor * tension;
            return law;
        }
        ASPERITY_INLINE V force(V gap) const {
            const V into = min(same<V>(0.0), gap);
            return -(stiffness * into) - tension * decay(gap);
        }
        ASPERITY_INLINE V energy(V gap) const {
            const V into = min(same<V>(0.0), gap);
            return into * (tension + same<V>(0.5) * stiffness * into) - adhesion * decay(gap);
        }
        /// Returns the gap at which a spring to the gap `target` holds a site in equilibrium, Å;
        /// the attraction is fixed at its value at `gap`.
        ASPERITY_INLINE V equilibrium(V gap, V target, V spring) const {
            const V pull = spring * target - tension * decay(gap);
            return select(pull > same<V>(0.0), pull / spring, pull / (spring + stiffness));
        }

        V adhesion, rate, stiffness, tension;

    private:
        /// Returns exp(-g/rho), but 1 for g < 0 and 0 for g > ranges rho.
        ASPERITY_INLINE V decay(V gap) const {
            const V x = rate * max(same<V>(0.0), gap);
            return select(x > same<V>(ranges), same<V>(0.0), exponential(-x));
        }
    };
    /// Returns the law with its attraction times the factor of a site.
    ExponentialWall scaled(const LawFactors<double>& factors) const {
        ExponentialWall law = *this;
        law.adhesion_ *= factors[LawFactor::attraction];
        law.tension_ *= factors[LawFactor::attraction];
        return law;
    }
    /// Returns the factor of the attraction for which scaled() has the fraction `part` of the work
    /// of adhesion.
    double factor_of(double part) const {
        return work_ > 0.0 ? ExponentialWall(part * work_, range_, stiffness_).adhesion_ / adhesion_
                           : 1.0;
    }
    double force(double gap) const { return Terms<double>(*this).force(gap); }
    double energy(double gap) const { return Terms<double>(*this).energy(gap); }
    /// Returns -dF/dg at this gap, eV/Å^2.
    double stiffness_at(double gap) const {
        return gap < 0.0 ? stiffness_ : Terms<double>(*this).force(gap) / range_;
    }
    /// Returns the depth of a site below the wall under a pressing force (eV/Å), Å.
    double depth_under(double force) const {
        return (std::fmax(0.0, force) + tension_) / stiffness_;
    }
    double softest() const { return -tension_ / range_; }
    double range() const { return range_; }
    /// Returns the gap below which a site is in contact, Å: 0, where the repulsion begins.
    double contact_gap() const { return 0.0; }
    double reach() const { return adhesion_ > 0.0 ? ranges * range_ : 0.0; }
    double stiffness() const { return stiffness_; }
    double tension() const { return tension_; } ///< returns the largest tension, at g = 0, eV/Å

private:
    /// The attraction is zero beyond this number of ranges: e^-32 = 1.3e-14.
    static constexpr double ranges = 32.0;

    double work_ = 0.0;     ///< W of the whole law, without a factor
    double adhesion_ = 0.0; ///< A
    double range_ = 1.0, stiffness_ = 0.0, tension_ = 0.0;
};

/// Smeared walls of the potentials that have a moment().
template <class P>
using SmearedWallsOf = std::conditional_t<P::has_tail, std::tuple<SmearedWall<P>>, std::tuple<>>;
template <class... Law>
std::variant<Law...> variant_of(const std::tuple<Law...>&);
template <class... P>
auto walls_of(const std::variant<P...>&)
    -> decltype(variant_of(std::tuple_cat(std::declval<std::tuple<ExponentialWall, ShapedWall>>(),
                                          std::declval<SmearedWallsOf<P>>()...)));
using WallLaw = decltype(walls_of(std::declval<PairPotential>()));

/// True for laws that differ from site to site by factors.
template <class Law>
concept ScaledBySite = requires(const Law& law) {
    law.scaled(LawFactors<double>{});
};

} // namespace asperity
