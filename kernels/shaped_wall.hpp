// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A wall whose law is an amplitude times an arbitrary shape (made by engine/case/wall_shape.hpp):
//
//     U(g) = A f(g / rho),
//
// where the force is piecewise linear in x = g / rho and the energy is its exact integral. The
// force is the sum of a decreasing part, whose energy is convex, and an increasing part, whose
// energy is concave. With the increasing part fixed at its value at a given gap, the equilibrium of
// a site on a spring is the minimum of a convex energy; the interval of the equilibrium is found by
// bisection.
//
// A shape that begins at contact, x = 0, is continued by the linear repulsion of the exponential
// wall (wall_law.hpp): U(g) = A (f(0) + g/rho f'(0)) + K g^2 / 2 for g <= 0, with a depth equal to
// the work of adhesion W: A (1 + A f'(0)^2 / (2 rho^2 K)) = W. A shape that includes a repulsion is
// continued along its first line, and A = W.
//
// Row k of a shape begins at x_k; the rows are equidistant in y / (1 + y), y = x - x_0.
#pragma once

#include "kernels/law_factors.hpp"
#include "kernels/number.hpp"

#include <cmath>
#include <cstddef>
#include <limits>

namespace asperity {

/// Law of a wall with a tabulated shape.
class ShapedWall {
public:
    static constexpr int rows = 1024; ///< number of rows of a shape; the last row is its end

    /// View of a shape with unit depth and range; the numbers belong to a WallShape.
    struct Shape {
        const double* force = nullptr; ///< [4 k + i]: x_k, force, its slope and the energy there
        const double* convex =
            nullptr; ///< [4 k + i]: x_k, the falling part of the force, its slope
        double first = 0.0, last = 0.0; ///< x of the first and the last row
        bool repels = false;            ///< the shape includes a repulsion
        double minimum = 0.0;           ///< x of the least energy
        double steepest = 0.0;          ///< x of the largest tension
        double tension = 0.0;           ///< largest tension
        double fastest = 0.0;           ///< largest slope of the force
    };

    ShapedWall() = default;
    /// Makes the law of a site. adhesion: W, eV; range: rho, Å; stiffness: K, eV/Å^2, for a shape
    /// without repulsion.
    ShapedWall(const Shape& shape, double adhesion, double range, double stiffness)
        : shape_(shape), work_(adhesion), range_(range), stiffness_(shape.repels ? 0.0 : stiffness),
          adhesion_(amplitude(adhesion)) {}

    /// Formulas for values of type V.
    template <class V>
    struct Terms {
        explicit Terms(const ShapedWall& w)
            : table(w.shape_.force), falling(w.shape_.convex), adhesion(same<V>(w.adhesion_)),
              tension(same<V>(w.adhesion_ / w.range_)), pull(same<V>(w.pull())),
              range(same<V>(w.range_)), rate(same<V>(1.0 / w.range_)),
              stiffness(same<V>(w.stiffness_)), first(same<V>(w.shape_.first)),
              least(
                  same<V>(w.shape_.repels ? -std::numeric_limits<double>::max() : w.shape_.first)),
              last(same<V>(w.shape_.last)), per_length(same<V>(w.per_length())),
              repels(w.shape_.repels) {}

        /// Returns the law times the factor of a site; a repulsion that is not of the shape stays.
        ASPERITY_INLINE Terms scaled(const LawFactors<V>& factors) const {
            const V factor = factors[LawFactor::attraction];
            Terms law = *this;
            law.adhesion = factor * adhesion;
            law.tension = factor * tension;
            law.pull = factor * pull;
            return law;
        }
        ASPERITY_INLINE V force(V gap) const {
            return attraction(gap) - stiffness * min(same<V>(0.0), gap);
        }
        ASPERITY_INLINE V energy(V gap) const {
            const V into = min(same<V>(0.0), gap), x = max(least, rate * gap);
            V row[4];
            gather_four(table, row_of(x), row);
            const V t = x - row[0], f = row[3] - t * (row[1] + same<V>(0.5) * t * row[2]);
            return select(x > last, same<V>(0.0), adhesion * f) +
                   into * (pull + same<V>(0.5) * stiffness * into);
        }
        /// Returns the gap at which a spring to the gap `target` holds a site in equilibrium, Å;
        /// the increasing part of the force is fixed at its value at `gap`.
        ASPERITY_INLINE V equilibrium(V gap, V target, V spring) const {
            if (!repels) { // nothing falls but the repulsion
                const V held = spring * target + attraction(gap);
                return select(held > same<V>(0.0), held / spring, held / (spring + stiffness));
            }
            const V x = rate * gap;
            V row[4];
            gather_four(falling, row_of(x), row);
            const V here = select(x > last, same<V>(0.0), row[1] + (x - row[0]) * row[2]);
            const V held = spring * target + (attraction(gap) - tension * here);
            const V stretch = spring * range;
            V k = same<V>(0.0);
            ASPERITY_UNROLL(1)
            for (int step = rows / 2; step > 0; step /= 2) {
                const V further = k + same<V>(step);
                gather_four(falling, further, row);
                k = select(held < stretch * row[0] - tension * row[1], k, further);
            }
            gather_four(falling, k, row);
            const V beyond = held - (stretch * row[0] - tension * row[1]);
            return range * (row[0] + beyond / (stretch - tension * row[2]));
        }

        const double *table, *falling;
        V adhesion, tension, pull, range, rate, stiffness, first, least, last, per_length;
        bool repels;

    private:
        /// Returns the index of the row that contains x; the last one for NaN.
        ASPERITY_INLINE V row_of(V x) const {
            const V y = max(same<V>(0.0), x - first), at = y / (same<V>(1.0) + y) * per_length;
            return max(min(nearest_whole(at - same<V>(0.5)), same<V>(rows - 2.0)), same<V>(0.0));
        }
        /// Returns the force of the shape.
        ASPERITY_INLINE V attraction(V gap) const {
            const V x = max(least, rate * gap);
            V row[4];
            gather_four(table, row_of(x), row);
            return select(x > last, same<V>(0.0), tension * (row[1] + (x - row[0]) * row[2]));
        }
    };
    /// Returns the law times the factor of a site; a repulsion that is not of the shape stays.
    ShapedWall scaled(const LawFactors<double>& factors) const {
        ShapedWall law = *this;
        law.adhesion_ *= factors[LawFactor::attraction];
        return law;
    }
    /// Returns the factor of the attraction for which scaled() has the fraction `part` of the work
    /// of adhesion.
    double factor_of(double part) const {
        return work_ > 0.0 ? amplitude(part * work_) / amplitude(work_) : 1.0;
    }
    double force(double gap) const { return Terms<double>(*this).force(gap); }
    double energy(double gap) const { return Terms<double>(*this).energy(gap); }
    /// Returns -dF/dg at this gap, eV/Å^2.
    double stiffness_at(double gap) const {
        const double x = gap / range_;
        if (x < shape_.first && !shape_.repels) return stiffness_;
        if (x > shape_.last) return 0.0;
        const double* row = shape_.force + 4 * row_of(x);
        return -row[2] * adhesion_ / (range_ * range_);
    }
    /// Returns the depth of a site below the wall under a pressing force (eV/Å), Å.
    double depth_under(double force) const {
        if (!shape_.repels) return (std::fmax(0.0, force) + pull()) / stiffness_;
        const double* row = shape_.force; // the first row, whose line goes on below it
        const double beyond = std::fmax(0.0, force * range_ / adhesion_ - row[1]);
        return std::fmax(0.0, -range_ * (row[0] + beyond / row[2]));
    }
    /// Returns the smallest stiffness -dF/dg of a site, eV/Å^2: negative.
    double softest() const { return -shape_.fastest * adhesion_ / (range_ * range_); }
    double range() const { return range_; } ///< returns rho, Å
    /// Returns the gap below which a site is in contact, Å: the gap of the largest tension, 0 if
    /// the shape begins at contact.
    double contact_gap() const { return shape_.repels ? range_ * shape_.steepest : 0.0; }
    /// Returns the gap beyond which the law is zero, Å.
    double reach() const { return adhesion_ > 0.0 ? range_ * shape_.last : 0.0; }
    /// Returns the gap of the energy minimum, Å.
    double deepest() const {
        return shape_.repels ? range_ * shape_.minimum : -pull() / stiffness_;
    }
    /// Returns the largest tension, eV/Å.
    double largest_tension() const { return shape_.tension * adhesion_ / range_; }
    /// Returns the gap of the largest tension, Å.
    double steepest() const { return range_ * shape_.steepest; }
    /// Returns true if the force has a kink at contact.
    bool has_kink() const { return !shape_.repels; }

private:
    std::ptrdiff_t row_of(double x) const {
        const double y = std::fmax(0.0, x - shape_.first);
        return static_cast<std::ptrdiff_t>(std::fmin(y / (1.0 + y) * per_length(), rows - 2.0));
    }
    /// Returns the number of rows per unit of y / (1 + y).
    double per_length() const {
        const double y = shape_.last - shape_.first;
        return (rows - 1) * (1.0 + y) / y;
    }
    /// Returns the tension at the beginning of a shape that does not repel, eV/Å.
    double pull() const { return shape_.repels ? 0.0 : -shape_.force[1] * adhesion_ / range_; }
    double amplitude(double work) const {
        if (shape_.repels) return work;
        const double slope = shape_.force[1];
        return 2.0 * work /
               (1.0 + std::sqrt(1.0 + 2.0 * work * slope * slope / (range_ * range_ * stiffness_)));
    }

    Shape shape_;
    double work_ = 0.0; ///< W of the whole law, without a factor
    double range_ = 1.0, stiffness_ = 0.0;
    double adhesion_ = 0.0; ///< A
};

} // namespace asperity
