// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/statics/relaxation.hpp"

#include "decomposition/global_sum.hpp"
#include "engine/statics/heavy_ball.hpp"
#include "engine/statics/newton.hpp"
#include "engine/statics/wall_minimiser.hpp"
#include "engine/statics/wall_newton.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace asperity {

namespace {

using Constants = RelaxationConstants;

/// Test for a relaxation that has stagnated.
class StagnationTest {
public:
    bool operator()(long long iteration, double residual) {
        if (residual < 0.5 * smallest_) {
            smallest_ = residual;
            found_at_ = iteration;
        }
        return iteration > found_at_ + Constants::stagnation_period;
    }

private:
    double smallest_ = HUGE_VAL;
    long long found_at_ = 0;
};

/// Returns the length of the longest vector of a field. Collective.
double largest(const Communicator& ranks, SiteField<float>& field) {
    const PlaneView<const float> f = field[0].plane(0);
    double longest = 0.0;
#pragma omp parallel for schedule(static) reduction(max : longest)
    for (int y = 0; y < f.ny; ++y) {
        std::array<float*, 3> rows{};
        for (std::size_t c = 0; c < field.size(); ++c)
            rows[c] = field[c].plane(0).line(y);
        longest = std::max(longest, static_cast<double>(longest_squared(
                                        rows.data(), static_cast<int>(field.size()), f.nx)));
    }
    return std::sqrt(ranks.max(longest));
}

/// A relaxation over atoms under way.
class Minimiser {
public:
    Minimiser(Response& block, const Interface& interface, const RelaxOptions& options,
              Phases& phases)
        : block_(block), interface_(interface), options_(options), phases_(phases),
          preconditioner_(block, options.scales.stiffness), ball_(block),
          newton_(block, preconditioner_, options.scales), g_(block.new_waves<double>()),
          d_(block.new_waves<float>()), at_sites_(block.new_field<float>()) {
        find_forces();
        tune();
        const double close = options.start == Start::anywhere ? Constants::newton_below_anywhere
                                                              : Constants::newton_below_near;
        spreading_ = !(rms_ < close * options.scales.interface_force());
        distance_ = rms_ / preconditioner_.k();
    }

    /// Computes the forces and the residual at the sites' displacements.
    void find_forces() {
        sweep(false);
        if (!spreading_) measure();
    }
    /// Returns the mean residual or, if that is below the tolerance, the largest of a site, eV/Å.
    /// During the first stage, for which no residual is computed, the largest distance of a site to
    /// its target stands for it.
    double residual() {
        if (spreading_) return options_.scales.stiffness * distance_;
        return rms_ <= options_.tolerance ? largest_residual() : rms_;
    }
    /// Computes the residual of the final state, eV/Å, and the energies in sums().
    double conclude() {
        mixed_precision_ = false;
        block_.apply_constraint();
        sweep(true);
        measure();
        return largest_residual();
    }
    const InterfaceSums& sums() const { return sums_; }

    /// Makes one step downhill.
    void step() {
        if (spreading_ || !newton_step()) move_sites();
        find_forces();
    }

private:
    void sweep(bool observe) {
        const auto t = phases_.time(Phase::interface);
        sums_ =
            interface_.sweep(block_.lowest_layer(), block_.interface_force(),
                             {.observe = observe, .mixed_precision = mixed_precision_ && !observe});
    }
    void measure() {
        const auto t = phases_.time(Phase::sums);
        block_.gradient(g_);
        rms_ = std::sqrt(dot(g_, g_)) / block_.slab().sites;
        mixed_precision_ = mixed_precision_ && rms_ > Constants::mixed_precision_above *
                                                          options_.scales.interface_force();
    }
    double largest_residual() {
        const auto t = phases_.time(Phase::sums);
        to_sites(g_, block_.transform<float>(), at_sites_);
        return largest(block_.communicator(), at_sites_);
    }
    void tune() {
        const auto t = phases_.time(Phase::interface);
        const double k = std::max(Constants::stiffness_share_min * options_.scales.stiffness,
                                  Constants::stiffness_share * newton_.mean_stiffness(interface_));
        if (std::abs(k - preconditioner_.k()) > Constants::stiffness_change * preconditioner_.k())
            preconditioner_.tune(block_, k);
    }

    void move_sites() {
        if (!spreading_) iterations_ = 0;
        spreading_ = true;
        if (++iterations_ % Constants::tuning_period == 0) tune();
        {
            const auto t = phases_.time(Phase::advance);
            distance_ = ball_.move(preconditioner_, move_max_);
        }
        if (distance_ > Constants::newton_distance * options_.scales.length ||
            iterations_ < Constants::heavy_balls_min)
            return;
        spreading_ = false;
        forcing_ = Constants::forcing_loose;
        expected_ = HUGE_VAL;
        ball_.stop();
        block_.apply_constraint();
    }
    /// Makes a step of Newton's method. Returns false, without a step, if the method does not help:
    /// its last step, solved closely, has reduced the residual by less than half of the expected
    /// reduction, the curvature is negative, or a site would move too far. Near an equilibrium a
    /// step is shortened instead, so that no site moves further than move_max.
    bool newton_step() {
        const auto t = phases_.time(Phase::relax);
        if (!(rms_ < expected_)) {
            if (forcing_ == Constants::forcing_tight) return false;
            forcing_ = Constants::forcing_tight;
        }
        if (!newton_.direction(interface_, forcing_, g_, d_)) return false;
        to_sites(d_, block_.transform<float>(), at_sites_);
        const double most = largest(block_.communicator(), at_sites_);
        const double shortest =
            options_.start == Start::anywhere ? 1.0 : Constants::step_fraction_min;
        const double fraction = most > move_max_ ? move_max_ / most : 1.0;
        if (!(fraction >= shortest)) return false;
        expected_ = (1.0 - 0.5 * fraction) * rms_;
        block_.displace(fraction, d_, at_sites_);
        return true;
    }

    Response& block_;
    const Interface& interface_;
    const RelaxOptions& options_;
    Phases& phases_;
    Preconditioner preconditioner_;
    HeavyBall ball_;
    Newton newton_;
    Waves<double> g_;
    Waves<float> d_;
    SiteField<float> at_sites_; ///< Newton's direction, or the residual
    InterfaceSums sums_;
    bool spreading_ = false;
    long long iterations_ = 0; ///< iterations of this stage
    double distance_ = 0.0;    ///< the largest to a target, Å
    double rms_ = 0.0;         ///< mean residual, eV/Å
    /// Newton's last step should have left less than this, eV/Å.
    double expected_ = HUGE_VAL;
    double forcing_ = Constants::forcing_loose;
    bool mixed_precision_ = true;
    double move_max_ = Constants::move_max * options_.scales.length; ///< Å
};

/// Returns true if `force`, the sum of the forces on the sites, is that of the constraint within
/// rounding. Where nothing attracts, a state without a load bears no force at all: then the sum may
/// be as large as the minimiser leaves it. Collective.
bool balanced(Response& block, double force, const RelaxOptions& options, double rounding) {
    const Constraint& constraint = block.constraint();
    if (constraint.is_mean_height()) return true;
    const double sites = static_cast<double>(block.slab().sites) * block.slab().sites;
    const double least = rounding * sites;
    if (constraint.is_top())
        return std::abs(force - block.top_force()) <= std::max(options.balance, least);
    ExactSum sum;
    const PlaneView<const double> f = std::as_const(block).interface_force().z;
    for (int y = 0; y < f.ny; ++y) {
        for (int x = 0; x < f.nx; ++x)
            sum.add(std::abs(f(x, y)));
        sum.carry();
    }
    const double all = global_sum(block.communicator(), sum), load = constraint.load();
    if (load == 0.0 && all - force <= load_accuracy * all)
        return force <=
               std::max(2.0 * Constants::mean_force_share * options.tolerance * sites, least);
    const double of = load == 0.0 ? all : std::max(std::abs(load), 1e-6 * all);
    return std::abs(force - load) <= std::max(load_accuracy * of, least);
}

/// Runs the loop of a method until it stagnates: stagnates(iteration, residual).
template <class Minimiser, class Stagnates>
RelaxedState iterate(Minimiser& minimiser, Response& block, const RelaxOptions& options,
                     double rounding, Stagnates stagnates) {
    RelaxedState state;
    state.rounding = rounding;
    // The first moves take the force out of its window too, but not for long.
    const ForceWindow& window = options.force_window;
    bool outside = false;
    for (;; ++state.iterations) {
        state.residual = minimiser.residual();
        const bool over = !std::isfinite(state.residual) ||
                          state.iterations >= options.max_iterations ||
                          stagnates(state.iterations, state.residual);
        state.interrupted = options.report && state.iterations % 10 == 0 &&
                            options.report(state.iterations, state.residual);
        if (over || state.interrupted || state.residual <= options.tolerance) {
            state.residual = minimiser.conclude();
            state.balanced =
                balanced(block, global_sum(block.communicator(), minimiser.sums().force_z), options,
                         rounding);
            state.converged = state.residual <= options.tolerance && state.balanced;
            if (over || state.interrupted || state.converged) break;
        }
        minimiser.step();
        if (!std::isfinite(window.furthest) || state.iterations < Constants::first_force_check ||
            state.iterations % Constants::force_check_period != 0)
            continue;
        state.force = global_sum(block.communicator(), minimiser.sums().force_z);
        const bool still = outside;
        outside = std::abs(state.force - window.expected) > window.furthest;
        if ((state.jumped = still && outside)) return state;
    }
    const InterfaceSums& sums = minimiser.sums();
    const auto values = global_sums(block.communicator(), std::array{sums.energy, sums.force_z});
    static_cast<StepEnergies&>(state) = block.energies();
    state[Term::interface] = values[0];
    state.force = values[1];
    // Largest values pass over what is not a number; sums do not.
    state.converged = state.converged && std::isfinite(values[0]) && std::isfinite(values[1]);
    state.top_force = block.constraint().is_mean_height() ? state.force : block.top_force();
    state.top = block.top();
    state.mean_height = block.mean_height_of_box();
    static_cast<ContactCount&>(state) = count_contacts(sums, block.communicator());
    return state;
}

/// Relaxes a block over a wall. Collective.
RelaxedState relax_over_wall(SpectralBlock& block, const Interface& interface,
                             const Constraint& constraint, RelaxOptions options, Phases& phases,
                             double rounding) {
    options.force_window = {}; // the steps over a wall do not add up the force
    long long products = 0;
    if (options.start == Start::near) {
        WallNewton newton(block, interface, constraint, options, phases);
        RelaxedState state = iterate(newton, block, options, rounding,
                                     [&](long long, double) { return newton.gives_up(); });
        products = state.iterations = newton.products();
        if (state.converged || state.interrupted) return state;
        newton.put_back();
    }
    WallMinimiser minimiser(block, interface, options, phases);
    RelaxedState state = iterate(minimiser, block, options, rounding, StagnationTest());
    state.iterations += products;
    return state;
}

} // namespace

double rounding_of_forces(const Scales& scales, const BlockOptions& block, double height) {
    const double positions = 4.0 * std::numeric_limits<double>::epsilon() *
                             (scales.stiffness + block.shortest_wave()) * height;
    return positions + 0x1p-51; // with the quantum of sums over sites (kernels/exact_sum.hpp)
}

std::string why_not_converged(const RelaxedState& state, double tolerance) {
    if (state.residual <= tolerance)
        return fmt::format("the forces on the sites, which add up to {:.3g} eV/Å, are not in "
                           "balance with what is prescribed",
                           state.force);
    std::string why = fmt::format("the largest force left is {:.2e} eV/Å, and the tolerance is "
                                  "{:.2e} eV/Å",
                                  state.residual, tolerance);
    if (tolerance < state.rounding)
        why +=
            fmt::format("; the rounding of numbers alone leaves about {:.0e} eV/Å", state.rounding);
    return why;
}

RelaxedState relax(SpectralBlock& block, const Interface& interface, const Constraint& constraint,
                   const RelaxOptions& options, Phases& phases) {
    if (!(options.scales.length > 0.0 && options.scales.stiffness > 0.0))
        throw std::invalid_argument("relax: a relaxation needs the scales of its interface");
    const bool wall = interface.options().wall.has_value(), near = options.start == Start::near;
    if (!(wall && near)) block.hold(constraint);
    const double height = std::abs(interface.reference_height()) + std::abs(block.mean_height()) +
                          interface.start_height();
    const double rounding = rounding_of_forces(options.scales, block.options(), height);
    if (wall) return relax_over_wall(block, interface, constraint, options, phases, rounding);
    Minimiser minimiser(block, interface, options, phases);
    return iterate(minimiser, block, options, rounding, StagnationTest());
}

} // namespace asperity
