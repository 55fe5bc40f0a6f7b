// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "kernels/elastic_finite.hpp"

#include "kernels/cell_geometry.hpp"
#include "kernels/kick.hpp"
#include "kernels/pack_step.hpp"

#include <algorithm>
#include <numbers>

namespace asperity::ASPERITY_VARIANT {

namespace {

using V = Pack<double>;
using PackVector = Triple<V>;

ASPERITY_INLINE PackVector operator+(const PackVector& a, const PackVector& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
ASPERITY_INLINE PackVector operator-(const PackVector& a, const PackVector& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
ASPERITY_INLINE V squared(const PackVector& a) { return fma(a.x, a.x, fma(a.y, a.y, a.z * a.z)); }

ASPERITY_INLINE PackVector load(const VectorVolume<const double>& u, std::ptrdiff_t at) {
    return {V::load(u.x.origin + at), V::load(u.y.origin + at), V::load(u.z.origin + at)};
}

/// A spring's constant k and k r0.
struct Stiffness {
    V k, k_edge, k_diagonal;
    Stiffness(double constant, double edge)
        : k(constant), k_edge(constant * edge), k_diagonal(constant * edge * std::numbers::sqrt2) {}
};

/// t r, the pull on the spring's first end: t = k - k r0 / |r|.
ASPERITY_INLINE PackVector pull(const PackVector& r, V k, V k_rest) {
    const V t = fma(-k_rest, inverse_sqrt(squared(r)), k);
    return {t * r.x, t * r.y, t * r.z};
}

/// The eight corners of a pack of cells: x and x + 1 (west, east) of four rows, numbered
/// y + 2 z.
struct Corners {
    PackVector west[4], east[4];
};

struct Cell {
    V edge, inverse_4_edge, pressure; ///< s; 1/(4s); 4 s kappa
    Stiffness inside, surface;        ///< springs shared by all their cells, and by half of them

    explicit Cell(const LevelCell& c)
        : edge(c.edge), inverse_4_edge(0.25 / c.edge), pressure(4.0 * c.edge * c.elasticity.kappa),
          inside(c.elasticity.k, c.edge), surface(0.5 * c.elasticity.k, c.edge) {}
};

/// The four springs that a cell owns in the plane through its lower corners.
ASPERITY_INLINE void pull_in_plane(const Corners& u, const Cell& c, const Stiffness& k,
                                   Corners& f) {
    const V s = c.edge;
    PackVector r = u.east[0] - u.west[0]; // along x
    r.x = r.x + s;
    const PackVector along_x = pull(r, k.k, k.k_edge);
    r = u.west[1] - u.west[0]; // along y
    r.y = r.y + s;
    const PackVector along_y = pull(r, k.k, k.k_edge);
    r = u.east[1] - u.west[0];
    r.x = r.x + s, r.y = r.y + s;
    const PackVector diagonal = pull(r, k.k, k.k_diagonal);
    r = u.west[1] - u.east[0];
    r.x = r.x - s, r.y = r.y + s;
    const PackVector across = pull(r, k.k, k.k_diagonal);
    f.west[0] = along_x + along_y + diagonal;
    f.east[0] = across - along_x;
    f.west[1] = PackVector{-across.x, -across.y, -across.z} - along_y;
    f.east[1] = {-diagonal.x, -diagonal.y, -diagonal.z};
}

/// The five springs that a cell owns and that lead to the plane above.
ASPERITY_INLINE void pull_upwards(const Corners& u, const Cell& c, Corners& f) {
    const V s = c.edge;
    const Stiffness& k = c.inside;
    PackVector r = u.west[2] - u.west[0]; // along z
    r.z = r.z + s;
    const PackVector along_z = pull(r, k.k, k.k_edge);
    r = u.east[2] - u.west[0]; // in the face across y
    r.x = r.x + s, r.z = r.z + s;
    const PackVector diagonal_x = pull(r, k.k, k.k_diagonal);
    r = u.west[2] - u.east[0];
    r.x = r.x - s, r.z = r.z + s;
    const PackVector across_x = pull(r, k.k, k.k_diagonal);
    r = u.west[3] - u.west[0]; // in the face across x
    r.y = r.y + s, r.z = r.z + s;
    const PackVector diagonal_y = pull(r, k.k, k.k_diagonal);
    r = u.west[2] - u.west[1];
    r.y = r.y - s, r.z = r.z + s;
    const PackVector across_y = pull(r, k.k, k.k_diagonal);
    f.west[0] = f.west[0] + (along_z + diagonal_x + diagonal_y);
    f.east[0] = f.east[0] + across_x;
    f.west[1] = f.west[1] + across_y;
    const PackVector down = along_z + across_x + across_y;
    f.west[2] = {-down.x, -down.y, -down.z};
    f.east[2] = {-diagonal_x.x, -diagonal_x.y, -diagonal_x.z};
    f.west[3] = {-diagonal_y.x, -diagonal_y.y, -diagonal_y.z};
    f.east[3] = {V(0.0), V(0.0), V(0.0)};
}

/// A row of F: component i of the displacement along x, y and z, on the mean of the cell.
template <class Component>
ASPERITY_INLINE PackVector mean_gradient(const Corners& u, const Cell& c,
                                         const Component& component) {
    const auto side = [&](const PackVector(&row)[4]) {
        const V low = component(row[0]) + component(row[1]);
        const V high = component(row[2]) + component(row[3]);
        const V north =
            (component(row[1]) - component(row[0])) + (component(row[3]) - component(row[2]));
        return PackVector{low + high, north, high - low};
    };
    const PackVector west = side(u.west), east = side(u.east);
    return {c.inverse_4_edge * (east.x - west.x), c.inverse_4_edge * (east.y + west.y),
            c.inverse_4_edge * (east.z + west.z)};
}

ASPERITY_INLINE V minor(V a, V b, V c, V d) { return fma(a, d, -(b * c)); }

/// det F - 1 and the cofactors of F, row by row.
struct Volume {
    V theta;
    PackVector cofactor[3];
};
ASPERITY_INLINE Volume volume_of(const Corners& u, const Cell& c) {
    PackVector a = mean_gradient(u, c, [](const PackVector& v) { return v.x; });
    PackVector b = mean_gradient(u, c, [](const PackVector& v) { return v.y; });
    PackVector d = mean_gradient(u, c, [](const PackVector& v) { return v.z; });
    const V one(1.0);
    a.x = a.x + one, b.y = b.y + one, d.z = d.z + one;
    const auto cross = [](const PackVector& p, const PackVector& q) {
        return PackVector{minor(p.y, p.z, q.y, q.z), minor(p.z, p.x, q.z, q.x),
                          minor(p.x, p.y, q.x, q.y)};
    };
    const PackVector bd = cross(b, d);
    const V det = fma(a.x, bd.x, fma(a.y, bd.y, a.z * bd.z));
    return {det - one, {bd, cross(d, a), cross(a, b)}};
}

/// What the mean dilatation gives to component i of the eight corners' forces.
template <class Component>
ASPERITY_INLINE void press(V p, const PackVector& cofactor, Corners& f,
                           const Component& component) {
    const V x = p * cofactor.x, y = p * cofactor.y, z = p * cofactor.z;
    const V sum = y + z, difference = y - z;
    const V corner[4] = {-sum, difference, -difference, sum};
#pragma GCC unroll 4
    for (int row = 0; row < 4; ++row) {
        component(f.west[row]) = component(f.west[row]) + (corner[row] - x);
        component(f.east[row]) = component(f.east[row]) + (corner[row] + x);
    }
}

ASPERITY_INLINE void press(const Corners& u, const Cell& c, Corners& f) {
    const Volume volume = volume_of(u, c);
    const V p = -(c.pressure * volume.theta);
    press(p, volume.cofactor[0], f, [](PackVector& v) -> V& { return v.x; });
    press(p, volume.cofactor[1], f, [](PackVector& v) -> V& { return v.y; });
    press(p, volume.cofactor[2], f, [](PackVector& v) -> V& { return v.z; });
}

/// Where the forces on one row of nodes are summed; nothing if the row is another band's.
struct Row {
    double *x = nullptr, *y = nullptr, *z = nullptr;
    int x0 = 0, x1 = 0; ///< nodes wanted
};

/// A pack of forces from node `at` of a row; first: nothing has been summed there yet.
template <bool first>
ASPERITY_INLINE void add(const Row& row, int at, const PackVector& f) {
    if (!row.x) return;
    (first ? f.x : V::load(row.x + at) + f.x).store(row.x + at);
    (first ? f.y : V::load(row.y + at) + f.y).store(row.y + at);
    (first ? f.z : V::load(row.z + at) + f.z).store(row.z + at);
}
/// The same at the ends of a row, where some lanes are not wanted.
template <bool first>
[[gnu::noinline]] void add_end(const Row& row, int at, const PackVector& f) {
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
/// `line` gives. with_cells: everything the cells own (pressed: the dilatation too); without: the
/// springs in the plane alone.
template <bool with_cells, bool pressed>
void cell_row(const VectorVolume<const double>& u, std::ptrdiff_t line, const Cell& cell,
              const Stiffness& in_plane, const RowsAround& to) {
    constexpr int rows = with_cells ? 4 : 2;
    const V zero(0.0);
    PackVector before[4]; // what the cells one pack back give to their east
    for (PackVector& b : before)
        b = {zero, zero, zero};
    for (int x = -V::width; x < to.x1; x += V::width) {
        Corners corner, f;
#pragma GCC unroll 4
        for (int r = 0; r < rows; ++r) {
            const auto at = line + x + (r & 1) * u.x.row + (r >> 1) * u.x.plane;
            corner.west[r] = load(u, at);
            corner.east[r] = load(u, at + 1);
        }
        pull_in_plane(corner, cell, in_plane, f);
        if constexpr (with_cells) pull_upwards(corner, cell, f);
        if constexpr (pressed) press(corner, cell, f);
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

/// Row y of a plane, as far as the patch wants it.
Row row_of(const VectorPlane<double>& force, Patch nodes, int y) {
    if (y < nodes.y0 || y >= nodes.y1) return {};
    return {force.x.line(y), force.y.line(y), force.z.line(y), nodes.x0, nodes.x1};
}

/// pressed: with a dilatation term; at nu = 1/4 there is none, and no volume to compute.
template <bool pressed>
void cell_layer(const VectorVolume<const double>& u, int z, const LevelCell& constants,
                Patch lower_nodes, const VectorPlane<double>& lower, Patch upper_nodes,
                const VectorPlane<double>& upper) {
    const Cell cell(constants);
    const Stiffness& in_plane = z == 0 ? cell.surface : cell.inside;
    const int x1 = lower_nodes.x1 > upper_nodes.x1 ? lower_nodes.x1 : upper_nodes.x1;
    const int y0 = lower_nodes.y0 < upper_nodes.y0 ? lower_nodes.y0 : upper_nodes.y0;
    const int y1 = lower_nodes.y1 > upper_nodes.y1 ? lower_nodes.y1 : upper_nodes.y1;
    for (int y = y0 - 1; y < y1; ++y)
        cell_row<true, pressed>(u, z * u.x.plane + y * u.x.row, cell, in_plane,
                                {{row_of(lower, lower_nodes, y), row_of(lower, lower_nodes, y + 1),
                                  row_of(upper, upper_nodes, y), row_of(upper, upper_nodes, y + 1)},
                                 x1});
}

void surface(VectorVolume<const double> u, int z, const LevelCell& c, Patch nodes,
             VectorPlane<double> force) {
    const Cell cell(c);
    for (int y = nodes.y0 - 1; y < nodes.y1; ++y)
        cell_row<false, false>(
            u, z * u.x.plane + y * u.x.row, cell, cell.surface,
            {{row_of(force, nodes, y), row_of(force, nodes, y + 1), {}, {}}, nodes.x1});
}

template <bool damped, bool observed>
void kick_rows(const VectorPlane<const double>& force, int z, int y0, int y1, const Kick& plan,
               const VectorVolume<double>& v, KickSums& sums) {
    Kicker<V, damped, observed> kicker(plan, v);
    for (int y = y0; y < y1; ++y)
        for (int x = 0; x < v.x.nx; x += V::width)
            kicker(z * v.x.plane + y * v.x.row + x, v.x.nx - x,
                   {V::load(force.x.line(y) + x), V::load(force.y.line(y) + x),
                    V::load(force.z.line(y) + x)});
    kicker.add_to(sums);
}

void kick(VectorPlane<const double> force, int z, int y0, int y1, const Kick& plan,
          const VectorVolume<double>& v, KickSums& sums) {
    const auto rows = plan.damped
                          ? (plan.observed ? kick_rows<true, true> : kick_rows<true, false>)
                          : (plan.observed ? kick_rows<false, true> : kick_rows<false, false>);
    rows(force, z, y0, y1, plan, v, sums);
}

/// Plane by plane through a band: the forces begun on the plane above are handed from one to the
/// next. place(z): where those on plane z are summed; complete(z, force): they are, and no other
/// force of the band needs the places of plane z.
template <class Place, class Complete>
void sweep_planes(const ElasticLevel& level, int y0, int y1, const Place& place,
                  const Complete& complete) {
    const VectorVolume<const double> u = level.u;
    const int cells = level.cells, nx = u.x.nx;
    const Patch inside = {0, nx, y0, y1}, beyond = upper_patch(level, y0, y1);
    const auto layer = level.cell.elasticity.kappa != 0.0 ? cell_layer<true> : cell_layer<false>;
    VectorPlane<double> lower = place(0);
    for (int y = y0; y < y1; ++y) {
        std::copy_n(level.incoming.x.line(y), nx, lower.x.line(y));
        std::copy_n(level.incoming.y.line(y), nx, lower.y.line(y));
        std::copy_n(level.incoming.z.line(y), nx, lower.z.line(y));
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

/// Energy of the cells whose lower corners are a pack of nodes, straight from the definition.
ASPERITY_INLINE V cell_energy(const VectorVolume<const double>& u, std::ptrdiff_t at,
                              const Cell& cell, const LevelCell& c) {
    Corners corner;
    for (int r = 0; r < 4; ++r) {
        const auto row = at + (r & 1) * u.x.row + (r >> 1) * u.x.plane;
        corner.west[r] = load(u, row);
        corner.east[r] = load(u, row + 1);
    }
    V edges(0.0), diagonals(0.0);
    for (const Spring& spring : cell_springs.spring) {
        const auto end = [&](int p) { return p & 1 ? corner.east[p >> 1] : corner.west[p >> 1]; };
        PackVector r = end(spring.to) - end(spring.from);
        r.x = r.x + V(spring.dx * c.edge);
        r.y = r.y + V(spring.dy * c.edge);
        r.z = r.z + V(spring.dz * c.edge);
        const double rest = spring.diagonal ? std::numbers::sqrt2 * c.edge : c.edge;
        const V stretch = sqrt(squared(r)) - V(rest);
        V& sum = spring.diagonal ? diagonals : edges;
        sum = fma(stretch, stretch, sum);
    }
    const V theta = volume_of(corner, cell).theta;
    // (lambda - mu) s^3 = 16 s^2 kappa.
    return V(0.125 * c.elasticity.k) * edges + V(0.25 * c.elasticity.k) * diagonals +
           V(8.0 * c.edge * c.edge * c.elasticity.kappa) * (theta * theta);
}

void energy(VectorVolume<const double> u, const LevelCell& cell, int y0, int y1, ExactSum& sum) {
    const Cell terms(cell);
    BasicExactSum<V> lanes;
    for (int z = 0; z + 1 < u.x.nz; ++z)
        for (int y = y0; y < y1; ++y) {
            const auto line = z * u.x.plane + y * u.x.row;
            for (int x = 0; x < u.x.nx; x += V::width) {
                lanes.add(first_lanes(cell_energy(u, line + x, terms, cell), u.x.nx - x));
            }
        }
    collect(lanes, sum);
}

} // namespace

extern const ElasticKernels finite_strain_kernels;
const ElasticKernels finite_strain_kernels = {forces, advance, drift, energy, plane_sum};

} // namespace asperity::ASPERITY_VARIANT
