// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "kernels/elastic_finite.hpp"

#include "kernels/elastic_finite_cell.hpp"
#include "kernels/pack_step.hpp"

#include <algorithm>

namespace asperity::ASPERITY_VARIANT {

namespace {

using V = Pack<double>;

/// Sums of the forces on one row of nodes; null if the row is another band's.
struct Row {
    double *x = nullptr, *y = nullptr, *z = nullptr;
    int x0 = 0, x1 = 0; ///< nodes wanted
};

/// Adds a pack of forces from node `at` of a row; first: nothing has been summed there yet.
template <bool first>
ASPERITY_INLINE void add(const Row& row, int at, const Triple<V>& f) {
    if (!row.x) return;
    (first ? f.x : V::load(row.x + at) + f.x).store(row.x + at);
    (first ? f.y : V::load(row.y + at) + f.y).store(row.y + at);
    (first ? f.z : V::load(row.z + at) + f.z).store(row.z + at);
}
/// Adds a pack of forces at the ends of a row, where some lanes are not wanted.
template <bool first>
[[gnu::noinline]] void add_end(const Row& row, int at, const Triple<V>& f) {
    if (!row.x) return;
    const auto lanes = [&](double* to, V value) {
        (first ? value : V::load(to) + value).store_lanes(to, row.x0 - at, row.x1 - at);
    };
    lanes(row.x + at, f.x);
    lanes(row.y + at, f.y);
    lanes(row.z + at, f.z);
}

/// The rows around a row of cells, and how far the cells go along x. A row of nodes meets as row 3
/// the first cells that give it anything.
struct RowsAround {
    Row row[4];
    int x1 = 0;
};

/// Adds to the rows of nodes around it what the row of cells whose lower corners begin at element
/// `line` gives. with_cells: everything the cells own (dilated: the dilatation too); without: the
/// springs in the plane alone.
template <bool with_cells, bool dilated>
void cell_row(const VectorVolume<const double>& u, std::ptrdiff_t line, const finite::Cell<V>& cell,
              const finite::Stiffness<V>& in_plane, const RowsAround& to) {
    constexpr int rows = with_cells ? 4 : 2;
    const V zero(0.0);
    Triple<V> before[4]; // forces of the cells one pack back on their east side
    for (Triple<V>& b : before)
        b = {zero, zero, zero};
    for (int x = -V::width; x < to.x1; x += V::width) {
        finite::Corners<V> corner, f;
        finite::load<rows>(u, line + x, corner);
        finite::forces<with_cells, dilated>(corner, cell, in_plane, f);
#pragma GCC unroll 4
        for (int r = 0; r < rows; ++r) {
            f.west[r].x = f.west[r].x + shift_right(before[r].x, f.east[r].x);
            f.west[r].y = f.west[r].y + shift_right(before[r].y, f.east[r].y);
            f.west[r].z = f.west[r].z + shift_right(before[r].z, f.east[r].z);
            before[r] = f.east[r];
        }
        if (x >= 0 && x + V::width <= u.x.nx) {
            add<false>(to.row[0], x, f.west[0]);
            add<false>(to.row[1], x, f.west[1]);
            if constexpr (with_cells) add<false>(to.row[2], x, f.west[2]);
            if constexpr (with_cells) add<true>(to.row[3], x, f.west[3]);
        } else {
            add_end<false>(to.row[0], x, f.west[0]);
            add_end<false>(to.row[1], x, f.west[1]);
            if constexpr (with_cells) add_end<false>(to.row[2], x, f.west[2]);
            if constexpr (with_cells) add_end<true>(to.row[3], x, f.west[3]);
        }
    }
}

/// Returns row y of a plane within the patch.
Row row_of(const VectorPlane<double>& force, Patch nodes, int y) {
    if (y < nodes.y0 || y >= nodes.y1) return {};
    return {force.x.line(y), force.y.line(y), force.z.line(y), nodes.x0, nodes.x1};
}

/// Computes the forces of a row of cells. dilated: with a dilatation term; at nu = 1/4 there is
/// none, and no volume to compute.
template <bool dilated>
void cell_layer(const VectorVolume<const double>& u, int z, const LevelCell& constants,
                Patch lower_nodes, const VectorPlane<double>& lower, Patch upper_nodes,
                const VectorPlane<double>& upper) {
    const finite::Cell<V> cell(constants);
    const finite::Stiffness<V>& in_plane = z == 0 ? cell.surface : cell.inside;
    const int x1 = lower_nodes.x1 > upper_nodes.x1 ? lower_nodes.x1 : upper_nodes.x1;
    const int y0 = lower_nodes.y0 < upper_nodes.y0 ? lower_nodes.y0 : upper_nodes.y0;
    const int y1 = lower_nodes.y1 > upper_nodes.y1 ? lower_nodes.y1 : upper_nodes.y1;
    for (int y = y0 - 1; y < y1; ++y)
        cell_row<true, dilated>(u, z * u.x.plane + y * u.x.row, cell, in_plane,
                                {{row_of(lower, lower_nodes, y), row_of(lower, lower_nodes, y + 1),
                                  row_of(upper, upper_nodes, y), row_of(upper, upper_nodes, y + 1)},
                                 x1});
}

void surface(VectorVolume<const double> u, int z, const LevelCell& c, Patch nodes,
             VectorPlane<double> force) {
    const finite::Cell<V> cell(c);
    for (int y = nodes.y0 - 1; y < nodes.y1; ++y)
        cell_row<false, false>(
            u, z * u.x.plane + y * u.x.row, cell, cell.surface,
            {{row_of(force, nodes, y), row_of(force, nodes, y + 1), {}, {}}, nodes.x1});
}

template <bool damped, bool observed>
void kick_rows(const VectorPlane<const double>& force, int z, int y0, int y1, const Kick& plan,
               const VectorVolume<double>& v, KickSums& sums) {
    Kicker<V, damped, observed> kicker(plan, v);
    for (int y = y0; y < y1; ++y) {
        for (int x = 0; x < v.x.nx; x += V::width)
            kicker(z * v.x.plane + y * v.x.row + x, v.x.nx - x,
                   {V::load(force.x.line(y) + x), V::load(force.y.line(y) + x),
                    V::load(force.z.line(y) + x)});
        kicker.end_row();
    }
    kicker.add_to(sums);
}

void kick(VectorPlane<const double> force, int z, int y0, int y1, const Kick& plan,
          const VectorVolume<double>& v, KickSums& sums) {
    const auto rows = plan.damped
                          ? (plan.observed ? kick_rows<true, true> : kick_rows<true, false>)
                          : (plan.observed ? kick_rows<false, true> : kick_rows<false, false>);
    rows(force, z, y0, y1, plan, v, sums);
}

/// Goes plane by plane through a band: the forces begun on the plane above are passed from one to
/// the next. place(z): place of the sums on plane z; complete(z, force): called when they are
/// complete and no other force of the band needs the displacements of plane z.
template <class Place, class Complete>
void sweep_planes(const ElasticLevel& level, int y0, int y1, const Place& place,
                  const Complete& complete) {
    const VectorVolume<const double> u = level.u;
    const int cells = level.cells, nx = u.x.nx;
    const Patch inside = {0, nx, y0, y1}, beyond = upper_patch(level, y0, y1);
    const auto layer = level.cell.elasticity.kappa != 0.0 ? cell_layer<true> : cell_layer<false>;
    VectorPlane<double> lower = place(0);
    for (int y = y0; y < y1; ++y) {
        std::copy_n(level.transferred.x.line(y), nx, lower.x.line(y));
        std::copy_n(level.transferred.y.line(y), nx, lower.y.line(y));
        std::copy_n(level.transferred.z.line(y), nx, lower.z.line(y));
    }
    for (int z = 0; z < cells; ++z) {
        const bool last = z + 1 == cells;
        const VectorPlane<double> upper = last ? level.upper_force : place(z + 1);
        layer(u, z, level.cell, inside, lower, last ? beyond : inside, upper);
        complete(z, lower);
        lower = upper;
    }
    surface(u, cells, level.cell, beyond, lower);
}

void forces(const ElasticLevel& level, int y0, int y1, VectorVolume<double> out) {
    sweep_planes(
        level, y0, y1, [&](int z) { return out[z]; }, [](int, const VectorPlane<double>&) {});
}

void advance(const ElasticLevel& level, const LevelKicks& kicks, double dt, Band band,
             VectorVolume<double> scratch, KickSums& sums) {
    const int from = band.begin > band.first ? band.begin - 1 : band.first + 1;
    const auto place = [&](int z) { // the two planes in turn
        VectorPlane<double> plane = scratch[z & 1];
        for (PlaneView<double>* component : {&plane.x, &plane.y, &plane.z})
            component->origin -= band.begin * component->row;
        return plane;
    };
    sweep_planes(level, band.begin, band.end, place, [&](int z, const VectorPlane<double>& force) {
        kick(force, z, band.begin, band.end, kicks(z), level.v, sums);
        drift_rows(level, z, dt, from, band.end - 1);
    });
}

void energy(VectorVolume<const double> u, const LevelCell& cell, int y0, int y1, ExactSum& sum) {
    const finite::Cell<V> terms(cell);
    cell_sum(u, y0, y1, sum, [&](std::ptrdiff_t at) { return finite::energy(u, at, terms, cell); });
}

} // namespace

extern const ElasticKernels finite_strain_kernels;
const ElasticKernels finite_strain_kernels = {forces, advance, drift, energy, plane_sum};

} // namespace asperity::ASPERITY_VARIANT
