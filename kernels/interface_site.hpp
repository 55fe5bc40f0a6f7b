// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A site of the interface over a substrate with the block's own lattice, for packs of sites and for
// the threads of a device: displacements limited to the range of the tables, the reach that follows
// from the gap, and the sums over the pairs within reach.
//
// Offsets are processed in fours, (±cx, ±cy): two rows of atoms, south and north of the site, and
// two columns, west and east. Lateral squares are formed once per column and row; the forces of a
// row are added and then multiplied by the row's cy. Four pairs (a quad) take 31 multiplications,
// fused or not, two divisions and 16 additions; most processors execute additions and divisions in
// parallel with multiplications.
//
// Rows, and the columns of a row, are summed outwards, in an order that does not depend on the cut.
#pragma once

#include "kernels/interface_pair.hpp"
#include "kernels/lane.hpp"

namespace asperity::ASPERITY_VARIANT {

/// Height or distance larger than that of any atom, Å, whose square can be represented in single
/// precision.
inline constexpr double beyond_atoms = 1e6;
/// Height larger than that of any site, Å.
inline constexpr double above_sites = 1e300;

/// Range of heights of sites over the datum that the tables cover, Å.
struct HeightRange {
    double deepest = -above_sites; ///< lower sites are left to the reference loop
    double ceiling = beyond_atoms; ///< sites higher than this have no atom in reach
};

/// Displacements of one block of sites, or of one site, limited to the range of the tables.
template <class Real, int size>
struct SiteBlock {
    alignas(8 * Real::width) double ux[size], uy[size];
    alignas(8 * Real::width) double z[size]; ///< height over the datum, Å
    double lowest_z, highest_z;              ///< extreme heights of the sites, Å
    double sideways;                         ///< largest lateral displacement |(ux, uy)|, Å
    /// Bits of sites that the tables do not cover; the reference loop sums them.
    unsigned beyond;

    /// Loads sites x to x + count of row y and repeats the last site behind the row's end. Heights
    /// are relative to the datum. margin: lateral displacement that the tables allow for, Å.
    ASPERITY_INLINE SiteBlock(const InterfaceSites& sites, int x, int y, int count, double datum,
                              HeightRange range, double margin) {
        const auto load = [&](const double* row, int lane) {
            // A whole register behind the row's end has the last site, too.
            const int first = lane < count ? lane : count - 1;
            return Real::load_first(row + x + first, count - first);
        };
        const double rise = sites.reference_height - datum;
        Real least(above_sites), most(-above_sites), widest(0.0);
        beyond = 0;
        for (int lane = 0; lane < size; lane += Real::width) {
            Real x_lanes = load(sites.displacement.x.line(y), lane);
            Real y_lanes = load(sites.displacement.y.line(y), lane);
            const Real uz = load(sites.displacement.z.line(y), lane);
            Real z_lanes = uz + Real(rise);
            // A not-a-number or infinity in any component makes this not-a-number: a lane beyond.
            const Real u2 = fma(x_lanes, x_lanes, y_lanes * y_lanes) + uz * Real(0.0);
            const Real kept =
                select(z_lanes > Real(range.deepest),
                       select(u2 < Real(margin * margin), u2, Real(-1.0)), Real(-1.0));
            const unsigned left = bits_where_less(kept, Real(0.0));
            if (left) {
                beyond |= left << lane;
                const auto near = kept > Real(-0.5);
                x_lanes = select(near, x_lanes, Real(0.0));
                y_lanes = select(near, y_lanes, Real(0.0));
                z_lanes = select(near, z_lanes, Real(range.ceiling));
            }
            z_lanes = min(z_lanes, Real(range.ceiling));
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

/// Tolerance of bounds on distances, Å: rounding of a bound must not exclude a pair within the
/// cutoff.
constexpr double bound_slack = 1e-6;

/// Returns the index of the highest set bit; bits must not be 0.
ASPERITY_INLINE int highest_bit(unsigned bits) {
#if defined(__CUDA_ARCH__)
    return 31 - __clz(static_cast<int>(bits));
#else
    return 31 - __builtin_clz(bits);
#endif
}
ASPERITY_INLINE int lowest_bit(unsigned bits) {
#if defined(__CUDA_ARCH__)
    return __ffs(static_cast<int>(bits)) - 1;
#else
    return __builtin_ctz(bits);
#endif
}

/// Lateral distances of the atoms that may interact with a block of sites, Å.
struct Reach {
    double from_rest = 0.0; ///< distance from the undisplaced site beyond which no atom interacts
    double from_site = 0.0; ///< distance from the displaced site beyond which no atom interacts
    /// Distance from the undisplaced site up to which all atoms are within the cutoff.
    double inside = beyond_atoms;
    bool close = false; ///< some atoms may be closer than PairTerms::closest
    /// Returns true if some atom may interact.
    ASPERITY_INLINE bool any() const { return from_rest > 0.0; }

    template <class Real, int size>
    ASPERITY_INLINE Reach(const ReachBounds& bounds, int x, int y, double datum,
                          const SiteBlock<Real, size>& site, double cutoff, double floor) {
        const double cut2 = cutoff * cutoff, u = site.sideways, w = bounds.ring_width;
        const Real low(site.lowest_z + datum), high(site.highest_z + datum);
        const std::ptrdiff_t first =
            (static_cast<std::ptrdiff_t>(y) * bounds.blocks + x / interface_block) *
            interface_rings;
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
            some_within |= bits_where_less(fma(nearest, nearest, squares), Real(cut2)) << ring;
            some_beyond |= bits_where_less(Real(cut2), fma(farthest, farthest, far * far)) << ring;
            some_close |= bits_where_less(fma(nearest, nearest, squares), Real(floor * floor));
            begin = begin + Real(w * Real::width);
        }
        close = some_close != 0;
        if (some_within) {
            // Atoms of the rings outside the last one in reach are known to be out of it.
            const int outer = highest_bit(some_within);
            const double above = site.lowest_z + datum - bounds.highest[first + outer];
            const double gap = above > 0.0 ? above : 0.0;
            const double chord = std::sqrt(cut2 - gap * gap) + bound_slack;
            const double edge = (outer + 1) * w + bound_slack;
            from_rest = chord + u < edge ? chord + u : edge;
            // Atoms of the rings within may have less of a gap.
            const double held = outer * w + u < cutoff ? outer * w + u : cutoff;
            from_site = chord < edge + u ? chord : edge + u;
            from_site = from_site > held ? from_site : held;
        }
        if (some_beyond) {
            const int inner = lowest_bit(some_beyond);
            const double below = bounds.highest[first + inner] - (site.lowest_z + datum);
            const double above = site.highest_z + datum - bounds.lowest[first + inner];
            const double far = below > above ? below : above;
            const double room2 = cut2 - far * far;
            const double room = room2 > 0.0 ? std::sqrt(room2) - u : 0.0;
            inside = (room > inner * w ? room : inner * w) - bound_slack;
        }
    }
};

/// Number of columns in each row within a lateral distance: entry k of the table, or the last entry
/// for larger k.
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

/// Table of (m - 1/2) a in units of length.
template <class T>
struct Offsets {
    T at[max_half_offsets + 1];
    Offsets(double spacing, int most) {
        for (int m = 1; m <= most; ++m)
            at[m] = static_cast<T>((m - 0.5) * spacing / length_unit<T>);
    }
};

/// Squared lateral distances to the columns west and east of a site: a table for registers of
/// sites, computed on demand for a single site.
template <class F, class T>
struct Laterals {
    using V = typename F::template Of<T>;
    V west2_[max_half_offsets + 1], east2_[max_half_offsets + 1];
    ASPERITY_INLINE Laterals(V ux, const Offsets<T>& offset, int columns) {
        for (int m = 1; m <= columns; ++m) {
            const V west = ux + V(offset.at[m]), east = ux - V(offset.at[m]);
            west2_[m] = west * west;
            east2_[m] = east * east;
        }
    }
    ASPERITY_INLINE V west2(int m) const { return west2_[m]; }
    ASPERITY_INLINE V east2(int m) const { return east2_[m]; }
};

template <>
struct Laterals<Scalar, double> {
    Lane<double> ux;
    const Offsets<double>& offset;
    ASPERITY_INLINE Laterals(Lane<double> u, const Offsets<double>& offsets, int)
        : ux(u), offset(offsets) {}
    ASPERITY_INLINE Lane<double> west2(int m) const {
        const Lane<double> west = ux + Lane<double>(offset.at[m]);
        return west * west;
    }
    ASPERITY_INLINE Lane<double> east2(int m) const {
        const Lane<double> east = ux - Lane<double>(offset.at[m]);
        return east * east;
    }
};

/// Four pairs between the computation of distance and force. t: results of begin().
template <class V>
struct Quad {
    V z_sw, z_se, z_nw, z_ne, r2_sw, r2_se, r2_nw, r2_ne, t_sw, t_se, t_nw, t_ne;
};

/// Sums over the pairs of sites, in units of force_scale and length_unit.
template <class V>
struct PairSums {
    V f, f_cx, f_cy, f_z, energy; ///< sums of f, f cx, f cy, f z, V
    V nearest;                    ///< least r^2
};

/// Order of operations: true computes a quad's forces before the next quad is begun; false begins
/// the next quad's divisions first, which takes the registers of two quads.
template <class F, class P, bool observe>
inline constexpr bool one_by_one = false;

/// Returns the sums over the pairs in reach of sites with heights z and lateral displacements ux,
/// uy. all, within: columns in reach, and columns for which all pairs are within the cutoff; here:
/// atom of the first site.
template <class F, class T, bool observe, bool close, class P>
ASPERITY_INLINE PairSums<typename F::template Of<T>>
sum_lattice(const SiteHeight<F, T>& z, typename F::template Of<T> ux, typename F::template Of<T> uy,
            Columns all, Columns within, const typename SiteHeight<F, T>::Atom* here,
            std::ptrdiff_t row, int half_offsets, const Offsets<T>& offsets,
            const PairTerms<F, T, P>& pair) {
    using V = typename F::template Of<T>;
    const auto offset = [&](int m) __attribute__((always_inline)) { return V(offsets.at[m]); };
    const Laterals<F, T> lateral(ux, offsets, all.of_row[0]);
    // Sums of a site, in the precision of its pairs: their rounding is below that of a pair.
    V f_all(T(0)), f_cx(T(0)), f_cy(T(0)), f_z(T(0)), v(T(0));
    V nearest = pair.r2_cut;
    const typename SiteHeight<F, T>::Atom *south_row = nullptr, *north_row = nullptr;
    V south2, north2;
    const auto enter_row = [&](int n) __attribute__((always_inline)) {
        south_row = here + (1 - n) * row;
        north_row = here + n * row;
        const V south = uy + offset(n), north = uy - offset(n);
        south2 = south * south;
        north2 = north * north;
    };
    V f_south, f_north; // sums of a row
    const auto end_row = [&](int n) __attribute__((always_inline)) {
        f_all = f_all + (f_south + f_north);
        f_cy = fma(f_south - f_north, offset(n), f_cy);
    };
    if constexpr (one_by_one<F, P, observe>) {
        const auto half = [&](int m, const auto* atoms, V side2, auto masked, V& f_west, V& f_east)
            __attribute__((always_inline)) {
            const V z_west = z.above(atoms + 1 - m), z_east = z.above(atoms + m);
            const V r2_west = fma(z_west, z_west, lateral.west2(m) + side2);
            const V r2_east = fma(z_east, z_east, lateral.east2(m) + side2);
            V t_west, t_east;
            pair.template begin<close>(r2_west, r2_east, t_west, t_east);
            f_west = pair.force(t_west, r2_west, masked);
            f_east = pair.force(t_east, r2_east, masked);
            f_z = fma(f_west, z_west, f_z);
            f_z = fma(f_east, z_east, f_z);
        };
        const auto take = [&](int m, auto masked) __attribute__((always_inline)) {
            V f_sw, f_se, f_nw, f_ne;
            half(m, south_row, south2, masked, f_sw, f_se);
            f_south = f_south + (f_sw + f_se);
            half(m, north_row, north2, masked, f_nw, f_ne);
            f_north = f_north + (f_nw + f_ne);
            f_cx = fma((f_sw + f_nw) - (f_se + f_ne), offset(m), f_cx);
        };
        for (int n = 1, rows = all.rows(half_offsets); n <= rows; ++n) {
            enter_row(n);
            f_south = f_north = V(T(0));
            const int inside = within.of_row[n - 1], last = all.of_row[n - 1];
            int m = 1;
            for (; m <= inside && m <= last; ++m)
                take(m, std::false_type{});
            for (; m <= last; ++m)
                take(m, std::true_type{});
            end_row(n);
        }
        return {f_all, f_cx, f_cy, f_z, v, nearest};
    }
    const auto approach = [&](int m) __attribute__((always_inline)) {
        Quad<V> q;
        q.z_sw = z.above(south_row + 1 - m);
        q.z_se = z.above(south_row + m);
        q.z_nw = z.above(north_row + 1 - m);
        q.z_ne = z.above(north_row + m);
        q.r2_sw = fma(q.z_sw, q.z_sw, lateral.west2(m) + south2);
        q.r2_se = fma(q.z_se, q.z_se, lateral.east2(m) + south2);
        q.r2_nw = fma(q.z_nw, q.z_nw, lateral.west2(m) + north2);
        q.r2_ne = fma(q.z_ne, q.z_ne, lateral.east2(m) + north2);
        pair.template begin<close>(q.r2_sw, q.r2_se, q.t_sw, q.t_se);
        pair.template begin<close>(q.r2_nw, q.r2_ne, q.t_nw, q.t_ne);
        return q;
    };
    const auto collect = [&](int m, const Quad<V>& q, auto masked) __attribute__((always_inline)) {
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
    Quad<V> quad = approach(1);
    for (int n = 1, rows = all.rows(half_offsets); n <= rows; ++n) {
        f_south = f_north = V(T(0));
        const int inside = within.of_row[n - 1], last = all.of_row[n - 1];
        int m = 1;
        for (; m <= inside && m < last; ++m) {
            const Quad<V> next = approach(m + 1);
            collect(m, quad, std::false_type{});
            quad = next;
        }
        for (; m < last; ++m) {
            const Quad<V> next = approach(m + 1);
            collect(m, quad, std::true_type{});
            quad = next;
        }
        enter_row(n < rows ? n + 1 : n);
        const Quad<V> next = approach(1);
        if (last <= inside)
            collect(last, quad, std::false_type{});
        else
            collect(last, quad, std::true_type{});
        quad = next;
        end_row(n);
    }
    return {f_all, f_cx, f_cy, f_z, v, nearest};
}

/// Force on a site, eV/Å.
struct SiteForce {
    double x, y, z;
};
/// Force on one site, with its energy, eV, and the nearest r^2, Å^2.
struct SiteTotal {
    SiteForce force;
    double energy, nearest;
};
/// Returns the force on a site from the sums over its pairs: sum f (ux + cx) = ux sum f + sum f cx.
template <class F, class T, class P>
ASPERITY_INLINE SiteForce site_force(const PairTerms<F, T, P>& pair, double ux, double uy, double f,
                                     double f_cx, double f_cy, double f_z) {
    constexpr double unit = length_unit<T>;
    return {pair.force_scale * (ux * f + unit * f_cx), pair.force_scale * (uy * f + unit * f_cy),
            pair.force_scale * (unit * f_z)};
}

} // namespace asperity::ASPERITY_VARIANT
