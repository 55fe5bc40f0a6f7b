// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/waves/subsurface.hpp"

#include "engine/waves/stiffness_table.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <iterator>
#include <map>
#include <numbers>
#include <span>

namespace asperity {

namespace {

using Complex = std::complex<double>;

/// q z beyond which the stress of a wave is below rounding.
constexpr double decayed = 45.0;

/// A tensor of the coefficients of a wave.
struct WaveTensor {
    Complex xx, yy, zz, xy, xz, yz;
};

/// Adds the stress of a wave of the direction (c, s) to a tensor in the directions of the box.
void add_rotated(const WaveStress& of, double c, double s, double weight, Complex pressure,
                 Complex shear_x, Complex shear_y, WaveTensor& to) {
    constexpr Complex i(0.0, 1.0);
    const Complex along = c * shear_x + s * shear_y, across = c * shear_y - s * shear_x;
    const Complex ll = of.pressure.xx * pressure + i * of.shear.xx * along;
    const Complex zz = of.pressure.zz * pressure + i * of.shear.zz * along;
    const Complex lz = i * of.pressure.xz * pressure + of.shear.xz * along;
    const Complex tt = of.poisson * (ll + zz);
    const Complex tz = of.across.yz * across, lt = i * of.across.xy * across;
    to.xx += weight * (c * c * ll + s * s * tt - 2.0 * c * s * lt);
    to.yy += weight * (s * s * ll + c * c * tt + 2.0 * c * s * lt);
    to.zz += weight * zz;
    to.xy += weight * (c * s * (ll - tt) + (c * c - s * s) * lt);
    to.xz += weight * (c * lz - s * tz);
    to.yz += weight * (s * lz + c * tz);
}

/// Returns the stress of a wave. Components of q along which the wave is the shortest stand for
/// both signs.
WaveTensor tensor(const WaveStress& of, double qx, double qy, bool both_x, bool both_y,
                  Complex pressure, Complex shear_x, Complex shear_y) {
    const double q = std::hypot(qx, qy), c = qx / q, s = qy / q;
    const double weight = (both_x ? 0.5 : 1.0) * (both_y ? 0.5 : 1.0);
    WaveTensor found;
    for (int x = 0; x <= (both_x ? 1 : 0); ++x)
        for (int y = 0; y <= (both_y ? 1 : 0); ++y)
            add_rotated(of, x ? -c : c, y ? -s : s, weight, pressure, shear_x, shear_y, found);
    return found;
}

/// Returns a component of a wave in a block.
Complex get(const double* block, const Slab& slab, int component, int column, int row) {
    const double* const at =
        block + slab.block_length(component) +
        2 * (block_columns * static_cast<std::size_t>(row) + static_cast<std::size_t>(column));
    return {at[0], at[1]};
}

/// Sets a component of a wave in a block.
void put(Complex value, double* block, const Slab& slab, int component, int column, int row) {
    double* const at =
        block + slab.block_length(component) +
        2 * (block_columns * static_cast<std::size_t>(row) + static_cast<std::size_t>(column));
    at[0] = value.real();
    at[1] = value.imag();
}

/// Calls work(block, column, row, nx, ny) for every wave of this rank, with ny of both signs.
template <class Work>
void each_wave(const Slab& slab, const Work& work) {
    const int width = static_cast<int>(block_columns);
#pragma omp parallel for schedule(dynamic)
    for (int b = 0; b < slab.blocks(); ++b) {
        const int first = slab.first_column() + b * width;
        for (int column = 0; column < std::min(width, slab.columns() - first); ++column)
            for (int row = 0; row < slab.sites; ++row)
                work(b, column, row, first + column, 2 * row > slab.sites ? row - slab.sites : row);
    }
}

std::vector<SolidLayer> solid_of(const BlockOptions& block) {
    BlockOptions deep = block;
    if (block.free_edges) deep.thickness = 1 << 30;
    return deep.solid();
}

} // namespace

SurfaceTractions with_friction(std::vector<double> pressure, double coefficient) {
    SurfaceTractions tractions{std::move(pressure), {}, {}};
    if (coefficient == 0.0) return tractions;
    for (const double p : tractions.pressure)
        tractions.shear_x.push_back(-coefficient * std::max(p, 0.0));
    tractions.shear_y.assign(tractions.pressure.size(), 0.0);
    return tractions;
}

SurfaceTractions with_slopes(const BlockOptions& block, std::vector<double> pressure,
                             const std::vector<double>& height) {
    const int n = block.sites;
    const Slab slab(n, Communicator());
    const SurfaceTransform<double> one(slab, 1), three(slab, 3);
    SiteField<double> heights = site_field<double>(slab, 1);
    for (int y = 0; y < n; ++y)
        std::copy_n(height.begin() + y * n, n, heights[0].plane(0).line(y));
    Waves<double> waves(slab, 1), slopes(slab, 3);
    to_waves(heights, one, waves);
    const double unit = 2.0 * std::numbers::pi / block.edge(), norm = 1.0 / (1.0 * n * n);
    each_wave(slab, [&](int b, int column, int row, int nx, int ny) {
        const Complex h = norm * get(waves.block(b), slab, 0, column, row);
        // The slope of the shortest wave along an axis vanishes at the sites.
        const double qx = 2 * nx == n ? 0.0 : unit * nx, qy = 2 * row == n ? 0.0 : unit * ny;
        put(Complex(0.0, qx) * h, slopes.block(b), slab, 0, column, row);
        put(Complex(0.0, qy) * h, slopes.block(b), slab, 1, column, row);
    });
    SiteField<double> slope = site_field<double>(slab, 3);
    to_sites(slopes, three, slope);
    SurfaceTractions tractions{std::move(pressure), {}, {}};
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
            const double p = tractions.pressure[static_cast<std::size_t>(y * n + x)];
            tractions.shear_x.push_back(-p * slope[0].plane(0)(x, y));
            tractions.shear_y.push_back(-p * slope[1].plane(0)(x, y));
        }
    return tractions;
}

namespace {

/// Returns the waves of tractions, of which each value stands for repeat x repeat points of the
/// slab from its first on.
Waves<double> waves_of(const SurfaceTractions& tractions, int sites, int repeat, const Slab& slab,
                       const SurfaceTransform<double>& transform) {
    SiteField<double> field = site_field<double>(slab, 3);
    const std::vector<double>* const of[3] = {&tractions.shear_x, &tractions.shear_y,
                                              &tractions.pressure};
    for (std::size_t k = 0; k < 3; ++k) {
        if (of[k]->empty()) continue;
        const PlaneView<double> to = field[k].plane(0);
        for (int y = 0; y < sites * repeat; ++y)
            for (int x = 0; x < sites * repeat; ++x)
                to(x, y) = (*of[k])[static_cast<std::size_t>(y / repeat) *
                                        static_cast<std::size_t>(sites) +
                                    static_cast<std::size_t>(x / repeat)];
    }
    Waves<double> waves(slab, 3);
    to_waves(field, transform, waves);
    combine(0.0, waves, 1.0 / (1.0 * slab.sites * slab.sites), waves);
    return waves;
}

/// Sets waves on a grid that is finer by a factor to those of the sites: the points of a site are
/// around its middle.
void interpolate(const Waves<double>& sites, int factor, Waves<double>& finer) {
    const Slab &from = sites.slab(), &to = finer.slab();
    const double shift = std::numbers::pi * (1.0 / factor - 1.0) / from.sites; // phase of wave 1
    const int width = static_cast<int>(block_columns);
    each_wave(from, [&](int b, int column, int row, int nx, int ny) {
        const bool both_x = 2 * nx == from.sites, both_y = 2 * ny == from.sites;
        const double share = (both_x ? 0.5 : 1.0) * (both_y ? 0.5 : 1.0);
        const auto add = [&](int y) {
            for (int c = 0; c < 3; ++c)
                put(share * std::polar(1.0, shift * (nx + y)) *
                        get(sites.block(b), from, c, column, row),
                    finer.block(nx / width), to, c, nx % width, y < 0 ? to.sites + y : y);
        };
        add(ny);
        if (both_y) add(-ny);
    });
}

} // namespace

Subsurface::Subsurface(const BlockOptions& block, const SurfaceTractions& tractions, int refinement,
                       WithinSite within, int padding)
    : layers_(solid_of(block)), free_edges_(block.free_edges), points_(block.sites * refinement),
      step_(block.spacing / refinement),
      slab_((block.free_edges ? padding : 1) * block.sites * refinement, Communicator()),
      transform_(slab_, 3), tractions_(slab_, 3) {
    if (within == WithinSite::constant || refinement == 1) {
        tractions_ = waves_of(tractions, block.sites, refinement, slab_, transform_);
    } else {
        const Slab sites(slab_.sites / refinement, Communicator());
        interpolate(waves_of(tractions, block.sites, 1, sites, SurfaceTransform<double>(sites, 3)),
                    refinement, tractions_);
    }
    if (block.surface_stress == 0.0) return;
    const double unit = 2.0 * std::numbers::pi / (slab_.sites * step_);
    each_wave(slab_, [&](int b, int column, int row, int nx, int ny) {
        if (nx == 0 && ny == 0) return;
        const double qx = unit * nx, qy = unit * ny;
        const double s = 1.0 / inverse(continuum_stiffness(layers_, qx, qy)).zz;
        const double borne = block.surface_stress * (qx * qx + qy * qy);
        double* const waves = tractions_.block(b);
        put(get(waves, slab_, 2, column, row) * (s / (s + borne)), waves, slab_, 2, column, row);
    });
}

std::vector<Stress> Subsurface::at(double depth) const {
    Waves<double> normal(slab_, 3), shear(slab_, 3); // xx, yy, zz and xy, xz, yz
    const int sites = slab_.sites;
    const double unit = 2.0 * std::numbers::pi / (sites * step_);
    each_wave(slab_, [&](int b, int column, int row, int nx, int ny) {
        const double qx = unit * nx, q = std::hypot(qx, unit * ny);
        if (ny < 0 || q == 0.0 || q * depth > decayed) return;
        const WaveStress of = subsurface_stress(layers_, q, std::span(&depth, 1)).front();
        const bool both_x = 2 * nx == sites, both_y = 2 * ny == sites;
        const auto add = [&](int at, double qy) {
            const auto in = [&](int c) { return get(tractions_.block(b), slab_, c, column, at); };
            const WaveTensor t = tensor(of, qx, qy, both_x, both_y, in(2), in(0), in(1));
            const Complex values[2][3] = {{t.xx, t.yy, t.zz}, {t.xy, t.xz, t.yz}};
            for (int c = 0; c < 3; ++c) {
                put(values[0][c], normal.block(b), slab_, c, column, at);
                put(values[1][c], shear.block(b), slab_, c, column, at);
            }
        };
        add(row, unit * ny);
        if (ny > 0 && !both_y) add(sites - ny, -unit * ny);
    });
    const double pressure = tractions_.uniform(2);
    const double lateral = uniform_lateral_stress(layers_, depth, free_edges_) * pressure;
    normal.uniform(0) = normal.uniform(1) = lateral;
    normal.uniform(2) = -pressure;
    shear.uniform(1) = -tractions_.uniform(0);
    shear.uniform(2) = -tractions_.uniform(1);
    SiteField<double> of_normal = site_field<double>(slab_, 3);
    SiteField<double> of_shear = site_field<double>(slab_, 3);
    to_sites(normal, transform_, of_normal);
    to_sites(shear, transform_, of_shear);
    std::vector<Stress> stresses;
    stresses.reserve(static_cast<std::size_t>(points_) * static_cast<std::size_t>(points_));
    for (int y = 0; y < points_; ++y)
        for (int x = 0; x < points_; ++x)
            stresses.push_back({of_normal[0].plane(0)(x, y), of_normal[1].plane(0)(x, y),
                                of_normal[2].plane(0)(x, y), of_shear[0].plane(0)(x, y),
                                of_shear[1].plane(0)(x, y), of_shear[2].plane(0)(x, y)});
    return stresses;
}

std::array<double, 3> measures(const Stress& s) {
    const std::array<double, 3> principal = principal_stresses(s);
    return {von_mises(s), principal[0] - principal[2], principal[0]};
}

namespace {

/// The largest measures of the points at a depth, and their points.
struct Extremes {
    std::array<double, 3> value{};
    std::array<std::size_t, 3> point{};
};

Extremes extremes(const std::vector<Stress>& stresses) {
    constexpr std::size_t part = 4096; // each thread's, in order: the first of equal values counts
    std::vector<Extremes> of_part((stresses.size() + part - 1) / part);
#pragma omp parallel for schedule(static)
    for (std::size_t k = 0; k < of_part.size(); ++k) {
        of_part[k].value.fill(-HUGE_VAL);
        for (std::size_t i = k * part; i < std::min(stresses.size(), (k + 1) * part); ++i) {
            const std::array<double, 3> values = measures(stresses[i]);
            for (std::size_t m = 0; m < values.size(); ++m)
                if (values[m] > of_part[k].value[m]) {
                    of_part[k].value[m] = values[m];
                    of_part[k].point[m] = i;
                }
        }
    }
    Extremes found = of_part.front();
    for (const Extremes& other : of_part)
        for (std::size_t m = 0; m < found.value.size(); ++m)
            if (other.value[m] > found.value[m]) {
                found.value[m] = other.value[m];
                found.point[m] = other.point[m];
            }
    return found;
}

/// Returns how far the parabola through a largest value and its neighbours rises above it.
double rise_between(double x0, double y0, double x1, double y1, double x2, double y2) {
    const double left = (y1 - y0) / (x1 - x0), right = (y2 - y1) / (x2 - x1);
    const double curvature = (right - left) / (x2 - x0);
    if (curvature >= 0.0) return 0.0;
    const double slope = left + curvature * (x1 - x0);
    return -0.25 * slope * slope / curvature;
}

using Depths = std::map<double, Extremes>;

/// Searches between the depths around the largest value of a measure until it changes by less
/// than 1e-3, four times at most. Sets value, depth and between_depths.
void refine(const Subsurface& field, std::size_t m, double from, double to, Depths& all,
            LargestStress& largest) {
    const auto better = [m](const auto& a, const auto& b) {
        return a.second.value[m] < b.second.value[m];
    };
    const auto first = [&] { return all.lower_bound(from); };
    const auto last = [&] { return all.upper_bound(to); };
    auto best = std::max_element(first(), last(), better);
    double change = 0.0;
    for (int turn = 0; turn < 4; ++turn) {
        const double before = best->second.value[m];
        std::vector<double> middle;
        if (best != first()) middle.push_back(0.5 * (std::prev(best)->first + best->first));
        if (std::next(best) != last())
            middle.push_back(0.5 * (best->first + std::next(best)->first));
        for (const double depth : middle)
            all.try_emplace(depth, extremes(field.at(depth)));
        best = std::max_element(first(), last(), better);
        change = best->second.value[m] - before;
        if (change < 1e-3 * std::abs(before)) break;
    }
    largest.value = best->second.value[m];
    largest.depth = best->first;
    largest.between_depths = change;
    if (best != first() && std::next(best) != last()) {
        const auto left = std::prev(best), right = std::next(best);
        largest.between_depths =
            std::max(change, rise_between(left->first, left->second.value[m], best->first,
                                          largest.value, right->first, right->second.value[m]));
    }
}

} // namespace

StressSearch search_stresses(const BlockOptions& block, const SurfaceTractions& tractions) {
    const Subsurface field(block, tractions), fine(block, tractions, 2);
    const Subsurface flat(block, tractions, 2, WithinSite::constant);
    const double shallowest = 0.5 * block.spacing;
    double thickness = 0.0;
    for (const SolidLayer& layer : field.layers())
        thickness += layer.thickness;
    const double deepest = std::min(0.5 * block.edge(), 0.999 * thickness);
    StressSearch search;
    double from = 0.0;
    for (const SolidLayer& layer : field.layers()) {
        if (from >= deepest) break;
        const double to = std::min(from + layer.thickness, deepest);
        search.layers.push_back({from, to, {}});
        from = to;
    }
    Depths all;
    const auto look = [&](double depth) { all.try_emplace(depth, extremes(field.at(depth))); };
    for (double depth = shallowest; depth < deepest; depth *= std::numbers::sqrt2)
        look(depth);
    for (std::size_t i = 0; i < search.layers.size(); ++i) {
        LayerStresses& layer = search.layers[i];
        if (layer.to < shallowest) {
            for (LargestStress& largest : layer.largest)
                largest.reason = "the layer is thinner than half the spacing of the sites";
            continue;
        }
        // The other side of a boundary is the next number.
        const double least =
            std::max(layer.from > 0.0 ? std::nextafter(layer.from, HUGE_VAL) : 0.0, shallowest);
        look(least);
        look(layer.to);
        for (std::size_t m = 0; m < stress_measures.size(); ++m) {
            LargestStress& largest = layer.largest[m];
            refine(field, m, least, layer.to, all, largest);
            if (largest.depth <= shallowest)
                largest.reason = "it lies less than half a spacing below the surface, where the "
                                 "pressure within a site counts";
            else if (largest.depth >= deepest)
                largest.reason = "it lies deeper than half the edge of the box, or at the block's "
                                 "upper end";
        }
    }
    std::map<double, std::pair<Extremes, Extremes>> finer; // for waves and constant tractions
    std::map<double, Extremes> farther;                    // with images twice as far
    std::optional<Subsurface> wide;
    if (block.free_edges) wide.emplace(block, tractions, 1, WithinSite::waves, 4);
    for (LayerStresses& layer : search.layers)
        for (std::size_t m = 0; m < stress_measures.size(); ++m) {
            LargestStress& largest = layer.largest[m];
            if (largest.depth == 0.0) continue;
            const auto [at, is_new] = finer.try_emplace(largest.depth);
            auto& [waves, constant] = at->second;
            if (is_new)
                waves = extremes(fine.at(at->first)), constant = extremes(flat.at(at->first));
            largest.between_points = std::abs(waves.value[m] - largest.value);
            for (std::size_t k = 0; k < stress_measures.size(); ++k)
                largest.within_site =
                    std::max(largest.within_site, std::abs(constant.value[k] - waves.value[k]));
            largest.value = waves.value[m];
            if (wide) { // a change by images halves at least with twice the distance
                const auto [far, unknown] = farther.try_emplace(largest.depth);
                if (unknown) far->second = extremes(wide->at(largest.depth));
                largest.images =
                    4.0 / 3.0 * std::abs(far->second.value[m] - all.at(largest.depth).value[m]);
            }
            const auto n = static_cast<std::size_t>(fine.points());
            largest.x = fine.place(static_cast<int>(waves.point[m] % n));
            largest.y = fine.place(static_cast<int>(waves.point[m] / n));
        }
    for (const auto& [depth, values] : all) {
        search.depth.push_back(depth);
        search.largest.push_back(values.value);
    }
    return search;
}

void displace_surface(const BlockOptions& block, const Slab& slab, SiteField<double>& field) {
    const StiffnessTable table(block, slab, true);
    const SurfaceTransform<double> transform(slab, 1);
    for (int y = 0; y < slab.rows; ++y) // no solid is below the sites around the box
        std::fill(field[0].plane(0).line(y) + (slab.first + y < block.sites ? block.sites : 0),
                  field[0].plane(0).line(y) + slab.sites, 0.0);
    Waves<double> waves(slab, 1);
    to_waves(field, transform, waves);
    const double force = block.spacing * block.spacing / (1.0 * slab.sites * slab.sites);
    each_wave(slab, [&](int b, int column, int row, int nx, int ny) {
        const bool uniform = nx == 0 && ny == 0;
        const double s = uniform ? table.uniform() : table.at(nx, std::abs(ny)).zz;
        put(get(waves.block(b), slab, 0, column, row) * (force / s), waves.block(b), slab, 0,
            column, row);
    });
    to_sites(waves, transform, field);
}

} // namespace asperity
