// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "kernels/elastic_level.hpp"

#include "kernels/cell_geometry.hpp"
#include "kernels/kick.hpp"
#include "kernels/simd.hpp"

namespace asperity::ASPERITY_VARIANT {

namespace {

using V = Pack<double>;

/// One displacement component in a pack of columns: at each of the planes below, at and above the
/// node, the node's own row and the sum and difference of the rows around it, already combined over
/// z.
struct Rows {
    V c, sum, difference; ///< y = 0; y = 1 plus y = -1; y = 1 minus y = -1

    ASPERITY_INLINE static Rows load(const double* p, std::ptrdiff_t row) {
        const V north = V::load_once(p + row), south = V::load_once(p - row);
        return {V::load_once(p), north + south, north - south};
    }
    ASPERITY_INLINE friend Rows operator+(const Rows& a, const Rows& b) {
        return {a.c + b.c, a.sum + b.sum, a.difference + b.difference};
    }
    ASPERITY_INLINE friend Rows operator-(const Rows& a, const Rows& b) {
        return {a.c - b.c, a.sum - b.sum, a.difference - b.difference};
    }
};

struct Column {
    Rows own, P, M;
};

/// The stencil's coefficients, a copy in every lane. Many are equal (make_stencil): inside a level
/// six numbers are left, which stay in registers.
template <Face face>
struct Weights {
    V own_c, own_e, own_t, own_d, own_n; ///< _n: of the diagonal neighbours in uz -> Fz
    V out_c, out_e, out_t, out_d, out_n; ///< _n: of the node itself in uz -> Fz
    V tau_r, tau_rd;

    ASPERITY_INLINE explicit Weights(const Stencil& s)
        : own_c(s.own_c), own_e(s.own_e), own_t(s.own_t), own_d(s.own_d), own_n(s.normal_d),
          out_c(s.out_c), out_e(s.out_e), out_t(s.out_t), out_d(s.out_d), out_n(s.out_normal_c),
          tau_r(s.tau_r), tau_rd(s.tau_rd) {
        if constexpr (face == Face::inner) {
            own_e = out_n;
            own_t = out_c;
            own_d = out_e;
            own_n = out_t;
        }
    }
};

template <Face face>
ASPERITY_INLINE Column load_column(const double* p, std::ptrdiff_t row, std::ptrdiff_t plane) {
    const Rows own = Rows::load(p, row);
    if constexpr (face == Face::lower) {
        const Rows up = Rows::load(p + plane, row);
        return {own, up, up};
    } else if constexpr (face == Face::upper) {
        const Rows down = Rows::load(p - plane, row);
        return {own, down, {-down.c, -down.sum, -down.difference}};
    } else {
        const Rows up = Rows::load(p + plane, row), down = Rows::load(p - plane, row);
        return {own, up + down, up - down};
    }
}

/// What the columns at x give to one force component at x, at x - 1 and at x + 1.
struct Parts {
    V here, west, east;
};
struct ColumnParts {
    Parts x, y, z;
};

/// even: the part that x - 1 and x + 1 get alike; odd: the part that x - 1 gets with a plus (it
/// sees the column at its +x side) and x + 1 with a minus.
ASPERITY_INLINE Parts parts(V here, V even, V odd) { return {here, even + odd, even - odd}; }

template <Face face>
ASPERITY_INLINE ColumnParts column_parts(const VectorVolume<const double>& u, std::ptrdiff_t at,
                                         const Weights<face>& s) {
    const auto row = u.x.row, plane = u.x.plane;
    V cx, ex, ox, cy, ey, oy, cz, ez, oz; // centre, even and odd parts of the three components
    {
        const Column a = load_column<face>(u.x.origin + at, row, plane);
        cx = s.own_c * a.own.c;
        cx = fma(s.own_t, a.own.sum, cx);
        cx = fma(s.out_c, a.P.c, cx);
        cx = fma(s.out_t, a.P.sum, cx);
        ex = s.own_e * a.own.c;
        ex = fma(s.own_d, a.own.sum, ex);
        ex = fma(s.out_e, a.P.c, ex);
        ex = fma(s.out_d, a.P.sum, ex);
        oy = s.own_d * a.own.difference;
        oy = fma(s.out_d, a.P.difference, oy);
        oz = s.out_e * a.M.c;
        oz = fma(s.out_d, a.M.sum, oz);
        if constexpr (face != Face::inner) {
            oz = fma(s.tau_r, a.own.c, oz);
            oz = fma(s.tau_rd, a.own.sum, oz);
        }
    }
    {
        const Column a = load_column<face>(u.y.origin + at, row, plane);
        cy = s.own_c * a.own.c;
        cy = fma(s.own_e, a.own.sum, cy);
        cy = fma(s.out_c, a.P.c, cy);
        cy = fma(s.out_e, a.P.sum, cy);
        ey = s.own_t * a.own.c;
        ey = fma(s.own_d, a.own.sum, ey);
        ey = fma(s.out_t, a.P.c, ey);
        ey = fma(s.out_d, a.P.sum, ey);
        ox = s.own_d * a.own.difference;
        ox = fma(s.out_d, a.P.difference, ox);
        cz = s.out_e * a.M.difference;
        ez = s.out_d * a.M.difference;
        if constexpr (face != Face::inner) {
            cz = fma(s.tau_r, a.own.difference, cz);
            ez = fma(s.tau_rd, a.own.difference, ez);
        }
    }
    {
        const Column a = load_column<face>(u.z.origin + at, row, plane);
        cz = fma(s.own_c, a.own.c, cz);
        cz = fma(s.own_t, a.own.sum, cz);
        cz = fma(s.out_n, a.P.c, cz);
        cz = fma(s.out_e, a.P.sum, cz);
        ez = fma(s.own_t, a.own.c, ez);
        ez = fma(s.own_n, a.own.sum, ez);
        ez = fma(s.out_e, a.P.c, ez);
        ez = fma(s.out_d, a.P.sum, ez);
        ox = fma(s.out_e, a.M.c, ox);
        ox = fma(s.out_d, a.M.sum, ox);
        cy = fma(s.out_e, a.M.difference, cy);
        ey = fma(s.out_d, a.M.difference, ey);
        if constexpr (face != Face::inner) {
            ox = fma(-s.tau_r, a.own.c, ox);
            ox = fma(-s.tau_rd, a.own.sum, ox);
            cy = fma(-s.tau_r, a.own.difference, cy);
            ey = fma(-s.tau_rd, a.own.difference, ey);
        }
    }
    return {parts(cx, ex, ox), parts(cy, ey, oy), parts(cz, ez, oz)};
}

/// Calls use(x, force) for the packs that cover [x0, x1) of a row; packs start at multiples of the
/// width, so lanes outside may come along.
template <Face face, class Use>
ASPERITY_INLINE void sweep_row(const VectorVolume<const double>& u, std::ptrdiff_t line, int x0,
                               int x1, const Weights<face>& s, const Use& use) {
    int x = x0 & ~(V::width - 1);
    // A node at x0 needs the column before it: in this pack, or in the one before.
    ColumnParts before = column_parts<face>(u, line + (x == x0 ? x - V::width : x), s);
    ColumnParts here = x == x0 ? column_parts<face>(u, line + x, s) : before;
    const auto join = [](const Parts& w, const Parts& c, const Parts& e) {
        return (shift_left(c.west, e.west) + shift_right(w.east, c.east)) + c.here;
    };
    for (; x < x1; x += V::width) {
        const ColumnParts behind = column_parts<face>(u, line + x + V::width, s);
        use(x, PackVector{join(before.x, here.x, behind.x), join(before.y, here.y, behind.y),
                          join(before.z, here.z, behind.z)});
        before = here;
        here = behind;
    }
}

template <Face face>
void force_patch(VectorVolume<const double> u, int z, const Stencil& s, Patch patch,
                 VectorPlane<double> out) {
    const Weights<face> weights(s);
    for (int y = patch.y0; y < patch.y1; ++y)
        sweep_row<face>(u, z * u.x.plane + y * u.x.row, patch.x0, patch.x1, weights,
                        [&](int x, const PackVector& f) {
                            const auto at = y * out.x.row + x;
                            f.x.store_lanes(out.x.origin + at, patch.x0 - x, patch.x1 - x);
                            f.y.store_lanes(out.y.origin + at, patch.x0 - x, patch.x1 - x);
                            f.z.store_lanes(out.z.origin + at, patch.x0 - x, patch.x1 - x);
                        });
}

/// Where the work goes on: plane z, from row y. What it needs is fetched from memory meanwhile.
struct Following {
    int z, y;
};

/// Calls what a place will need into the second cache, a line of each array at a time.
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

template <Face face, bool with_incoming, bool damped, bool observed>
void kick_rows(VectorVolume<const double> u, int z, const Stencil& s, int y0, int y1,
               VectorPlane<const double> incoming, const Kick& plan, Following next,
               const VectorVolume<double>& v, KickSums& sums) {
    const int nx = u.x.nx;
    const auto place = [&](int plane, int y) { return plane * u.x.plane + y * u.x.row; };
    const Fetch fetch(u, v, place(z, y0), place(next.z, next.y), next.z == 0);
    const Weights<face> weights(s);
    Kicker<damped, observed> kicker(plan, v);
    for (int y = y0; y < y1; ++y) {
        const auto line = place(z, y);
        sweep_row<face>(u, line, 0, nx, weights, [&](int x, PackVector f) {
            const auto at = line + x;
            fetch(at);
            if constexpr (with_incoming) {
                f.x = f.x + V::load(incoming.x.line(y) + x);
                f.y = f.y + V::load(incoming.y.line(y) + x);
                f.z = f.z + V::load(incoming.z.line(y) + x);
            }
            kicker(at, nx - x, f);
        });
    }
    kicker.add_to(sums);
}

template <Face face, bool with_incoming>
void kick_as(VectorVolume<const double> u, int z, const Stencil& s, int y0, int y1,
             VectorPlane<const double> incoming, const Kick& plan, Following next,
             const VectorVolume<double>& v, KickSums& sums) {
    const auto rows = plan.damped ? (plan.observed ? kick_rows<face, with_incoming, true, true>
                                                   : kick_rows<face, with_incoming, true, false>)
                                  : (plan.observed ? kick_rows<face, with_incoming, false, true>
                                                   : kick_rows<face, with_incoming, false, false>);
    rows(u, z, s, y0, y1, incoming, plan, next, v, sums);
}

void forces(const ElasticLevel& level, int y0, int y1, VectorVolume<double> out) {
    const VectorVolume<const double> u = level.u;
    const int nx = u.x.nx;
    const Patch nodes = {0, nx, y0, y1};
    const VectorPlane<double> lowest = out[0];
    force_patch<Face::lower>(u, 0, level.lower, nodes, lowest);
    for (int y = y0; y < y1; ++y)
        for (int x = 0; x < nx; ++x) {
            lowest.x(x, y) += level.incoming.x(x, y);
            lowest.y(x, y) += level.incoming.y(x, y);
            lowest.z(x, y) += level.incoming.z(x, y);
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
            kick_as<Face::lower, true>(u, z, level.lower, band.begin, band.end, level.incoming,
                                       kicks(z), next, level.v, sums);
        else
            kick_as<Face::inner, false>(u, z, level.inner, band.begin, band.end, level.incoming,
                                        kicks(z), next, level.v, sums);
        if (z > 0) drift_rows(level, z - 1, dt, from, band.end - 1);
    }
    force_patch<Face::upper>(u, cells, level.upper, upper_patch(level, band.begin, band.end),
                             level.upper_force);
    drift_rows(level, cells - 1, dt, from, band.end - 1);
}

/// Energy of the cells whose lower corners are a pack of nodes, straight from the definition.
ASPERITY_INLINE V cell_energy(const VectorVolume<const double>& u, std::ptrdiff_t at,
                              CellElasticity e) {
    V cx[8], cy[8], cz[8];
    for (int p = 0; p < 8; ++p) {
        const auto q = at + (p & 1) + (p >> 1 & 1) * u.x.row + (p >> 2 & 1) * u.x.plane;
        cx[p] = V::load(u.x.origin + q);
        cy[p] = V::load(u.y.origin + q);
        cz[p] = V::load(u.z.origin + q);
    }
    V edges(0.0), diagonals(0.0), dilatation(0.0);
#pragma GCC unroll 24
    for (int n = 0; n < 24; ++n) {
        const Spring& s = cell_springs.spring[n];
        V stretch(0.0);
        if (s.dx) stretch = stretch + V(s.dx) * (cx[s.to] - cx[s.from]);
        if (s.dy) stretch = stretch + V(s.dy) * (cy[s.to] - cy[s.from]);
        if (s.dz) stretch = stretch + V(s.dz) * (cz[s.to] - cz[s.from]);
        if (s.diagonal)
            diagonals = fma(stretch, stretch, diagonals);
        else
            edges = fma(stretch, stretch, edges);
    }
#pragma GCC unroll 8
    for (int p = 0; p < 8; ++p) {
        dilatation = (p & 1) ? dilatation + cx[p] : dilatation - cx[p];
        dilatation = (p & 2) ? dilatation + cy[p] : dilatation - cy[p];
        dilatation = (p & 4) ? dilatation + cz[p] : dilatation - cz[p];
    }
    // Edges weigh k/4; diagonals k/2 with e.du = stretch / sqrt(2); (lambda-mu) s^3 theta^2 / 2 =
    // kappa/2 (4 s theta)^2.
    return V(0.125 * e.k) * (edges + diagonals) + V(0.5 * e.kappa) * (dilatation * dilatation);
}

void energy(VectorVolume<const double> u, const LevelCell& cell, int y0, int y1, ExactSum& sum) {
    BasicExactSum<V> lanes;
    for (int z = 0; z + 1 < u.x.nz; ++z)
        for (int y = y0; y < y1; ++y) {
            const auto line = z * u.x.plane + y * u.x.row;
            for (int x = 0; x < u.x.nx; x += V::width) {
                const auto inside = lane_numbers() < V(static_cast<double>(u.x.nx - x));
                lanes.add(select(inside, cell_energy(u, line + x, cell.elasticity), V(0.0)));
            }
        }
    collect(lanes, sum);
}

} // namespace

extern const ElasticKernels small_strain_kernels;
const ElasticKernels small_strain_kernels = {forces, advance, drift, energy, plane_sum};

} // namespace asperity::ASPERITY_VARIANT
