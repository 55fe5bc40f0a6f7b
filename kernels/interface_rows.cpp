// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The sweep over the rows of a substrate of any spacing; compiled once for each x86-64 level
// (variant.hpp).
//
// Site by site: registers of atoms stand side by side along x, centred on the site, and each is
// taken up through the rows of atoms within its chord of the reach, two rows at a time (they share
// a division). dx and its square belong to the register, dy to the row. A pair takes eight
// multiplications, as in the lattice sweep, and the comparison with the cutoff. About a fifth of
// the lanes lie between the circle of the cutoff and the ends of the rows.
//
// Registers and pairs of rows are counted from the atom below the site, so the order of a site's
// sum is its own; the lanes are added at the end, by halving.
#include "kernels/interface_block.hpp"

namespace asperity::ASPERITY_VARIANT {

namespace {

/// Registers of atoms that hold the longest row in reach.
constexpr int most_registers = 2 * max_half_offsets;
/// Rows in reach to either side, and behind them room for a register.
constexpr int most_rows = 2 * max_half_offsets;
constexpr int room_for_rows = 2 * most_rows + 16;

/// The substrate's side of a sweep, the same for all its sites.
template <class T>
struct Rows {
    using V = Pack<T>;
    static constexpr int width = V::width;

    const PairTerms<Simd, T>& pair;
    PlaneView<const typename SiteHeight<Simd, T>::Atom> heights;
    int i0, j0;
    double b, inverse_b;
    int start; ///< first atom of register 0, counted from the one below the site
    T step;    ///< b in units of length
    V lanes;   ///< 0, b, 2b, ... in units of length
    /// j b in units of length, from row -most_rows on.
    alignas(64) T row_at[room_for_rows];

    Rows(const RowSubstrate& atoms, const PairTerms<Simd, T>& terms)
        : pair(terms), heights(SiteHeight<Simd, T>::of(atoms.heights)), i0(atoms.i0), j0(atoms.j0),
          b(atoms.map.spacing), inverse_b(1.0 / b), step(static_cast<T>(b / length_unit<T>)) {
        for (int j = 0; j < room_for_rows; ++j)
            row_at[j] = static_cast<T>((j - most_rows) * b / length_unit<T>);
        // The diameter of the cutoff in registers, to the nearest, is centred on the site.
        const int across = static_cast<int>(std::lround(2.0 * terms.cutoff / (b * width)));
        start = 1 - (across > 1 ? across : 1) * width / 2;
        for (int i = 0; i < width; ++i)
            lanes.r[i] = static_cast<T>(i * b / length_unit<T>);
    }

    /// The registers within reach of a site anywhere above its atom, with half the length of their
    /// chords.
    struct Chords {
        int first, count;
        double half[most_registers];
        double longest = 0.0;
    };
    ASPERITY_INLINE void chords(double reach, Chords& c) const {
        // Register k holds atoms start + k width and on; the site is from 0 to b past its own.
        const double before = -reach * inverse_b - (start + width - 1);
        const double behind = reach * inverse_b + 1.0 - start;
        c.first = static_cast<int>(std::ceil(before / width));
        const int last = static_cast<int>(std::floor(behind / width));
        c.count = last - c.first + 1 < most_registers ? last - c.first + 1 : most_registers;
        for (int k = 0; k < c.count; ++k) {
            const int begin = start + (c.first + k) * width, end = begin + width - 1;
            const double aside = begin > 1 ? (begin - 1) * b : end < 0 ? -end * b : 0.0;
            const double chord2 = reach * reach - aside * aside;
            c.half[k] = chord2 > 0.0 ? std::sqrt(chord2) : 0.0;
            c.longest = c.half[k] > c.longest ? c.half[k] : c.longest;
        }
    }

    /// Two pairs on their way from distance to force.
    struct Couple {
        V z, z_next, r2, r2_next, t, t_next;
    };

    /// The sums of one site, displaced to (x, y).
    template <bool observe, bool close>
    ASPERITY_INLINE void sum(double x, double y, double height, const Chords& chords, int to,
                             SiteTerms& terms) const {
        const SiteHeight<Simd, T> z(height);
        const int i_below = static_cast<int>(std::floor(x * inverse_b));
        const int j_below = static_cast<int>(std::floor(y * inverse_b));
        const double x_there = x - i_below * b, y_there = y - j_below * b; // from 0 to b
        // Couples of rows: p holds rows 2p and 2p + 1 from the one below.
        const auto first_couple = [&](double half) {
            return static_cast<int>(std::floor(0.5 * std::ceil((y_there - half) * inverse_b)));
        };
        const auto last_couple = [&](double half) {
            return static_cast<int>(std::floor(0.5 * std::floor((y_there + half) * inverse_b)));
        };
        alignas(64) T dy[room_for_rows], dy2[room_for_rows]; // to row j - most_rows
        const V y_unit(static_cast<T>(y_there / length_unit<T>));
        const int j_end = 2 * last_couple(chords.longest) + 2 + most_rows;
        for (int j = 2 * first_couple(chords.longest) + most_rows; j < j_end; j += width) {
            const V d = y_unit - V::load(row_at + j);
            d.store(dy + j);
            (d * d).store(dy2 + j);
        }
        WideSum<T> sum_x, sum_y, sum_z, energy;
        V nearest = pair.r2_cut;
        for (int k = 0; k < chords.count; ++k) {
            const int first = start + (chords.first + k) * width;
            const int p_first = first_couple(chords.half[k]), p_last = last_couple(chords.half[k]);
            const V dx = V(static_cast<T>((x_there - first * b) / length_unit<T>)) - lanes;
            const V dx2 = dx * dx;
            V f_all(T(0)), f_y(T(0)), f_next(T(0)), f_z(T(0)), v(T(0));
            const auto* row = heights.line(j_below + 2 * p_first - j0) + (i_below + first - i0);
            const auto approach = [&](int p) __attribute__((always_inline)) {
                const T* lateral2 = dy2 + 2 * p + most_rows;
                Couple c;
                c.z = z.above(row);
                c.z_next = z.above(row + heights.row);
                c.r2 = fma(c.z, c.z, dx2 + V(lateral2[0]));
                c.r2_next = fma(c.z_next, c.z_next, dx2 + V(lateral2[1]));
                pair.template inverse<close>(c.r2, c.r2_next, c.t, c.t_next);
                row += 2 * heights.row;
                return c;
            };
            const auto collect = [&](int p, const Couple& c) __attribute__((always_inline)) {
                const V f = pair.force(c.t, c.r2, std::true_type{});
                const V next = pair.force(c.t_next, c.r2_next, std::true_type{});
                const V both = f + next;
                f_all = f_all + both;
                f_next = f_next + next;
                f_y = fma(both, V(dy[2 * p + most_rows]), f_y);
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
            sum_x.add(f_all * dx);
            sum_y.add(f_y - f_next * V(step));
            sum_z.add(f_z);
            if constexpr (observe) energy.add(v);
        }
        const double scale = pair.force_scale * length_unit<T>;
        terms.x[to] = scale * sum_x.over_lanes();
        terms.y[to] = scale * sum_y.over_lanes();
        terms.z[to] = scale * sum_z.over_lanes();
        if constexpr (observe) {
            terms.energy[to] = pair.energy_scale * energy.over_lanes();
            T least = nearest[0];
            for (int i = 1; i < width; ++i)
                least = nearest[i] < least ? nearest[i] : least;
            terms.nearest[to] = pair.nearest(least);
        }
    }
};

template <class T, bool observe>
void row_sweep(const InterfaceSites& sites, const RowSubstrate& atoms, const LennardJones& lj,
               int row_begin, int row_end, InterfaceSums& sums) {
    const PairTerms<Simd, T> pair(lj);
    const Rows<T> rows(atoms, pair);
    const double a = sites.spacing;
    sweep_blocks<T, observe>(
        sites, atoms, lj, pair, row_begin, row_end, sums,
        [&](const BlockOfSites& site, const Reach& reach, int x, int y, int count, SiteTerms& terms)
            __attribute__((always_inline)) {
                typename Rows<T>::Chords chords;
                rows.chords(reach.from_site, chords);
                for (int i = 0; i < count; ++i) {
                    const double at_x = (sites.x0 + x + i + 0.5) * a + site.ux[i];
                    const double at_y = (sites.y0 + y + 0.5) * a + site.uy[i];
                    if (reach.close)
                        rows.template sum<observe, true>(at_x, at_y, site.z[i], chords, i, terms);
                    else
                        rows.template sum<observe, false>(at_x, at_y, site.z[i], chords, i, terms);
                }
            });
}

} // namespace

extern const InterfaceKernels::Sweeps<RowSubstrate> row_sweeps;
const InterfaceKernels::Sweeps<RowSubstrate> row_sweeps = {
    {row_sweep<double, false>, row_sweep<double, true>},
    {row_sweep<float, false>, row_sweep<float, true>}};

} // namespace asperity::ASPERITY_VARIANT
