// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "kernels/elastic_column.hpp"
#include "kernels/kick.hpp"
#include "kernels/pack_step.hpp"

namespace asperity::ASPERITY_VARIANT {

namespace {

using V = Pack<double>;
using PackVector = Triple<V>;

/// Calls use(x, force) for the packs that cover [x0, x1) of a row; packs start at multiples of the
/// width, so lanes outside may come along.
template <Face face, class Use>
ASPERITY_INLINE void sweep_row(const VectorVolume<const double>& u, std::ptrdiff_t line, int x0,
                               int x1, const Weights<V, face>& s, const Use& use) {
    int x = x0 & ~(V::width - 1);
    // A node at x0 needs the column before it: in this pack, or in the one before.
    ColumnParts<V> before = column_parts<face>(u, line + (x == x0 ? x - V::width : x), s);
    ColumnParts<V> here = x == x0 ? column_parts<face>(u, line + x, s) : before;
    const auto join = [](const Parts<V>& w, const Parts<V>& c, const Parts<V>& e) {
        return (shift_left(c.west, e.west) + shift_right(w.east, c.east)) + c.here;
    };
    for (; x < x1; x += V::width) {
        const ColumnParts<V> behind = column_parts<face>(u, line + x + V::width, s);
        use(x, PackVector{join(before.x, here.x, behind.x), join(before.y, here.y, behind.y),
                          join(before.z, here.z, behind.z)});
        before = here;
        here = behind;
    }
}

template <Face face>
void force_patch(VectorVolume<const double> u, int z, const Stencil& s, Patch patch,
                 VectorPlane<double> out) {
    const Weights<V, face> weights(s);
    for (int y = patch.y0; y < patch.y1; ++y)
        sweep_row<face>(u, z * u.x.plane + y * u.x.row, patch.x0, patch.x1, weights,
                        [&](int x, const PackVector& f) {
                            const auto at = y * out.x.row + x;
                            f.x.store_lanes(out.x.origin + at, patch.x0 - x, patch.x1 - x);
                            f.y.store_lanes(out.y.origin + at, patch.x0 - x, patch.x1 - x);
                            f.z.store_lanes(out.z.origin + at, patch.x0 - x, patch.x1 - x);
                        });
}

/// What is worked on next: plane z, from row y. Its data are prefetched meanwhile.
struct Following {
    int z, y;
};

/// Prefetches the data of a place into the second-level cache, a line of each array at a time.
class Fetch {
public:
    ASPERITY_INLINE Fetch(const VectorVolume<const double>& u, const VectorVolume<double>& v,
                          std::ptrdiff_t from, std::ptrdiff_t to, bool lowest)
        : u_(u), v_(v), here_(to - from), above_(here_ + u.x.plane), lowest_(lowest) {}

    /// The counterpart of element `at`: its own velocity and the displacement above; those of its
    /// own plane are there already, but for the lowest plane of a band.
    ASPERITY_INLINE void operator()(std::ptrdiff_t at) const {
        constexpr int line = 64 / sizeof(double);
        if (V::width < line && at % line != 0) return;
        line_of(u_.x.origin + at + above_);
        line_of(u_.y.origin + at + above_);
        line_of(u_.z.origin + at + above_);
        line_of(v_.x.origin + at + here_);
        line_of(v_.y.origin + at + here_);
        line_of(v_.z.origin + at + here_);
        if (!lowest_) return;
        line_of(u_.x.origin + at + here_);
        line_of(u_.y.origin + at + here_);
        line_of(u_.z.origin + at + here_);
    }

private:
    ASPERITY_INLINE static void line_of(const double* p) { __builtin_prefetch(p, 0, 2); }

    VectorVolume<const double> u_;
    VectorVolume<double> v_;
    std::ptrdiff_t here_, above_;
    bool lowest_;
};

template <Face face, bool with_transferred, bool damped, bool observed>
void kick_rows(VectorVolume<const double> u, int z, const Stencil& s, int y0, int y1,
               VectorPlane<const double> transferred, const Kick& plan, Following next,
               const VectorVolume<double>& v, KickSums& sums) {
    const int nx = u.x.nx;
    const auto place = [&](int plane, int y) { return plane * u.x.plane + y * u.x.row; };
    const Fetch fetch(u, v, place(z, y0), place(next.z, next.y), next.z == 0);
    const Weights<V, face> weights(s);
    Kicker<V, damped, observed> kicker(plan, v);
    for (int y = y0; y < y1; ++y) {
        const auto line = place(z, y);
        sweep_row<face>(u, line, 0, nx, weights, [&](int x, PackVector f) {
            const auto at = line + x;
            fetch(at);
            if constexpr (with_transferred) {
                f.x = f.x + V::load(transferred.x.line(y) + x);
                f.y = f.y + V::load(transferred.y.line(y) + x);
                f.z = f.z + V::load(transferred.z.line(y) + x);
            }
            kicker(at, nx - x, f);
        });
    }
    kicker.add_to(sums);
}

template <Face face, bool with_transferred>
void kick_as(VectorVolume<const double> u, int z, const Stencil& s, int y0, int y1,
             VectorPlane<const double> transferred, const Kick& plan, Following next,
             const VectorVolume<double>& v, KickSums& sums) {
    const auto rows = plan.damped
                          ? (plan.observed ? kick_rows<face, with_transferred, true, true>
                                           : kick_rows<face, with_transferred, true, false>)
                          : (plan.observed ? kick_rows<face, with_transferred, false, true>
                                           : kick_rows<face, with_transferred, false, false>);
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
