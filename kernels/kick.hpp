// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The kick of a time step and its sums, for packs and for the threads of a device.
#pragma once

#include "kernels/elastic_level.hpp"
#include "kernels/variant.hpp"

namespace asperity::ASPERITY_VARIANT {

/// A force, displacement or distance on V's nodes.
template <class V>
struct Triple {
    V x, y, z;
};
template <class V>
ASPERITY_INLINE Triple<V> operator+(const Triple<V>& a, const Triple<V>& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class V>
ASPERITY_INLINE Triple<V> operator-(const Triple<V>& a, const Triple<V>& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}

/// An exact sum (exact_sum.hpp) of products. Its bins contain their shifters, so that the addition
/// to a bin also splits the term, which takes five operations instead of seven.
///
/// The sum of a term's parts in the two bins does not depend on the contents of the bins. The
/// coarse part depends on them if a b lies halfway between two coarse quanta, but the fine part
/// compensates exactly. No rest lies halfway between two fine quanta, because its last bit is set.
/// The sum of the terms between two calls of close() must stay below 2^29.
template <class V>
class ProductSum {
public:
    /// Adds the product a b.
    ASPERITY_INLINE void add(V a, V b) {
        const V coarse = fma(a, b, coarse_);
        const V part = coarse - coarse_;
        coarse_ = coarse;
        fine_ = fine_ + with_last_bit(fms(a, b, part));
    }
    /// Adds the bins, without their shifters, to the sum and resets them.
    ASPERITY_INLINE void close() {
        const V coarse(Sum::shifter(0)), fine(Sum::shifter(1));
        sum_.bin[0] = sum_.bin[0] + (coarse_ - coarse);
        sum_.bin[1] = sum_.bin[1] + (fine_ - fine);
        coarse_ = coarse;
        fine_ = fine;
    }
    /// Returns the sum of the terms before the last close().
    ASPERITY_INLINE const BasicExactSum<V>& sum() const { return sum_; }

private:
    using Sum = BasicExactSum<V>;
    V coarse_ = V(Sum::shifter(0)), fine_ = V(Sum::shifter(1));
    Sum sum_;
};

/// Functor that kicks the nodes of one plane.
template <class V, bool damped, bool observed>
class Kicker {
public:
    ASPERITY_INLINE Kicker(const Kick& plan, const VectorVolume<double>& v)
        : velocity_factor_(plan.velocity_factor), kick_(plan.kick), drag_(plan.drag_z),
          medium_(2.0 * plan.medium_z), kinetic_weight_(0.25 * plan.half_mass),
          loss_weight_(0.25 * plan.drag), given_weight_(0.5 * plan.drag),
          per_force_(plan.per_force), x_(v.x.origin), y_(v.y.origin), z_(v.z.origin) {}

    /// Kicks the first `count` nodes of a V from element `at` of the volume on, under the force f,
    /// eV/Å. Returns the new velocities, Å/fs.
    ASPERITY_INLINE Triple<V> operator()(std::ptrdiff_t at, int count, const Triple<V>& f) {
        const V old_x = V::load(x_ + at), old_y = V::load(y_ + at), old_z = V::load(z_ + at);
        V new_x, new_y, new_z;
        if constexpr (damped) {
            new_x = fma(kick_, f.x, velocity_factor_ * old_x);
            new_y = fma(kick_, f.y, velocity_factor_ * old_y);
            new_z = fma(kick_, f.z, fma(velocity_factor_, old_z, drag_));
        } else {
            new_x = fma(kick_, f.x, old_x);
            new_y = fma(kick_, f.y, old_y);
            new_z = fma(kick_, f.z, old_z);
        }
        // Twice the velocity at the whole step; factors of two are exact.
        V wx = old_x + new_x, wy = old_y + new_y, wz = old_z + new_z;
        V rz = wz - medium_;
        if (count >= V::width) [[likely]] {
            new_x.store(x_ + at);
            new_y.store(y_ + at);
            new_z.store(z_ + at);
        } else {
            new_x.store_first(x_ + at, count);
            new_y.store_first(y_ + at, count);
            new_z.store_first(z_ + at, count);
            wx = first_lanes(wx, count);
            wy = first_lanes(wy, count);
            wz = first_lanes(wz, count);
            rz = first_lanes(rz, count);
        }
        if constexpr (observed) {
            kinetic_.add(kinetic_weight_, fma(wx, wx, fma(wy, wy, wz * wz)));
            V squares = fma(f.x, f.x, fma(f.y, f.y, f.z * f.z));
            if (count < V::width) squares = first_lanes(squares, count);
            of_step_.add(per_force_, squares);
        }
        if constexpr (damped) {
            dissipated_.add(loss_weight_, fma(wx, wx, fma(wy, wy, rz * rz)));
            dragged_.add(given_weight_, rz);
        }
        return {new_x, new_y, new_z};
    }

    /// Ends a row: closes the sums, which keeps their bins within range.
    ASPERITY_INLINE void end_row() {
        if constexpr (observed) kinetic_.close();
        if constexpr (observed) of_step_.close();
        if constexpr (damped) dissipated_.close();
        if constexpr (damped) dragged_.close();
    }
    /// Adds the sums of the closed rows.
    ASPERITY_INLINE void add_to(KickSums& sums) const {
        if constexpr (observed) collect(kinetic_.sum(), sums.kinetic);
        if constexpr (observed) collect(of_step_.sum(), sums.of_step);
        if constexpr (damped) {
            collect(dissipated_.sum(), sums.dissipated);
            collect(dragged_.sum(), sums.dragged);
        }
    }

private:
    V velocity_factor_, kick_, drag_, medium_, kinetic_weight_, loss_weight_, given_weight_,
        per_force_;
    double *x_, *y_, *z_;
    ProductSum<V> kinetic_, of_step_, dissipated_, dragged_;
};

} // namespace asperity::ASPERITY_VARIANT
