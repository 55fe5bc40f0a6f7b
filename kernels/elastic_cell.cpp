// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "kernels/elastic_cell.hpp"

#include "kernels/cell_geometry.hpp"
#include "kernels/simd.hpp"

namespace asperity::ASPERITY_VARIANT {

namespace {

using V = Pack<double>;

/// A scalar field at the nine nodes around a pack of nodes.
struct Nine {
    V c, e, w, n, s, ne, nw, se, sw;

    ASPERITY_INLINE static Nine load(const double* p, std::ptrdiff_t row) {
        return {V::load(p),           V::load(p + 1),       V::load(p - 1),
                V::load(p + row),     V::load(p - row),     V::load(p + row + 1),
                V::load(p + row - 1), V::load(p - row + 1), V::load(p - row - 1)};
    }
    ASPERITY_INLINE friend Nine operator+(const Nine& a, const Nine& b) {
        return {a.c + b.c,   a.e + b.e,   a.w + b.w,   a.n + b.n,  a.s + b.s,
                a.ne + b.ne, a.nw + b.nw, a.se + b.se, a.sw + b.sw};
    }
    ASPERITY_INLINE friend Nine operator-(const Nine& a, const Nine& b) {
        return {a.c - b.c,   a.e - b.e,   a.w - b.w,   a.n - b.n,  a.s - b.s,
                a.ne - b.ne, a.nw - b.nw, a.se - b.se, a.sw - b.sw};
    }
    ASPERITY_INLINE V ex() const { return e + w; }
    ASPERITY_INLINE V ey() const { return n + s; }
    ASPERITY_INLINE V d() const { return (ne + sw) + (nw + se); }
    ASPERITY_INLINE V rxy() const { return (ne + sw) - (nw + se); }
    ASPERITY_INLINE V rx() const { return e - w; }
    ASPERITY_INLINE V ry() const { return n - s; }
    ASPERITY_INLINE V rxd() const { return (ne - sw) + (se - nw); }
    ASPERITY_INLINE V ryd() const { return (ne - sw) - (se - nw); }
};

/// The own plane, the sum and the difference of its neighbours, of one displacement component.
struct Column {
    Nine own, sum, difference;
};

template <Face face>
ASPERITY_INLINE Column load_column(const double* p, std::ptrdiff_t row, std::ptrdiff_t plane) {
    const Nine own = Nine::load(p, row);
    if constexpr (face == Face::lower) {
        const Nine up = Nine::load(p + plane, row);
        return {own, up, up};
    } else if constexpr (face == Face::upper) {
        const Nine down = Nine::load(p - plane, row);
        const V zero(0.0);
        return {own, down, Nine{zero, zero, zero, zero, zero, zero, zero, zero, zero} - down};
    } else {
        const Nine up = Nine::load(p + plane, row);
        const Nine down = Nine::load(p - plane, row);
        return {own, up + down, up - down};
    }
}

struct Force {
    V x, y, z;
};

template <Face face>
ASPERITY_INLINE Force stencil_force(const VectorVolume<const double>& u, std::ptrdiff_t at,
                                    const Stencil& s) {
    const auto row = u.x.row, plane = u.x.plane;
    Force f;
    { // ux: into Fx by its even filters, into Fy and Fz by its odd ones
        const Column a = load_column<face>(u.x.origin + at, row, plane);
        f.x = V(s.own_c) * a.own.c;
        f.x = fma(V(s.own_e), a.own.ex(), f.x);
        f.x = fma(V(s.own_t), a.own.ey(), f.x);
        f.x = fma(V(s.own_d), a.own.d(), f.x);
        f.x = fma(V(s.out_c), a.sum.c, f.x);
        f.x = fma(V(s.out_e), a.sum.ex(), f.x);
        f.x = fma(V(s.out_t), a.sum.ey(), f.x);
        f.x = fma(V(s.out_d), a.sum.d(), f.x);
        f.y = V(s.own_xy) * a.own.rxy();
        f.y = fma(V(s.out_xy), a.sum.rxy(), f.y);
        f.z = V(s.out_r) * a.difference.rx();
        f.z = fma(V(s.out_rd), a.difference.rxd(), f.z);
        if constexpr (face != Face::inner) {
            f.z = fma(V(s.tau_r), a.own.rx(), f.z);
            f.z = fma(V(s.tau_rd), a.own.rxd(), f.z);
        }
    }
    { // uy: the same with x and y exchanged
        const Column a = load_column<face>(u.y.origin + at, row, plane);
        f.y = fma(V(s.own_c), a.own.c, f.y);
        f.y = fma(V(s.own_e), a.own.ey(), f.y);
        f.y = fma(V(s.own_t), a.own.ex(), f.y);
        f.y = fma(V(s.own_d), a.own.d(), f.y);
        f.y = fma(V(s.out_c), a.sum.c, f.y);
        f.y = fma(V(s.out_e), a.sum.ey(), f.y);
        f.y = fma(V(s.out_t), a.sum.ex(), f.y);
        f.y = fma(V(s.out_d), a.sum.d(), f.y);
        f.x = fma(V(s.own_xy), a.own.rxy(), f.x);
        f.x = fma(V(s.out_xy), a.sum.rxy(), f.x);
        f.z = fma(V(s.out_r), a.difference.ry(), f.z);
        f.z = fma(V(s.out_rd), a.difference.ryd(), f.z);
        if constexpr (face != Face::inner) {
            f.z = fma(V(s.tau_r), a.own.ry(), f.z);
            f.z = fma(V(s.tau_rd), a.own.ryd(), f.z);
        }
    }
    {
        const Column a = load_column<face>(u.z.origin + at, row, plane);
        f.z = fma(V(s.normal_c), a.own.c, f.z);
        f.z = fma(V(s.normal_e), a.own.ex() + a.own.ey(), f.z);
        f.z = fma(V(s.normal_d), a.own.d(), f.z);
        f.z = fma(V(s.out_normal_c), a.sum.c, f.z);
        f.z = fma(V(s.out_normal_e), a.sum.ex() + a.sum.ey(), f.z);
        f.z = fma(V(s.out_normal_d), a.sum.d(), f.z);
        f.x = fma(V(s.out_r), a.difference.rx(), f.x);
        f.x = fma(V(s.out_rd), a.difference.rxd(), f.x);
        f.y = fma(V(s.out_r), a.difference.ry(), f.y);
        f.y = fma(V(s.out_rd), a.difference.ryd(), f.y);
        if constexpr (face != Face::inner) {
            f.x = fma(V(-s.tau_r), a.own.rx(), f.x);
            f.x = fma(V(-s.tau_rd), a.own.rxd(), f.x);
            f.y = fma(V(-s.tau_r), a.own.ry(), f.y);
            f.y = fma(V(-s.tau_rd), a.own.ryd(), f.y);
        }
    }
    return f;
}

template <Face face>
void force_patch(const VectorVolume<const double>& u, int z, const Stencil& s, Patch patch,
                 const VectorPlane<double>& out) {
    for (int y = patch.y0; y < patch.y1; ++y) {
        const auto line = z * u.x.plane + y * u.x.row;
        for (int x = patch.x0; x < patch.x1; x += V::width) {
            const Force f = stencil_force<face>(u, line + x, s);
            const int count = patch.x1 - x;
            f.x.store_first(out.x.line(y) + x, count);
            f.y.store_first(out.y.line(y) + x, count);
            f.z.store_first(out.z.line(y) + x, count);
        }
    }
}

/// 0, 1, 2, ... as a pack: to switch off lanes behind the end of a row.
ASPERITY_INLINE V lane_numbers() {
    double lane[V::width];
    for (int i = 0; i < V::width; ++i) lane[i] = i;
    return V::load(lane);
}

ASPERITY_INLINE void collect(const BasicExactSum<V>& lanes, ExactSum& into) {
    for (int k = 0; k < 3; ++k)
        for (int i = 0; i < V::width; ++i) into.bin[k] += lanes.bin[k][i];
}

template <Face face, bool with_incoming, bool damped, bool observed>
void advance_rows(const VectorVolume<const double>& u, int z, const Stencil& s, int y0, int y1,
                  const VectorPlane<const double>& incoming, const KickDrift& kd,
                  const VectorVolume<double>& v, const VectorVolume<double>& u_next, KickSums& sums) {
    const int nx = u.x.nx;
    const V keep(kd.keep), kick(kd.kick), dt(kd.dt), drag(kd.drag_z);
    [[maybe_unused]] BasicExactSum<V> kinetic, dissipated, dragged;
    for (int y = y0; y < y1; ++y) {
        const auto line = z * u.x.plane + y * u.x.row;
        for (int x = 0; x < nx; x += V::width) {
            const auto at = line + x;
            Force f = stencil_force<face>(u, at, s);
            if constexpr (with_incoming) {
                f.x = f.x + V::load(incoming.x.line(y) + x);
                f.y = f.y + V::load(incoming.y.line(y) + x);
                f.z = f.z + V::load(incoming.z.line(y) + x);
            }
            const V old_x = V::load(v.x.origin + at);
            const V old_y = V::load(v.y.origin + at);
            const V old_z = V::load(v.z.origin + at);
            V new_x, new_y, new_z;
            if constexpr (damped) {
                new_x = fma(kick, f.x, keep * old_x);
                new_y = fma(kick, f.y, keep * old_y);
                new_z = fma(kick, f.z, fma(keep, old_z, drag));
            } else {
                new_x = fma(kick, f.x, old_x);
                new_y = fma(kick, f.y, old_y);
                new_z = fma(kick, f.z, old_z);
            }
            const int count = nx - x;
            new_x.store_first(v.x.origin + at, count);
            new_y.store_first(v.y.origin + at, count);
            new_z.store_first(v.z.origin + at, count);
            fma(dt, new_x, V::load(u.x.origin + at)).store_first(u_next.x.origin + at, count);
            fma(dt, new_y, V::load(u.y.origin + at)).store_first(u_next.y.origin + at, count);
            fma(dt, new_z, V::load(u.z.origin + at)).store_first(u_next.z.origin + at, count);
            if constexpr (damped || observed) {
                const V half(0.5);
                const V mx = half * (old_x + new_x), my = half * (old_y + new_y),
                        mz = half * (old_z + new_z);
                const auto inside = lane_numbers() < V(static_cast<double>(count));
                const V zero(0.0);
                if constexpr (observed) {
                    const V twice = fma(mx, mx, fma(my, my, mz * mz));
                    kinetic.add(select(inside, V(kd.half_mass) * twice, zero));
                }
                if constexpr (damped) {
                    const V rz = mz - V(kd.medium_z);
                    const V square = fma(mx, mx, fma(my, my, rz * rz));
                    dissipated.add(select(inside, V(kd.drag) * square, zero));
                    dragged.add(select(inside, V(kd.drag) * rz, zero));
                }
            }
        }
    }
    if constexpr (observed) collect(kinetic, sums.kinetic);
    if constexpr (damped) {
        collect(dissipated, sums.dissipated);
        collect(dragged, sums.dragged);
    }
}

void force(VectorVolume<const double> u, int z, const Stencil& s, Patch patch,
           VectorPlane<double> out) {
    if (s.below == 0.0) return force_patch<Face::lower>(u, z, s, patch, out);
    if (s.above == 0.0) return force_patch<Face::upper>(u, z, s, patch, out);
    force_patch<Face::inner>(u, z, s, patch, out);
}

template <Face face, bool with_incoming>
void advance_as(const VectorVolume<const double>& u, int z, const Stencil& s, int y0, int y1,
                const VectorPlane<const double>& incoming, const KickDrift& kd,
                const VectorVolume<double>& v, const VectorVolume<double>& u_next, KickSums& sums) {
    if (kd.damped && kd.observed)
        advance_rows<face, with_incoming, true, true>(u, z, s, y0, y1, incoming, kd, v, u_next, sums);
    else if (kd.damped)
        advance_rows<face, with_incoming, true, false>(u, z, s, y0, y1, incoming, kd, v, u_next, sums);
    else if (kd.observed)
        advance_rows<face, with_incoming, false, true>(u, z, s, y0, y1, incoming, kd, v, u_next, sums);
    else
        advance_rows<face, with_incoming, false, false>(u, z, s, y0, y1, incoming, kd, v, u_next, sums);
}

void advance(VectorVolume<const double> u, int z, const Stencil& s, int y0, int y1,
             VectorPlane<const double> incoming, const KickDrift& kd, VectorVolume<double> v,
             VectorVolume<double> u_next, KickSums& sums) {
    // A level's upper plane is prescribed, so what advances is its lower face or inside.
    if (s.below == 0.0)
        advance_as<Face::lower, true>(u, z, s, y0, y1, incoming, kd, v, u_next, sums);
    else
        advance_as<Face::inner, false>(u, z, s, y0, y1, incoming, kd, v, u_next, sums);
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

void energy(VectorVolume<const double> u, int z, CellElasticity e, int y0, int y1, ExactSum& sum) {
    BasicExactSum<V> lanes;
    for (int y = y0; y < y1; ++y) {
        const auto line = z * u.x.plane + y * u.x.row;
        for (int x = 0; x < u.x.nx; x += V::width) {
            const auto inside = lane_numbers() < V(static_cast<double>(u.x.nx - x));
            lanes.add(select(inside, cell_energy(u, line + x, e), V(0.0)));
        }
    }
    collect(lanes, sum);
}

} // namespace

extern const ElasticKernels elastic_kernels;
const ElasticKernels elastic_kernels = {force, advance, energy};

} // namespace asperity::ASPERITY_VARIANT
