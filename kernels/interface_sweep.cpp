// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The interface sweeps on SIMD registers; compiled once for each x86-64 level (variant.hpp).
//
// With t = r_m^2 / r^2 and r_m = 2^(1/6) r0 the potential of a pair is
//
//     V = epsilon t^3 (t^3 - 2) - V0(r_c),    -V'/r = (12 epsilon / r_m^2) t (t^6 - t^3).
//
// Offsets come in fours, (±cx, ±cy): the lateral squares dx^2 and dy^2 are formed once per column
// and row, x and y forces take two multiplications for four pairs, and one division serves two
// pairs (1/a = b / (ab)), which the divider does beside the multiplications. That is eight fused or
// plain multiplications a pair, the limit being two registers a cycle on most processors.
//
// Distances beyond the cutoff are masked, not branched on; r^2 is held at r2_floor from below.
#include "kernels/interface_sweep.hpp"
#include "kernels/simd.hpp"

namespace asperity::ASPERITY_VARIANT {

namespace {

using Real = Pack<double>;
constexpr int width = Real::width;

/// Constants of the potential, one copy in every lane where it meets the pairs.
struct PairTerms {
    Real rm2, r2_floor, r2_cut, shift;
    double force_scale, energy_scale, cutoff, contact_r2;

    explicit PairTerms(const LennardJones& lj)
        : rm2(std::cbrt(2.0) * lj.r0 * lj.r0), r2_floor(lj.r2_floor()), r2_cut(lj.r2_cut()),
          shift(LennardJones{1.0, lj.r0, lj.cutoff}.shift()),
          force_scale(12.0 * lj.epsilon / (std::cbrt(2.0) * lj.r0 * lj.r0)),
          energy_scale(lj.epsilon), cutoff(lj.cutoff),
          contact_r2(lj.contact_distance() * lj.contact_distance()) {}

    /// -V'/r in units of force_scale, from t; zero beyond the cutoff.
    ASPERITY_INLINE Real force(Real t, Real r2) const {
        const Real t3 = t * t * t;
        return select(r2 < r2_cut, t * fma(t3, t3, -t3), Real(0.0));
    }
    /// V in units of energy_scale.
    ASPERITY_INLINE Real energy(Real t, Real r2) const {
        const Real t3 = t * t * t;
        return select(r2 < r2_cut, fma(t3, t3, Real(-2.0) * t3) - shift, Real(0.0));
    }
    /// r_m^2 / a and r_m^2 / b by one division.
    ASPERITY_INLINE void inverse(Real a, Real b, Real& ta, Real& tb) const {
        a = max(a, r2_floor);
        b = max(b, r2_floor);
        const Real both = rm2 / (a * b);
        ta = b * both;
        tb = a * both;
    }
};

/// A site's running sums, lane by lane.
struct SiteTerms {
    Real x{0.0}, y{0.0}, z{0.0}, energy{0.0}, nearest{no_pair};
};

/// The first `count` values, the last of them repeated: lanes behind a row's end stay harmless.
ASPERITY_INLINE Real load_first(const double* from, int count) {
    if (count >= width) return Real::load(from);
    double lane[width];
    for (int i = 0; i < width; ++i)
        lane[i] = from[i < count ? i : count - 1];
    return Real::load(lane);
}

/// The least lane, by halving.
ASPERITY_INLINE double lowest(Real v) {
#pragma GCC unroll 4
    for (int half = width / 2; half > 1; half /= 2) {
        Real::Mask other{};
#pragma GCC unroll 8
        for (int i = 0; i < width; ++i)
            other[i] = i ^ half;
        v = min(v, Real(__builtin_shuffle(v.r, other)));
    }
    return v[1] < v[0] ? v[1] : v[0];
}

/// Rounding in a bound must never drop a pair that the mask would keep.
constexpr double bound_slack = 1e-6;

/// Lateral distance (from the undisplaced site) beyond which no atom is in reach of sites as low as
/// z and displaced by at most u sideways; negative if none is in reach at all.
ASPERITY_INLINE double lateral_reach(const double* highest, double ring_width, double z, double u,
                                     double cutoff) {
    const double cut2 = cutoff * cutoff;
    for (int ring = interface_rings - 1; ring >= 0; --ring) {
        const double gap = z - highest[ring];
        if (!(gap < cutoff)) continue;
        const double reach2 = gap > 0.0 ? cut2 - gap * gap : cut2;
        const double nearest = ring * ring_width - u - bound_slack;
        if (nearest > 0.0 && nearest * nearest >= reach2) continue;
        // Atoms of the outer rings are known to be out of reach.
        const double far = std::sqrt(reach2) + u + bound_slack;
        const double ring_end = (ring + 1) * ring_width + bound_slack;
        return ring == interface_rings - 1 || far < ring_end ? far : ring_end;
    }
    return -1.0;
}

/// The block of sites that site (x, y) of the tile is in.
ASPERITY_INLINE std::ptrdiff_t block_of(const ReachBounds& reach, int x, int y) {
    return static_cast<std::ptrdiff_t>(y) * reach.blocks + x / interface_block;
}

/// Displacements of one register of sites, made safe for the tables.
struct SiteLanes {
    Real ux, uy, z;
    double lowest_z, sideways; ///< over the lanes: least z, greatest |(ux, uy)|, Å
    unsigned beyond;           ///< lanes displaced beyond the margin: left to the reference loop
};

ASPERITY_INLINE SiteLanes load_sites(const InterfaceSites& sites, int x, int y, int count,
                                     double margin) {
    SiteLanes s;
    s.ux = load_first(sites.displacement.x.line(y) + x, count);
    s.uy = load_first(sites.displacement.y.line(y) + x, count);
    const Real uz = load_first(sites.displacement.z.line(y) + x, count);
    s.z = uz + Real(sites.reference_height);
    // Not-a-number or infinity in any component makes this not-a-number, and so a lane beyond.
    const Real u2 = fma(s.ux, s.ux, s.uy * s.uy) + uz * Real(0.0);
    const Real kept = select(u2 < Real(margin * margin), u2, Real(-1.0));
    const double least = lowest(kept);
    s.beyond = 0;
    if (least < 0.0) {
        for (int i = 0; i < width; ++i)
            s.beyond |= kept[i] < 0.0 ? 1u << i : 0u;
        const auto near = kept > Real(-0.5);
        s.ux = select(near, s.ux, Real(0.0));
        s.uy = select(near, s.uy, Real(0.0));
        s.z = select(near, s.z, Real(1e6));
    }
    s.sideways = std::sqrt(-lowest(-max(kept, Real(0.0))));
    s.lowest_z = lowest(s.z);
    return s;
}

/// Hands a finished register of sites over: forces to memory, sums to the totals.
struct Totals {
    BasicExactSum<Real> force_z, energy;
    std::int64_t in_contact = 0, pushed = 0, in_reach = 0;
    double closest_r2 = no_pair;

    template <bool observe>
    ASPERITY_INLINE void take(const InterfaceSites& sites, const PairTerms& pair, SiteTerms s,
                              int x, int y, int count) {
        s.x.store_first(sites.force.x.line(y) + x, count);
        s.y.store_first(sites.force.y.line(y) + x, count);
        s.z.store_first(sites.force.z.line(y) + x, count);
        double lane[width];
        for (int i = 0; i < width; ++i)
            lane[i] = i < count ? 1.0 : 0.0;
        const Real owned = Real::load(lane);
        force_z.add(select(owned > Real(0.5), s.z, Real(0.0)));
        if constexpr (observe) {
            energy.add(select(owned > Real(0.5), s.energy, Real(0.0)));
            // Atoms beyond the cutoff that were looked at all the same do not count as neighbours.
            const Real nearest = select(s.nearest < pair.r2_cut, s.nearest, Real(no_pair));
            if (sites.nearest_r2.origin) nearest.store_first(sites.nearest_r2.line(y) + x, count);
            for (int i = 0; i < count; ++i) {
                in_contact += nearest[i] < pair.contact_r2;
                pushed += s.z[i] > 0.0;
                closest_r2 = nearest[i] < closest_r2 ? nearest[i] : closest_r2;
            }
        }
    }
    /// The same for sites with nothing in reach: zeros, which change no sum.
    template <bool observe>
    ASPERITY_INLINE void pass(const InterfaceSites& sites, int x, int y, int count) const {
        const Real zero(0.0);
        zero.store_first(sites.force.x.line(y) + x, count);
        zero.store_first(sites.force.y.line(y) + x, count);
        zero.store_first(sites.force.z.line(y) + x, count);
        if (observe && sites.nearest_r2.origin)
            Real(no_pair).store_first(sites.nearest_r2.line(y) + x, count);
    }
    void give(InterfaceSums& sums) const {
        for (int i = 0; i < width; ++i)
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

/// Replaces the lanes that the tables do not cover by the reference loop.
void sum_beyond(const InterfaceSites& sites, const SubstrateMap& map, const LennardJones& lj,
                unsigned beyond, int x, int y, SiteTerms& s) {
    const auto& u = sites.displacement;
    for (int i = 0; i < width; ++i) {
        if (!(beyond >> i & 1u)) continue;
        const int xi = x + i < u.x.nx ? x + i : u.x.nx - 1; // behind the row's end: its last site
        const PairSum p = pair_sum(map, lj, (sites.x0 + xi + 0.5) * sites.spacing + u.x(xi, y),
                                   (sites.y0 + y + 0.5) * sites.spacing + u.y(xi, y),
                                   sites.reference_height + u.z(xi, y));
        s.x.r[i] = p.force[0];
        s.y.r[i] = p.force[1];
        s.z.r[i] = p.force[2];
        s.energy.r[i] = p.energy;
        s.nearest.r[i] = p.nearest_r2;
    }
}

/// Sums over the quads of offsets within a lateral cut for one register of sites.
template <bool observe>
ASPERITY_INLINE SiteTerms lattice_sites(const SiteLanes& site, const double* height,
                                        const OffsetQuad* quads, OffsetCut cut, double spacing,
                                        const PairTerms& pair) {
    // Squares of the lateral distances to the columns of atoms on the left and right, and likewise
    // in y.
    Real west2[max_half_offsets + 1], east2[max_half_offsets + 1];
    Real south2[max_half_offsets + 1], north2[max_half_offsets + 1];
    for (int m = 1; m <= cut.half_offsets; ++m) {
        const Real c((m - 0.5) * spacing);
        const Real west = site.ux + c, east = site.ux - c;
        const Real south = site.uy + c, north = site.uy - c;
        west2[m] = west * west;
        east2[m] = east * east;
        south2[m] = south * south;
        north2[m] = north * north;
    }
    Real sum_f(0.0), sum_cx(0.0), sum_cy(0.0), sum_z(0.0);
    SiteTerms s;
    for (int k = 0; k < cut.quads; ++k) {
        const OffsetQuad& q = quads[k];
        const Real z_sw = site.z - Real::load(height + q.sw);
        const Real z_se = site.z - Real::load(height + q.se);
        const Real z_nw = site.z - Real::load(height + q.nw);
        const Real z_ne = site.z - Real::load(height + q.ne);
        const Real r2_sw = fma(z_sw, z_sw, west2[q.m] + south2[q.n]);
        const Real r2_se = fma(z_se, z_se, east2[q.m] + south2[q.n]);
        const Real r2_nw = fma(z_nw, z_nw, west2[q.m] + north2[q.n]);
        const Real r2_ne = fma(z_ne, z_ne, east2[q.m] + north2[q.n]);
        Real t_sw, t_se, t_nw, t_ne;
        pair.inverse(r2_sw, r2_se, t_sw, t_se);
        pair.inverse(r2_nw, r2_ne, t_nw, t_ne);
        const Real f_sw = pair.force(t_sw, r2_sw);
        const Real f_se = pair.force(t_se, r2_se);
        const Real f_nw = pair.force(t_nw, r2_nw);
        const Real f_ne = pair.force(t_ne, r2_ne);
        const Real west = f_sw + f_nw, east = f_se + f_ne;
        const Real south = f_sw + f_se, north = f_nw + f_ne;
        sum_f = sum_f + (west + east);
        sum_cx = fma(west - east, Real(q.cx), sum_cx);
        sum_cy = fma(south - north, Real(q.cy), sum_cy);
        sum_z = fma(f_sw, z_sw, sum_z);
        sum_z = fma(f_se, z_se, sum_z);
        sum_z = fma(f_nw, z_nw, sum_z);
        sum_z = fma(f_ne, z_ne, sum_z);
        if constexpr (observe) {
            s.energy = s.energy + ((pair.energy(t_sw, r2_sw) + pair.energy(t_se, r2_se)) +
                                   (pair.energy(t_nw, r2_nw) + pair.energy(t_ne, r2_ne)));
            s.nearest = min(s.nearest, min(min(r2_sw, r2_se), min(r2_nw, r2_ne)));
        }
    }
    // Sum f (ux + c) = ux sum f + sum f c.
    const Real scale(pair.force_scale);
    s.x = scale * fma(site.ux, sum_f, sum_cx);
    s.y = scale * fma(site.uy, sum_f, sum_cy);
    s.z = scale * sum_z;
    s.energy = Real(pair.energy_scale) * s.energy;
    return s;
}

template <bool observe>
void lattice_sweep(const InterfaceSites& sites, const LatticeSubstrate& substrate,
                   const LennardJones& lj, int row_begin, int row_end, InterfaceSums& sums) {
    const PairTerms pair(lj);
    const ReachBounds& reach = substrate.reach;
    const int nx = sites.displacement.x.nx;
    Totals totals;
    for (int y = row_begin; y < row_end; ++y)
        for (int x = 0; x < nx; x += width) {
            const int count = nx - x < width ? nx - x : width;
            const SiteLanes site = load_sites(sites, x, y, count, reach.offset_margin);
            const std::ptrdiff_t block = block_of(reach, x, y);
            const double lateral =
                lateral_reach(reach.highest + block * interface_rings, reach.ring_width,
                              site.lowest_z, site.sideways, pair.cutoff);
            if (lateral < 0.0 && !site.beyond) {
                totals.pass<observe>(sites, x, y, count);
                continue;
            }
            SiteTerms s;
            if (lateral > 0.0) {
                const int step = static_cast<int>(lateral * substrate.cuts_per_length);
                const OffsetCut cut =
                    substrate.cuts[step < substrate.cut_count ? step : substrate.cut_count - 1];
                s = lattice_sites<observe>(site, substrate.height.line(y) + x, substrate.quads, cut,
                                           sites.spacing, pair);
                totals.in_reach += count;
            }
            if (site.beyond) sum_beyond(sites, substrate.map, lj, site.beyond, x, y, s);
            totals.take<observe>(sites, pair, s, x, y, count);
        }
    totals.give(sums);
}

/// Rows of cells whose ranges of atoms are found together, ahead of the sums over them.
constexpr int row_batch = 32;

/// Sums over the atoms within `lateral` of a register of sites that stand at x (undisplaced: from
/// west to east) in the row at site_y.
template <bool observe>
ASPERITY_INLINE SiteTerms cell_list_sites(const SiteLanes& site, Real site_x, double west,
                                          double east, double site_y, double lateral,
                                          const CellListSubstrate& atoms, const PairTerms& pair) {
    const double inverse = 1.0 / atoms.cell;
    const auto cell_of = [&](double at) { return static_cast<int>(std::floor(at * inverse)); };
    const Real x = site_x + site.ux, y = Real(site_y) + site.uy, z = site.z;
    Real sum_x(0.0), sum_y(0.0), sum_z(0.0), energy(0.0), nearest(no_pair);
    std::int32_t begin[row_batch], end[row_batch];
    const int last_row = cell_of(site_y + lateral);
    for (int row = cell_of(site_y - lateral); row <= last_row;) {
        int batch = 0;
        for (; batch < row_batch && row <= last_row; ++batch, ++row) {
            // The row of cells crosses the reach in a chord, widest at its side nearest to the
            // site.
            const double below = site_y - (row + 1) * atoms.cell;
            const double above = row * atoms.cell - site_y;
            const double aside = below > 0.0 ? below : above > 0.0 ? above : 0.0;
            const double chord2 = lateral * lateral - aside * aside;
            const double half = (chord2 > 0.0 ? std::sqrt(chord2) : 0.0) + bound_slack;
            const std::int32_t* first =
                atoms.first + static_cast<std::ptrdiff_t>(row - atoms.row0) * (atoms.columns + 1) -
                atoms.column0;
            begin[batch] = first[cell_of(west - half)];
            end[batch] = first[cell_of(east + half) + 1];
        }
        for (int k = 0; k < batch; ++k)
            for (std::int32_t p = begin[k]; p < end[k]; p += 2) {
                const Real dx = x - Real(atoms.x[p]), dx_next = x - Real(atoms.x[p + 1]);
                const Real dy = y - Real(atoms.y[p]), dy_next = y - Real(atoms.y[p + 1]);
                const Real dz = z - Real(atoms.z[p]), dz_next = z - Real(atoms.z[p + 1]);
                const Real r2 = fma(dz, dz, fma(dy, dy, dx * dx));
                const Real r2_next =
                    fma(dz_next, dz_next, fma(dy_next, dy_next, dx_next * dx_next));
                Real t, t_next;
                pair.inverse(r2, r2_next, t, t_next);
                const Real f = pair.force(t, r2), f_next = pair.force(t_next, r2_next);
                sum_x = fma(f_next, dx_next, fma(f, dx, sum_x));
                sum_y = fma(f_next, dy_next, fma(f, dy, sum_y));
                sum_z = fma(f_next, dz_next, fma(f, dz, sum_z));
                if constexpr (observe) {
                    energy = energy + (pair.energy(t, r2) + pair.energy(t_next, r2_next));
                    nearest = min(nearest, min(r2, r2_next));
                }
            }
    }
    const Real scale(pair.force_scale);
    return {scale * sum_x, scale * sum_y, scale * sum_z, Real(pair.energy_scale) * energy, nearest};
}

template <bool observe>
void cell_list_sweep(const InterfaceSites& sites, const CellListSubstrate& atoms,
                     const LennardJones& lj, int row_begin, int row_end, InterfaceSums& sums) {
    const PairTerms pair(lj);
    const ReachBounds& reach = atoms.reach;
    const int nx = sites.displacement.x.nx;
    const double a = sites.spacing;
    Totals totals;
    for (int y = row_begin; y < row_end; ++y) {
        const double site_y = (sites.y0 + y + 0.5) * a;
        for (int x = 0; x < nx; x += width) {
            const int count = nx - x < width ? nx - x : width;
            const SiteLanes site = load_sites(sites, x, y, count, reach.offset_margin);
            const std::ptrdiff_t block = block_of(reach, x, y);
            const double lateral =
                lateral_reach(reach.highest + block * interface_rings, reach.ring_width,
                              site.lowest_z, site.sideways, pair.cutoff);
            if (lateral < 0.0 && !site.beyond) {
                totals.pass<observe>(sites, x, y, count);
                continue;
            }
            SiteTerms s;
            if (lateral > 0.0) {
                double site_x[width];
                for (int i = 0; i < width; ++i)
                    site_x[i] = (sites.x0 + x + (i < count ? i : count - 1) + 0.5) * a;
                s = cell_list_sites<observe>(site, Real::load(site_x), site_x[0], site_x[count - 1],
                                             site_y, lateral, atoms, pair);
                totals.in_reach += count;
            }
            if (site.beyond) sum_beyond(sites, atoms.map, lj, site.beyond, x, y, s);
            totals.take<observe>(sites, pair, s, x, y, count);
        }
    }
    totals.give(sums);
}

} // namespace

InterfaceKernels interface_table() {
    return {lattice_sweep<false>, lattice_sweep<true>, cell_list_sweep<false>,
            cell_list_sweep<true>};
}

} // namespace asperity::ASPERITY_VARIANT
