// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The sweep over substrate atoms anywhere, in cells of sixteen; compiled once for each x86-64 level
// (variant.hpp).
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

namespace asperity::ASPERITY_VARIANT {

template <>
struct Ground<CellSubstrate> {
    const CellSubstrate& from;
    double datum() const { return from.datum; }
    double margin() const { return from.offset_margin; }
    const SubstrateAtoms& judge() const { return from.atoms; }
    struct Some {
        double from_rest; ///< negative: nothing is in reach
    };
    template <class T>
    ASPERITY_INLINE Some reach(int x, int y, const BlockOfSites& site,
                               const PairTerms<Simd, T>& pair) const {
        const double highest =
            from.highest[static_cast<std::ptrdiff_t>(y) * from.blocks + x / interface_block];
        return {pair.cutoff - (site.lowest_z - highest)};
    }
};

namespace {

/// Fixed-point and single-precision distances differ from those of the bounds by less, Å.
constexpr double cell_slack = 1e-5;

/// Cells near a block of sites.
struct NearCells {
    static constexpr int most = 64;
    int count = 0;
    alignas(64) double low_x[most], high_x[most], low_y[most], high_y[most], low_z[most],
        high_z[most];
    double shift_x[most], shift_y[most]; ///< of the image, Å
    std::int32_t cell[most];

    /// Images [from, to) within `reach` of the block, as many as there is room for; where to go on.
    ASPERITY_INLINE std::int64_t gather(const CellSubstrate& atoms, std::int64_t from,
                                        std::int64_t to, double left, double right, double y,
                                        const BlockOfSites& site, double reach) {
        const double aside = site.sideways, edge = atoms.atoms.edge;
        count = 0;
        for (; from < to && count < most; ++from) {
            const CellImage image = atoms.images[from];
            const double* bound = atoms.bounds + image.cell;
            const auto n = static_cast<std::ptrdiff_t>(atoms.cells);
            const int k = count;
            shift_x[k] = image.x * edge;
            shift_y[k] = image.y * edge;
            low_x[k] = bound[0] + shift_x[k];
            high_x[k] = bound[n] + shift_x[k];
            low_y[k] = bound[2 * n] + shift_y[k];
            high_y[k] = bound[3 * n] + shift_y[k];
            low_z[k] = bound[4 * n];
            high_z[k] = bound[5 * n];
            cell[k] = image.cell;
            const auto gap = [](double a, double b) {
                return a > b ? (a > 0.0 ? a : 0.0) : (b > 0.0 ? b : 0.0);
            };
            const double dx = gap(low_x[k] - right - aside, left - aside - high_x[k]);
            const double dy = gap(low_y[k] - y - aside, y - aside - high_y[k]);
            const double dz = gap(low_z[k] - site.highest_z, site.lowest_z - high_z[k]);
            count += dx * dx + dy * dy + dz * dz < reach * reach;
        }
        for (int k = count; k < most && k % Real::width; ++k)
            low_x[k] = high_x[k] = low_y[k] = high_y[k] = low_z[k] = high_z[k] = 1e30;
        return from;
    }

    /// Bits of those within `reach` of a point.
    ASPERITY_INLINE std::uint64_t within(double x, double y, double z, double reach) const {
        const Real px(x), py(y), pz(z), zero(0.0), reach2(reach * reach);
        std::uint64_t bits = 0;
        for (int k = 0; k < count; k += Real::width) {
            const auto gap = [&](const double* low, const double* high, Real p) {
                return max(max(Real::load(low + k) - p, p - Real::load(high + k)), zero);
            };
            const Real dx = gap(low_x, high_x, px), dy = gap(low_y, high_y, py),
                       dz = gap(low_z, high_z, pz);
            bits |= static_cast<std::uint64_t>(
                        bits_where_less(fma(dx, dx, fma(dy, dy, dz * dz)), reach2))
                    << k;
        }
        return bits;
    }
};

/// The atoms of a cell as a site sees them, in units of length.
template <class T>
struct CellView;
template <>
struct CellView<double> {
    const double *x, *y, *z;
    Real at_x, at_y, at_z;
    ASPERITY_INLINE CellView(const CellSubstrate& atoms, std::int64_t cell, double px, double py,
                             double pz)
        : x(atoms.x + cell * cell_atoms), y(atoms.y + cell * cell_atoms),
          z(atoms.z + cell * cell_atoms), at_x(px), at_y(py), at_z(pz) {}
    ASPERITY_INLINE Real dx(int k) const { return at_x - Real::load(x + k); }
    ASPERITY_INLINE Real dy(int k) const { return at_y - Real::load(y + k); }
    ASPERITY_INLINE Real dz(int k) const { return at_z - Real::load(z + k); }
};
template <>
struct CellView<float> {
    using V = Pack<float>;
    const std::int32_t *x, *y, *z;
    SiteHeight<Simd, float> at_x, at_y, at_z; // differences of fixed-point numbers
    ASPERITY_INLINE CellView(const CellSubstrate& atoms, std::int64_t cell, double px, double py,
                             double pz)
        : x(atoms.fixed_x + cell * cell_atoms), y(atoms.fixed_y + cell * cell_atoms),
          z(atoms.fixed_z + cell * cell_atoms), at_x(px - centre(atoms, 0, cell)),
          at_y(py - centre(atoms, 2, cell)), at_z(pz - centre(atoms, 4, cell)) {}
    ASPERITY_INLINE V dx(int k) const { return at_x.above(x + k); }
    ASPERITY_INLINE V dy(int k) const { return at_y.above(y + k); }
    ASPERITY_INLINE V dz(int k) const { return at_z.above(z + k); }

private:
    ASPERITY_INLINE static double centre(const CellSubstrate& atoms, int bound, std::int64_t cell) {
        const double* low = atoms.bounds + bound * atoms.cells + cell;
        return 0.5 * (low[0] + low[atoms.cells]);
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
            const V dx = cell.dx(0), dy = cell.dy(0), dz = cell.dz(0), r2 = square(dx, dy, dz);
            add(pair, dx, dy, dz, r2, pair.template inverse<true>(r2));
        } else {
            for (int k = 0; k < cell_atoms; k += 2 * V::width) {
                const int l = k + V::width;
                const V dx = cell.dx(k), dy = cell.dy(k), dz = cell.dz(k), r2 = square(dx, dy, dz);
                const V ex = cell.dx(l), ey = cell.dy(l), ez = cell.dz(l), s2 = square(ex, ey, ez);
                V t, s;
                pair.template inverse<true>(r2, s2, t, s);
                add(pair, dx, dy, dz, r2, t);
                add(pair, ex, ey, ez, s2, s);
            }
        }
    }
    ASPERITY_INLINE void finish(const PairTerms<Simd, T>& pair, int to, SiteTerms& terms) const {
        const auto over_lanes = [](V lanes) {
            WideSum<T> sum;
            sum.add(lanes);
            return sum.over_lanes();
        };
        const double scale = pair.force_scale * length_unit<T>;
        terms.x[to] = scale * over_lanes(x);
        terms.y[to] = scale * over_lanes(y);
        terms.z[to] = scale * over_lanes(z);
        if constexpr (observe) {
            terms.energy[to] = pair.energy_scale * over_lanes(energy);
            T least = nearest[0];
            for (int i = 1; i < V::width; ++i)
                least = nearest[i] < least ? nearest[i] : least;
            terms.nearest[to] = pair.nearest(least);
        }
    }
};

template <class T, bool observe>
void cell_sweep(const InterfaceSites& sites, const CellSubstrate& atoms, const LennardJones& lj,
                int row_begin, int row_end, InterfaceSums& sums) {
    const PairTerms<Simd, T> pair(lj);
    const double a = sites.spacing, reach = pair.cutoff + cell_slack;
    sweep_blocks<T, observe>(
        sites, atoms, lj, pair, row_begin, row_end, sums,
        [&](const BlockOfSites& site, const auto&, int x, int y, int count, SiteTerms& terms)
            __attribute__((always_inline)) {
                const std::ptrdiff_t block =
                    static_cast<std::ptrdiff_t>(y) * atoms.blocks + x / interface_block;
                const double left = (sites.x0 + x + 0.5) * a;
                const double right = (sites.x0 + x + count - 1 + 0.5) * a;
                const double at_y = (sites.y0 + y + 0.5) * a;
                CellSums<T, observe> sum[interface_block];
                for (int i = 0; i < count; ++i)
                    sum[i].clear(pair);
                NearCells near;
                std::int64_t next = atoms.first[block];
                const std::int64_t end = atoms.first[block + 1];
                while (next < end) {
                    next = near.gather(atoms, next, end, left, right, at_y, site, reach);
                    for (int i = 0; i < count; ++i) {
                        const double px = (sites.x0 + x + i + 0.5) * a + site.ux[i];
                        const double py = at_y + site.uy[i], pz = site.z[i];
                        std::uint64_t bits = near.within(px, py, pz, reach);
                        CellSums<T, observe> mine = sum[i];
                        for (; bits; bits &= bits - 1) {
                            const int k = __builtin_ctzll(bits);
                            mine.add_cell(pair, {atoms, near.cell[k], px - near.shift_x[k],
                                                 py - near.shift_y[k], pz});
                        }
                        sum[i] = mine;
                    }
                }
                for (int i = 0; i < count; ++i)
                    sum[i].finish(pair, i, terms);
            });
}

} // namespace

extern const InterfaceKernels::Sweeps<CellSubstrate> cell_sweeps;
const InterfaceKernels::Sweeps<CellSubstrate> cell_sweeps = {
    {cell_sweep<double, false>, cell_sweep<double, true>},
    {cell_sweep<float, false>, cell_sweep<float, true>}};

} // namespace asperity::ASPERITY_VARIANT
