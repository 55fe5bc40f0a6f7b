// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "kernels/elastic_column.hpp"
#include "kernels/kick.hpp"
#include "kernels/pack_step.hpp"

namespace asperity::ASPERITY_VARIANT {

namespace {

using V = Pack<double>;
using PackVector = Triple<V>;

constexpr int cache_line = 64 / sizeof(double);

/// True if a register holds a whole line of the cache: each load that does not begin at one would
/// take two, and there are registers enough to shift the lanes of packs instead.
constexpr bool by_shifts = V::width == cache_line;

/// The parts (column_parts) of the columns of a stretch of a row, in the first-level cache: of each
/// component a row of numbers for the nodes west of the columns, at them and east of them.
class RowParts {
public:
    static constexpr int stretch = 64;

    /// Place i of each row.
    class Place {
    public:
        ASPERITY_INLINE explicit Place(double* p) : p_(p) {}
        ASPERITY_INLINE void take_here(int k, V part) { part.store(row(k, 1)); }
        ASPERITY_INLINE void take_beside(int k, V to_west, V to_east) {
            to_west.store(row(k, 0));
            to_east.store(row(k, 2));
        }
        ASPERITY_INLINE V to_west(int k) const { return V::load(row(k, 0)); }
        ASPERITY_INLINE V here(int k) const { return V::load(row(k, 1)); }
        ASPERITY_INLINE V to_east(int k) const { return V::load(row(k, 2)); }
        ASPERITY_INLINE Place operator+(int i) const { return Place(p_ + i); }
        ASPERITY_INLINE void copy(const Place& other) {
            for (int i = 0; i < 9; ++i)
                V::load(other.p_ + i * length).store(p_ + i * length);
        }

    private:
        ASPERITY_INLINE double* row(int k, int side) const { return p_ + (3 * k + side) * length; }
        double* p_;
    };
    /// i: from -margin to stretch + margin - 1.
    ASPERITY_INLINE Place operator[](int i) { return Place(part_ + margin + i); }

private:
    static constexpr int margin = cache_line, length = stretch + 2 * margin;
    static_assert(margin >= V::width && stretch % margin == 0);
    alignas(64) double part_[9 * length];
};

/// The forces on the nodes at successive places, pack by pack: what the columns east and west of
/// them give, and their own.
class Forces {
public:
    ASPERITY_INLINE explicit Forces(const RowParts::Place& first) : at_(first) {
        if constexpr (!by_shifts) return;
        for (int k = 0; k < 3; ++k) {
            west_[k] = at_.to_west(k);
            east_before_[k] = (at_ + -V::width).to_east(k);
        }
    }
    ASPERITY_INLINE PackVector next() {
        const PackVector force = {component(0), component(1), component(2)};
        at_ = at_ + V::width;
        return force;
    }

private:
    ASPERITY_INLINE V component(int k) {
        if constexpr (!by_shifts)
            return ((at_ + 1).to_west(k) + (at_ + -1).to_east(k)) + at_.here(k);
        const V west_behind = (at_ + V::width).to_west(k), east = at_.to_east(k);
        const V beside = shift_left(west_[k], west_behind) + shift_right(east_before_[k], east);
        west_[k] = west_behind;
        east_before_[k] = east;
        return beside + at_.here(k);
    }
    RowParts::Place at_;
    V west_[3], east_before_[3];
};

/// Prefetches what is needed a row or two later into the second-level cache; further ahead, and it
/// is gone again before it is used.
class Prefetch {
public:
    static constexpr int distance = by_shifts ? 1 : 2;
    /// The fewer loads and stores a pack takes, the more of them wait for the memory at a time.
    static constexpr bool parts_in_registers = by_shifts;

    /// Prepares the prefetch. row: beginning of the row whose nodes will be kicked; lowest: the row
    /// is in a band's lowest plane. Displacements beside the row are prefetched in this plane only,
    /// because for other planes the plane below has read them.
    ASPERITY_INLINE Prefetch(const VectorVolume<const double>& u, const VectorVolume<double>& v,
                             std::ptrdiff_t row, bool lowest)
        : ux_(u.x.origin), uy_(u.y.origin), uz_(u.z.origin), vx_(v.x.origin), vy_(v.y.origin),
          vz_(v.z.origin), row_(row), beside_(row + u.x.row), above_(beside_ + u.x.plane),
          lowest_(lowest) {}

    ASPERITY_INLINE void operator()(int x) const {
        lines(ux_, uy_, uz_, above_ + x);
        lines(vx_, vy_, vz_, row_ + x);
        if (lowest_) [[unlikely]]
            lines(ux_, uy_, uz_, beside_ + x);
    }

private:
    ASPERITY_INLINE static void lines(const double* a, const double* b, const double* c,
                                      std::ptrdiff_t at) {
#if defined(__x86_64__)
        asm("" : "+r"(at)); // one pointer instead of one for each
#endif
        __builtin_prefetch(a + at, 0, 2);
        __builtin_prefetch(b + at, 0, 2);
        __builtin_prefetch(c + at, 0, 2);
    }

    const double *ux_, *uy_, *uz_, *vx_, *vy_, *vz_;
    std::ptrdiff_t row_, beside_, above_;
    bool lowest_;
};
struct NoPrefetch {
    static constexpr bool parts_in_registers = false;
    NoPrefetch() = default;
    ASPERITY_INLINE NoPrefetch(const VectorVolume<const double>&, const VectorVolume<double>&,
                               std::ptrdiff_t, bool) {}
    ASPERITY_INLINE void operator()(int) const {}
};
/// Nodes of a level, of 48 bytes each, up to which it stays in the caches: prefetching would cost 4
/// to 8 % of its time.
constexpr std::ptrdiff_t nodes_in_cache = 170000;

/// Sweeps a row like sweep_row(), for an x0 at which a pack begins: the parts of the packs of
/// columns before, at and behind a node's stay in registers, as far as these reach.
template <Face face, class Fetch, class Use>
ASPERITY_INLINE void sweep_in_registers(const VectorVolume<const double>& u, std::ptrdiff_t line,
                                        int x0, int x1, const Weights<V, face>& weights,
                                        const Around& around, const Fetch& fetch, const Use& use) {
    const auto columns = [&](int x) __attribute__((always_inline)) {
        ColumnParts<V> parts;
        column_parts(u.x.origin + line + x, u.y.origin + line + x, u.z.origin + line + x, around,
                     weights, parts);
        return parts;
    };
    ColumnParts<V> before = columns(x0 - V::width), here = columns(x0);
    for (int x = x0; x < x1; x += V::width) {
        const ColumnParts<V> behind = columns(x + V::width);
        const auto force = [&](int k) __attribute__((always_inline)) {
            return (shift_left(here.west[k], behind.west[k]) +
                    shift_right(before.east[k], here.east[k])) +
                   here.here[k];
        };
        fetch(x);
        use(x, x1 - x, PackVector{force(0), force(1), force(2)});
        before = here;
        here = behind;
    }
}

/// Calls use(x, count, force) for the nodes [x0, x1) of a row, pack by pack from x0 on; count: how
/// many lanes are nodes of it, where these are not all. Before each line of the cache, fetch(x).
/// A stretch at a time: first the parts of its columns, then the forces, which read them a number
/// further on or back and so keep nothing in registers meanwhile.
template <Face face, class Fetch, class Use>
ASPERITY_INLINE void sweep_row(const VectorVolume<const double>& u, std::ptrdiff_t line, int x0,
                               int x1, const Weights<V, face>& weights, const Around& around,
                               RowParts& parts, const Fetch& fetch, const Use& use) {
    if constexpr (Fetch::parts_in_registers)
        return sweep_in_registers<face>(u, line, x0, x1, weights, around, fetch, use);
    constexpr int last = V::width - 1;
    int known = (x0 - 1) & ~last; // columns before it have their parts
    for (int begin = x0; begin < x1; begin += RowParts::stretch) {
        const int end = begin + RowParts::stretch < x1 ? begin + RowParts::stretch : x1;
        const int origin = begin & ~last;
        if (begin != x0)
            for (int x = (begin - 1) & ~last; x < known; x += V::width)
                parts[x - origin].copy(parts[x - origin + RowParts::stretch]);
        const double *ux = u.x.origin + line + known, *uy = u.y.origin + line + known,
                     *uz = u.z.origin + line + known;
        for (; known <= end; known += V::width) {
#if defined(__x86_64__)
            asm("" : "+r"(ux), "+r"(uy), "+r"(uz)); // Around
#endif
            RowParts::Place place = parts[known - origin];
            column_parts(ux, uy, uz, around, weights, place);
            ux += V::width;
            uy += V::width;
            uz += V::width;
        }
        Forces forces(parts[begin - origin]);
        int x = begin;
        for (; x + cache_line <= end; x += cache_line) {
            fetch(x);
#pragma GCC unroll 8
            for (int i = 0; i < cache_line; i += V::width)
                use(x + i, V::width, forces.next());
        }
        for (; x < end; x += V::width)
            use(x, end - x, forces.next());
    }
}

template <Face face>
void force_patch(VectorVolume<const double> u, int z, const Stencil& s, Patch patch,
                 VectorPlane<double> out) {
    const Weights<V, face> weights(s);
    const Around around(u.x.row, u.x.plane);
    RowParts parts;
    for (int y = patch.y0; y < patch.y1; ++y) {
        double *const fx = out.x.line(y), *const fy = out.y.line(y), *const fz = out.z.line(y);
        sweep_row<face>(
            u, z * u.x.plane + y * u.x.row, patch.x0, patch.x1, weights, around, parts,
            NoPrefetch{},
            [&](int x, int count, const PackVector& f) __attribute__((always_inline)) {
                f.x.store_first(fx + x, count);
                f.y.store_first(fy + x, count);
                f.z.store_first(fz + x, count);
            });
    }
}

/// Next part of the work: plane z, from row y. Its first rows are prefetched meanwhile.
struct Following {
    int z, y;
};

template <Face face, bool with_transferred, bool damped, bool observed, class Fetch>
void kick_rows(VectorVolume<const double> u, int z, const Stencil& s, int y0, int y1,
               VectorPlane<const double> transferred, const Kick& plan, Following next,
               const VectorVolume<double>& v, KickSums& sums) {
    const auto place = [&](int plane, int y) { return plane * u.x.plane + y * u.x.row; };
    const Weights<V, face> weights(s);
    const Around around(u.x.row, u.x.plane);
    RowParts parts;
    Kicker<V, damped, observed> kicker(plan, v);
    for (int y = y0; y < y1; ++y) {
        const auto line = place(z, y);
        const int ahead = y + Prefetch::distance;
        const Fetch fetch = ahead < y1
                                ? Fetch(u, v, place(z, ahead), z == 0)
                                : Fetch(u, v, place(next.z, next.y + ahead - y1), next.z == 0);
        sweep_row<face>(
            u, line, 0, u.x.nx, weights, around, parts,
            fetch, [&](int x, int count, PackVector f) __attribute__((always_inline)) {
                if constexpr (with_transferred) {
                    f.x = f.x + V::load(transferred.x.line(y) + x);
                    f.y = f.y + V::load(transferred.y.line(y) + x);
                    f.z = f.z + V::load(transferred.z.line(y) + x);
                }
                kicker(line + x, count, f);
            });
        kicker.end_row();
    }
    kicker.add_to(sums);
}

template <Face face, bool with_transferred>
void kick_as(VectorVolume<const double> u, int z, const Stencil& s, int y0, int y1,
             VectorPlane<const double> transferred, const Kick& plan, Following next,
             const VectorVolume<double>& v, KickSums& sums) {
    const bool cached = u.x.nz * u.x.plane <= nodes_in_cache;
    const auto rows =
        plan.observed ? (plan.damped ? kick_rows<face, with_transferred, true, true, Prefetch>
                                     : kick_rows<face, with_transferred, false, true, Prefetch>)
        : plan.damped ? (cached ? kick_rows<face, with_transferred, true, false, NoPrefetch>
                                : kick_rows<face, with_transferred, true, false, Prefetch>)
                      : (cached ? kick_rows<face, with_transferred, false, false, NoPrefetch>
                                : kick_rows<face, with_transferred, false, false, Prefetch>);
    rows(u, z, s, y0, y1, transferred, plan, next, v, sums);
}

void forces(const ElasticLevel& level, int y0, int y1, VectorVolume<double> out) {
    const VectorVolume<const double> u = level.u;
    const int nx = u.x.nx;
    const Patch nodes = {0, nx, y0, y1};
    const VectorPlane<double> lowest = out[0];
    force_patch<Face::lower>(u, 0, level.lower, nodes, lowest);
    for (int y = y0; y < y1; ++y)
        for (int x = 0; x < nx; ++x) {
            lowest.x(x, y) += level.transferred.x(x, y);
            lowest.y(x, y) += level.transferred.y(x, y);
            lowest.z(x, y) += level.transferred.z(x, y);
        }
    for (int z = 1; z < level.cells; ++z)
        force_patch<Face::inner>(u, z, level.inner, nodes, out[z]);
    force_patch<Face::upper>(u, level.cells, level.upper, upper_patch(level, y0, y1),
                             level.upper_force);
}

void advance(const ElasticLevel& level, const LevelKicks& kicks, double dt, Band band,
             VectorVolume<double>, KickSums& sums) {
    const VectorVolume<const double> u = level.u;
    const int cells = level.cells;
    // Rows of a plane drift when the forces on the planes around it are done.
    const int from = band.begin > band.first ? band.begin - 1 : band.first + 1;
    for (int z = 0; z < cells; ++z) {
        const Following next = z + 1 < cells          ? Following{z + 1, band.begin}
                               : band.end < band.last ? Following{0, band.end}
                                                      : Following{z, band.begin};
        if (z == 0)
            kick_as<Face::lower, true>(u, z, level.lower, band.begin, band.end, level.transferred,
                                       kicks(z), next, level.v, sums);
        else
            kick_as<Face::inner, false>(u, z, level.inner, band.begin, band.end, level.transferred,
                                        kicks(z), next, level.v, sums);
        if (z > 0) drift_rows(level, z - 1, dt, from, band.end - 1);
    }
    force_patch<Face::upper>(u, cells, level.upper, upper_patch(level, band.begin, band.end),
                             level.upper_force);
    drift_rows(level, cells - 1, dt, from, band.end - 1);
}

void energy(VectorVolume<const double> u, const LevelCell& cell, int y0, int y1, ExactSum& sum) {
    cell_sum(u, y0, y1, sum,
             [&](std::ptrdiff_t at) { return cell_energy<V>(u, at, cell.elasticity); });
}

} // namespace

extern const ElasticKernels small_strain_kernels;
const ElasticKernels small_strain_kernels = {forces, advance, drift, energy, plane_sum};

} // namespace asperity::ASPERITY_VARIANT
