// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The reference sweep: slow, scalar and plain, the executable specification of
// docs/explanation/model.md.
//
// One loop over the rows of substrate atoms within the cutoff of the site, one over the atoms of a
// row. Atoms are counted beyond the box and folded back for their height alone, so periodic images
// need no thought and the cutoff may exceed the box. Cost: 4 r_c^2 / b^2 distances per site. Over
// atoms anywhere: one loop over all of them, and over the images of each within the cutoff.
//
// The tail correction is here too: it is one formula per site, no sum over pairs.
#include "kernels/interface_kernels.hpp"

namespace asperity {

PairSum pair_sum(const SubstrateMap& map, const PairPotential& potential, double x, double y,
                 double z) {
    return std::visit(
        [&](const auto& p) {
            PairSum sum = portable::sum_of_pairs(map, Pair(p), x, y, z);
            sum.in_contact = sum.nearest_r2 < p.inflection() * p.inflection();
            return sum;
        },
        potential);
}

namespace {

/// Adds the atoms of one type.
template <class P>
void add_type(const SubstrateAtoms& atoms, int type, const P& potential, double x, double y,
              double z, PairSum& sum) {
    const double edge = atoms.edge, reach = potential.cutoff, contact = potential.inflection();
    const Pair<P> pair(potential);
    for (std::int64_t i = 0; i < atoms.count; ++i) {
        if (atoms.type && atoms.type[i] != type) continue;
        const double dz = z - atoms.z[i];
        PairSum of_atom;
        for (double n = std::ceil((y - reach - atoms.y[i]) / edge);
             n <= std::floor((y + reach - atoms.y[i]) / edge); ++n)
            for (double m = std::ceil((x - reach - atoms.x[i]) / edge);
                 m <= std::floor((x + reach - atoms.x[i]) / edge); ++m) {
                const double dx = x - (atoms.x[i] + m * edge), dy = y - (atoms.y[i] + n * edge);
                portable::add_pair(pair, dx, dy, dz, of_atom);
            }
        for (int k = 0; k < 3; ++k)
            sum.force[k] += of_atom.force[k];
        sum.energy += of_atom.energy;
        sum.nearest_r2 = std::fmin(sum.nearest_r2, of_atom.nearest_r2);
        sum.in_contact |= of_atom.nearest_r2 < contact * contact;
    }
}

} // namespace

PairSum pair_sum(const SubstrateAtoms& atoms, const PairTable& pairs, double x, double y,
                 double z) {
    PairSum sum;
    if (!(std::fabs(x) + std::fabs(y) + std::fabs(z) < 1e9)) {
        sum.force[0] = sum.force[1] = sum.force[2] = sum.energy = std::nan("");
        return sum;
    }
    for (int type = 0; type < pairs.types; ++type)
        std::visit([&](const auto& p) { add_type(atoms, type, p, x, y, z, sum); }, pairs.of[type]);
    return sum;
}

namespace {

template <class Substrate, class Potential>
void sweep_one_by_one(const InterfaceSites& sites, const Substrate& substrate,
                      const Potential& potential, int row_begin, int row_end, InterfaceSums& sums) {
    const auto& u = sites.displacement;
    const double a = sites.spacing;
    for (int y = row_begin; y < row_end; ++y) {
        for (int x = 0; x < u.x.nx; ++x) {
            const PairSum site =
                pair_sum(substrate, potential, (sites.x0 + x + 0.5) * a + u.x(x, y),
                         (sites.y0 + y + 0.5) * a + u.y(x, y), sites.reference_height + u.z(x, y));
            sites.force.x(x, y) = site.force[0];
            sites.force.y(x, y) = site.force[1];
            sites.force.z(x, y) = site.force[2];
            if (sites.nearest_r2.origin) sites.nearest_r2(x, y) = site.nearest_r2;
            if (sites.in_contact.origin) sites.in_contact(x, y) = site.in_contact;
            sums.force_z.add(site.force[2]);
            sums.energy.add(site.energy);
            sums.in_contact += site.in_contact;
            sums.repulsive += site.force[2] > 0.0;
            if (site.nearest_r2 < sums.closest_r2) sums.closest_r2 = site.nearest_r2;
        }
        sums.carry();
    }
}

} // namespace

void reference_sweep(const InterfaceSites& sites, const SubstrateMap& map,
                     const PairPotential& potential, int row_begin, int row_end,
                     InterfaceSums& sums) {
    sweep_one_by_one(sites, map, potential, row_begin, row_end, sums);
}
void reference_sweep(const InterfaceSites& sites, const SubstrateAtoms& atoms,
                     const PairTable& pairs, int row_begin, int row_end, InterfaceSums& sums) {
    sweep_one_by_one(sites, atoms, pairs, row_begin, row_end, sums);
}

namespace {

template <class P>
void add_tail(const Tail<P>& tail, const InterfaceSites& sites, PlaneView<const double> mean_height,
              int row_begin, int row_end, bool observe, InterfaceSums& sums) {
    for (int y = row_begin; y < row_end; ++y) {
        for (int x = 0; x < mean_height.nx; ++x) {
            const double gap =
                sites.reference_height + sites.displacement.z(x, y) - mean_height(x, y);
            const double force = tail.force(gap);
            double& force_z = sites.force.z(x, y);
            if (observe) {
                sums.energy.add(tail.energy(gap));
                sums.repulsive += (force_z + force > 0.0) - (force_z > 0.0);
            }
            force_z += force;
            sums.force_z.add(force);
        }
        sums.carry();
    }
}

} // namespace

void tail_sweep(const InterfaceSites& sites, const PairPotential& potential, double density,
                PlaneView<const double> mean_height, int row_begin, int row_end, bool observe,
                InterfaceSums& sums) {
    std::visit(
        [&]<class P>(const P& p) {
            if constexpr (P::has_tail)
                add_tail(Tail(p, density), sites, mean_height, row_begin, row_end, observe, sums);
        },
        potential);
}

} // namespace asperity
