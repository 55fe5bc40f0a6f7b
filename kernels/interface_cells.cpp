// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The sweep over substrate atoms anywhere, in cells of sixteen; compiled once for each x86-64 level
// (variant.hpp). Cells hold atoms of one type; the types are summed one after the other.
//
// A block of sites has a list of the cells that any of its sites may reach. Those whose bounds are
// within the cutoff of the block are gathered, up to 64 at a time. Each site compares its position
// with their bounds, a register of cells at a time, and takes the atoms of those it finds, a
// register of atoms at a time; two registers share a division. A pair takes eleven and a half
// multiplications, and the comparison with the cutoff.
//
// Cells follow one another in the order of the list, which is that of the atoms and not of the
// block, and a cell that is left out would have added exact zeros: so the order of a site's sum is
// its own. The lanes are added at the end, by halving.
#include "kernels/interface_block.hpp"

#include <bit>

namespace asperity::ASPERITY_VARIANT {

template <>
struct Ground<CellSubstrate> {
    static constexpr bool of_types = true;
    const CellSubstrate& from;
    double datum() const { return from.datum; }
    double margin() const { return from.offset_margin; }
    const SubstrateAtoms& judge() const { return from.atoms; }
    struct Some {
        double from_rest; ///< negative: nothing is in reach
    };
    ASPERITY_INLINE Some reach(int x, int y, const BlockOfSites& site,
                               const PairTable& pairs) const {
        const double highest =
            from.highest[static_cast<std::ptrdiff_t>(y) * from.blocks + x / interface_block];
        return {pairs.cutoff - (site.lowest_z - highest)};
    }
};

namespace {

/// Fixed-point and single-precision distances differ from those of the bounds by less, Å.
constexpr double cell_slack = 1e-5;

/// Cells near a block of sites, and where one of the sites stands as they see it.
template <class T>
struct NearCells {
    static constexpr int most = 64;
    int count = 0;
    std::int64_t cell[most];
    alignas(64) double low[3][most], high[3][most]; ///< bounds of the image, Å
    alignas(64) double origin[3][most]; ///< positions in the cell are counted from here, Å
    alignas(64) double from[3][most];   ///< the site's, to be read by place()

    /// Images [next, end) within `reach` of a box around the sites, as many as there is room for;
    /// where to go on.
    ASPERITY_INLINE std::int64_t gather(const CellSubstrate& atoms, std::int64_t next,
                                        std::int64_t end, const double (&least)[3],
                                        const double (&greatest)[3], double reach) {
        count = 0;
        for (; next < end && count < most; ++next) {
            const CellImage image = atoms.images[next];
            const double* bound = atoms.bounds + image.cell;
            const double shift[3] = {image.x * atoms.atoms.edge, image.y * atoms.atoms.edge, 0.0};
            double distance2 = 0.0;
            for (int k = 0; k < 3; ++k) {
                const double bottom = bound[2 * k * atoms.cells] + shift[k],
                             top = bound[(2 * k + 1) * atoms.cells] + shift[k];
                low[k][count] = bottom;
                high[k][count] = top;
                origin[k][count] = mixed ? 0.5 * (bottom + top) : shift[k];
                // Twice the greatest of below, above and zero, without a branch: at most one of
                // the two is positive.
                const double below = bottom - greatest[k], above = least[k] - top;
                const double gap = (below + std::fabs(below)) + (above + std::fabs(above));
                distance2 += 0.25 * (gap * gap);
            }
            cell[count] = image.cell;
            count += distance2 < reach * reach;
        }
        for (int k = count; k < most && k % Real::width; ++k)
            low[0][k] = high[0][k] = 1e30;
        return next;
    }

    /// Bits of those within `reach` of a site, which is placed before them.
    ASPERITY_INLINE std::uint64_t within(double x, double y, double z, double reach) {
        const Real site[3] = {x, y, z}, zero(0.0), reach2(reach * reach);
        std::uint64_t bits = 0;
        for (int c = 0; c < count; c += Real::width) {
            Real r2(0.0);
            for (int k = 0; k < 3; ++k) {
                biased(site[k] - Real::load(origin[k] + c)).store(from[k] + c);
                const Real below = Real::load(low[k] + c) - site[k],
                           above = site[k] - Real::load(high[k] + c);
                const Real gap = max(max(below, above), zero);
                r2 = fma(gap, gap, r2);
            }
            bits |= static_cast<std::uint64_t>(bits_where_less(r2, reach2)) << c;
        }
        return bits;
    }

    /// The site's coordinate from a cell, in every lane.
    ASPERITY_INLINE auto place(int k, int c) const {
        if constexpr (mixed) // the integer of a biased number is its last 32 bits
            return Simd::Int32::same(
                static_cast<std::int32_t>(std::bit_cast<std::int64_t>(from[k][c])));
        else
            return Real(from[k][c]);
    }

private:
    static constexpr bool mixed = std::is_same_v<T, float>;
    ASPERITY_INLINE static Real biased(Real length) {
        if constexpr (mixed)
            return fma(length, Real(1.0 / fixed_quantum), Real(0x1.8p52));
        else
            return length;
    }
};

/// The atoms of a cell as a site sees them, in units of length.
template <class T>
struct CellView;
template <>
struct CellView<double> {
    const double* atoms[3];
    Real at[3];
    ASPERITY_INLINE CellView(const CellSubstrate& of, const NearCells<double>& near, int c)
        : atoms{of.x + near.cell[c] * cell_atoms, of.y + near.cell[c] * cell_atoms,
                of.z + near.cell[c] * cell_atoms},
          at{near.place(0, c), near.place(1, c), near.place(2, c)} {}
    ASPERITY_INLINE Real d(int k, int lane) const { return at[k] - Real::load(atoms[k] + lane); }
};
template <>
struct CellView<float> {
    const std::int32_t* atoms[3];
    Simd::Int32 at[3];
    ASPERITY_INLINE CellView(const CellSubstrate& of, const NearCells<float>& near, int c)
        : atoms{of.fixed_x + near.cell[c] * cell_atoms, of.fixed_y + near.cell[c] * cell_atoms,
                of.fixed_z + near.cell[c] * cell_atoms},
          at{near.place(0, c), near.place(1, c), near.place(2, c)} {}
    ASPERITY_INLINE Pack<float> d(int k, int lane) const {
        return to_float(at[k] - Simd::Int32::load(atoms[k] + lane));
    }
};

/// The sums of a site, lane by lane.
template <class T, bool observe>
struct CellSums {
    using V = Pack<T>;
    V x, y, z, energy, nearest;

    ASPERITY_INLINE void clear(const PairTerms<Simd, T>& pair) {
        x = y = z = energy = V(T(0));
        nearest = pair.r2_cut;
    }
    ASPERITY_INLINE void add(const PairTerms<Simd, T>& pair, V dx, V dy, V dz, V r2, V t) {
        const V f = pair.force(t, r2, std::true_type{});
        x = fma(f, dx, x);
        y = fma(f, dy, y);
        z = fma(f, dz, z);
        if constexpr (observe) {
            energy = energy + pair.energy(t, r2);
            nearest = min(nearest, r2);
        }
    }
    ASPERITY_INLINE void add_cell(const PairTerms<Simd, T>& pair, const CellView<T>& cell) {
        const auto square = [](V dx, V dy, V dz) { return fma(dx, dx, fma(dy, dy, dz * dz)); };
        if constexpr (V::width == cell_atoms) {
            const V dx = cell.d(0, 0), dy = cell.d(1, 0), dz = cell.d(2, 0),
                    r2 = square(dx, dy, dz);
            add(pair, dx, dy, dz, r2, pair.template inverse<true>(r2));
        } else {
            for (int k = 0; k < cell_atoms; k += 2 * V::width) {
                const int l = k + V::width;
                const V dx = cell.d(0, k), dy = cell.d(1, k), dz = cell.d(2, k);
                const V ex = cell.d(0, l), ey = cell.d(1, l), ez = cell.d(2, l);
                const V r2 = square(dx, dy, dz), s2 = square(ex, ey, ez);
                V t, s;
                pair.template inverse<true>(r2, s2, t, s);
                add(pair, dx, dy, dz, r2, t);
                add(pair, ex, ey, ez, s2, s);
            }
        }
    }
    /// Adds them to those of the types before, if there are any.
    ASPERITY_INLINE void finish(const PairTerms<Simd, T>& pair, bool first, int to,
                                SiteTerms& terms) const {
        const auto over_lanes = [](V lanes) {
            WideSum<Pack<T>> sum;
            sum.add(lanes);
            return sum.over_lanes();
        };
        const double scale = pair.force_scale * length_unit<T>;
        const auto give = [&](double* sum, double mine) {
            sum[to] = first ? mine : sum[to] + mine;
        };
        give(terms.x, scale * over_lanes(x));
        give(terms.y, scale * over_lanes(y));
        give(terms.z, scale * over_lanes(z));
        if constexpr (observe) {
            give(terms.energy, pair.energy_scale * over_lanes(energy));
            T least = nearest[0];
            for (int i = 1; i < V::width; ++i)
                least = nearest[i] < least ? nearest[i] : least;
            const double r2 = pair.nearest(least);
            if (first || r2 < terms.nearest[to]) terms.nearest[to] = r2;
            terms.in_contact |= unsigned{r2 < pair.contact_r2} << to;
        }
    }
};

/// The cells of one type, images [next, end), over a block of sites.
template <class T, bool observe>
ASPERITY_INLINE void sum_type(const InterfaceSites& sites, const CellSubstrate& atoms,
                              const PairTerms<Simd, T>& pair, std::int64_t next, std::int64_t end,
                              bool first, const BlockOfSites& site, int x, int y, int count,
                              SiteTerms& terms) {
    const double a = sites.spacing, reach = pair.cutoff + cell_slack;
    const double at_x = (sites.x0 + x + 0.5) * a, at_y = (sites.y0 + y + 0.5) * a;
    const double least[3] = {at_x - site.sideways, at_y - site.sideways, site.lowest_z};
    const double greatest[3] = {at_x + (count - 1) * a + site.sideways, at_y + site.sideways,
                                site.highest_z};
    CellSums<T, observe> sum[interface_block];
    for (int i = 0; i < count; ++i)
        sum[i].clear(pair);
    NearCells<T> near;
    while (next < end) {
        next = near.gather(atoms, next, end, least, greatest, reach);
        for (int i = 0; i < count; ++i) {
            const double px = (sites.x0 + x + i + 0.5) * a + site.ux[i];
            std::uint64_t bits = near.within(px, at_y + site.uy[i], site.z[i], reach);
            CellSums<T, observe> mine = sum[i];
            for (; bits; bits &= bits - 1)
                mine.add_cell(pair, {atoms, near, __builtin_ctzll(bits)});
            sum[i] = mine;
        }
    }
    for (int i = 0; i < count; ++i)
        sum[i].finish(pair, first, i, terms);
}

template <class T, bool observe>
void cell_sweep(const InterfaceSites& sites, const CellSubstrate& atoms, const PairTable& pairs,
                int row_begin, int row_end, InterfaceSums& sums) {
    sweep_blocks<T, observe>(
        sites, atoms, pairs, pairs, row_begin, row_end, sums,
        [&](const BlockOfSites& site, const auto&, int x, int y, int count, SiteTerms& terms)
            __attribute__((always_inline)) {
                const std::ptrdiff_t block =
                    static_cast<std::ptrdiff_t>(y) * atoms.blocks + x / interface_block;
                for (int type = 0; type < pairs.types; ++type) {
                    const std::int64_t* list = atoms.first + block * pairs.types + type;
                    sum_type<T, observe>(sites, atoms, PairTerms<Simd, T>(pairs.of[type]), list[0],
                                         list[1], type == 0, site, x, y, count, terms);
                }
            });
}

} // namespace

extern const InterfaceKernels::Sweeps<CellSubstrate, PairTable> cell_sweeps;
const InterfaceKernels::Sweeps<CellSubstrate, PairTable> cell_sweeps = {
    {cell_sweep<double, false>, cell_sweep<double, true>},
    {cell_sweep<float, false>, cell_sweep<float, true>}};

} // namespace asperity::ASPERITY_VARIANT
