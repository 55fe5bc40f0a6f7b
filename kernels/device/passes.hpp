// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The launches of device.hpp as functions of a node, compiled for CUDA and for the emulated device,
// each with its own launch() (launch.hpp). The arithmetic is that of the processor's kernels, on
// lanes.
#pragma once

#include "kernels/lane.hpp"

#include "kernels/device/launch.hpp"
#include "kernels/elastic_column.hpp"
#include "kernels/interface_site.hpp"
#include "kernels/kick.hpp"
#include "kernels/node_noise.hpp"
#include "kernels/pair_sum.hpp"
#include "kernels/transfer_node.hpp"

namespace asperity::ASPERITY_VARIANT {

using Number = Lane<double>;

/// Returns the level of node i of the ranges, and sets i to the node's number in it.
ASPERITY_INLINE int locate(const NodeRanges& ranges, long long& i) {
    int level = 0;
    while (level + 1 < ranges.levels && i >= ranges.first[level + 1])
        ++level;
    i -= ranges.first[level];
    return level;
}

/// Interpolation of the constrained planes, halo included, and motion of the top plane.
struct Interpolate {
    DeviceStep s;
    ASPERITY_HOST_DEVICE void operator()(long long i, PassSums&) const {
        if (i == 0) s.sums[0] = s.sums[1] = PassSums{}; // the next launches add to them
        const int l = locate(s.constrained, i);
        const DeviceLevel& level = s.levels[l];
        constexpr int h = halo_width;
        const int width = level.nx + 2 * h;
        const int x = static_cast<int>(i % width) - h, y = static_cast<int>(i / width) - h;
        const VectorPlane<double> fine = level.u[s.now][level.cells];
        if (l + 1 == s.constrained.levels) {
            fine.z(x, y) = s.top;
            return;
        }
        const VectorPlane<double> coarse = s.levels[l + 1].u[s.now][0];
        const int gy = level.seam.fine_y0 + y, gx = level.seam.fine_x0 + x;
        const auto value = [&](const PlaneView<double>& c) {
            const double* low = c.line((gy >> 1) - level.seam.coarse_y0) - level.seam.coarse_x0;
            const double* high =
                c.line(((gy + 1) >> 1) - level.seam.coarse_y0) - level.seam.coarse_x0;
            return interpolated_node(low, high, gx);
        };
        fine.x(x, y) = value(coarse.x);
        fine.y(x, y) = value(coarse.y);
        fine.z(x, y) = value(coarse.z);
    }
};

/// Returns the force on the node at element `at`, small strain.
template <Face face>
ASPERITY_INLINE Triple<Number> small_force(const VectorVolume<const double>& u, std::ptrdiff_t at,
                                           const Stencil& stencil) {
    const Weights<Number, face> weights(stencil);
    const Around around(u.x.row, u.x.plane);
    const auto columns = [&](std::ptrdiff_t x) {
        ColumnParts<Number> parts;
        column_parts(u.x.origin + x, u.y.origin + x, u.z.origin + x, around, weights, parts);
        return parts;
    };
    const ColumnParts<Number> west = columns(at - 1), here = columns(at), east = columns(at + 1);
    const auto force = [&](int k) { return (east.west[k] + west.east[k]) + here.here[k]; };
    return {force(0), force(1), force(2)};
}

/// Computes the force on node i of the upper faces.
ASPERITY_INLINE void upper_face(const DeviceStep& s, long long i, PassSums& sums) {
    const int l = locate(s.faces, i);
    const DeviceLevel& level = s.levels[l];
    const int width = level.nx + 2;
    const int x = static_cast<int>(i % width) - 1, y = static_cast<int>(i / width) - 1;
    const VectorVolume<const double> u = level.u[s.now];
    const std::ptrdiff_t at = level.cells * u.x.plane + y * u.x.row + x;
    const Triple<Number> f = small_force<Face::upper>(u, at, level.upper);
    level.upper_force.x(x, y) = f.x.r;
    level.upper_force.y(x, y) = f.y.r;
    level.upper_force.z(x, y) = f.z.r;
    const bool inside = x >= 0 && x < level.nx && y >= 0 && y < level.ny;
    if (l + 1 == s.faces.levels && level.counted && inside) sums.sum[ForceSum::top_z].add(f.z.r);
}

/// Forces of the interface's sites, then of the upper faces.
template <class P, bool observe>
struct Forces {
    DeviceStep s;
    PairTerms<Scalar, double, P> pair;
    Offsets<double> offsets;
    Pair<P> reference; ///< formulas for sites that the tables do not cover
    Tail<P> tail;

    Forces(const DeviceStep& step, const P& potential)
        : s(step), pair(potential), offsets(step.sites.spacing, step.lattice.half_offsets),
          reference(potential), tail(potential, step.tail_density) {}

    ASPERITY_HOST_DEVICE void operator()(long long i, PassSums& sums) const {
        const int nx = s.sites.displacement.x.nx;
        const long long sites = static_cast<long long>(nx) * s.sites.displacement.x.ny;
        if (i < sites)
            site(static_cast<int>(i % nx), static_cast<int>(i / nx), sums);
        else
            upper_face(s, i - sites, sums);
    }

private:
    ASPERITY_HOST_DEVICE void site(int x, int y, PassSums& sums) const {
        const LatticeSubstrate& atoms = s.lattice;
        const double datum = atoms.heights.datum;
        const SiteBlock<Number, 1> site(s.sites, x, y, 1, datum, {}, atoms.reach.offset_margin);
        const Reach reach(atoms.reach, x, y, datum, site, pair.cutoff, pair.closest);
        const auto& u = s.sites.displacement;
        SiteTotal total{{0.0, 0.0, 0.0}, 0.0, no_pair};
        if (site.beyond) {
            const PairSum p = sum_of_pairs(atoms.map, reference,
                                           (s.sites.x0 + x + 0.5) * s.sites.spacing + u.x(x, y),
                                           (s.sites.y0 + y + 0.5) * s.sites.spacing + u.y(x, y),
                                           s.sites.reference_height + u.z(x, y));
            total = {{p.force[0], p.force[1], p.force[2]}, p.energy, p.nearest_r2};
        } else if (reach.any()) {
            total = sum_pairs(x, y, site, reach);
        }
        SiteForce& force = total.force;
        sums.sum[ForceSum::interface_z].add(force.z);
        if constexpr (observe) sums.sum[ForceSum::interface_energy].add(total.energy);
        if constexpr (P::has_tail)
            if (s.with_tail) {
                const double gap = s.sites.reference_height + u.z(x, y) - s.mean_height(x, y);
                const double beyond = tail.force(gap);
                if constexpr (observe) sums.sum[ForceSum::interface_energy].add(tail.energy(gap));
                force.z += beyond;
                sums.sum[ForceSum::interface_z].add(beyond);
            }
        s.sites.force.x(x, y) = force.x;
        s.sites.force.y(x, y) = force.y;
        s.sites.force.z(x, y) = force.z;
        sums.sum[ForceSum::lowest_z].add(u.z(x, y));
        if constexpr (observe) {
            sums.count[ForceSum::in_contact] += total.nearest < pair.contact_r2 ? 1.0 : 0.0;
            sums.count[ForceSum::repulsive] += force.z > 0.0 ? 1.0 : 0.0;
            sums.least = total.nearest < sums.least ? total.nearest : sums.least;
        }
    }

    ASPERITY_INLINE SiteTotal sum_pairs(int x, int y, const SiteBlock<Number, 1>& site,
                                        const Reach& reach) const {
        const LatticeSubstrate& atoms = s.lattice;
        const Columns all(atoms, static_cast<int>(reach.from_rest * atoms.cuts_per_length) + 1);
        const Columns within(atoms, static_cast<int>(reach.inside * atoms.cuts_per_length));
        const PlaneView<const double>& heights = atoms.heights.height;
        const auto pairs = sum_lattice<Scalar, double, observe, true>(
            SiteHeight<Scalar, double>(site.z), lengths<Scalar, double>(site.ux),
            lengths<Scalar, double>(site.uy), all, within, heights.line(y) + x, heights.row,
            atoms.half_offsets, offsets, pair);
        SiteTotal total{site_force(pair, site.ux[0], site.uy[0], pairs.f.r, pairs.f_cx.r,
                                   pairs.f_cy.r, pairs.f_z.r),
                        0.0, no_pair};
        if constexpr (observe) {
            total.energy = pair.energy_scale * pairs.energy.r;
            total.nearest = pair.nearest(pairs.nearest.r);
        }
        return total;
    }
};

/// Returns the force on coarse node (x, y) from the upper face of the finer level.
ASPERITY_INLINE Triple<Number> restricted_force(const DeviceLevel& fine, int x, int y) {
    const LevelSeam& seam = fine.seam;
    const int fx = 2 * (seam.coarse_x0 + x) - seam.fine_x0;
    const int fy = 2 * (seam.coarse_y0 + y) - seam.fine_y0;
    const auto sum = [&](const PlaneView<double>& f) {
        return Number(restricted_node(f.line(fy) + fx, f.row));
    };
    return {sum(fine.upper_force.x), sum(fine.upper_force.y), sum(fine.upper_force.z)};
}

/// Restriction into the transferred forces of a level that every rank holds.
struct RestrictToShared {
    DeviceStep s;
    int coarse;
    Patch nodes;
    ASPERITY_HOST_DEVICE void operator()(long long i, PassSums&) const {
        const int width = nodes.x1 - nodes.x0;
        const int x = nodes.x0 + static_cast<int>(i % width);
        const int y = nodes.y0 + static_cast<int>(i / width);
        const auto f = restricted_force(s.levels[coarse - 1], x, y);
        const VectorPlane<double>& to = s.levels[coarse].transferred;
        to.x(x, y) = f.x.r;
        to.y(x, y) = f.y.r;
        to.z(x, y) = f.z.r;
    }
};

/// Places x + k n of a coordinate in the halo or the tile: from first on, below end; x itself if
/// another tile holds the images.
struct Images {
    int first, end;
    ASPERITY_INLINE Images(int x, int n, bool wraps)
        : first(x), end(wraps ? n + halo_width : x + 1) {
        while (wraps && first - n >= -halo_width)
            first -= n;
    }
};

/// Writes a node of a plane and its periodic images. x, y: owned along every axis that wraps.
ASPERITY_INLINE void write_images(const PlaneView<double>& u, const DeviceLevel& level, int x,
                                  int y, bool wraps_x, double value) {
    const Images along_x(x, level.nx, wraps_x), along_y(y, level.ny, level.wraps_y);
    for (int j = along_y.first; j < along_y.end; j += level.ny)
        for (int i = along_x.first; i < along_x.end; i += level.nx)
            u(i, j) = value;
}

/// Elastic forces, kick, drift and noise of the moving nodes.
template <bool observe, bool noisy>
struct Advance {
    DeviceStep s;

    ASPERITY_HOST_DEVICE void operator()(long long i, PassSums& all) const {
        const int l = locate(s.moving, i);
        const DeviceLevel& level = s.levels[l];
        const int x = static_cast<int>(i % level.nx);
        const long long row = i / level.nx;
        const int y = static_cast<int>(row % level.ny), z = static_cast<int>(row / level.ny);
        const VectorVolume<const double> u = level.u[s.now];
        const std::ptrdiff_t at = z * u.x.plane + y * u.x.row + x;
        Triple<Number> in{};
        if (z == 0)
            in = level.in_line
                     ? restricted_force(s.levels[l - 1], x, y)
                     : Triple<Number>{level.transferred.x(x, y), level.transferred.y(x, y),
                                      level.transferred.z(x, y)};
        const Triple<Number> f = z == 0 ? small_force<Face::lower>(u, at, level.lower) + in
                                        : small_force<Face::inner>(u, at, level.inner);
        PassSums sums;
        const Kick& kick = s.kicks[l](z);
        [[maybe_unused]] const std::ptrdiff_t of_v = z * level.v.x.plane + y * level.v.x.row + x;
        [[maybe_unused]] Triple<double> old{};
        if constexpr (noisy)
            old = {level.v.x.origin[of_v], level.v.y.origin[of_v], level.v.z.origin[of_v]};
        const Triple<Number> v = kick.damped ? kicked<true>(kick, level, z, y, x, f, sums)
                                             : kicked<false>(kick, level, z, y, x, f, sums);
        const Number dt(s.dt);
        Triple<double> moved = {fma(dt, v.x, Number(u.x.origin[at])).r,
                                fma(dt, v.y, Number(u.y.origin[at])).r,
                                fma(dt, v.z, Number(u.z.origin[at])).r};
        if constexpr (noisy)
            if (kick.damped) {
                Triple<double> speed = {v.x.r, v.y.r, v.z.r};
                const auto xi = normals(s.noise, level.number, level.x0 + x, level.y0 + y, z);
                const NoiseEnergies given =
                    add_noise(s.noise, 2.0 * kick.half_mass, xi, old, speed, moved);
                sums.sum[AdvanceSum::heat].add(given.heat);
                if constexpr (observe) sums.sum[AdvanceSum::kinetic].add(given.kinetic);
                level.v.x.origin[of_v] = speed.x;
                level.v.y.origin[of_v] = speed.y;
                level.v.z.origin[of_v] = speed.z;
            }
        const VectorPlane<double> next = level.u[1 - s.now][z];
        write_images(next.x, level, x, y, level.wraps_x, moved.x);
        write_images(next.y, level, x, y, level.wraps_x, moved.y);
        write_images(next.z, level, x, y, level.wraps_x, moved.z);
        if constexpr (observe)
            sums.sum[AdvanceSum::elastic].add(cell_energy<Number>(u, at, level.cell.elasticity).r);
        if (level.counted) merge(all, sums);
    }

private:
    template <bool damped>
    ASPERITY_INLINE Triple<Number> kicked(const Kick& plan, const DeviceLevel& level, int z, int y,
                                          int x, const Triple<Number>& f, PassSums& sums) const {
        Kicker<Number, damped, observe> kicker(plan, level.v);
        const auto v = kicker(z * level.v.x.plane + y * level.v.x.row + x, 1, f);
        KickSums added;
        kicker.end_row();
        kicker.add_to(added);
        if constexpr (observe) sums.sum[AdvanceSum::kinetic].merge(added.kinetic);
        if constexpr (observe) sums.sum[AdvanceSum::of_step].merge(added.of_step);
        if constexpr (damped) {
            sums.sum[AdvanceSum::dissipated].merge(added.dissipated);
            sums.sum[AdvanceSum::dragged].merge(added.dragged);
        }
        return v;
    }
};

/// Strips of halo, copied to messages or from them. Node i of a strip is component, plane, row,
/// column.
template <bool packs>
struct Halo {
    DeviceStep s;
    DeviceHalo halo;

    ASPERITY_HOST_DEVICE void operator()(long long i, PassSums&) const {
        constexpr int h = halo_width;
        double& message = halo.messages[i];
        const bool high = i >= halo.strip.first[halo.strip.levels];
        if (high) i -= halo.strip.first[halo.strip.levels];
        const int l = locate(halo.strip, i);
        const DeviceLevel& level = s.levels[l];
        const int width = halo.along_x ? h : level.nx + 2 * h;
        const int rows = halo.along_x ? level.ny : h;
        const int n = halo.along_x ? level.nx : level.ny;
        const int begin = packs ? (high ? n - h : 0) : (high ? n : -h);
        const int x = static_cast<int>(i % width) + (halo.along_x ? begin : -h);
        long long remainder = i / width;
        const int y = static_cast<int>(remainder % rows) + (halo.along_x ? 0 : begin);
        remainder /= rows;
        const int z = static_cast<int>(remainder % level.cells);
        const int component = static_cast<int>(remainder / level.cells);
        const VectorVolume<double>& u = level.u[halo.buffer];
        const PlaneView<double> plane = (component == 0 ? u.x : component == 1 ? u.y : u.z)[z];
        if constexpr (packs)
            message = plane(x, y);
        else if (halo.along_x)
            write_images(plane, level, x, y, false, message);
        else
            plane(x, y) = message;
    }
};

inline const char* interpolate(const DeviceStep& s) {
    return launch<false>(Interpolate{s}, s.constrained.first[s.constrained.levels], nullptr);
}

inline const char* forces(const DeviceStep& s, const PairPotential& potential) {
    const long long nodes =
        static_cast<long long>(s.sites.displacement.x.nx) * s.sites.displacement.x.ny +
        s.faces.first[s.faces.levels];
    return std::visit(
        [&]<class P>(const P& p) {
            return s.observe ? launch<true>(Forces<P, true>(s, p), nodes, s.sums)
                             : launch<true>(Forces<P, false>(s, p), nodes, s.sums);
        },
        potential);
}

inline const char* restrict_to_shared(const DeviceStep& s, int coarse, Patch nodes) {
    return launch<false>(RestrictToShared{s, coarse, nodes},
                         static_cast<long long>(nodes.x1 - nodes.x0) * (nodes.y1 - nodes.y0),
                         nullptr);
}

inline const char* advance(const DeviceStep& s) {
    const long long nodes = s.moving.first[s.moving.levels];
    PassSums* sums = s.sums + 1;
    if (s.noisy)
        return s.observe ? launch<true>(Advance<true, true>{s}, nodes, sums)
                         : launch<true>(Advance<false, true>{s}, nodes, sums);
    if (s.observe) return launch<true>(Advance<true, false>{s}, nodes, sums);
    return s.damped ? launch<true>(Advance<false, false>{s}, nodes, sums)
                    : launch<false>(Advance<false, false>{s}, nodes, nullptr);
}

template <bool packs>
const char* halo(const DeviceStep& s, const DeviceHalo& h) {
    return launch<false>(Halo<packs>{s, h}, 2 * h.strip.first[h.strip.levels], nullptr);
}

DeviceFunctions functions_with(auto allocate, auto release, auto copy) {
    return {allocate,           release, copy,       interpolate, forces,
            restrict_to_shared, advance, halo<true>, halo<false>};
}

} // namespace asperity::ASPERITY_VARIANT
