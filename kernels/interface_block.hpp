// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Blocks of sites on packs for the sweeps over atoms: transfer of their sums, and the loop over a
// tile's rows.
#pragma once

#include "kernels/interface_kernels.hpp"
#include "kernels/interface_site.hpp"
#include "kernels/simd.hpp"

namespace asperity::ASPERITY_VARIANT {

using Real = Pack<double>;
using BlockOfSites = SiteBlock<Real, interface_block>;

/// Finished sums of a block of sites: forces, eV/Å, energies, eV, nearest r^2, Å^2.
struct SiteTerms {
    alignas(64) double x[interface_block], y[interface_block], z[interface_block];
    alignas(64) double energy[interface_block], nearest[interface_block];
    std::uint32_t in_contact = 0; ///< one bit for each site

    void clear() {
        in_contact = 0;
        for (int i = 0; i < interface_block; ++i) {
            x[i] = y[i] = z[i] = energy[i] = 0.0;
            nearest[i] = no_pair;
        }
    }
};

/// Totals over sites. Stores the forces of finished blocks and adds their sums to the totals.
struct Totals {
    BasicExactSum<Real> force_z, energy;
    std::int64_t in_contact = 0, repulsive = 0;
    double closest_r2 = no_pair;

    template <bool observe>
    ASPERITY_INLINE void take(const InterfaceSites& sites, const SiteTerms& s, int x, int y,
                              int count) {
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
                    repulsive += z[i] > 0.0;
                    closest_r2 = nearest[i] < closest_r2 ? nearest[i] : closest_r2;
                }
            }
        }
        if constexpr (observe) {
            in_contact += __builtin_popcount(s.in_contact);
            if (sites.in_contact.origin)
                for (int i = 0; i < count; ++i)
                    sites.in_contact(x + i, y) = s.in_contact >> i & 1u;
        }
    }
    /// Writes zeros for sites without an atom within the interaction range; the sums do not change.
    template <bool observe>
    ASPERITY_INLINE void pass(const InterfaceSites& sites, int x, int y, int count) const {
        for (int i = x; i < x + count; ++i) {
            sites.force.x(i, y) = 0.0;
            sites.force.y(i, y) = 0.0;
            sites.force.z(i, y) = 0.0;
            if (observe && sites.nearest_r2.origin) sites.nearest_r2(i, y) = no_pair;
            if (observe && sites.in_contact.origin) sites.in_contact(i, y) = 0;
        }
    }
    /// Adds the totals to the sums of a sweep.
    void give(InterfaceSums& sums) const {
        for (int i = 0; i < Real::width; ++i) {
            sums.force_z.merge({{force_z.bin[0][i], force_z.bin[1][i]}});
            sums.energy.merge({{energy.bin[0][i], energy.bin[1][i]}});
        }
        sums.in_contact += in_contact;
        sums.repulsive += repulsive;
        sums.closest_r2 = closest_r2 < sums.closest_r2 ? closest_r2 : sums.closest_r2;
    }
};

/// Replaces the sums of sites that the tables do not cover (bits of `beyond`) by those of the
/// reference loop.
template <class Exact, class Potential>
void sum_beyond(const InterfaceSites& sites, const Exact& exact, const Potential& potential,
                unsigned beyond, int x, int y, int count, SiteTerms& s) {
    const auto& u = sites.displacement;
    for (int i = 0; i < count; ++i) {
        if (!(beyond >> i & 1u)) continue;
        const PairSum p =
            pair_sum(exact, potential, (sites.x0 + x + i + 0.5) * sites.spacing + u.x(x + i, y),
                     (sites.y0 + y + 0.5) * sites.spacing + u.y(x + i, y),
                     sites.reference_height + u.z(x + i, y));
        s.x[i] = p.force[0];
        s.y[i] = p.force[1];
        s.z[i] = p.force[2];
        s.energy[i] = p.energy;
        s.nearest[i] = p.nearest_r2;
        s.in_contact = (s.in_contact & ~(1u << i)) | (unsigned{p.in_contact} << i);
    }
}

/// Properties of a substrate for sweep_blocks(): the datum of heights, the largest lateral
/// displacement that its tables allow for, the argument of the reference loop, its reach, and
/// of_types, true if its atoms may have several types. With several types sum() decides which sites
/// are in contact; otherwise the distance of the nearest atom decides.
template <class Substrate>
struct SubstrateAccess {
    static constexpr bool of_types = false;
    const Substrate& from;
    double datum() const { return from.heights.datum; }
    double margin() const { return from.reach.offset_margin; }
    const SubstrateMap& exact() const { return from.map; }
    template <class Pair>
    ASPERITY_INLINE Reach reach(int x, int y, const BlockOfSites& site, const Pair& pair) const {
        return Reach(from.reach, x, y, from.heights.datum, site, pair.cutoff, pair.closest);
    }
};

/// Sweeps rows [row_begin, row_end) block by block. sum(site, reach, x, y, count, terms): sums the
/// pairs of a block, which differs between substrates.
template <bool observe, class Substrate, class Potential, class Pair, class SumOfPairs>
ASPERITY_INLINE void sweep_blocks(const InterfaceSites& sites, const Substrate& substrate,
                                  const Potential& potential, const Pair& pair, int row_begin,
                                  int row_end, HeightRange range, InterfaceSums& sums,
                                  SumOfPairs sum) {
    const SubstrateAccess<Substrate> access{substrate};
    const double datum = access.datum();
    const int nx = sites.displacement.x.nx;
    Totals totals;
    for (int y = row_begin; y < row_end; ++y)
        for (int x = 0; x < nx; x += interface_block) {
            const int count = nx - x < interface_block ? nx - x : interface_block;
            const BlockOfSites site(sites, x, y, count, datum, range, access.margin());
            const auto reach = access.reach(x, y, site, pair);
            if (!reach.any() && !site.beyond) {
                totals.pass<observe>(sites, x, y, count);
                continue;
            }
            SiteTerms terms;
            if (reach.any()) {
                sum(site, reach, x, y, count, terms);
                if constexpr (observe && !SubstrateAccess<Substrate>::of_types) {
                    terms.in_contact = 0;
                    for (int i = 0; i < count; ++i)
                        terms.in_contact |= unsigned{terms.nearest[i] < pair.contact_r2} << i;
                }
            } else {
                terms.clear();
            }
            if (site.beyond)
                sum_beyond(sites, access.exact(), potential, site.beyond, x, y, count, terms);
            totals.take<observe>(sites, terms, x, y, count);
        }
    totals.give(sums);
}

} // namespace asperity::ASPERITY_VARIANT
