// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What becomes of a pack of forces in a time step: the kick, and the step's sums. Shared by the
// elastic kernels of small and finite strain.
#pragma once

#include "kernels/elastic_cell.hpp"
#include "kernels/simd.hpp"

namespace asperity::ASPERITY_VARIANT {

/// A force, displacement or distance on a pack of nodes.
struct PackVector {
    Pack<double> x, y, z;
};

/// 0, 1, 2, ... as a pack: to switch off lanes behind the end of a row.
ASPERITY_INLINE Pack<double> lane_numbers() {
    double lane[Pack<double>::width];
    for (int i = 0; i < Pack<double>::width; ++i)
        lane[i] = i;
    return Pack<double>::load(lane);
}

ASPERITY_INLINE void collect(const BasicExactSum<Pack<double>>& lanes, ExactSum& into) {
    for (int k = 0; k < ExactSum::bins; ++k)
        for (int i = 0; i < Pack<double>::width; ++i)
            into.bin[k] += lanes.bin[k][i];
}

/// Kicks the nodes of one plane, pack by pack.
template <bool damped, bool observed>
class Kicker {
    using V = Pack<double>;

public:
    ASPERITY_INLINE Kicker(const Kick& plan, const VectorVolume<double>& v)
        : keep_(plan.keep), kick_(plan.kick), drag_(plan.drag_z), plan_(plan), v_(v) {}

    /// The first count nodes from element `at` of the volume, under the force f.
    ASPERITY_INLINE void operator()(std::ptrdiff_t at, int count, const PackVector& f) {
        const V old_x = V::load(v_.x.origin + at);
        const V old_y = V::load(v_.y.origin + at);
        const V old_z = V::load(v_.z.origin + at);
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
        new_x.store_first(v_.x.origin + at, count);
        new_y.store_first(v_.y.origin + at, count);
        new_z.store_first(v_.z.origin + at, count);
        if constexpr (damped || observed) {
            // Twice the velocity at the whole step; factors of two are exact.
            const V wx = old_x + new_x, wy = old_y + new_y, wz = old_z + new_z;
            const V zero(0.0);
            [[maybe_unused]] V energy = zero, loss = zero, given = zero;
            if constexpr (observed)
                energy = V(0.25 * plan_.half_mass) * fma(wx, wx, fma(wy, wy, wz * wz));
            if constexpr (damped) {
                const V rz = wz - V(2.0 * plan_.medium_z);
                loss = V(0.25 * plan_.drag) * fma(wx, wx, fma(wy, wy, rz * rz));
                given = V(0.5 * plan_.drag) * rz;
            }
            if (count < V::width) {
                const auto inside = lane_numbers() < V(static_cast<double>(count));
                energy = select(inside, energy, zero);
                loss = select(inside, loss, zero);
                given = select(inside, given, zero);
            }
            if constexpr (observed) kinetic_.add(energy);
            if constexpr (damped) {
                dissipated_.add(loss);
                dragged_.add(given);
            }
        }
    }

    ASPERITY_INLINE void add_to(KickSums& sums) const {
        if constexpr (observed) collect(kinetic_, sums.kinetic);
        if constexpr (damped) {
            collect(dissipated_, sums.dissipated);
            collect(dragged_, sums.dragged);
        }
    }

private:
    V keep_, kick_, drag_;
    const Kick& plan_;
    const VectorVolume<double>& v_;
    BasicExactSum<V> kinetic_, dissipated_, dragged_;
};

} // namespace asperity::ASPERITY_VARIANT
