// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A site of the interface over the rows of a substrate of any spacing: one text for packs of atoms
// and for the threads of a device, which take one atom after the other.
//
// Atoms along x stand in groups of row_lanes, side by side and centred on the site; a register is a
// group or a part of one. Each register is taken up through the rows of atoms within its chord of
// the reach, two rows at a time (they share a division). dx and its square belong to the register,
// dy to the row. A pair takes eight multiplications, as in the lattice sweep, and the comparison
// with the cutoff. With whole groups about a fifth of the lanes lie between the circle of the
// cutoff and the ends of the rows.
//
// Groups and pairs of rows are counted from the atom below the site. The sum over a lane of all
// groups is formed first, then lanes are added by halving: lane i and i + row_lanes / 2, and so on.
// So the order of a site's sum is its own, and the same for registers of any width.
#pragma once

#include "kernels/interface_site.hpp"

namespace asperity::ASPERITY_VARIANT {

/// Atoms in a group: the lanes of the widest register.
template <class T>
inline constexpr int row_lanes = 64 / static_cast<int>(sizeof(T));

/// Adds sums by halving. They come in the order of turn(): 0, 4, 2, 6, 1, 5, 3, 7 of eight.
template <class Sum, int count>
struct HalvedSum {
    static constexpr int levels = count >= 16 ? 4 : count >= 8 ? 3 : count >= 4 ? 2 : count / 2;
    static_assert(count == 1 << levels);

    /// Which sum is the n-th: n with its bits reversed.
    ASPERITY_INLINE static int turn(int n) {
        int reversed = 0;
        ASPERITY_UNROLL(4)
        for (int bit = 0; bit < levels; ++bit)
            reversed |= (n >> bit & 1) << (levels - 1 - bit);
        return reversed;
    }
    ASPERITY_INLINE void add(int n, Sum sum) {
        bool waits = false; // for the other half, at some level
        ASPERITY_UNROLL(4)
        for (int level = 0; level < levels; ++level) {
            const bool first = !(n >> level & 1);
            if (!waits && first) half[level] = sum;
            waits = waits || first;
            if (!waits) sum.merge(half[level]);
        }
        all = sum; // in the end
    }
    Sum all;

private:
    Sum half[levels > 0 ? levels : 1]; ///< [level]: a sum that waits
};

/// A substrate, and the constants of a sweep over it.
template <class F, class T, class P>
struct AtomRows {
    using V = typename F::template Of<T>;
    using Atom = typename SiteHeight<F, T>::Atom;
    static constexpr int width = V::width, lanes = row_lanes<T>;
    /// Registers in a group.
    static constexpr int parts = lanes / width;

    PairTerms<F, T, P> pair;
    PlaneView<const Atom> heights;
    int i0, j0;
    double b, inverse_b;
    int start;        ///< first atom of group 0, counted from the one below the site
    T step;           ///< b in units of length
    T lane_at[lanes]; ///< 0, b, 2b, ... in units of length

    AtomRows(const RowSubstrate& atoms, const P& potential)
        : pair(potential), heights(SiteHeight<F, T>::of(atoms.heights)), i0(atoms.i0), j0(atoms.j0),
          b(atoms.map.spacing), inverse_b(1.0 / b), step(row_offset(1)) {
        // The diameter of the cutoff in groups, to the nearest, is centred on the site.
        const int across = static_cast<int>(std::lround(2.0 * pair.cutoff / (b * lanes)));
        start = 1 - (across > 1 ? across : 1) * lanes / 2;
        for (int i = 0; i < lanes; ++i)
            lane_at[i] = row_offset(i);
    }

    /// j b in units of length.
    ASPERITY_INLINE T row_offset(int j) const {
        return static_cast<T>(j * b * (1.0 / length_unit<T>));
    }

    /// The registers [first, end), counted from the beginning of group 0, that may be in reach of a
    /// site anywhere above its atom: the site is from 0 to b past it.
    ASPERITY_INLINE int first_register(double reach) const {
        return static_cast<int>(std::ceil((-reach * inverse_b - (start + width - 1)) / width));
    }
    ASPERITY_INLINE int end_of_registers(double reach) const {
        return static_cast<int>(std::floor((reach * inverse_b + 1.0 - start) / width)) + 1;
    }
    /// Half the length of the chord of reach along the columns of register k.
    ASPERITY_INLINE double half_chord(int k, double reach) const {
        const int begin = start + k * width, end = begin + width - 1;
        const double aside = begin > 1 ? (begin - 1) * b : end < 0 ? -end * b : 0.0;
        const double chord2 = reach * reach - aside * aside;
        return chord2 > 0.0 ? std::sqrt(chord2) : 0.0;
    }

    /// Couples of rows within half a chord: p holds rows 2p and 2p + 1 from the one below the site.
    ASPERITY_INLINE int first_couple(double y_there, double half) const {
        return static_cast<int>(std::floor(0.5 * std::ceil((y_there - half) * inverse_b)));
    }
    ASPERITY_INLINE int last_couple(double y_there, double half) const {
        return static_cast<int>(std::floor(0.5 * std::floor((y_there + half) * inverse_b)));
    }

    /// Two pairs on their way from distance to force; t: what begin() returned.
    struct Couple {
        V z, z_next, r2, r2_next, t, t_next;
    };
    struct Sums {
        WideSum<V> x, y, z, energy;
        ASPERITY_INLINE void merge(const Sums& other) {
            x.merge(other.x), y.merge(other.y), z.merge(other.z), energy.merge(other.energy);
        }
    };

    /// The sums of one site, displaced to (x, y). Chords: half the chord of each register in reach
    /// (first, end, half(k)). Aside: dy(j) and dy2(j) to row j, made from the site's y and chords.
    template <bool observe, bool close, class Aside, class Chords>
    ASPERITY_INLINE SiteTotal sum(double x, double y, double height, const Chords& chords) const {
        const SiteHeight<F, T> z(height);
        const int i_below = static_cast<int>(std::floor(x * inverse_b));
        const int j_below = static_cast<int>(std::floor(y * inverse_b));
        const double x_there = x - i_below * b, y_there = y - j_below * b; // from 0 to b
        const Aside aside(*this, y_there, chords);
        HalvedSum<Sums, parts> over_parts;
        V nearest = pair.r2_cut;
        ASPERITY_UNROLL(1)
        for (int n = 0; n < parts; ++n) {
            // The registers that are this part of their groups.
            const int part = over_parts.turn(n);
            const V lane = V::load(lane_at + part * width);
            Sums sums;
            int k = chords.first + ((part - chords.first) & (parts - 1));
            for (; k < chords.end; k += parts) {
                const int group = start + (k - part) * width, first = group + part * width;
                const V dx =
                    V(static_cast<T>((x_there - group * b) * (1.0 / length_unit<T>))) - lane;
                const int p_first = first_couple(y_there, chords.half(k));
                const int p_last = last_couple(y_there, chords.half(k));
                add_register<observe, close>(heights.line(j_below + 2 * p_first - j0) +
                                                 (i_below + first - i0),
                                             z, dx, p_first, p_last, aside, sums, nearest);
            }
            over_parts.add(n, sums);
        }
        const Sums& all = over_parts.all;
        const double scale = pair.force_scale * length_unit<T>;
        SiteTotal result{
            {scale * all.x.over_lanes(), scale * all.y.over_lanes(), scale * all.z.over_lanes()},
            0.0,
            no_pair};
        if constexpr (observe) {
            result.energy = pair.energy_scale * all.energy.over_lanes();
            T least = nearest[0];
            for (int i = 1; i < width; ++i)
                least = nearest[i] < least ? nearest[i] : least;
            result.nearest = pair.nearest(least);
        }
        return result;
    }

private:
    /// One register through couples p_first to p_last of rows; row: its first atom there.
    template <bool observe, bool close, class Aside>
    ASPERITY_INLINE void add_register(const Atom* row, const SiteHeight<F, T>& z, V dx, int p_first,
                                      int p_last, const Aside& aside, Sums& sums,
                                      V& nearest) const {
        const V dx2 = dx * dx;
        V f_all(T(0)), f_y(T(0)), f_next(T(0)), f_z(T(0)), v(T(0));
        const auto approach = [&](int p) __attribute__((always_inline)) {
            Couple c;
            c.z = z.above(row);
            c.z_next = z.above(row + heights.row);
            c.r2 = fma(c.z, c.z, dx2 + aside.dy2(2 * p));
            c.r2_next = fma(c.z_next, c.z_next, dx2 + aside.dy2(2 * p + 1));
            pair.template begin<close>(c.r2, c.r2_next, c.t, c.t_next);
            row += 2 * heights.row;
            return c;
        };
        const auto collect = [&](int p, const Couple& c) __attribute__((always_inline)) {
            const V f = pair.force(c.t, c.r2, std::true_type{});
            const V next = pair.force(c.t_next, c.r2_next, std::true_type{});
            const V both = f + next;
            f_all = f_all + both;
            f_next = f_next + next;
            f_y = fma(both, aside.dy(2 * p), f_y);
            f_z = fma(f, c.z, f_z);
            f_z = fma(next, c.z_next, f_z);
            if constexpr (observe) {
                v = v + (pair.energy(c.t, c.r2) + pair.energy(c.t_next, c.r2_next));
                nearest = min(nearest, min(c.r2, c.r2_next));
            }
        };
        // The next couple's division is under way while this one's forces are formed; a device has
        // other threads for that.
        if constexpr (width == 1) {
            for (int p = p_first; p <= p_last; ++p)
                collect(p, approach(p));
        } else {
            Couple couple = approach(p_first);
            for (int p = p_first; p < p_last; ++p) {
                const Couple next = approach(p + 1);
                collect(p, couple);
                couple = next;
            }
            collect(p_last, couple);
        }
        // Sum f dy = sum over both rows of f times the first one's dy - b sum over the second.
        sums.x.add(f_all * dx);
        sums.y.add(f_y - f_next * V(step));
        sums.z.add(f_z);
        if constexpr (observe) sums.energy.add(v);
    }
};

/// Of a single site: chords and distances are made where they are needed.
template <class T, class P>
struct ChordsOfOne {
    const AtomRows<Scalar, T, P>& rows;
    double reach;
    int first, end;
    ASPERITY_INLINE ChordsOfOne(const AtomRows<Scalar, T, P>& of, double within)
        : rows(of), reach(within), first(of.first_register(within)),
          end(of.end_of_registers(within)) {}
    ASPERITY_INLINE double half(int k) const { return rows.half_chord(k, reach); }
};
template <class T, class P>
struct AsideOfOne {
    const AtomRows<Scalar, T, P>& rows;
    T y;
    ASPERITY_INLINE AsideOfOne(const AtomRows<Scalar, T, P>& of, double y_there,
                               const ChordsOfOne<T, P>&)
        : rows(of), y(static_cast<T>(y_there * (1.0 / length_unit<T>))) {}
    ASPERITY_INLINE Lane<T> dy(int j) const { return Lane<T>(y) - Lane<T>(rows.row_offset(j)); }
    ASPERITY_INLINE Lane<T> dy2(int j) const { return dy(j) * dy(j); }
};

} // namespace asperity::ASPERITY_VARIANT
