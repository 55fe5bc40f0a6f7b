// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The sweep over the rows of a substrate of any spacing (interface_row.hpp) on SIMD registers;
// compiled once for each x86-64 level (variant.hpp). Chords are tabulated for a block of sites,
// distances to rows for a site.
#include "kernels/interface_block.hpp"
#include "kernels/interface_row.hpp"

namespace asperity::ASPERITY_VARIANT {

namespace {

/// j b in units of length for rows j from -max_rows on, and behind them room for a register.
template <class T>
struct RowTable {
    static constexpr int size = 2 * max_rows + 16;
    alignas(64) T at[size];
    template <class P>
    explicit RowTable(const AtomRows<Simd, T, P>& rows) {
        for (int j = 0; j < size; ++j)
            at[j] = rows.row_offset(j - max_rows);
    }
};

template <class T, class P>
struct ChordsOfBlock {
    const RowTable<T>& table;
    int first, end;
    double longest = 0.0;

    ASPERITY_INLINE ChordsOfBlock(const AtomRows<Simd, T, P>& rows, const RowTable<T>& of,
                                  double reach)
        : table(of), first(rows.first_register(reach)), end(rows.end_of_registers(reach)) {
        end = end - first < most ? end : first + most;
        for (int k = first; k < end; ++k) {
            half_[k - first] = rows.half_chord(k, reach);
            longest = half(k) > longest ? half(k) : longest;
        }
    }
    ASPERITY_INLINE double half(int k) const { return half_[k - first]; }

private:
    static constexpr int most = 2 * max_rows / Pack<T>::width + 2;
    double half_[most];
};

template <class T, class P>
struct AsideOfRegister {
    using V = Pack<T>;
    ASPERITY_INLINE AsideOfRegister(const AtomRows<Simd, T, P>& rows, double y_there,
                                    const ChordsOfBlock<T, P>& chords) {
        const V y(static_cast<T>(y_there * (1.0 / length_unit<T>)));
        const int end = 2 * rows.last_couple(y_there, chords.longest) + 2 + max_rows;
        for (int j = 2 * rows.first_couple(y_there, chords.longest) + max_rows; j < end;
             j += V::width) {
            const V d = y - V::load(chords.table.at + j);
            d.store(dy_ + j);
            (d * d).store(dy2_ + j);
        }
    }
    ASPERITY_INLINE V dy(int j) const { return V(dy_[j + max_rows]); }
    ASPERITY_INLINE V dy2(int j) const { return V(dy2_[j + max_rows]); }

private:
    alignas(64) T dy_[RowTable<T>::size], dy2_[RowTable<T>::size];
};

template <class T, bool observe, class P>
void sweep_with(const AtomRows<Simd, T, P>& rows, const InterfaceSites& sites,
                const RowSubstrate& atoms, const PairPotential& potential, int row_begin,
                int row_end, InterfaceSums& sums) {
    const RowTable<T> table(rows);
    const double a = sites.spacing;
    sweep_blocks<T, observe>(
        sites, atoms, potential, rows.pair, row_begin, row_end, sums,
        [&](const BlockOfSites& site, const Reach& reach, int x, int y, int count, SiteTerms& terms)
            __attribute__((always_inline)) {
                const ChordsOfBlock<T, P> chords(rows, table, reach.from_site);
                for (int i = 0; i < count; ++i) {
                    const double at_x = (sites.x0 + x + i + 0.5) * a + site.ux[i];
                    const double at_y = (sites.y0 + y + 0.5) * a + site.uy[i];
                    const SiteTotal total =
                        reach.close ? rows.template sum<observe, true, AsideOfRegister<T, P>>(
                                          at_x, at_y, site.z[i], chords)
                                    : rows.template sum<observe, false, AsideOfRegister<T, P>>(
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

template <class T, bool observe>
void row_sweep(const InterfaceSites& sites, const RowSubstrate& atoms,
               const PairPotential& potential, int row_begin, int row_end, InterfaceSums& sums) {
    std::visit(
        [&]<class P>(const P& p) {
            sweep_with<T, observe>(AtomRows<Simd, T, P>(atoms, p), sites, atoms, potential,
                                   row_begin, row_end, sums);
        },
        potential);
}

} // namespace

extern const InterfaceKernels::Sweeps<RowSubstrate> row_sweeps;
const InterfaceKernels::Sweeps<RowSubstrate> row_sweeps = {
    {{row_sweep<double, false>, row_sweep<double, true>},
     {row_sweep<float, false>, row_sweep<float, true>}}};

} // namespace asperity::ASPERITY_VARIANT
