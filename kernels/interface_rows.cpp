// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The sweep over the rows of a substrate of any spacing: site by site, SIMD over the atoms along x;
// compiled once for each x86-64 level (variant.hpp).
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
//
// Chords are tabulated for a block of sites, distances to rows for a site.
#include "kernels/interface_block.hpp"

namespace asperity::ASPERITY_VARIANT {

namespace {

/// Atoms in a group: the lanes of the widest register.
constexpr int row_lanes = 8;

/// Adds sums by halving. They come in the order of number(): 0, 2, 1, 3 of four.
template <class Sum, int count>
struct PairwiseSum {
    static constexpr int levels = count >= 4 ? 2 : count / 2;
    static_assert(count == 1 << levels);

    /// Returns the number of the n-th sum: n with its bits reversed.
    ASPERITY_INLINE static int number(int n) {
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
            if (!waits && first) half_[level] = sum;
            waits = waits || first;
            if (!waits) sum.merge(half_[level]);
        }
        all = sum; // in the end
    }
    Sum all;

private:
    Sum half_[levels > 0 ? levels : 1]; ///< [level]: a sum that waits
};

/// A substrate, and the constants of a sweep over it.
template <class P>
struct AtomRows {
    static constexpr int width = Real::width, lanes = row_lanes;
    /// Registers in a group.
    static constexpr int parts = lanes / width;

    PairTerms<Simd, double, P> pair;
    PlaneView<const double> heights;
    int i0, j0;
    double b, inverse_b;
    int start;             ///< first atom of group 0, counted from the one below the site
    double lane_at[lanes]; ///< 0, b, 2b, ..., Å

    AtomRows(const RowSubstrate& atoms, const P& potential)
        : pair(potential), heights(atoms.heights.height), i0(atoms.i0), j0(atoms.j0),
          b(atoms.map.spacing), inverse_b(1.0 / b) {
        // The diameter of the cutoff in groups, to the nearest, is centred on the site.
        const int across = static_cast<int>(std::lround(2.0 * pair.cutoff / (b * lanes)));
        start = 1 - (across > 1 ? across : 1) * lanes / 2;
        for (int i = 0; i < lanes; ++i)
            lane_at[i] = i * b;
    }

    /// Returns the first register, counted from the beginning of group 0, that may be in reach of a
    /// site anywhere above its atom: the site is from 0 to b past it.
    ASPERITY_INLINE int first_register(double reach) const {
        return static_cast<int>(std::ceil((-reach * inverse_b - (start + width - 1)) / width));
    }
    ASPERITY_INLINE int end_of_registers(double reach) const {
        return static_cast<int>(std::floor((reach * inverse_b + 1.0 - start) / width)) + 1;
    }
    /// Returns half the length of the chord of reach along the columns of register k.
    ASPERITY_INLINE double half_chord(int k, double reach) const {
        const int begin = start + k * width, end = begin + width - 1;
        const double aside = begin > 1 ? (begin - 1) * b : end < 0 ? -end * b : 0.0;
        const double chord2 = reach * reach - aside * aside;
        return chord2 > 0.0 ? std::sqrt(chord2) : 0.0;
    }

    /// Returns the first couple of rows within half a chord: p holds rows 2p and 2p + 1 from the
    /// one below the site.
    ASPERITY_INLINE int first_couple(double y_there, double half) const {
        return static_cast<int>(std::floor(0.5 * std::ceil((y_there - half) * inverse_b)));
    }
    ASPERITY_INLINE int last_couple(double y_there, double half) const {
        return static_cast<int>(std::floor(0.5 * std::floor((y_there + half) * inverse_b)));
    }

    /// Two pairs between the computation of distance and force. t: results of begin().
    struct Couple {
        Real z, z_next, r2, r2_next, t, t_next;
    };
    struct Sums {
        Real x{0.0}, y{0.0}, z{0.0}, energy{0.0};
        ASPERITY_INLINE void merge(const Sums& other) {
            x = x + other.x;
            y = y + other.y;
            z = z + other.z;
            energy = energy + other.energy;
        }
    };

    /// Sums one site, displaced to (x, y). Chords: half the chord of each register in reach (first,
    /// end, half(k)). Aside: dy(j) and dy2(j) to row j, made from the site's y and chords.
    template <bool observe, bool close, class Aside, class Chords>
    ASPERITY_INLINE SiteTotal sum(double x, double y, double height, const Chords& chords) const {
        const SiteHeight<Simd, double> z(height);
        const int i_below = static_cast<int>(std::floor(x * inverse_b));
        const int j_below = static_cast<int>(std::floor(y * inverse_b));
        const double x_there = x - i_below * b, y_there = y - j_below * b; // between 0 and b
        const Aside aside(*this, y_there, chords);
        PairwiseSum<Sums, parts> over_parts;
        Real nearest = pair.r2_cut;
        ASPERITY_UNROLL(1)
        for (int n = 0; n < parts; ++n) {
            // The registers that are this part of their groups.
            const int part = over_parts.number(n);
            const Real lane = Real::load(lane_at + part * width);
            Sums sums;
            int k = chords.first + ((part - chords.first) & (parts - 1));
            for (; k < chords.end; k += parts) {
                const int group = start + (k - part) * width, first = group + part * width;
                const Real dx = Real(x_there - group * b) - lane;
                const int p_first = first_couple(y_there, chords.half(k));
                const int p_last = last_couple(y_there, chords.half(k));
                add_register<observe, close>(heights.line(j_below + 2 * p_first - j0) +
                                                 (i_below + first - i0),
                                             z, dx, p_first, p_last, aside, sums, nearest);
            }
            over_parts.add(n, sums);
        }
        const Sums& all = over_parts.all;
        const double scale = pair.force_scale;
        SiteTotal result{
            {scale * total(all.x), scale * total(all.y), scale * total(all.z)}, 0.0, no_pair};
        if constexpr (observe) {
            result.energy = pair.energy_scale * total(all.energy);
            double least = nearest[0];
            for (int i = 1; i < width; ++i)
                least = nearest[i] < least ? nearest[i] : least;
            result.nearest = pair.nearest(least);
        }
        return result;
    }

private:
    /// Sums one register through couples p_first to p_last of rows; row: its first atom there.
    template <bool observe, bool close, class Aside>
    ASPERITY_INLINE void add_register(const double* row, const SiteHeight<Simd, double>& z, Real dx,
                                      int p_first, int p_last, const Aside& aside, Sums& sums,
                                      Real& nearest) const {
        const Real dx2 = dx * dx;
        Real f_all(0.0), f_y(0.0), f_next(0.0), f_z(0.0), v(0.0);
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
            const Real f = pair.force(c.t, c.r2, std::true_type{});
            const Real next = pair.force(c.t_next, c.r2_next, std::true_type{});
            const Real both = f + next;
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
        // The next couple's division is under way while this one's forces are formed.
        Couple couple = approach(p_first);
        for (int p = p_first; p < p_last; ++p) {
            const Couple next = approach(p + 1);
            collect(p, couple);
            couple = next;
        }
        collect(p_last, couple);
        // Sum f dy = sum over both rows of f times the first one's dy - b sum over the second.
        sums.x = sums.x + f_all * dx;
        sums.y = sums.y + (f_y - f_next * Real(b));
        sums.z = sums.z + f_z;
        if constexpr (observe) sums.energy = sums.energy + v;
    }
};

/// j b for rows j from -max_rows on, and behind them room for a register.
struct RowTable {
    static constexpr int size = 2 * max_rows + interface_block;
    alignas(64) double at[size];
    explicit RowTable(double b) {
        for (int j = 0; j < size; ++j)
            at[j] = (j - max_rows) * b;
    }
};

template <class P>
struct ChordsOfBlock {
    const RowTable& table;
    int first, end;
    double longest = 0.0;

    ASPERITY_INLINE ChordsOfBlock(const AtomRows<P>& rows, const RowTable& of, double reach)
        : table(of), first(rows.first_register(reach)), end(rows.end_of_registers(reach)) {
        end = end - first < most ? end : first + most;
        for (int k = first; k < end; ++k) {
            half_[k - first] = rows.half_chord(k, reach);
            longest = half(k) > longest ? half(k) : longest;
        }
    }
    ASPERITY_INLINE double half(int k) const { return half_[k - first]; }

private:
    static constexpr int most = 2 * max_rows / Real::width + 2;
    double half_[most];
};

template <class P>
struct AsideOfRegister {
    ASPERITY_INLINE AsideOfRegister(const AtomRows<P>& rows, double y_there,
                                    const ChordsOfBlock<P>& chords) {
        const Real y(y_there);
        const int end = 2 * rows.last_couple(y_there, chords.longest) + 2 + max_rows;
        for (int j = 2 * rows.first_couple(y_there, chords.longest) + max_rows; j < end;
             j += Real::width) {
            const Real d = y - Real::load(chords.table.at + j);
            d.store(dy_ + j);
            (d * d).store(dy2_ + j);
        }
    }
    ASPERITY_INLINE Real dy(int j) const { return Real(dy_[j + max_rows]); }
    ASPERITY_INLINE Real dy2(int j) const { return Real(dy2_[j + max_rows]); }

private:
    alignas(64) double dy_[RowTable::size], dy2_[RowTable::size];
};

template <bool observe, class P>
void sweep_with(const AtomRows<P>& rows, const InterfaceSites& sites, const RowSubstrate& atoms,
                const PairPotential& potential, int row_begin, int row_end, InterfaceSums& sums) {
    const RowTable table(rows.b);
    const double a = sites.spacing;
    sweep_blocks<observe>(
        sites, atoms, potential, rows.pair, row_begin, row_end, {}, sums,
        [&](const BlockOfSites& site, const Reach& reach, int x, int y, int count, SiteTerms& terms)
            __attribute__((always_inline)) {
                const ChordsOfBlock<P> chords(rows, table, reach.from_site);
                for (int i = 0; i < count; ++i) {
                    const double at_x = (sites.x0 + x + i + 0.5) * a + site.ux[i];
                    const double at_y = (sites.y0 + y + 0.5) * a + site.uy[i];
                    const SiteTotal total =
                        reach.close ? rows.template sum<observe, true, AsideOfRegister<P>>(
                                          at_x, at_y, site.z[i], chords)
                                    : rows.template sum<observe, false, AsideOfRegister<P>>(
                                          at_x, at_y, site.z[i], chords);
                    terms.x[i] = total.force.x;
                    terms.y[i] = total.force.y;
                    terms.z[i] = total.force.z;
                    if constexpr (observe) {
                        terms.energy[i] = total.energy;
                        terms.nearest[i] = total.nearest;
                    }
                }
            });
}

template <bool observe>
void row_sweep(const InterfaceSites& sites, const RowSubstrate& atoms,
               const PairPotential& potential, int row_begin, int row_end, InterfaceSums& sums) {
    std::visit(
        [&]<class P>(const P& p) {
            sweep_with<observe>(AtomRows<P>(atoms, p), sites, atoms, potential, row_begin, row_end,
                                sums);
        },
        potential);
}

} // namespace

extern const InterfaceKernels::Sweeps<RowSubstrate> row_sweeps;
const InterfaceKernels::Sweeps<RowSubstrate> row_sweeps = {{row_sweep<false>, row_sweep<true>}};

} // namespace asperity::ASPERITY_VARIANT
