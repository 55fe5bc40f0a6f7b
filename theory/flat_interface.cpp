// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "theory/flat_interface.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include <boost/math/quadrature/gauss.hpp>

#include "theory/error.hpp"

namespace asperity::theory {
namespace {

void check(const PairInteraction& pair, double a, double b) {
    if (!(pair.zero > 0 && a > 0 && b > 0))
        throw InvalidInput(message("interface: a potential that is zero at ", pair.zero,
                                   " and lattice spacings ", a, ", ", b,
                                   " must all be positive; check them"));
    if (!(pair.cutoff > pair.minimum))
        throw InvalidInput(message("interface: cutoff ", pair.cutoff,
                                   " leaves no attraction, it must lie beyond the pair minimum ",
                                   pair.minimum, "; enlarge it"));
}

constexpr double tail_rings = 8; // times the cutoff; what is beyond is 1e-4 of the tail

/// Rings at Gauss points of R dR from R_from to R_to, `per_area` atoms for each area there.
void add_rings(double from, double to, double per_area, std::vector<double>& radii,
               std::vector<double>& densities) {
    using Rule = boost::math::quadrature::gauss<double, 20>;
    const auto add = [&](double x, double weight) {
        const double R = (from + to) / 2 + (to - from) / 2 * x;
        radii.push_back(R);
        densities.push_back(per_area * 2 * std::numbers::pi * R * weight * (to - from) / 2);
    };
    for (std::size_t i = 0; i < Rule::abscissa().size(); ++i) {
        add(-Rule::abscissa()[i], Rule::weights()[i]);
        add(Rule::abscissa()[i], Rule::weights()[i]);
    }
}

} // namespace

FlatInterface FlatInterface::hollow_sites(const PairInteraction& pair, double a) {
    check(pair, a, a);
    FlatInterface flat;
    flat.pair_ = pair;
    flat.spacing_ = a;
    std::map<int, int> count; // atoms by R² / (a/2)²
    const int reach = 2 * static_cast<int>(pair.cutoff / a) + 3;
    for (int i = 1; i <= reach; i += 2)
        for (int j = 1; j <= reach; j += 2)
            if (const int square = i * i + j * j; square * a * a / 4 < pair.cutoff * pair.cutoff)
                count[square] += 4;
    for (const auto& [square, atoms] : count) {
        flat.radii_.push_back(std::sqrt(square) * a / 2);
        flat.densities_.push_back(atoms / (a * a));
    }
    flat.complete(1 / std::pow(a, 4), a * a / 2);
    return flat;
}

FlatInterface FlatInterface::all_registries(const PairInteraction& pair, double a, double b) {
    check(pair, a, b);
    FlatInterface flat;
    flat.pair_ = pair;
    flat.spacing_ = b;
    const double per_area = 1 / (a * a * b * b);
    // Finer near R = 0, where V varies within a fraction of its length.
    const double ends[] = {0, pair.zero, 2 * pair.zero, pair.cutoff};
    for (int k = 0; k < 3; ++k)
        if (ends[k + 1] > ends[k])
            add_rings(ends[k], std::min(ends[k + 1], pair.cutoff), per_area, flat.radii_,
                      flat.densities_);
    flat.complete(per_area, b * b / 6); // the nearest atom is b/√6 off on average of squares
    return flat;
}

void FlatInterface::complete(double per_area, double sideways2) {
    if (pair_.tail)
        add_rings(pair_.cutoff, tail_rings * pair_.cutoff, per_area, radii_, densities_);
    shift_ = pair_.tail ? 0 : pair_.at(pair_.cutoff * pair_.cutoff).energy;
    contact_ = std::sqrt(std::max(0.0, pair_.inflection * pair_.inflection - sideways2));
    closest_ = 0.75 * pair_.zero;
    reach_ = (pair_.tail ? 2 : 1) * pair_.cutoff;
    find_minimum();
}

FlatInterface FlatInterface::wall(std::function<double(double)> energy, double closest,
                                  double reach, double contact) {
    if (!(reach > closest))
        throw InvalidInput(message("wall: it reaches to ", reach, " and starts at ", closest,
                                   "; the first must be the larger"));
    FlatInterface flat;
    flat.wall_ = std::move(energy);
    flat.radii_ = {0};
    flat.densities_ = {1};
    flat.closest_ = closest;
    flat.reach_ = reach;
    flat.contact_ = contact;
    flat.find_minimum();
    return flat;
}

PairTerms FlatInterface::pair(double r2) const {
    if (!pair_.tail && r2 >= pair_.cutoff * pair_.cutoff) return {};
    PairTerms there = pair_.at(r2);
    there.energy -= shift_;
    return there;
}

FlatInterface::Terms FlatInterface::terms(int ring, double u) const {
    if (wall_) return {wall_(u), 0, 0, 0};
    const double R = radii_[static_cast<std::size_t>(ring)];
    const double density = densities_[static_cast<std::size_t>(ring)];
    const PairTerms d = pair(R * R + u * u);
    return {density * d.energy, density * (d.first + d.second * u * u), density * d.second * R * u,
            density * 0.5 * (2 * d.first + d.second * R * R)};
}

double FlatInterface::energy(double u) const {
    double sum = 0;
    for (int k = 0; k < static_cast<int>(radii_.size()); ++k)
        sum += terms(k, u).energy;
    return sum;
}

void FlatInterface::find_minimum() {
    const int points = 4000;
    const double step = (reach_ - closest_) / points;
    const auto at = [&](int i) { return closest_ + i * step; };
    int low = 0;
    double least = energy(at(0));
    for (int i = 1; i <= points; ++i)
        if (const double e = energy(at(i)); e < least) {
            least = e;
            low = i;
        }
    if (low == 0 || low == points || !(least < 0))
        throw InvalidInput(message("interface: flat on flat has no minimum of energy between the "
                                   "separations ",
                                   closest_, " and ", reach_,
                                   "; choose r0 not far from the spacing and a longer cutoff"));
    const double golden = 0.5 * (std::sqrt(5.0) - 1);
    const auto minimise = [&](double a, double b, auto&& f) {
        while (b - a > 1e-10 * (reach_ - closest_)) {
            const double x = b - golden * (b - a), y = a + golden * (b - a);
            f(x) < f(y) ? b = y : a = x;
        }
        return (a + b) / 2;
    };
    separation_ = minimise(at(low - 1), at(low + 1), [&](double u) { return energy(u); });
    depth_ = -energy(separation_);
    const auto tension = [&](double u) { return energy(u + step) - energy(u - step); };
    int steep = low + 1;
    for (int i = low + 1; i < points; ++i)
        if (tension(at(i)) > tension(at(steep))) steep = i;
    const double d = 0.05 * step;
    const auto slope = [&](double u) { return (energy(u + d) - energy(u - d)) / (2 * d); };
    inflection_ = minimise(at(steep - 1), at(steep + 1), [&](double u) { return -slope(u); });
    tension_ = slope(inflection_);
}

double FlatInterface::tilt_cost(bool sliding) const {
    double tilt = 0, kappa = 0, sideways = 0; // of D/q², κ/q and φ_tt at q -> 0
    const double u = separation_, d = 1e-4 * u;
    for (int k = 0; k < static_cast<int>(radii_.size()); ++k) {
        const double R = radii_[static_cast<std::size_t>(k)];
        const Terms here = terms(k, u);
        const double bend = (terms(k, u + d).energy - 2 * here.energy + terms(k, u - d).energy);
        tilt += 0.25 * R * R * bend / (d * d);
        kappa += 0.5 * R * here.tilt;
        sideways += here.sideways;
    }
    if (sliding && sideways > 0) tilt -= 0.5 * kappa * kappa / sideways;
    return tilt / depth_;
}

double FlatInterface::contact(double u, double slope_variance) const {
    if (u < contact_) return 1;
    if (!(slope_variance > 0) || spacing_ == 0) return 0;
    // (a/2)(|X| + |Y|) < y for two normal slopes of variance σ²: erf(y / aσ)².
    const double within = std::erf((u - contact_) / (spacing_ * std::sqrt(slope_variance / 2)));
    return 1 - within * within;
}

} // namespace asperity::theory
