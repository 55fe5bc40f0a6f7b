// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The lattice sweep on SIMD registers; compiled once for each x86-64 level (variant.hpp).
//
// Offsets come in fours, (±cx, ±cy): two rows of atoms, one south and one north of the site, two
// columns, west and east. Lateral squares are formed once per column and row; forces of a row are
// only added up, and meet the row's cy at its end. A quad takes 31 multiplications, fused or not,
// two divisions and 16 additions; the additions, like the divisions, run beside the multiplications
// on most processors.
//
// Rows follow one another outwards, and so do the columns of a row: an order that no cut changes.
#include "kernels/interface_block.hpp"

namespace asperity::ASPERITY_VARIANT {

namespace {

/// How many columns each row has within some lateral distance: entry k of the table, or the last.
struct Columns {
    const std::int32_t* of_row; ///< [n - 1]
    ASPERITY_INLINE Columns(const LatticeSubstrate& s, int k)
        : of_row(s.columns +
                 static_cast<std::ptrdiff_t>(k < s.cut_count - 1 ? k : s.cut_count - 1) *
                     s.half_offsets) {}
    ASPERITY_INLINE int rows(int half_offsets) const {
        int n = 0;
        while (n < half_offsets && of_row[n] > 0)
            ++n;
        return n;
    }
};

/// (m - 1/2) a in units of length.
template <class T>
struct Offsets {
    T at[max_half_offsets + 1];
    Offsets(double spacing, int most) {
        for (int m = 1; m <= most; ++m)
            at[m] = static_cast<T>((m - 0.5) * spacing / length_unit<T>);
    }
    ASPERITY_INLINE Pack<T> operator()(int m) const { return Pack<T>(at[m]); }
};

/// Four pairs on their way from distance to force.
template <class T>
struct Quad {
    Pack<T> z_sw, z_se, z_nw, z_ne, r2_sw, r2_se, r2_nw, r2_ne, t_sw, t_se, t_nw, t_ne;
};

/// Sums over the quads in reach for the register of sites that begins `lane` sites into the block
/// at `here`, its first site's atom.
template <class T, bool observe, bool close>
ASPERITY_INLINE void sum_lattice(const SiteBlock& site, int lane, Columns all, Columns within,
                                 const typename SiteHeight<T>::Atom* here, std::ptrdiff_t row,
                                 int half_offsets, const Offsets<T>& offset,
                                 const PairTerms<T>& pair, SiteTerms& terms) {
    using V = Pack<T>;
    constexpr int width = V::width;
    const double unit = length_unit<T>;
    const SiteHeight<T> z(site.z + lane);
    const V ux = lengths<T>(site.ux + lane), uy = lengths<T>(site.uy + lane);
    V west2[max_half_offsets + 1], east2[max_half_offsets + 1];
    for (int m = 1; m <= all.of_row[0]; ++m) {
        const V west = ux + offset(m), east = ux - offset(m);
        west2[m] = west * west;
        east2[m] = east * east;
    }
    // Sums of a site, in the precision of its pairs: their rounding is below that of a pair.
    V f_all(T(0)), f_cx(T(0)), f_cy(T(0)), f_z(T(0)), v(T(0));
    V nearest = pair.r2_cut;
    const typename SiteHeight<T>::Atom *south_row = nullptr, *north_row = nullptr;
    V south2, north2;
    const auto enter_row = [&](int n) __attribute__((always_inline)) {
        south_row = here + (1 - n) * row;
        north_row = here + n * row;
        const V south = uy + offset(n), north = uy - offset(n);
        south2 = south * south;
        north2 = north * north;
    };
    const auto approach = [&](int m) __attribute__((always_inline)) {
        Quad<T> q;
        q.z_sw = z.above(south_row + 1 - m);
        q.z_se = z.above(south_row + m);
        q.z_nw = z.above(north_row + 1 - m);
        q.z_ne = z.above(north_row + m);
        q.r2_sw = fma(q.z_sw, q.z_sw, west2[m] + south2);
        q.r2_se = fma(q.z_se, q.z_se, east2[m] + south2);
        q.r2_nw = fma(q.z_nw, q.z_nw, west2[m] + north2);
        q.r2_ne = fma(q.z_ne, q.z_ne, east2[m] + north2);
        pair.template inverse<close>(q.r2_sw, q.r2_se, q.t_sw, q.t_se);
        pair.template inverse<close>(q.r2_nw, q.r2_ne, q.t_nw, q.t_ne);
        return q;
    };
    V f_south, f_north; // sums of a row
    const auto collect = [&](int m, const Quad<T>& q, auto masked) __attribute__((always_inline)) {
        const V f_sw = pair.force(q.t_sw, q.r2_sw, masked);
        const V f_se = pair.force(q.t_se, q.r2_se, masked);
        const V f_nw = pair.force(q.t_nw, q.r2_nw, masked);
        const V f_ne = pair.force(q.t_ne, q.r2_ne, masked);
        f_south = f_south + (f_sw + f_se);
        f_north = f_north + (f_nw + f_ne);
        f_cx = fma((f_sw + f_nw) - (f_se + f_ne), offset(m), f_cx);
        f_z = fma(f_sw, q.z_sw, f_z);
        f_z = fma(f_se, q.z_se, f_z);
        f_z = fma(f_nw, q.z_nw, f_z);
        f_z = fma(f_ne, q.z_ne, f_z);
        if constexpr (observe) {
            v = v + ((pair.energy(q.t_sw, q.r2_sw) + pair.energy(q.t_se, q.r2_se)) +
                     (pair.energy(q.t_nw, q.r2_nw) + pair.energy(q.t_ne, q.r2_ne)));
            nearest = min(nearest, min(min(q.r2_sw, q.r2_se), min(q.r2_nw, q.r2_ne)));
        }
    };
    // The next quad's divisions are under way while this one's forces are formed.
    enter_row(1);
    Quad<T> quad = approach(1);
    for (int n = 1, rows = all.rows(half_offsets); n <= rows; ++n) {
        f_south = f_north = V(T(0));
        const int inside = within.of_row[n - 1], last = all.of_row[n - 1];
        int m = 1;
        for (; m <= inside && m < last; ++m) {
            const Quad<T> next = approach(m + 1);
            collect(m, quad, std::false_type{});
            quad = next;
        }
        for (; m < last; ++m) {
            const Quad<T> next = approach(m + 1);
            collect(m, quad, std::true_type{});
            quad = next;
        }
        enter_row(n < rows ? n + 1 : n);
        const Quad<T> next = approach(1);
        if (last <= inside)
            collect(last, quad, std::false_type{});
        else
            collect(last, quad, std::true_type{});
        quad = next;
        f_all = f_all + (f_south + f_north);
        f_cy = fma(f_south - f_north, offset(n), f_cy);
    }
    // Sum f (ux + cx) = ux sum f + sum f cx.
    alignas(64) double all_f[width], all_cx[width], all_cy[width], all_z[width], all_v[width];
    store_wide(f_all, all_f);
    store_wide(f_cx, all_cx);
    store_wide(f_cy, all_cy);
    store_wide(f_z, all_z);
    for (int i = 0; i < width; ++i) {
        terms.x[lane + i] = pair.force_scale * (site.ux[lane + i] * all_f[i] + unit * all_cx[i]);
        terms.y[lane + i] = pair.force_scale * (site.uy[lane + i] * all_f[i] + unit * all_cy[i]);
        terms.z[lane + i] = pair.force_scale * (unit * all_z[i]);
    }
    if constexpr (observe) {
        store_wide(v, all_v);
        for (int i = 0; i < width; ++i) {
            terms.energy[lane + i] = pair.energy_scale * all_v[i];
            terms.nearest[lane + i] = pair.nearest(nearest[i]);
        }
    }
}

template <class T, bool observe>
void lattice_sweep(const InterfaceSites& sites, const LatticeSubstrate& atoms,
                   const LennardJones& lj, int row_begin, int row_end, InterfaceSums& sums) {
    const PairTerms<T> pair(lj);
    const Offsets<T> offset(sites.spacing, atoms.half_offsets);
    const auto heights = SiteHeight<T>::of(atoms.heights);
    // No atom of a lattice is laterally nearer to a hollow site than this.
    const double hollow = std::sqrt(0.5) * sites.spacing;
    sweep_blocks<T, observe>(
        sites, atoms, lj, pair, row_begin, row_end, sums,
        [&](const SiteBlock& site, const Reach& reach, int x, int y, int count,
            SiteTerms& terms) __attribute__((always_inline)) {
            // What is in reach is rounded up to the table's steps, what is inside down.
            const Columns all(atoms, static_cast<int>(reach.from_rest * atoms.cuts_per_length) + 1);
            const Columns within(atoms, static_cast<int>(reach.inside * atoms.cuts_per_length));
            const bool close = reach.close && hollow - site.sideways < pair.floor;
            for (int lane = 0; lane < count; lane += Pack<T>::width) {
                const auto* here = heights.line(y) + x + lane;
                if (close)
                    sum_lattice<T, observe, true>(site, lane, all, within, here, heights.row,
                                                  atoms.half_offsets, offset, pair, terms);
                else
                    sum_lattice<T, observe, false>(site, lane, all, within, here, heights.row,
                                                   atoms.half_offsets, offset, pair, terms);
            }
        });
}

} // namespace

InterfaceKernels::Sweeps<LatticeSubstrate> lattice_sweeps() {
    return {{lattice_sweep<double, false>, lattice_sweep<double, true>},
            {lattice_sweep<float, false>, lattice_sweep<float, true>}};
}

} // namespace asperity::ASPERITY_VARIANT
