// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Blocks of sites, as both sweeps of the interface take them: displacements made safe, the reach
// that follows from the gap, sums handed over, and the loop over a tile's rows.
#pragma once

#include "kernels/interface_pair.hpp"

namespace asperity::ASPERITY_VARIANT {

/// The finished sums of a block of sites: forces, eV/Å, energies, eV, nearest r^2, Å^2.
struct SiteTerms {
    alignas(64) double x[interface_block], y[interface_block], z[interface_block];
    alignas(64) double energy[interface_block], nearest[interface_block];

    void clear() {
        for (int i = 0; i < interface_block; ++i) {
            x[i] = y[i] = z[i] = energy[i] = 0.0;
            nearest[i] = no_pair;
        }
    }
};

/// Displacements of one block of sites, made safe for the tables.
struct SiteBlock {
    alignas(64) double ux[interface_block], uy[interface_block];
    alignas(64) double z[interface_block]; ///< over the datum, Å
    double lowest_z, highest_z;            ///< over the sites, Å
    double sideways;                       ///< greatest |(ux, uy)|, Å
    unsigned beyond; ///< bits of sites that the tables do not cover: left to the reference loop

    /// Sites x to x + count of row y; behind a row's end its last site is repeated. Heights are
    /// counted from the datum; sites lower than `deepest` over it are beyond, and nothing is in
    /// reach of sites as high as the ceiling.
    ASPERITY_INLINE SiteBlock(const InterfaceSites& sites, int x, int y, int count, double datum,
                              double deepest, double ceiling, double margin) {
        const auto load = [&](const double* row, int lane) {
            if (lane + Real::width <= count) return Real::load(row + x + lane);
            Real tail;
            for (int i = 0; i < Real::width; ++i)
                tail.r[i] = row[x + (lane + i < count ? lane + i : count - 1)];
            return tail;
        };
        const double rise = sites.reference_height - datum;
        Real least(1e300), most(-1e300), widest(0.0);
        beyond = 0;
        for (int lane = 0; lane < interface_block; lane += Real::width) {
            Real x_lanes = load(sites.displacement.x.line(y), lane);
            Real y_lanes = load(sites.displacement.y.line(y), lane);
            const Real uz = load(sites.displacement.z.line(y), lane);
            Real z_lanes = uz + Real(rise);
            // Not-a-number or infinity in any component makes this not-a-number: a lane beyond.
            const Real u2 = fma(x_lanes, x_lanes, y_lanes * y_lanes) + uz * Real(0.0);
            const Real kept =
                select(z_lanes > Real(deepest), select(u2 < Real(margin * margin), u2, Real(-1.0)),
                       Real(-1.0));
            const unsigned left = bits_where_less(kept, Real(0.0));
            if (left) {
                beyond |= left << lane;
                const auto near = kept > Real(-0.5);
                x_lanes = select(near, x_lanes, Real(0.0));
                y_lanes = select(near, y_lanes, Real(0.0));
                z_lanes = select(near, z_lanes, Real(ceiling));
            }
            z_lanes = min(z_lanes, Real(ceiling));
            x_lanes.store(ux + lane);
            y_lanes.store(uy + lane);
            z_lanes.store(z + lane);
            least = min(least, z_lanes);
            most = max(most, z_lanes);
            widest = max(widest, kept);
        }
        lowest_z = lowest(least);
        highest_z = -lowest(-most);
        sideways = std::sqrt(-lowest(-widest));
    }
};

/// Rounding in a bound must never drop a pair that the mask would keep.
constexpr double bound_slack = 1e-6;

/// Which atoms matter to a block of sites, by lateral distance, Å.
struct Reach {
    double from_rest =
        -1.0;               ///< beyond this, from the undisplaced site, none; negative: none at all
    double from_site = 0.0; ///< likewise from the displaced site
    double inside = 1e6;    ///< within this, from the undisplaced site, all are within the cutoff
    bool close = false;     ///< some may be closer than r2_floor

    ASPERITY_INLINE Reach(const ReachBounds& bounds, int x, int y, double datum,
                          const SiteBlock& site, double cutoff, double floor) {
        const double cut2 = cutoff * cutoff, u = site.sideways, w = bounds.ring_width;
        const Real low(site.lowest_z + datum), high(site.highest_z + datum);
        const std::ptrdiff_t first =
            (static_cast<std::ptrdiff_t>(y) * bounds.blocks + x / interface_block) *
            interface_rings;
        double gap2[interface_rings], far2[interface_rings];
        // Bits of rings: some atom may be within the cutoff, some beyond it, some within r2_floor.
        unsigned some_within = 0, some_beyond = 0, some_close = 0;
        constexpr double count[8] = {0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0};
        Real begin = Real(w) * Real::load(count);
        for (int ring = 0; ring < interface_rings; ring += Real::width) {
            const Real top = Real::load(bounds.highest + first + ring);
            const Real bottom = Real::load(bounds.lowest + first + ring);
            const Real gap = max(low - top, Real(0.0)), far = max(top - low, high - bottom);
            const Real nearest = max(begin - Real(u + bound_slack), Real(0.0));
            const Real farthest = begin + Real(w + u + bound_slack);
            const Real squares = gap * gap;
            squares.store(gap2 + ring);
            (far * far).store(far2 + ring);
            some_within |= bits_where_less(fma(nearest, nearest, squares), Real(cut2)) << ring;
            some_beyond |= bits_where_less(Real(cut2), fma(farthest, farthest, far * far)) << ring;
            some_close |= bits_where_less(fma(nearest, nearest, squares), Real(floor * floor));
            begin = begin + Real(w * Real::width);
        }
        close = some_close != 0;
        if (some_within) {
            // Atoms of the rings outside the last one in reach are known to be out of it.
            const int outer = 31 - __builtin_clz(some_within);
            const double chord = std::sqrt(cut2 - gap2[outer]) + bound_slack;
            const double edge = (outer + 1) * w + bound_slack;
            from_rest = chord + u < edge ? chord + u : edge;
            // Atoms of the rings within may have less of a gap.
            const double held = outer * w + u < cutoff ? outer * w + u : cutoff;
            from_site = chord < edge + u ? chord : edge + u;
            from_site = from_site > held ? from_site : held;
        }
        if (some_beyond) {
            const int inner = __builtin_ctz(some_beyond);
            const double room2 = cut2 - far2[inner];
            const double room = room2 > 0.0 ? std::sqrt(room2) - u : 0.0;
            inside = (room > inner * w ? room : inner * w) - bound_slack;
        }
    }
};

/// Hands a finished block of sites over: forces to memory, sums to the totals.
struct Totals {
    BasicExactSum<Real> force_z, energy;
    std::int64_t in_contact = 0, pushed = 0, in_reach = 0;
    double closest_r2 = no_pair;

    template <bool observe>
    ASPERITY_INLINE void take(const InterfaceSites& sites, double contact_r2, const SiteTerms& s,
                              int x, int y, int count) {
        for (int lane = 0; lane < count; lane += Real::width) {
            const int here = count - lane < Real::width ? count - lane : Real::width;
            Real z = Real::load(s.z + lane);
            Real::load(s.x + lane).store_first(sites.force.x.line(y) + x + lane, here);
            Real::load(s.y + lane).store_first(sites.force.y.line(y) + x + lane, here);
            z.store_first(sites.force.z.line(y) + x + lane, here);
            for (int i = here; i < Real::width; ++i)
                z.r[i] = 0.0;
            force_z.add(z);
            if constexpr (observe) {
                Real e = Real::load(s.energy + lane);
                const Real nearest = Real::load(s.nearest + lane);
                for (int i = here; i < Real::width; ++i)
                    e.r[i] = 0.0;
                energy.add(e);
                if (sites.nearest_r2.origin)
                    nearest.store_first(sites.nearest_r2.line(y) + x + lane, here);
                for (int i = 0; i < here; ++i) {
                    in_contact += nearest[i] < contact_r2;
                    pushed += z[i] > 0.0;
                    closest_r2 = nearest[i] < closest_r2 ? nearest[i] : closest_r2;
                }
            }
        }
    }
    /// The same for sites with nothing in reach: zeros, which change no sum.
    template <bool observe>
    ASPERITY_INLINE void pass(const InterfaceSites& sites, int x, int y, int count) const {
        for (int i = x; i < x + count; ++i) {
            sites.force.x(i, y) = 0.0;
            sites.force.y(i, y) = 0.0;
            sites.force.z(i, y) = 0.0;
            if (observe && sites.nearest_r2.origin) sites.nearest_r2(i, y) = no_pair;
        }
    }
    void give(InterfaceSums& sums) const {
        for (int i = 0; i < Real::width; ++i)
            for (int k = 0; k < ExactSum::bins; ++k) {
                sums.force_z.bin[k] += force_z.bin[k][i];
                sums.energy.bin[k] += energy.bin[k][i];
            }
        sums.in_contact += in_contact;
        sums.pushed += pushed;
        sums.in_reach += in_reach;
        sums.closest_r2 = closest_r2 < sums.closest_r2 ? closest_r2 : sums.closest_r2;
    }
};

/// Replaces the sites that the tables do not cover by the reference loop.
inline void sum_beyond(const InterfaceSites& sites, const SubstrateMap& map, const LennardJones& lj,
                       unsigned beyond, int x, int y, int count, SiteTerms& s) {
    const auto& u = sites.displacement;
    for (int i = 0; i < count; ++i) {
        if (!(beyond >> i & 1u)) continue;
        const PairSum p =
            pair_sum(map, lj, (sites.x0 + x + i + 0.5) * sites.spacing + u.x(x + i, y),
                     (sites.y0 + y + 0.5) * sites.spacing + u.y(x + i, y),
                     sites.reference_height + u.z(x + i, y));
        s.x[i] = p.force[0];
        s.y[i] = p.force[1];
        s.z[i] = p.force[2];
        s.energy[i] = p.energy;
        s.nearest[i] = p.nearest_r2;
    }
}

/// The sweep over rows [row_begin, row_end), a block of sites at a time; sum(site, reach, x, y,
/// count, terms) is what differs between substrates.
template <class T, bool observe, class Substrate, class SumOfPairs>
ASPERITY_INLINE void sweep_blocks(const InterfaceSites& sites, const Substrate& substrate,
                                  const LennardJones& lj, const PairTerms<T>& pair, int row_begin,
                                  int row_end, InterfaceSums& sums, SumOfPairs sum) {
    const double datum = substrate.heights.datum;
    // Atoms deeper than the fixed depth are not where they seem: nothing may reach down to them.
    constexpr bool fixed = std::is_same_v<T, float>;
    const double deepest = fixed ? lj.cutoff - fixed_depth : -1e300;
    const double ceiling = fixed ? fixed_depth : 1e6;
    const int nx = sites.displacement.x.nx;
    Totals totals;
    for (int y = row_begin; y < row_end; ++y)
        for (int x = 0; x < nx; x += interface_block) {
            const int count = nx - x < interface_block ? nx - x : interface_block;
            const SiteBlock site(sites, x, y, count, datum, deepest, ceiling,
                                 substrate.reach.offset_margin);
            const Reach reach(substrate.reach, x, y, datum, site, pair.cutoff, pair.floor);
            if (reach.from_rest < 0.0 && !site.beyond) {
                totals.pass<observe>(sites, x, y, count);
                continue;
            }
            SiteTerms terms;
            if (reach.from_rest > 0.0) {
                sum(site, reach, x, y, count, terms);
                totals.in_reach += count;
            } else {
                terms.clear();
            }
            if (site.beyond) sum_beyond(sites, substrate.map, lj, site.beyond, x, y, count, terms);
            totals.take<observe>(sites, pair.contact_r2, terms, x, y, count);
        }
    totals.give(sums);
}

} // namespace asperity::ASPERITY_VARIANT
