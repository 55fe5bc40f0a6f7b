// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/statics/wall_tangent.hpp"

#include <algorithm>
#include <cmath>

namespace asperity {

namespace {

/// Share of the residual that may be left, measured by the preconditioner, and the largest number
/// of products.
constexpr double forcing = 1e-2;
constexpr long long most_products = 100;

class Tangent {
public:
    Tangent(SpectralBlock& block, const Interface& interface, const Constraint& constraint)
        : block_(block), u_(block.moving_layer(0)), held_(constraint.is_mean_height()),
          sites_(static_cast<double>(block.slab().sites) * block.slab().sites),
          product_(block.new_field<float>()), h_(block.new_map<double>()),
          weight_(block.new_map<double>()), r_(block.new_map<double>()),
          p_(block.new_map<double>()), d_(block.new_map<double>()) {
        block.apply_constraint(); // the waves of the equilibrium
        const double mean = block.mean_height();
        block.constrain(constraint);
        lift_ = held_ ? constraint.value - mean : 0.0;
        interface.sweep(block.lowest_layer(), block.interface_force(), {});
        Waves<double> g = block.new_waves<double>();
        SiteField<double> at_sites = block.new_field<double>();
        block.gradient(g);
        to_sites(g, block.transform<double>(), at_sites);

        const double spring = block.stiffest_wave();
        const OverWall& wall = *interface.wall();
        const double reference = interface.reference_height();
        for_sites([&](int x, int y) {
            const double below = wall.below(x, y);
            const double h =
                std::isnan(below) ? 0.0 : wall.stiffness_at(x, y, reference + u_(x, y) - below);
            h_.plane(0)(x, y) = h;
            weight_.plane(0)(x, y) = 1.0 / (spring + std::max(0.0, h));
        });
        if (held_) weights_ = sum([&](int x, int y) { return weight_.plane(0)(x, y); });
        const PlaneView<const double> left = std::as_const(at_sites[0]).plane(0);
        for_sites([&](int x, int y) {
            d_.plane(0)(x, y) = lift_;
            r_.plane(0)(x, y) = -left(x, y) - h_.plane(0)(x, y) * lift_;
        });
    }

    /// Solves for the tangent. Returns the number of products.
    long long solve() {
        const PlaneView<double> h = h_.plane(0), r = r_.plane(0), p = p_.plane(0), d = d_.plane(0);
        const PlaneView<const float> sp = std::as_const(product_[0]).plane(0);
        double rz = measure(), keep = 0.0;
        const double enough = forcing * forcing * rz;
        long long i = 0;
        for (; i < most_products && rz > enough; ++i) {
            for_sites([&](int x, int y) { p(x, y) = preconditioned(x, y) + keep * p(x, y); });
            multiply();
            const auto q = [&](int x, int y) {
                return static_cast<double>(sp(x, y)) / sites_ + h(x, y) * p(x, y);
            };
            const double curvature = sum([&](int x, int y) { return p(x, y) * q(x, y); });
            if (!(curvature > 0.0)) break; // no minimum, or one just lost
            const double a = rz / curvature;
            for_sites([&](int x, int y) {
                d(x, y) += a * p(x, y);
                r(x, y) -= a * q(x, y);
            });
            const double next = measure();
            keep = next / rz;
            rz = next;
        }
        return i;
    }

    void move(double furthest) {
        const PlaneView<const double> d = std::as_const(d_).plane(0);
        double longest = 0.0;
        for (int y = 0; y < u_.ny; ++y)
            for (int x = 0; x < u_.nx; ++x)
                longest = std::max(longest, std::abs(d(x, y) - lift_));
        longest = block_.communicator().max(longest);
        const double part = longest > furthest ? furthest / longest : 1.0;
        for_sites([&](int x, int y) { u_(x, y) += lift_ + part * (d(x, y) - lift_); });
        block_.apply_constraint();
    }

private:
    template <class Do>
    void for_sites(const Do& at) const {
#pragma omp parallel for schedule(static)
        for (int y = 0; y < u_.ny; ++y)
            for (int x = 0; x < u_.nx; ++x)
                at(x, y);
    }
    template <class Term>
    double sum(const Term& term) const {
        OrderedSums sums(block_.slab(), OrderedSums::Over::rows, 1);
#pragma omp parallel for schedule(static)
        for (int y = 0; y < u_.ny; ++y) {
            double of_row = 0.0;
            for (int x = 0; x < u_.nx; ++x)
                of_row += term(x, y);
            *sums.part(y) = of_row;
        }
        return sums.total()[0] / sites_; // total() multiplies by the sites
    }
    /// Returns the preconditioned residual, which has no mean if the mean height is held.
    double preconditioned(int x, int y) const {
        return (r_.plane(0)(x, y) - force_) * weight_.plane(0)(x, y);
    }
    /// Finds the force that holds the mean height. Returns r.(P r).
    double measure() {
        const PlaneView<const double> r = std::as_const(r_).plane(0);
        if (held_)
            force_ = sum([&](int x, int y) { return r(x, y) * weight_.plane(0)(x, y); }) / weights_;
        return sum([&](int x, int y) { return r(x, y) * preconditioned(x, y); });
    }
    /// Sets product_ to N^2 S p.
    void multiply() {
        const PlaneView<float> to = product_[0].plane(0);
        for_sites([&](int x, int y) { to(x, y) = static_cast<float>(p_.plane(0)(x, y)); });
        block_.stiffen(product_);
    }

    SpectralBlock& block_;
    PlaneView<double> u_;
    bool held_; ///< the mean height is
    double sites_;
    double lift_ = 0.0;    ///< change of the held mean height, Å
    double weights_ = 0.0; ///< sum of weight_, Å^2/eV
    double force_ = 0.0;   ///< force on each site that holds the mean height, eV/Å
    SiteField<float> product_;
    Field<double> h_;      ///< stiffness of the interface, eV/Å^2
    Field<double> weight_; ///< weights of the preconditioner, Å^2/eV
    Field<double> r_;      ///< residual, eV/Å
    Field<double> p_, d_;  ///< direction and tangent, Å
};

} // namespace

long long follow_tangent(SpectralBlock& block, const Interface& interface,
                         const Constraint& constraint, double furthest) {
    Tangent tangent(block, interface, constraint);
    const long long products = tangent.solve();
    tangent.move(furthest);
    return products;
}

} // namespace asperity
