// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/equilibrium/spectral_relaxation.hpp"

#include "decomposition/global_sum.hpp"
#include "engine/equilibrium/curvature_memory.hpp"
#include "engine/equilibrium/newton.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace asperity {

namespace {

constexpr std::size_t remembered_pairs = 6;

/// Rows of a field's components.
std::array<float*, 3> lines(SiteField<float>& field, int y) {
    std::array<float*, 3> rows{};
    for (std::size_t c = 0; c < field.size(); ++c)
        rows[c] = field[c].plane(0).line(y);
    return rows;
}

/// Length of the longest vector of a field. Collective.
double largest(const Communicator& ranks, SiteField<float>& field) {
    const PlaneView<const float> f = field[0].plane(0);
    double longest = 0.0;
#pragma omp parallel for schedule(static) reduction(max : longest)
    for (int y = 0; y < f.ny; ++y)
        longest =
            std::max(longest, static_cast<double>(longest_squared(
                                  lines(field, y).data(), static_cast<int>(field.size()), f.nx)));
    ranks.max(std::span(&longest, 1));
    return std::sqrt(longest);
}

/// Shortens what is longer than bound at each site.
void clip(double bound, SiteField<float>& field) {
    const PlaneView<const float> f = field[0].plane(0);
#pragma omp parallel for schedule(static)
    for (int y = 0; y < f.ny; ++y)
        clip_row(static_cast<float>(bound), lines(field, y).data(), static_cast<int>(field.size()),
                 f.nx);
}

/// The descent: where it is, what is left, and how it goes on.
class Descent {
public:
    Descent(SpectralBlock& block, const Interface& interface, double reference_height,
            const RelaxOptions& options, Phases& phases)
        : block_(block), interface_(interface), height_(reference_height), options_(options),
          phases_(phases), ranks_(block.communicator()),
          // Half of what a bonded site has, for not all are.
          preconditioner_(block, 0.5 * options.site_stiffness), g_(block.new_waves<double>()),
          d_(block.new_waves<float>()), work_(block.new_waves<float>()),
          at_sites_(block.new_field<float>()), memory_(block, preconditioner_, remembered_pairs),
          newton_(block, preconditioner_) {
        evaluate(false);
        note(memory_.look(g_));
    }

    /// The mean residual, or, where that is below the tolerance, the largest of a site.
    double residual() {
        if (!(rms_ <= options_.tolerance)) return rms_;
        return largest_residual();
    }
    /// The residual of waves that agree with the sites to the last digit; energies in sums().
    double conclude() {
        rough_ = false;
        block_.settle();
        evaluate(true);
        note(memory_.look(g_));
        return largest_residual();
    }
    const InterfaceSums& sums() const { return sums_; }

    /// One step downhill. False if there is no way down.
    bool step(long long iteration) {
        if (iteration % 16 == 15) block_.settle(); // before single precision shows
        const bool newton = iteration >= newton_from_ && newton_direction(iteration);
        if (!newton) remembered_direction();
        clip(options_.max_move, at_sites_);
        const double slope = take_direction();
        if (!(slope < 0.0)) return turn_back(newton, iteration);

        double step = 1.0, there = move(step, slope);
        // Where the force along the step has turned round, back to where it vanishes.
        constexpr int most_cuts = 8;
        for (int cut = 0; cut < most_cuts && !(there <= 0.5 * std::abs(slope)); ++cut) {
            const double ratio = std::isfinite(there) ? slope / (slope - there) : 0.1;
            const double shorter = step * std::clamp(ratio, 0.1, 0.7);
            there = move(shorter - step, there);
            step = shorter;
        }
        return true;
    }

private:
    void evaluate(bool observe) {
        {
            const auto t = phases_.time(Phase::interface);
            sums_ = interface_.sweep(block_.lowest_layer(), block_.interface_force(), height_,
                                     observe, rough_ && !observe);
        }
        const auto t = phases_.time(Phase::advance);
        block_.gradient(options_.load, g_);
    }
    /// By t along the direction, whose slope is given. Returns the slope there.
    double move(double t, double slope) {
        block_.displace(t, d_, at_sites_);
        evaluate(false);
        const auto timed = phases_.time(Phase::sums);
        note(memory_.learn(g_, t, d_, slope));
        return memory_.slope();
    }
    void note(double gradient2) {
        rms_ = std::sqrt(gradient2) / block_.options().sites;
        strongest_ = std::max(strongest_, rms_);
        rough_ = rough_ && rms_ > rough_enough;
    }
    double largest_residual() {
        const auto t = phases_.time(Phase::sums);
        combine(1.0, g_, 0.0, work_);
        block_.at_sites(work_, at_sites_);
        return largest(ranks_, at_sites_);
    }

    void remembered_direction() {
        const auto t = phases_.time(Phase::sums);
        memory_.direction(work_);
        block_.at_sites(work_, at_sites_);
    }
    /// Newton's direction, if it is of use: the forces are no longer those of a fall, and no site
    /// is sent far away (where it is, the state is still moving, and Newton must wait).
    bool newton_direction(long long iteration) {
        const double near = iteration > 0 ? std::max(0.1 * strongest_, 20.0 * options_.tolerance)
                                          : 1e-2; // eV/Å: a point close to an equilibrium
        if (rms_ > near) return false;
        const auto t = phases_.time(Phase::relax);
        // While steps are cut to max_move, half of the gradient is enough; at the end a tenth is
        // left of it.
        const double forcing = rms_ > 1e-3 ? 0.5 : 0.1;
        if (newton_.direction(interface_, height_, forcing, g_, work_)) {
            block_.at_sites(work_, at_sites_);
            if (largest(ranks_, at_sites_) <= far) return true;
        }
        newton_from_ = iteration + patience;
        return false;
    }
    /// The direction at the sites, as waves. Returns its slope.
    double take_direction() {
        const auto t = phases_.time(Phase::sums);
        block_.to_waves(at_sites_, d_);
        const double sites = block_.options().sites;
        combine(0.0, d_, 1.0 / (sites * sites), d_);
        block_.keep_mean_height(d_, at_sites_);
        return dot(g_, d_);
    }
    /// The direction, clipped, does not go down: what it was made of is forgotten.
    bool turn_back(bool newton, long long iteration) {
        if (newton) {
            newton_from_ = iteration + patience;
            return true;
        }
        if (memory_.empty()) return false;
        memory_.forget();
        return true;
    }

    /// Sweeps are in mixed precision down to a mean residual ten times their error, eV/Å.
    static constexpr double rough_enough = 1e-5;
    static constexpr double far = 2.0; ///< Å: of Newton's direction, before it is cut to max_move
    static constexpr long long patience = 10; ///< iterations before Newton is tried again

    SpectralBlock& block_;
    const Interface& interface_;
    double height_;
    const RelaxOptions& options_;
    Phases& phases_;
    const Communicator& ranks_;
    Preconditioner preconditioner_;
    Waves<double> g_;
    Waves<float> d_, work_;
    SiteField<float> at_sites_; ///< the direction, or the residual
    CurvatureMemory memory_;
    Newton newton_;
    InterfaceSums sums_;
    double rms_ = 0.0;       ///< mean residual, eV/Å
    double strongest_ = 0.0; ///< the greatest of them so far
    long long newton_from_ = 0;
    bool rough_ = true;
};

} // namespace

RelaxedState relax(SpectralBlock& block, const Interface& interface, double reference_height,
                   const RelaxOptions& options, Phases& phases) {
    Descent descent(block, interface, reference_height, options, phases);
    RelaxedState state;
    for (bool stuck = false;; ++state.iterations) {
        state.residual = descent.residual();
        const bool over =
            stuck || !std::isfinite(state.residual) || state.iterations >= options.max_iterations;
        state.interrupted = options.report && state.iterations % 10 == 0 &&
                            options.report(state.iterations, state.residual);
        if (over || state.interrupted || state.residual <= options.tolerance) {
            state.residual = descent.conclude();
            state.converged = state.residual <= options.tolerance;
            if (over || state.interrupted || state.converged) break;
        }
        stuck = !descent.step(state.iterations);
    }
    const InterfaceSums& sums = descent.sums();
    const auto values = global_sums(block.communicator(), std::array{sums.energy, sums.force_z});
    state.interface_energy = values[0];
    state.force = values[1];
    state.top_force = block.mean_height_is_held() ? state.force : block.top_force();
    state.elastic_energy = block.elastic_energy();
    state.mean_height = block.mean_height();
    const ContactCount contacts = count_contacts(sums, block.communicator());
    state.in_contact = contacts.in_contact;
    state.pushed = contacts.pushed;
    state.closest = contacts.closest;
    return state;
}

std::size_t spectral_relaxation_bytes(const SpectralBlock& block) {
    // Vectors of the sites: in double, the gradient, a displaced layer with its force; in single,
    // direction, pairs (two in one) with what makes them, Newton's four and its map, and its sites.
    const std::size_t sites = block.tile().nx * static_cast<std::size_t>(block.tile().ny);
    const auto c = static_cast<std::size_t>(block.components());
    const std::size_t map = c == 1 ? 1 : 6;
    return sites * (sizeof(double) * (c + (c == 1 ? 3 : 6)) +
                    sizeof(float) * (c * (3 + remembered_pairs + 2 + 5) + map));
}

} // namespace asperity
