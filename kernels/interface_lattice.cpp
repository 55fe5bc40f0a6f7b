// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The lattice sweep (interface_site.hpp) on SIMD registers, in double and in mixed precision;
// compiled once for each x86-64 level (variant.hpp).
#include "kernels/interface_block.hpp"

namespace asperity::ASPERITY_VARIANT {

/// Heights in single precision: the difference of two heights in fixed_quantum is exact.
template <>
struct SiteHeight<Simd, float> {
    using Atom = std::int32_t;
    using V = Pack<float>;
    PackInt32 z;
    ASPERITY_INLINE explicit SiteHeight(const double* from) {
        alignas(64) std::int32_t fixed[V::width];
        for (int i = 0; i < V::width; ++i)
            fixed[i] = to_fixed(from[i]);
        z = PackInt32::load(fixed);
    }
    ASPERITY_INLINE V above(const std::int32_t* atoms) const {
        return to_float(z - PackInt32::load(atoms));
    }

private:
    ASPERITY_INLINE static std::int32_t to_fixed(double z) {
        constexpr double round_to_integer = 0x1.8p52;
        return static_cast<std::int32_t>((z * (1.0 / fixed_quantum) + round_to_integer) -
                                         round_to_integer);
    }
};

/// Two quads do not fit into the sixteen registers of AVX2. Where energies are asked for, or a
/// potential takes long to begin, keeping some of them in memory is the lesser evil.
template <>
inline constexpr bool one_by_one<Simd, LennardJones, false> = register_bytes == 32;

namespace {

ASPERITY_INLINE PlaneView<const double> heights_in(double, const LatticeSubstrate& s) {
    return s.heights.height;
}
ASPERITY_INLINE PlaneView<const std::int32_t> heights_in(float, const LatticeSubstrate& s) {
    return s.fixed;
}

/// Writes a pack as doubles.
ASPERITY_INLINE void store_wide(Pack<double> a, double* to) { a.store(to); }
ASPERITY_INLINE void store_wide(Pack<float> a, double* to) {
    widen_low(a).store(to);
    widen_high(a).store(to + Real::width);
}

/// Sums one register of sites, `lane` sites into the block.
template <class T, bool observe, bool close, class P>
ASPERITY_INLINE void sum_register(const BlockOfSites& site, int lane, Columns all, Columns within,
                                  const typename SiteHeight<Simd, T>::Atom* here,
                                  std::ptrdiff_t row, int half_offsets, const Offsets<T>& offsets,
                                  const PairTerms<Simd, T, P>& pair, SiteTerms& terms) {
    constexpr int width = Pack<T>::width;
    const auto sums = sum_lattice<Simd, T, observe, close>(
        SiteHeight<Simd, T>(site.z + lane), lengths<Simd, T>(site.ux + lane),
        lengths<Simd, T>(site.uy + lane), all, within, here, row, half_offsets, offsets, pair);
    alignas(64) double f[width], f_cx[width], f_cy[width], f_z[width], energy[width];
    store_wide(sums.f, f);
    store_wide(sums.f_cx, f_cx);
    store_wide(sums.f_cy, f_cy);
    store_wide(sums.f_z, f_z);
    for (int i = 0; i < width; ++i) {
        const SiteForce force =
            site_force(pair, site.ux[lane + i], site.uy[lane + i], f[i], f_cx[i], f_cy[i], f_z[i]);
        terms.x[lane + i] = force.x;
        terms.y[lane + i] = force.y;
        terms.z[lane + i] = force.z;
    }
    if constexpr (observe) {
        store_wide(sums.energy, energy);
        for (int i = 0; i < width; ++i) {
            terms.energy[lane + i] = pair.energy_scale * energy[i];
            terms.nearest[lane + i] = pair.nearest(sums.nearest[i]);
        }
    }
}

/// Sums one register of sites of which a pair may be closer than the potential holds, as in solids
/// that overlap at a start. It is rare, and compiled apart to be small: the file compiles in three
/// quarters of the time.
template <class T, bool observe, class P>
[[gnu::noinline, gnu::cold]] void
sum_close_register(const BlockOfSites& site, int lane, Columns all, Columns within,
                   const typename SiteHeight<Simd, T>::Atom* here, std::ptrdiff_t row,
                   int half_offsets, const Offsets<T>& offsets, const PairTerms<Simd, T, P>& pair,
                   SiteTerms& terms) {
    sum_register<T, observe, true>(site, lane, all, within, here, row, half_offsets, offsets, pair,
                                   terms);
}

template <class T, bool observe, class P>
void sweep_with(const PairTerms<Simd, T, P>& pair, const InterfaceSites& sites,
                const LatticeSubstrate& atoms, const PairPotential& potential, int row_begin,
                int row_end, InterfaceSums& sums) {
    const Offsets<T> offset(sites.spacing, atoms.half_offsets);
    const auto heights = heights_in(T(), atoms);
    // No atom of a lattice is laterally nearer to a hollow site than this.
    const double hollow = std::sqrt(0.5) * sites.spacing;
    // Atoms deeper than the fixed depth are not where the fixed heights have them.
    const HeightRange range = std::is_same_v<T, float>
                                  ? HeightRange{pair.cutoff - fixed_depth, fixed_depth}
                                  : HeightRange{};
    sweep_blocks<observe>(
        sites, atoms, potential, pair, row_begin, row_end, range, sums,
        [&](const BlockOfSites& site, const Reach& reach, int x, int y, int count,
            SiteTerms& terms) __attribute__((always_inline)) {
            // The reach is rounded up to the table's steps, the inside down.
            const Columns all(atoms, static_cast<int>(reach.from_rest * atoms.cuts_per_length) + 1);
            const Columns within(atoms, static_cast<int>(reach.inside * atoms.cuts_per_length));
            const bool close = reach.close && hollow - site.sideways < pair.closest;
            for (int lane = 0; lane < count; lane += Pack<T>::width) {
                const auto* here = heights.line(y) + x + lane;
                if (close)
                    sum_close_register<T, observe>(site, lane, all, within, here, heights.row,
                                                   atoms.half_offsets, offset, pair, terms);
                else
                    sum_register<T, observe, false>(site, lane, all, within, here, heights.row,
                                                    atoms.half_offsets, offset, pair, terms);
            }
        });
}

/// Sweeps rows of sites. mixed: pairs in single precision; those of a table are in double all the
/// same.
template <bool mixed, bool observe>
void lattice_sweep(const InterfaceSites& sites, const LatticeSubstrate& atoms,
                   const PairPotential& potential, int row_begin, int row_end,
                   InterfaceSums& sums) {
    std::visit(
        [&]<class P>(const P& p) {
            using T = std::conditional_t<mixed && !std::is_same_v<P, Tabulated>, float, double>;
            sweep_with<T, observe>(PairTerms<Simd, T, P>(p), sites, atoms, potential, row_begin,
                                   row_end, sums);
        },
        potential);
}

} // namespace

extern const InterfaceKernels::LatticeSweeps lattice_sweeps;
const InterfaceKernels::LatticeSweeps lattice_sweeps = {
    {lattice_sweep<false, false>, lattice_sweep<false, true>},
    {lattice_sweep<true, false>, lattice_sweep<true, true>}};

} // namespace asperity::ASPERITY_VARIANT
