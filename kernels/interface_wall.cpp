// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The sweep over a wall, and sites that come to rest over it: a register of sites at a time;
// compiled once for each x86-64 level (variant.hpp).
#include "kernels/interface_block.hpp"
#include "kernels/pack_step.hpp"

#include <cmath>
#include <type_traits>

namespace asperity::ASPERITY_VARIANT {

namespace {

/// Height below every other one: a hole, whose height is NaN, is not above it.
constexpr double below_all = -HUGE_VAL;

/// Calls use(by_site, yields) with true or false as types: whether the law has factors at each
/// site, and whether sites yield.
template <class Law, class Use>
auto with_maps(const double* factors, const double* yield_gap, Use use) {
    const auto with = [&](auto by_site) {
        return yield_gap ? use(by_site, std::true_type()) : use(by_site, std::false_type());
    };
    if constexpr (ScaledBySite<Law>)
        if (factors) return with(std::true_type());
    return with(std::false_type());
}

/// Returns the law of a register of sites.
template <bool by_site, class Terms>
ASPERITY_INLINE auto law_at(const Terms& law, const LawFactors<const double*>& factors, int x,
                            int count) {
    if constexpr (by_site) {
        LawFactors<Real> here;
        for (std::size_t k = 0; k < here.count; ++k)
            here.of[k] = Real::load_first(factors.of[k] + x, count);
        return law.scaled(here);
    } else {
        return law;
    }
}

/// Returns the height of the wall below a register of sites; NaN where there is no solid.
template <bool yields>
ASPERITY_INLINE Real height_at(const double* below, const double* set, int count) {
    const Real height = Real::load_first(below, count);
    if constexpr (yields)
        return height - Real::load_first(set, count);
    else
        return height;
}

template <bool by_site, bool yields, bool observe, class Law>
void sweep_over(const Law& wall, const InterfaceSites& sites, const WallMaps& maps, int row_begin,
                int row_end, InterfaceSums& sums) {
    const int nx = sites.displacement.x.nx;
    const typename Law::template Terms<Real> whole(wall);
    const double contact_gap = wall.contact_gap();
    const Real nothing(below_all);
    const Real reference(sites.reference_height);
    Totals totals;
    for (int y = row_begin; y < row_end; ++y) {
        const double *u = sites.displacement.z.line(y), *below = maps.height.line(y);
        LawFactors<const double*> factors{};
        for (std::size_t k = 0; by_site && k < factors.count; ++k)
            factors.of[k] = maps.factors.of[k].line(y);
        const double* const yield_gap = yields ? maps.yield_gap.line(y) : nullptr;
        const double* const set = yields ? maps.set.line(y) : nullptr;
        for (int x = 0; x < nx; x += interface_block) {
            const int count = nx - x < interface_block ? nx - x : interface_block;
            SiteTerms terms;
            for (int lane = 0; lane < count; lane += Real::width) {
                const int here = count - lane;
                const Real under = height_at<yields>(below + x + lane, set + x + lane, here);
                const auto solid = under > nothing;
                const auto law = law_at<by_site>(whole, factors, x + lane, here);
                const Real gap = reference + Real::load_first(u + x + lane, here) -
                                 select(solid, under, Real(0.0));
                Real(0.0).store(terms.x + lane);
                Real(0.0).store(terms.y + lane);
                Real of_law = gap; // gap of the law
                if constexpr (yields)
                    of_law = max(gap, Real::load_first(yield_gap + x + lane, here));
                select(solid, law.force(of_law), Real(0.0)).store(terms.z + lane);
                if constexpr (observe) {
                    select(solid, law.energy(of_law), Real(0.0)).store(terms.energy + lane);
                    select(solid, gap, Real(no_pair)).store(terms.nearest + lane);
                }
            }
            if constexpr (observe)
                for (int i = 0; i < count; ++i) {
                    const double gap = terms.nearest[i], open = gap > 0.0 ? gap : 0.0;
                    terms.in_contact |= unsigned{gap < contact_gap} << i;
                    terms.nearest[i] = gap < no_pair ? open * open : no_pair;
                }
            totals.take<observe>(sites, terms, x, y, count);
        }
    }
    totals.give(sums);
}

template <bool observe>
void wall_sweep(const InterfaceSites& sites, const WallMaps& maps, const WallLaw& wall,
                int row_begin, int row_end, InterfaceSums& sums) {
    std::visit(
        [&]<class Law>(const Law& law) {
            with_maps<Law>(maps.factors.of[0].origin, maps.yield_gap.origin,
                           [&](auto by_site, auto yields) {
                               sweep_over<by_site(), yields(), observe>(law, sites, maps, row_begin,
                                                                        row_end, sums);
                           });
        },
        wall);
}

template <bool by_site, bool yields, class Law, class T>
WallSums rest_over(const Law& wall, const WallRow<T>& row, const WallRule& rule, int sites) {
    const typename Law::template Terms<Real> whole(wall);
    const Real reference(rule.reference_height), spring(rule.spring), momentum(rule.momentum);
    const Real compliance(1.0 / rule.spring), load(rule.load), norm(rule.norm);
    const Real nothing(below_all);
    Real furthest(0.0), reversal(0.0), height(0.0);
    for (int x = 0; x < sites; x += interface_block) {
        const int count = sites - x < interface_block ? sites - x : interface_block;
        alignas(64) double elastic[interface_block], step[interface_block];
        for (int i = 0; i < interface_block; ++i) {
            elastic[i] = i < count ? static_cast<double>(row.elastic[x + i]) : 0.0;
            step[i] = i < count ? static_cast<double>(row.step[x + i]) : 0.0;
        }
        for (int lane = 0; lane < count; lane += Real::width) {
            const int here = count - lane;
            const auto law = law_at<by_site>(whole, row.factors, x + lane, here);
            const Real u = Real::load_first(row.u + x + lane, here);
            const Real under = height_at<yields>(row.below + x + lane, row.set + x + lane, here);
            const auto solid = under > nothing;
            const Real base = reference - select(solid, under, Real(0.0));
            const Real z = u + momentum * Real::load(step + lane);
            const Real force = norm * Real::load(elastic + lane) + load;
            const Real target = z + base - compliance * force;
            Real equilibrium = law.equilibrium(z + base, target, spring), yield_gap(0.0);
            if constexpr (yields) { // the force is the smaller one, and so is the gap
                yield_gap = Real::load_first(row.yield_gap + x + lane, here);
                equilibrium = min(equilibrium, target + compliance * law.force(yield_gap));
            }
            const Real gap = select(solid, equilibrium, target);
            const Real next = gap - base, way = next - z;
            next.store_first(row.next + x + lane, here);
            Real of_law = gap; // gap of the law
            if constexpr (yields) of_law = max(gap, yield_gap);
            const Real left =
                select(solid, target - gap + compliance * law.force(of_law), Real(0.0));
            furthest = max(furthest, first_lanes(max(way, -way) + max(left, -left), here));
            reversal = reversal - first_lanes(way * (next - u), here);
            height = height + first_lanes(next, here);
        }
    }
    return {-lowest(Real(0.0) - furthest), total(reversal), total(height)};
}

template <class T>
WallSums rest_row(const WallLaw& wall, const WallRow<T>& row, const WallRule& rule, int sites) {
    return std::visit(
        [&]<class Law>(const Law& law) {
            return with_maps<Law>(row.factors.of[0], row.yield_gap, [&](auto by_site, auto yields) {
                return rest_over<by_site(), yields()>(law, row, rule, sites);
            });
        },
        wall);
}

} // namespace

extern const WallKernels wall_kernels;
const WallKernels wall_kernels = {
    {wall_sweep<false>, wall_sweep<true>}, rest_row<double>, rest_row<float>};

} // namespace asperity::ASPERITY_VARIANT
