// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/statics/wall_minimiser.hpp"

#include "decomposition/global_sum.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace asperity {

namespace {

using Constants = RelaxationConstants;

} // namespace

WallMinimiser::WallMinimiser(Response& block, const Interface& interface,
                             const RelaxOptions& options, Phases& phases)
    : block_(block), interface_(interface), options_(options), phases_(phases),
      waves_(block.new_waves<double>()), field_(block.new_field<double>()),
      single_field_(block.new_field<float>()), next_(block.new_map<double>()),
      step_(block.new_map<float>()) {
    stiffest_wave_ = block.stiffest_wave();
    estimate_ = stiffest_wave_ * options.scales.length;
    mean_ = block.mean_height();
    holder_ = block.holder();
    uniform_force_ = holder_(mean_);
}

void WallMinimiser::step() {
    single_ = single_ && estimate_ > Constants::single_precision_error * stiffest_wave_ * widest_;
    double reversal = 0.0;
    if (single_) { // single precision while it is good enough
        elastic_forces(single_field_);
        reversal = relax_sites(single_field_);
    } else {
        elastic_forces(field_);
        reversal = relax_sites(field_);
    }
    accept();
    if (reversal > 0.0) sequence_ = 1.0;
    const double following = 0.5 * (1.0 + std::sqrt(1.0 + 4.0 * sequence_ * sequence_));
    momentum_ = (sequence_ - 1.0) / following;
    sequence_ = following;
}

double WallMinimiser::conclude() {
    block_.apply_constraint();
    {
        const auto t = phases_.time(Phase::interface);
        sums_ =
            interface_.sweep(block_.lowest_layer(), block_.interface_force(), {.observe = true});
    }
    const auto t = phases_.time(Phase::sums);
    block_.gradient(waves_);
    to_sites(waves_, block_.transform<double>(), field_);
    const PlaneView<const double> g = std::as_const(field_[0]).plane(0);
    double largest = 0.0;
#pragma omp parallel for schedule(static) reduction(max : largest)
    for (int y = 0; y < g.ny; ++y)
        for (int x = 0; x < g.nx; ++x)
            largest = std::max(largest, std::abs(g(x, y)));
    largest = block_.communicator().max(largest);
    // Steps do not show this residual: forces of single precision, or sites that still jump.
    single_ = false;
    residual_factor_ *= largest > options_.tolerance ? 2.0 : 1.0;
    return largest;
}

/// Computes N^2 S (z - mean) at the sites; the field holds z - mean meanwhile.
template <class T>
void WallMinimiser::elastic_forces(SiteField<T>& field) {
    const auto t = phases_.time(Phase::advance);
    const PlaneView<double> u = block_.moving_layer(0);
    const PlaneView<T> z = field[0].plane(0);
    const PlaneView<const float> step = std::as_const(step_).plane(0);
    double widest = 0.0;
#pragma omp parallel for schedule(static) reduction(max : widest)
    for (int y = 0; y < u.ny; ++y)
        for (int x = 0; x < u.nx; ++x) {
            z(x, y) = static_cast<T>(u(x, y) - mean_ + momentum_ * static_cast<double>(step(x, y)));
            widest = std::max(widest, std::abs(static_cast<double>(z(x, y))));
        }
    widest_ = block_.communicator().max(widest);
    block_.shape_forces(field); // balance() looks after the uniform wave
}

/// Fills next_. Returns by how much the step turns against the gradient.
template <class T>
double WallMinimiser::relax_sites(const SiteField<T>& elastic) {
    const Constraint& constraint = block_.constraint();
    const double n = block_.slab().sites, sites = n * n, load = constraint.load() / sites;
    const PlaneView<double> u = block_.moving_layer(0);
    WallRule rule{.reference_height = interface_.reference_height(),
                  .spring = stiffest_wave_,
                  .momentum = momentum_,
                  .norm = 1.0 / sites,
                  .load = 0.0};
    double reversal = 0.0, mean = 0.0;
    const auto relax = [&](double force) {
        const auto t = phases_.time(Phase::interface);
        rule.load = force;
        OrderedSums sums(block_.slab(), OrderedSums::Over::rows, 2);
        double furthest = 0.0;
#pragma omp parallel for schedule(static) reduction(max : furthest)
        for (int y = 0; y < u.ny; ++y) {
            const WallRow<T> row{.u = u.line(y),
                                 .step = std::as_const(step_).plane(0).line(y),
                                 .elastic = elastic[0].plane(0).line(y),
                                 .next = next_.plane(0).line(y)};
            const WallSums s = interface_.wall()->rest_row(y, row, rule, u.nx);
            furthest = std::max(furthest, s.furthest);
            sums.part(y)[0] = s.reversal;
            sums.part(y)[1] = s.height;
        }
        estimate_ = stiffest_wave_ * block_.communicator().max(furthest);
        const std::vector<double> total = sums.total();
        reversal = total[0];
        mean = total[1] / (sites * sites); // total() multiplies by the sites
    };
    // Excess of the demand of the block's spring and the load over the force and over the part of L
    // in the uniform wave; or the force that lifts the mean to its held height.
    const auto excess = [&](double force) {
        relax(force);
        if (constraint.is_mean_height()) return stiffest_wave_ * (mean - constraint.value);
        return holder_(mean) - stiffest_wave_ * (mean - mean_) - force;
    };
    // A mean height to its rounding, a load well enough for load_accuracy.
    double enough = Constants::mean_force_share * options_.tolerance;
    if (constraint.is_mean_height())
        enough = 1e-14 * stiffest_wave_ * std::max(std::abs(constraint.value), widest_);
    else if (load != 0.0)
        enough = std::min(enough, 0.1 * load_accuracy * std::abs(load));
    balance(excess, enough);
    next_mean_ = mean;
    return reversal + sites * sites * (mean - mean_) * (mean - mean_); // without the uniform wave
}

/// Finds the uniform force at which excess(force), eV/Å, is no more than enough, by the secant from
/// the last one. The sites follow the force, so the excess falls steadily as the force grows. A
/// secant that leaves what is known of the root is replaced by a halving. Where a soft machine
/// holds sites that touch nothing, the excess hardly falls, and a small one says little: what the
/// secant would still change must be small as well.
template <class Excess>
void WallMinimiser::balance(const Excess& excess_at, double enough) {
    const double small = holder_.stiffness > 0.0 ? 0.1 * options_.tolerance : HUGE_VAL;
    double force = uniform_force_, excess = excess_at(force), low = -HUGE_VAL, high = HUGE_VAL;
    double next = force + excess;
    const auto found = [&] {
        return std::abs(excess) <= enough && std::abs(excess) <= small * fall_;
    };
    for (int i = 0; i < 60 && !found(); ++i) {
        (excess > 0.0 ? low : high) = force;
        const double now = excess_at(next);
        if (now == excess) break; // no number lies between the two
        const double before = std::exchange(force, next);
        fall_ = std::abs((now - excess) / (force - before));
        next = force - now * (force - before) / (now - excess);
        excess = now;
        (excess > 0.0 ? low : high) = force;
        if (next > low && next < high) continue;
        const bool between = low > -HUGE_VAL && high < HUGE_VAL;
        next = between ? 0.5 * (low + high) : force + 2.0 * excess;
    }
    uniform_force_ = force;
}

/// Moves the sites to next_.
void WallMinimiser::accept() {
    const double lift = next_mean_ - mean_;
    mean_ = next_mean_;
    const PlaneView<double> u = block_.moving_layer(0);
    const PlaneView<const double> next = std::as_const(next_).plane(0);
    const PlaneView<float> step = step_.plane(0);
#pragma omp parallel for schedule(static)
    for (int y = 0; y < u.ny; ++y)
        for (int x = 0; x < u.nx; ++x) {
            step(x, y) = static_cast<float>(next(x, y) - u(x, y) - lift);
            u(x, y) = next(x, y);
        }
}

} // namespace asperity
