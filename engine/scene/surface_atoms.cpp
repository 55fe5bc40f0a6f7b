// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A substrate of atoms at positions of their own, as a Surface.
#include "engine/scene/surface.hpp"

#include "io/height_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <tuple>

namespace asperity {

namespace {

/// No two atoms of a solid are as close, Å.
constexpr double least_distance = 0.5;

/// Refuses coinciding atoms. Periodic images count: an atom on the box's edge may have been written
/// on both sides.
void refuse_coinciding(const AtomPositions& atoms, double edge) {
    struct Place {
        double row, x, y, z; ///< row of height least_distance along y
        std::size_t atom;
    };
    std::vector<Place> places;
    places.reserve(atoms.size() + atoms.size() / 16);
    for (std::size_t i = 0; i < atoms.size(); ++i)
        for (const double shift_y : {0.0, edge})
            for (const double shift_x : {0.0, edge}) {
                const double x = atoms.x[i] + shift_x, y = atoms.y[i] + shift_y;
                if (x < edge + least_distance && y < edge + least_distance)
                    places.push_back({std::floor(y / least_distance), x, y, atoms.z[i], i});
            }
    const auto in_order = [](const Place& a, const Place& b) {
        return std::tie(a.row, a.x, a.atom) < std::tie(b.row, b.x, b.atom);
    };
    std::sort(places.begin(), places.end(), in_order);
    const auto compare = [&](const Place& a, std::size_t from, double row) {
        for (std::size_t k = from; k < places.size(); ++k) {
            const Place& b = places[k];
            if (b.row != row || b.x - a.x >= least_distance) return;
            const double distance = std::hypot(b.x - a.x, b.y - a.y, b.z - a.z);
            if (distance >= least_distance || a.atom == b.atom) continue;
            throw std::invalid_argument(fmt::format(
                "atoms {} and {} of the substrate are {:.3g} Å apart, less than {} Å; give each "
                "atom of the periodic box once, one on its edge too",
                std::min(a.atom, b.atom) + 1, std::max(a.atom, b.atom) + 1, distance,
                least_distance));
        }
    };
    for (std::size_t k = 0; k < places.size(); ++k) {
        const Place& a = places[k];
        compare(a, k + 1, a.row);
        Place from = a;
        from.row += 1.0;
        from.x -= least_distance;
        from.atom = 0;
        compare(
            a,
            static_cast<std::size_t>(
                std::lower_bound(places.begin(), places.end(), from, in_order) - places.begin()),
            from.row);
    }
}

} // namespace

Surface surface_from_atoms(const SurfaceOptions& o, AtomPositions atoms) {
    if (atoms.size() == 0) throw std::invalid_argument("the substrate has no atoms");
    refuse_coinciding(atoms, o.length);
    const auto n = static_cast<std::size_t>(o.sites);
    const double none = std::numeric_limits<double>::quiet_NaN();
    std::vector<double> height(n * n, none);
    const double spacing = o.length / o.sites;
    // The points of the map are at (i, j) times the spacing, as the atoms of a lattice. An atom
    // half way between some of them (files have three digits and more) is nearest to each.
    constexpr double half_way = 0.5 + 1e-3;
    for (std::size_t k = 0; k < atoms.size(); ++k) {
        const double x = atoms.x[k] / spacing, y = atoms.y[k] / spacing;
        for (double j = std::ceil(y - half_way); j <= y + half_way; ++j)
            for (double i = std::ceil(x - half_way); i <= x + half_way; ++i) {
                const auto periodic = [&](double at) {
                    return static_cast<std::size_t>(at + o.sites) % n;
                };
                double& top = height[periodic(j) * n + periodic(i)];
                if (!(top >= atoms.z[k])) top = atoms.z[k];
            }
    }
    const auto empty = static_cast<std::size_t>(
        std::count_if(height.begin(), height.end(), [](double h) { return std::isnan(h); }));
    if (empty > 0) io::fill_missing(height, n, n);
    const double mean =
        std::accumulate(height.begin(), height.end(), 0.0) / static_cast<double>(height.size());
    for (double& h : height)
        h -= mean;
    for (double& z : atoms.z)
        z -= mean;
    SurfaceOptions as_they_are = o;
    as_they_are.rms = 0.0;
    Surface s = surface_from_heights(as_they_are, std::move(height), o.sites, o.sites);
    s.atoms = std::move(atoms);
    s.notes.push_back(fmt::format("heights are those of the topmost atom nearest to each of {0} x "
                                  "{0} points (i a, j a), from their mean (z = {1:.6g} Å in the "
                                  "file)",
                                  o.sites, mean));
    if (empty > 0)
        s.notes.push_back(fmt::format("{} of {} sites have no atom nearest to them: filled by "
                                      "Laplace's equation (in maps and statistics alone)",
                                      empty, n * n));
    return s;
}

} // namespace asperity
