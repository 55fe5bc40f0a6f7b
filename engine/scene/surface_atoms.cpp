// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A substrate of atoms at positions of their own, as a Surface.
#include "engine/scene/surface.hpp"

#include "io/height_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
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

/// Heights of the topmost atoms.
struct Topmost {
    std::vector<double> height; ///< heights over their mean, Å
    double mean = 0.0;          ///< Å
    double empty = 0.0;         ///< number of sites without an atom, which are filled
};

/// Finds the heights of the topmost atoms nearest to n x n points.
Topmost topmost_of(const AtomPositions& atoms, int sites, double spacing) {
    const auto n = static_cast<std::size_t>(sites);
    Topmost top;
    std::vector<double>& height = top.height;
    height.assign(n * n, std::numeric_limits<double>::quiet_NaN());
    // The points of the map are at (i, j) times the spacing, as the atoms of a lattice. An atom
    // half way between some of them (files have three digits and more) is nearest to each.
    constexpr double half_way = 0.5 + 1e-3;
    for (std::size_t k = 0; k < atoms.size(); ++k) {
        const double x = atoms.x[k] / spacing, y = atoms.y[k] / spacing;
        for (double j = std::ceil(y - half_way); j <= y + half_way; ++j)
            for (double i = std::ceil(x - half_way); i <= x + half_way; ++i) {
                const auto periodic = [&](double at) {
                    return static_cast<std::size_t>(at + sites) % n;
                };
                double& highest = height[periodic(j) * n + periodic(i)];
                if (!(highest >= atoms.z[k])) highest = atoms.z[k];
            }
    }
    top.empty = static_cast<double>(
        std::count_if(height.begin(), height.end(), [](double h) { return std::isnan(h); }));
    if (top.empty > 0.0) io::fill_missing(height, n, n);
    top.mean =
        std::accumulate(height.begin(), height.end(), 0.0) / static_cast<double>(height.size());
    for (double& h : height)
        h -= top.mean;
    return top;
}

} // namespace

Surface surface_from_atoms(const SurfaceOptions& o, AtomPositions atoms,
                           const Communicator& ranks) {
    if (atoms.size() == 0) throw std::invalid_argument("the substrate has no atoms");
    Topmost top;
    ranks.on_root([&] {
        refuse_coinciding(atoms, o.length);
        top = topmost_of(atoms, o.sites, o.length / o.sites);
    });
    std::array<double, 2> numbers = {top.mean, top.empty};
    ranks.broadcast(numbers);
    for (double& z : atoms.z)
        z -= numbers[0];
    SurfaceOptions as_they_are = o;
    as_they_are.rms = 0.0;
    Surface s = surface_from_heights(as_they_are, std::move(top.height), o.sites, o.sites, ranks);
    s.atoms = std::move(atoms);
    s.notes.push_back(fmt::format("heights are those of the topmost atom nearest to each of {0} x "
                                  "{0} points (i a, j a), from their mean (z = {1:.6g} Å in the "
                                  "file)",
                                  o.sites, numbers[0]));
    if (numbers[1] > 0.0)
        s.notes.push_back(fmt::format("{} of {} sites have no atom nearest to them: filled by "
                                      "Laplace's equation (in maps and statistics alone)",
                                      static_cast<long long>(numbers[1]), 1ll * o.sites * o.sites));
    return s;
}

} // namespace asperity
