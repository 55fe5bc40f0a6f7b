// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "theory/flat_interface.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>

#include <boost/math/quadrature/gauss.hpp>

namespace asperity::theory {
namespace {

constexpr double tail_rings = 8; // times the cutoff; what is beyond is 1e-4 of the tail

FlatInterface start(const PairInteraction& pair, double spacing) {
    FlatInterface flat;
    flat.pair = pair;
    flat.spacing = spacing;
    flat.furthest = (pair.tail ? 1.05 * tail_rings : 1) * pair.cutoff;
    return flat;
}

/// Adds rings at Gauss points of R dR, `per_area` atoms for each area there.
void add_rings(double from, double to, double per_area, std::vector<FlatInterface::Ring>& rings) {
    using Rule = boost::math::quadrature::gauss<double, 20>;
    for (std::size_t i = 0; i < Rule::abscissa().size(); ++i)
        for (const double side : {-1.0, 1.0}) {
            const double R = (from + to) / 2 + side * (to - from) / 2 * Rule::abscissa()[i];
            rings.push_back(
                {R, per_area * std::numbers::pi * R * Rule::weights()[i] * (to - from)});
        }
}

/// Completes the interface. sideways2: mean square distance of a site from the nearest atom, along
/// the surface.
FlatInterface complete(FlatInterface flat, double per_area, double sideways2) {
    const PairInteraction& pair = flat.pair;
    if (pair.tail) add_rings(pair.cutoff, tail_rings * pair.cutoff, per_area, flat.rings);
    flat.contact = std::sqrt(std::max(0.0, pair.inflection * pair.inflection - sideways2));
    return flat;
}

} // namespace

PairTerms PairInteraction::operator()(double r2) const {
    if (tail) return at(r2);
    if (r2 >= cutoff * cutoff) return {};
    PairTerms here = at(r2);
    here.energy -= at(cutoff * cutoff).energy;
    return here;
}

FlatInterface FlatInterface::hollow_sites(const PairInteraction& pair, double a) {
    FlatInterface flat = start(pair, a);
    std::map<int, int> count; // atoms by R² / (a/2)²
    const int reach = 2 * static_cast<int>(pair.cutoff / a) + 3;
    for (int i = 1; i <= reach; i += 2)
        for (int j = 1; j <= reach; j += 2)
            if (const int square = i * i + j * j; square * a * a / 4 < pair.cutoff * pair.cutoff)
                count[square] += 4;
    for (const auto& [square, atoms] : count)
        flat.rings.push_back({std::sqrt(square) * a / 2, atoms / (a * a)});
    return complete(std::move(flat), 1 / std::pow(a, 4), a * a / 2);
}

FlatInterface FlatInterface::all_registries(const PairInteraction& pair, double a, double b) {
    FlatInterface flat = start(pair, b);
    const double per_area = 1 / (a * a * b * b);
    // Finer near R = 0, where V varies within a fraction of its length.
    const double ends[] = {0, pair.zero, 2 * pair.zero, pair.cutoff};
    for (int k = 0; k < 3; ++k)
        if (ends[k + 1] > ends[k])
            add_rings(ends[k], std::min(ends[k + 1], pair.cutoff), per_area, flat.rings);
    // The nearest atom is b/√6 off on average of squares.
    return complete(std::move(flat), per_area, b * b / 6);
}

double FlatInterface::energy(double u) const {
    double sum = 0;
    for (const auto& [R, density] : rings)
        sum += density * pair(R * R + u * u).energy;
    return sum;
}

double FlatInterface::tilt_cost(double u, bool sliding) const {
    // D/q², κ/q and φ_tt (python/asperity/theories/renormalised.py) at q -> 0, of V_uu, V_Ru and
    // the lateral Laplacian of each ring.
    double tilt = 0, kappa = 0, sideways = 0;
    for (const auto& [R, density] : rings) {
        const PairTerms d = pair(R * R + u * u);
        tilt += 0.25 * R * R * density * (d.first + d.second * u * u);
        kappa += 0.5 * R * density * d.second * R * u;
        sideways += 0.5 * density * (2 * d.first + d.second * R * R);
    }
    if (sliding && sideways > 0) tilt -= 0.5 * kappa * kappa / sideways;
    return -tilt / energy(u);
}

} // namespace asperity::theory
