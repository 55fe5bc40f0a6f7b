// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The reference sweep: slow, scalar and plain, the executable specification of docs/model.md.
//
// One loop over the rows of substrate atoms within the cutoff of the site, one over the atoms of a
// row. Atoms are counted beyond the box and folded back for their height alone, so periodic images
// need no thought and the cutoff may exceed the box. Cost: 4 r_c^2 / b^2 distances per site.
//
// The tail correction lives here too: it is one formula per site, no sum over pairs.
#include "kernels/interface_sweep.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace asperity {

namespace {

int fold(long i, int n) {
    const long r = i % n;
    return static_cast<int>(r < 0 ? r + n : r);
}

/// Farther out than this (in atoms) no index is formed; a site there has long left the model.
constexpr double farthest_index = 1e9;

} // namespace

PairSum pair_sum(const SubstrateMap& map, const LennardJones& potential, double x, double y,
                 double z) {
    PairSum sum;
    const double b = map.spacing;
    const bool somewhere =
        std::abs(x / b) < farthest_index && std::abs(y / b) < farthest_index && std::isfinite(z);
    if (!somewhere) {
        const double nan = std::numeric_limits<double>::quiet_NaN();
        sum.force[0] = sum.force[1] = sum.force[2] = sum.energy = nan;
        return sum;
    }
    const double reach = potential.cutoff;
    const long j_first = std::lround(std::floor((y - reach) / b));
    const long j_last = std::lround(std::ceil((y + reach) / b));
    const long i_first = std::lround(std::floor((x - reach) / b));
    const long i_last = std::lround(std::ceil((x + reach) / b));
    for (long j = j_first; j <= j_last; ++j) {
        const double dy = y - static_cast<double>(j) * b;
        const double* row =
            map.height + static_cast<std::ptrdiff_t>(fold(j, map.sites)) * map.sites;
        for (long i = i_first; i <= i_last; ++i) {
            const double dx = x - static_cast<double>(i) * b;
            const double dz = z - row[fold(i, map.sites)];
            const double r2 = dx * dx + dy * dy + dz * dz;
            if (r2 >= potential.r2_cut()) continue;
            const double f = potential.force_over_distance(r2);
            sum.force[0] += f * dx;
            sum.force[1] += f * dy;
            sum.force[2] += f * dz;
            sum.energy += potential.energy(r2);
            if (r2 < sum.nearest_r2) sum.nearest_r2 = r2;
        }
    }
    return sum;
}

void reference_sweep(const InterfaceSites& sites, const SubstrateMap& map,
                     const LennardJones& potential, int row_begin, int row_end,
                     InterfaceSums& sums) {
    const auto& u = sites.displacement;
    const double a = sites.spacing;
    const double contact = potential.contact_distance();
    for (int y = row_begin; y < row_end; ++y)
        for (int x = 0; x < u.x.nx; ++x) {
            const PairSum site =
                pair_sum(map, potential, (sites.x0 + x + 0.5) * a + u.x(x, y),
                         (sites.y0 + y + 0.5) * a + u.y(x, y), sites.reference_height + u.z(x, y));
            sites.force.x(x, y) = site.force[0];
            sites.force.y(x, y) = site.force[1];
            sites.force.z(x, y) = site.force[2];
            if (sites.nearest_r2.origin) sites.nearest_r2(x, y) = site.nearest_r2;
            sums.force_z.add(site.force[2]);
            sums.energy.add(site.energy);
            sums.in_contact += site.nearest_r2 < contact * contact;
            sums.pushed += site.force[2] > 0.0;
            sums.in_reach += 1;
            if (site.nearest_r2 < sums.closest_r2) sums.closest_r2 = site.nearest_r2;
        }
}

double TailCorrection::energy(double gap) const {
    const double cut = potential.cutoff;
    const double from = std::abs(gap) > cut ? std::abs(gap) : cut;
    const double s2 = potential.r0 * potential.r0 / (from * from);
    const double s4 = s2 * s2;
    // r0^12 / c^10 = r0^2 s^10, r0^6 / c^4 = r0^2 s^4.
    const double beyond = 8.0 * std::numbers::pi * density * potential.epsilon * potential.r0 *
                          potential.r0 * s4 * (s4 * s2 / 10.0 - 0.25);
    const double inside = cut * cut - gap * gap;
    return beyond + (inside > 0.0 ? std::numbers::pi * density * inside * potential.shift() : 0.0);
}

double TailCorrection::force(double gap) const {
    const double cut = potential.cutoff;
    const double from = std::abs(gap) > cut ? std::abs(gap) : cut;
    const double s2 = potential.r0 * potential.r0 / (from * from);
    const double s6 = s2 * s2 * s2;
    const double unshifted = 4.0 * potential.epsilon * s6 * (s6 - 1.0);
    return 2.0 * std::numbers::pi * density * gap * unshifted;
}

void tail_sweep(const InterfaceSites& sites, const TailCorrection& tail,
                PlaneView<const double> mean_height, int row_begin, int row_end, bool observe,
                InterfaceSums& sums) {
    for (int y = row_begin; y < row_end; ++y)
        for (int x = 0; x < mean_height.nx; ++x) {
            const double gap =
                sites.reference_height + sites.displacement.z(x, y) - mean_height(x, y);
            const double force = tail.force(gap);
            double& force_z = sites.force.z(x, y);
            if (observe) {
                sums.energy.add(tail.energy(gap));
                sums.pushed += (force_z + force > 0.0) - (force_z > 0.0);
            }
            force_z += force;
            sums.force_z.add(force);
        }
}

} // namespace asperity
