// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/statics/wall_newton.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace asperity {

namespace {

using Constants = RelaxationConstants;

/// Least k of the preconditioner divided by L: above the rounding of the stiffness of waves.
constexpr double least_stiffness = 1e-9;

} // namespace

WallNewton::WallNewton(SpectralBlock& block, const Interface& interface,
                       const Constraint& constraint, const RelaxOptions& options, Phases& phases)
    : block_(block), interface_(interface), phases_(phases), tolerance_(options.tolerance),
      furthest_(interface.wall()->attracts() ? Constants::move_max * options.scales.length
                                             : HUGE_VAL),
      u_(block.moving_layer(0)), mean_is_held_(constraint.is_mean_height()),
      sites_(static_cast<double>(block.slab().sites) * block.slab().sites),
      stiffest_wave_(block.stiffest_wave()), gradient_(block.new_field<double>()),
      product_(block.new_field<float>()), response_(block.new_field<float>()),
      h_(block.new_map<double>()), weight_(block.new_map<double>()), r_(block.new_map<double>()),
      p_(block.new_map<double>()), d_(block.new_map<double>()), first_(block.new_map<double>()) {
    block.apply_constraint(); // the waves of the equilibrium
    const double mean = block.mean_height();
    block.constrain(constraint);
    if (mean_is_held_) {
        lift_ = constraint.value - mean;
        of_uniform_.emplace(block.new_map<double>());
    }
    uniform_stiffness_ = block.holder().stiffness;
    measure();
    step();
    const PlaneView<double> first = first_.plane(0);
    for_sites([&](int x, int y) { first(x, y) = u_(x, y); });
}

void WallNewton::put_back() {
    const PlaneView<const double> first = std::as_const(first_).plane(0);
    for_sites([&](int x, int y) { u_(x, y) = first(x, y); });
    block_.apply_constraint();
}

double WallNewton::conclude() {
    const auto t = phases_.time(Phase::interface);
    sums_ = interface_.sweep(block_.lowest_layer(), block_.interface_force(), {.observe = true});
    return residual_;
}

void WallNewton::step() {
    bool cut = false;
    {
        const auto t = phases_.time(Phase::interface);
        linearise();
    }
    {
        const auto t = phases_.time(Phase::relax);
        solve();
        cut = move();
    }
    measure();
    if (cut)
        ++cut_;
    else
        ++stalled_;
    if (residual_ < 0.5 * smallest_) {
        smallest_ = residual_;
        stalled_ = 0;
    }
}

bool WallNewton::gives_up() const {
    return unstable_ || stalled_ >= Constants::wall_stagnation_period ||
           cut_ >= Constants::wall_cut_steps_max;
}

/// Computes the gradient of the energy at the sites, and the residual.
void WallNewton::measure() {
    {
        const auto t = phases_.time(Phase::interface);
        interface_.sweep(block_.lowest_layer(), block_.interface_force(), {});
    }
    const auto t = phases_.time(Phase::sums);
    Waves<double> g = block_.new_waves<double>();
    block_.gradient(g);
    to_sites(g, block_.transform<double>(), gradient_);
    const PlaneView<const double> sites = std::as_const(gradient_[0]).plane(0);
    const double mean = sum([&](int x, int y) { return sites(x, y); }) / sites_;
    // A load is met to its accuracy.
    const double load = block_.constraint().load() / sites_;
    double share = Constants::mean_force_share;
    if (load != 0.0) share = std::min(share, 0.1 * load_accuracy * std::abs(load) / tolerance_);
    residual_ =
        std::max({largest(sites, 0.0), std::abs(mean) / share, stiffest_wave_ * std::abs(lift_)});
}

/// Sets H, the preconditioner and the right side.
void WallNewton::linearise() {
    const OverWall& wall = *interface_.wall();
    const double reference = interface_.reference_height();
    const PlaneView<double> h = h_.plane(0), weight = weight_.plane(0), r = r_.plane(0);
    const PlaneView<const double> g = std::as_const(gradient_[0]).plane(0);
    for_sites([&](int x, int y) {
        const double below = wall.below(x, y); // NaN over a hole
        h(x, y) = std::isnan(below) ? 0.0 : wall.stiffness_at(x, y, reference + u_(x, y) - below);
        weight(x, y) = 1.0 / (stiffest_wave_ + std::max(0.0, h(x, y)));
        d_.plane(0)(x, y) = lift_;
        r(x, y) = -g(x, y) - h(x, y) * lift_;
    });
    const double k =
        sum([&](int x, int y) { return damping(x, y) * damping(x, y) * std::max(0.0, h(x, y)); });
    preconditioner_.emplace(block_, std::max(k / sites_, least_stiffness * stiffest_wave_));
    if (!mean_is_held_) return;
    // The response to a uniform force.
    const PlaneView<double> of_uniform = of_uniform_->plane(0);
    respond([](int, int) { return 1.0; });
    for_sites([&](int x, int y) { of_uniform(x, y) = response(x, y, 1.0); });
    sum_of_uniform_ = sum([&](int x, int y) { return of_uniform(x, y); });
}

/// Solves for the step.
void WallNewton::solve() {
    const PlaneView<double> h = h_.plane(0), r = r_.plane(0), p = p_.plane(0), d = d_.plane(0);
    const PlaneView<const float> sp = std::as_const(product_[0]).plane(0);
    double rz = precondition(), keep = 0.0;
    const double enough = Constants::wall_forcing * Constants::wall_forcing * rz;
    for (int i = 0; i < Constants::products_max && rz > enough; ++i) {
        for_sites([&](int x, int y) { p(x, y) = preconditioned(x, y) + keep * p(x, y); });
        multiply();
        const auto q = [&](int x, int y) {
            return static_cast<double>(sp(x, y)) / sites_ + uniform_product_ + h(x, y) * p(x, y);
        };
        const double curvature = sum([&](int x, int y) { return p(x, y) * q(x, y); });
        if ((unstable_ = !(curvature > 0.0))) break; // no minimum, or one just lost
        const double a = rz / curvature;
        for_sites([&](int x, int y) {
            d(x, y) += a * p(x, y);
            r(x, y) -= a * q(x, y);
        });
        const double next = precondition();
        keep = next / rz;
        rz = next;
    }
}

/// Moves the sites by the step, or a part of it. Returns true for a part.
bool WallNewton::move() {
    const PlaneView<const double> d = std::as_const(d_).plane(0);
    const double longest = largest(d, lift_);
    const double part = longest > furthest_ ? furthest_ / longest : 1.0;
    const OverWall* const yields = interface_.yielding_wall();
    const double reference = interface_.reference_height();
    for_sites([&](int x, int y) {
        double step = lift_ + part * (d(x, y) - lift_);
        if (const double gap = yields ? reference + u_(x, y) - yields->below(x, y) : NAN;
            !std::isnan(gap))
            step = yields->step(x, y, gap, step, stiffest_wave_);
        u_(x, y) += step;
    });
    // Steps to or from a yield gap miss a held mean height.
    lift_ = mean_is_held_ && yields
                ? sum([&](int x, int y) { return block_.constraint().value - u_(x, y); }) / sites_
                : 0.0;
    if (stiffest_wave_ * std::abs(lift_) > Constants::mean_force_share * tolerance_) {
        block_.transform_sites();
    } else {
        block_.apply_constraint();
        lift_ = 0.0;
    }
    return part < 1.0;
}

/// Sets product_ to N^2 S p without the uniform wave of p, whose part is uniform_product_.
void WallNewton::multiply() {
    const PlaneView<const double> p = std::as_const(p_).plane(0);
    const PlaneView<float> to = product_[0].plane(0);
    const double mean = sum([&](int x, int y) { return p(x, y); }) / sites_;
    for_sites([&](int x, int y) { to(x, y) = static_cast<float>(p(x, y) - mean); });
    block_.stiffen(product_);
    uniform_product_ = uniform_stiffness_ * mean;
    ++products_;
}

/// Sets response_ to N^2 (S + k)^-1 D f, with f(x, y) a force on each site, eV/Å.
template <class Force>
void WallNewton::respond(const Force& f) {
    const PlaneView<float> to = response_[0].plane(0);
    for_sites([&](int x, int y) { to(x, y) = static_cast<float>(damping(x, y) * f(x, y)); });
    block_.respond(std::cref(*preconditioner_), response_);
}

/// Returns the site's component of P f after respond(). f: force on the site, eV/Å.
double WallNewton::response(int x, int y, double f) const {
    const double damping = this->damping(x, y);
    return damping * static_cast<double>(response_[0].plane(0)(x, y)) / sites_ +
           (1.0 - damping * damping) * weight_.plane(0)(x, y) * f;
}

/// Returns the preconditioned residual, which has no mean if the mean height is held.
double WallNewton::preconditioned(int x, int y) const {
    const double z = response(x, y, r_.plane(0)(x, y));
    return mean_is_held_ ? z - force_ * of_uniform_->plane(0)(x, y) : z;
}

/// Computes P r of the residual r. Returns r.(P r).
double WallNewton::precondition() {
    const PlaneView<const double> r = std::as_const(r_).plane(0);
    respond([&](int x, int y) { return r(x, y); });
    if (mean_is_held_)
        force_ = sum_of_uniform_ > 0.0
                     ? sum([&](int x, int y) { return response(x, y, r(x, y)); }) / sum_of_uniform_
                     : 0.0;
    return sum([&](int x, int y) { return r(x, y) * preconditioned(x, y); });
}

/// Returns the largest distance of a number of a site from `from`. Collective.
double WallNewton::largest(const PlaneView<const double>& of, double from) const {
    double most = 0.0;
#pragma omp parallel for schedule(static) reduction(max : most)
    for (int y = 0; y < of.ny; ++y)
        for (int x = 0; x < of.nx; ++x)
            most = std::max(most, std::abs(of(x, y) - from));
    return block_.communicator().max(most);
}

template <class Do>
void WallNewton::for_sites(const Do& at) const {
#pragma omp parallel for schedule(static)
    for (int y = 0; y < u_.ny; ++y)
        for (int x = 0; x < u_.nx; ++x)
            at(x, y);
}

/// Returns the sum of a term over the sites. Collective.
template <class Term>
double WallNewton::sum(const Term& term) const {
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

} // namespace asperity
