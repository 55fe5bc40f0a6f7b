// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What becomes of a force in a time step: the kick and its sums. One text for packs and for the
// threads of a device.
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

/// Adds a times b; both parts of it are split off without rounding the product first, which takes
/// an addition and a multiplication less.
template <class V>
ASPERITY_INLINE void add_product(BasicExactSum<V>& sum, V a, V b) {
    const V coarse(sum.shifter(0)), fine(sum.shifter(1));
    const V part = fma(a, b, coarse) - coarse;
    sum.bin[0] = sum.bin[0] + part;
    sum.bin[1] = sum.bin[1] + ((fms(a, b, part) + fine) - fine);
}

/// Kicks the nodes of one plane, V by V.
template <class V, bool damped, bool observed>
class Kicker {
public:
    ASPERITY_INLINE Kicker(const Kick& plan, const VectorVolume<double>& v)
        : keep_(plan.keep), kick_(plan.kick), drag_(plan.drag_z), medium_(2.0 * plan.medium_z),
          kinetic_weight_(0.25 * plan.half_mass), loss_weight_(0.25 * plan.drag),
          given_weight_(0.5 * plan.drag), x_(v.x.origin), y_(v.y.origin), z_(v.z.origin) {}

    /// The first count nodes from element `at` of the volume, under the force f. Their new
    /// velocities.
    ASPERITY_INLINE Triple<V> operator()(std::ptrdiff_t at, int count, const Triple<V>& f) {
        const V old_x = V::load(x_ + at), old_y = V::load(y_ + at), old_z = V::load(z_ + at);
        V new_x, new_y, new_z;
        if constexpr (damped) {
            new_x = fma(kick_, f.x, keep_ * old_x);
            new_y = fma(kick_, f.y, keep_ * old_y);
            new_z = fma(kick_, f.z, fma(keep_, old_z, drag_));
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
        if constexpr (observed)
            add_product(kinetic_, kinetic_weight_, fma(wx, wx, fma(wy, wy, wz * wz)));
        if constexpr (damped) {
            add_product(dissipated_, loss_weight_, fma(wx, wx, fma(wy, wy, rz * rz)));
            add_product(dragged_, given_weight_, rz);
        }
        return {new_x, new_y, new_z};
    }

    ASPERITY_INLINE void add_to(KickSums& sums) const {
        if constexpr (observed) collect(kinetic_, sums.kinetic);
        if constexpr (damped) {
            collect(dissipated_, sums.dissipated);
            collect(dragged_, sums.dragged);
        }
    }

private:
    V keep_, kick_, drag_, medium_, kinetic_weight_, loss_weight_, given_weight_;
    double *x_, *y_, *z_;
    BasicExactSum<V> kinetic_, dissipated_, dragged_;
};

} // namespace asperity::ASPERITY_VARIANT
