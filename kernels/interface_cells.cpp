// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The sweep over substrate atoms anywhere, in cells of sixteen; compiled once for each x86-64 level
// (variant.hpp). Cells hold atoms of one type; the types are summed one after the other.
//
// A block of sites has a list of the cells that any of its sites may reach. Those whose bounds are
// within the cutoff of the block are gathered, up to 64 at a time. Each site compares its position
// with their bounds, a register of cells at a time, in single precision, lists those it finds, and
// takes their atoms, a register of atoms at a time; two registers share a division. A pair takes
// eleven and a half multiplications, and the comparison with the cutoff.
//
// Cells follow one another in the order of the list, which is that of the atoms and not of the
// block, and a cell that is left out would have added exact zeros: so the order of a site's sum is
// its own. The lanes are added at the end, by halving.
#include "kernels/interface_block.hpp"

#include <cstring>

namespace asperity::ASPERITY_VARIANT {

template <>
struct SubstrateAccess<CellSubstrate> {
    static constexpr bool of_types = true;
    const CellSubstrate& from;
    double datum() const { return from.datum; }
    double margin() const { return from.offset_margin; }
    const SubstrateAtoms& exact() const { return from.atoms; }
    struct CellReach {
        double from_rest; ///< distance within which atoms may matter, Å
        bool close;       ///< a pair may be nearer than it can be
        bool any() const { return from_rest > 0.0; }
    };
    ASPERITY_INLINE CellReach reach(int x, int y, const BlockOfSites& site,
                                    const PairTable& pairs) const {
        const double highest =
            from.highest[static_cast<std::ptrdiff_t>(y) * from.blocks + x / interface_block];
        const double gap = site.lowest_z - highest;
        return {pairs.cutoff - gap, !(gap - 0.01 > pairs.closest)};
    }
};

namespace {

/// Single-precision distances differ from those of the bounds by less, up to some thousand Å from
/// the base.
constexpr double cell_slack = 2e-3;

/// x, y, z and nothing, Å.
typedef double Place __attribute__((vector_size(32)));
ASPERITY_INLINE Place place_at(const double* from) {
    typedef double Unaligned __attribute__((vector_size(32), aligned(8), may_alias));
    return *reinterpret_cast<const Unaligned*>(from);
}

/// Cells near a block of sites.
struct NearCells {
    static constexpr int most = 64;
    Place base; ///< bounds are counted from here: the lowest corner, its middle sideways, Å
    Place low_corner, high_corner; ///< corners of a box around the sites, from the base, Å
    double slack;                  ///< slack of comparisons with the bounds, Å
    int count = 0;
    std::int64_t cell[most];
    /// Bounds of the image from the base, in single precision: they only say which cells are
    /// visited, and one too many adds exact zeros.
    alignas(64) float low[3][most], high[3][most];
    alignas(64) double origin[most][4]; ///< positions in the cell are counted from here

    ASPERITY_INLINE NearCells(const Place& least, const Place& greatest)
        : base(0.5 * (least + greatest)) {
        base[2] = least[2];
        low_corner = least - base;
        high_corner = greatest - base;
        // A site that is summed elsewhere may stand very high here.
        slack = cell_slack + 4e-7 * high_corner[2];
    }

    /// Gathers images [next, end) within `reach` of the box, up to the available room. Returns the
    /// next image.
    ASPERITY_INLINE std::int64_t gather(const CellSubstrate& atoms, std::int64_t next,
                                        std::int64_t end, double reach) {
        const double edge = atoms.atoms.edge;
        const Place none{};
        count = 0;
        for (; next < end && count < most; ++next) {
            const CellImage image = atoms.images[next];
            const double* bounds = atoms.bounds + std::ptrdiff_t{8} * image.cell;
            const Place shift = {image.x * edge, image.y * edge, 0.0, 0.0};
            const Place centre = place_at(bounds) + shift, extent = place_at(bounds + 4);
            const Place from = centre - base, below = from - extent, above = from + extent;
            const Place left = below - high_corner, right = low_corner - above;
            Place gap = left > right ? left : right;
            gap = gap > none ? gap : none;
            gap *= gap;
            std::memcpy(origin[count], &shift, sizeof shift);
            for (int k = 0; k < 3; ++k) {
                low[k][count] = static_cast<float>(below[k]);
                high[k][count] = static_cast<float>(above[k]);
            }
            cell[count] = image.cell;
            count += gap[0] + gap[1] + gap[2] < (reach + slack) * (reach + slack);
        }
        for (int k = count; k < most && k % Pack<float>::width; ++k)
            low[0][k] = high[0][k] = 1e30f;
        return next;
    }

    /// Returns the bits of the cells within `reach` of a site.
    ASPERITY_INLINE std::uint64_t within(const double (&site)[3], double reach) const {
        using V = Pack<float>;
        V at[3];
        for (int k = 0; k < 3; ++k)
            at[k] = V(static_cast<float>(site[k] - base[k]));
        const V zero(0.0f), reach2(static_cast<float>((reach + slack) * (reach + slack)));
        std::uint64_t bits = 0;
        for (int c = 0; c < count; c += V::width) {
            V r2(0.0f);
            for (int k = 0; k < 3; ++k) {
                const V gap =
                    max(max(V::load(low[k] + c) - at[k], at[k] - V::load(high[k] + c)), zero);
                r2 = fma(gap, gap, r2);
            }
            bits |= static_cast<std::uint64_t>(bits_where_less(r2, reach2)) << c;
        }
        return bits;
    }
};

/// The cells that a site reaches, and where it stands as their atoms have their places. Found
/// before the first pair, so that no pair waits for them.
struct CellsInReach {
    int count = 0;
    std::int64_t first[NearCells::most]; ///< first numbers of the cells
    alignas(32) double site[NearCells::most][4];

    ASPERITY_INLINE CellsInReach(const NearCells& near, const double (&at)[3], double reach) {
        const Place here = {at[0], at[1], at[2], 0.0};
        for (std::uint64_t bits = near.within(at, reach); bits; bits &= bits - 1) {
            const int c = __builtin_ctzll(bits);
            const Place from = here - place_at(near.origin[c]);
            std::memcpy(site[count], &from, sizeof from);
            first[count++] = near.cell[c] * (3 * cell_atoms);
        }
    }
};

/// Distances of a site from the atoms of a cell, Å.
struct CellView {
    const double* atoms;
    Real at[3];
    ASPERITY_INLINE CellView(const CellSubstrate& of, const CellsInReach& cells, int k)
        : atoms(of.places + cells.first[k]), at{cells.site[k][0], cells.site[k][1],
                                                cells.site[k][2]} {}
    ASPERITY_INLINE Real d(int axis, int lane) const {
        return at[axis] - Real::load(atoms + axis * cell_atoms + lane);
    }
};

/// The sums of a block's sites, lane by lane, between one load of cells and the next.
struct BlockSums {
    alignas(64) double x[interface_block][Real::width], y[interface_block][Real::width],
        z[interface_block][Real::width];
    alignas(64) double energy[interface_block][Real::width], nearest[interface_block][Real::width];
};

/// The sums of a site, lane by lane.
template <bool observe>
struct CellSums {
    using V = Real;
    V x, y, z, energy, nearest;

    template <class P>
    ASPERITY_INLINE explicit CellSums(const PairTerms<Simd, double, P>& pair)
        : x(0.0), y(0.0), z(0.0), energy(0.0), nearest(pair.r2_cut) {}
    ASPERITY_INLINE CellSums(const BlockSums& of, int i)
        : x(V::load(of.x[i])), y(V::load(of.y[i])), z(V::load(of.z[i])), energy(0.0), nearest(0.0) {
        if constexpr (observe) {
            energy = V::load(of.energy[i]);
            nearest = V::load(of.nearest[i]);
        }
    }
    ASPERITY_INLINE void store(BlockSums& to, int i) const {
        x.store(to.x[i]);
        y.store(to.y[i]);
        z.store(to.z[i]);
        if constexpr (observe) {
            energy.store(to.energy[i]);
            nearest.store(to.nearest[i]);
        }
    }
    template <class P>
    ASPERITY_INLINE void add(const PairTerms<Simd, double, P>& pair, V dx, V dy, V dz, V r2, V t) {
        const V f = pair.force(t, r2, std::true_type{});
        x = fma(f, dx, x);
        y = fma(f, dy, y);
        z = fma(f, dz, z);
        if constexpr (observe) {
            energy = energy + pair.energy(t, r2);
            nearest = min(nearest, r2);
        }
    }
    template <bool close, class P>
    ASPERITY_INLINE void add_cell(const PairTerms<Simd, double, P>& pair, const CellView& cell) {
        const auto square = [](V dx, V dy, V dz) { return fma(dx, dx, fma(dy, dy, dz * dz)); };
        for (int k = 0; k < cell_atoms; k += 2 * V::width) {
            const int l = k + V::width;
            const V dx = cell.d(0, k), dy = cell.d(1, k), dz = cell.d(2, k);
            const V ex = cell.d(0, l), ey = cell.d(1, l), ez = cell.d(2, l);
            const V r2 = square(dx, dy, dz), s2 = square(ex, ey, ez);
            V t, s;
            pair.template begin<close>(r2, s2, t, s);
            add(pair, dx, dy, dz, r2, t);
            add(pair, ex, ey, ez, s2, s);
        }
    }
    /// Adds the sums of this type of atoms to those of the types before.
    template <class P>
    ASPERITY_INLINE void finish(const PairTerms<Simd, double, P>& pair, bool first, int to,
                                SiteTerms& terms) const {
        const double scale = pair.force_scale;
        const auto give = [&](double* sum, double mine) {
            sum[to] = first ? mine : sum[to] + mine;
        };
        give(terms.x, scale * total(x));
        give(terms.y, scale * total(y));
        give(terms.z, scale * total(z));
        if constexpr (observe) {
            give(terms.energy, pair.energy_scale * total(energy));
            double least = nearest[0];
            for (int i = 1; i < V::width; ++i)
                least = nearest[i] < least ? nearest[i] : least;
            const double r2 = pair.nearest(least);
            if (first || r2 < terms.nearest[to]) terms.nearest[to] = r2;
            terms.in_contact |= unsigned{r2 < pair.contact_r2} << to;
        }
    }
};

/// Sums the cells of one type, images [next, end), over a block of sites.
template <bool observe, bool close, class P>
ASPERITY_INLINE void sum_type(const InterfaceSites& sites, const CellSubstrate& atoms,
                              const PairTerms<Simd, double, P>& pair, std::int64_t next,
                              std::int64_t end, bool first, const BlockOfSites& site, int x, int y,
                              int count, SiteTerms& terms) {
    const double a = sites.spacing, reach = pair.cutoff;
    const double at_x = (sites.x0 + x + 0.5) * a, at_y = (sites.y0 + y + 0.5) * a;
    const Place least = {at_x - site.sideways, at_y - site.sideways, site.lowest_z, 0.0};
    const Place greatest = {at_x + (count - 1) * a + site.sideways, at_y + site.sideways,
                            site.highest_z, 0.0};
    NearCells near(least, greatest);
    BlockSums sums;
    bool begun = false;
    do {
        next = near.gather(atoms, next, end, reach);
        for (int i = 0; i < count; ++i) {
            const double at[3] = {(sites.x0 + x + i + 0.5) * a + site.ux[i], at_y + site.uy[i],
                                  site.z[i]};
            const CellsInReach cells(near, at, reach);
            CellSums<observe> sum = begun ? CellSums<observe>(sums, i) : CellSums<observe>(pair);
            for (int k = 0; k < cells.count; ++k)
                sum.template add_cell<close>(pair, {atoms, cells, k});
            if (next < end)
                sum.store(sums, i);
            else
                sum.finish(pair, first, i, terms);
        }
        begun = true;
    } while (next < end);
}

template <bool observe>
void cell_sweep(const InterfaceSites& sites, const CellSubstrate& atoms, const PairTable& pairs,
                int row_begin, int row_end, InterfaceSums& sums) {
    sweep_blocks<observe>(
        sites, atoms, pairs, pairs, row_begin, row_end, {}, sums,
        [&](const BlockOfSites& site, const auto& reach, int x, int y, int count, SiteTerms& terms)
            __attribute__((always_inline)) {
                const std::ptrdiff_t block =
                    static_cast<std::ptrdiff_t>(y) * atoms.blocks + x / interface_block;
                for (int type = 0; type < pairs.types; ++type) {
                    const std::int64_t* list = atoms.first + block * pairs.types + type;
                    std::visit(
                        [&]<class P>(const P& p) {
                            const PairTerms<Simd, double, P> pair(p);
                            if (reach.close)
                                sum_type<observe, true>(sites, atoms, pair, list[0], list[1],
                                                        type == 0, site, x, y, count, terms);
                            else
                                sum_type<observe, false>(sites, atoms, pair, list[0], list[1],
                                                         type == 0, site, x, y, count, terms);
                        },
                        pairs.of[type]);
                }
            });
}

} // namespace

extern const InterfaceKernels::Sweeps<CellSubstrate, PairTable> cell_sweeps;
const InterfaceKernels::Sweeps<CellSubstrate, PairTable> cell_sweeps = {
    {cell_sweep<false>, cell_sweep<true>}};

} // namespace asperity::ASPERITY_VARIANT
