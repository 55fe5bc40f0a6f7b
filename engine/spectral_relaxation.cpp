// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/spectral_relaxation.hpp"

#include "engine/interface_stiffness.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <utility>
#include <vector>

namespace asperity {

namespace {

constexpr std::size_t remembered_pairs = 4;

/// Length of the longest vector of a field.
double largest(const VectorField<double>& field) {
    const VectorPlane<const double> f = field.plane(0);
    double longest = 0.0;
#pragma omp parallel for schedule(static) reduction(max : longest)
    for (int y = 0; y < f.x.ny; ++y)
        for (int x = 0; x < f.x.nx; ++x)
            longest = std::max(longest, f.x(x, y) * f.x(x, y) + f.y(x, y) * f.y(x, y) +
                                            f.z(x, y) * f.z(x, y));
    return std::sqrt(longest);
}

/// to <- factor (a - b)
void set_difference(double factor, const Waves<double>& a, const Waves<double>& b,
                    Waves<float>& to) {
#pragma omp parallel for schedule(static)
    for (int y = 0; y < a.sites(); ++y)
        for (int c = 0; c < 3; ++c)
            for (int i = 0; i < 2 * a.columns(); ++i)
                to.row(c, y)[i] = static_cast<float>(factor * (a.row(c, y)[i] - b.row(c, y)[i]));
}

template <class From, class To>
void copy(double factor, const Waves<From>& from, Waves<To>& to) {
#pragma omp parallel for schedule(static)
    for (int y = 0; y < from.sites(); ++y)
        for (int c = 0; c < 3; ++c)
            for (int i = 0; i < 2 * from.columns(); ++i)
                to.row(c, y)[i] = static_cast<To>(factor * from.row(c, y)[i]);
}

/// Shortens what is longer than bound at each site. True if anything was.
bool clip(double bound, VectorField<double>& field) {
    const VectorPlane<double> f = field.plane(0);
    bool clipped = false;
#pragma omp parallel for schedule(static) reduction(|| : clipped)
    for (int y = 0; y < f.x.ny; ++y)
        for (int x = 0; x < f.x.nx; ++x) {
            const double length =
                std::sqrt(f.x(x, y) * f.x(x, y) + f.y(x, y) * f.y(x, y) + f.z(x, y) * f.z(x, y));
            if (!(length > bound)) continue;
            const double q = bound / length;
            f.x(x, y) *= q;
            f.y(x, y) *= q;
            f.z(x, y) *= q;
            clipped = true;
        }
    return clipped;
}

/// What the last steps have told of the curvature.
class Curvature {
public:
    Curvature(int sites, std::size_t pairs) : sites_(sites), limit_(pairs), work_(sites) {}

    /// The pair step, change of gradient; left out where the energy curves down along the step.
    void learn(double t, const Waves<double>& d, const Waves<double>& g_new,
               const Waves<double>& g_old) {
        Pair pair;
        if (pairs_.size() < limit_) {
            pair = {Waves<float>(sites_), Waves<float>(sites_), 0.0};
        } else {
            pair = std::move(pairs_.front());
            pairs_.pop_front();
        }
        copy(t, d, pair.s);
        set_difference(1.0, g_new, g_old, pair.y);
        const double sy = dot(pair.s, pair.y);
        if (sy > 1e-8 * std::sqrt(dot(pair.s, pair.s) * dot(pair.y, pair.y))) {
            pair.rho = 1.0 / sy;
            pairs_.push_back(std::move(pair));
        }
    }
    void forget() { pairs_.clear(); }
    bool empty() const { return pairs_.empty(); }

    /// d <- -H g, with H the inverse Hessian as far as it is known.
    void descend(const SpectralBlock& block, double k, const Waves<double>& g, Waves<double>& d) {
        std::vector<double> alpha(pairs_.size());
        copy(-1.0, g, work_);
        for (std::size_t i = pairs_.size(); i-- > 0;) {
            alpha[i] = pairs_[i].rho * dot(pairs_[i].s, work_);
            add(-alpha[i], pairs_[i].y, work_);
        }
        block.precondition(k, work_);
        for (std::size_t i = 0; i < pairs_.size(); ++i) {
            const double beta = pairs_[i].rho * dot(pairs_[i].y, work_);
            add(alpha[i] - beta, pairs_[i].s, work_);
        }
        copy(1.0, work_, d);
    }

private:
    struct Pair {
        Waves<float> s, y;
        double rho = 0.0; ///< 1 / s.y
    };
    int sites_;
    std::size_t limit_;
    std::deque<Pair> pairs_;
    Waves<float> work_;
};

/// Newton's direction: (S + H) d = -g by conjugate gradients, in single precision.
class Newton {
public:
    explicit Newton(const SpectralBlock& block)
        : block_(block), stiffness_(block.tile()), at_sites_(block.tile(), 1, 0),
          transform_(block.options().sites, at_sites_.plane(0).x.row), r_(block.options().sites),
          z_(block.options().sites), p_(block.options().sites), q_(block.options().sites),
          d_(block.options().sites) {}

    /// False, and no direction, where the energy curves down on the way to it.
    bool direction(const Interface& interface, double reference_height, double k, double rms,
                   const Waves<double>& g, Waves<double>& d) {
        stiffness_.measure(interface, block_.lowest_layer(), block_.interface_force(),
                           reference_height);
        // The nearer the end, the more exact: what is left of the gradient, by then quadratically
        // small.
        const double forcing = std::clamp(std::sqrt(rms), 0.03, 0.3);
        copy(-1.0, g, r_);
        copy(0.0, r_, d_);
        copy(1.0, r_, p_);
        block_.precondition(k, p_);
        double rz = dot(r_, p_);
        const double enough = forcing * forcing * rz;
        for (int i = 0; i < most_products && rz > enough; ++i) {
            multiply();
            const double curvature = dot(p_, q_);
            if (!(curvature > 0.0)) return false;
            const double a = rz / curvature;
            add(a, p_, d_);
            add(-a, q_, r_);
            copy(1.0, r_, z_);
            block_.precondition(k, z_);
            const double next = dot(r_, z_), b = next / rz;
            rz = next;
            add_scaled(z_, b, p_);
        }
        copy(1.0, d_, d);
        return true;
    }

private:
    /// q <- (S + H) p
    void multiply() {
        copy(1.0, p_, q_);
        transform_.backward(q_, at_sites_.plane(0));
        stiffness_.apply(at_sites_.plane(0));
        transform_.forward(std::as_const(at_sites_).plane(0), q_);
        const double n = block_.options().sites;
        block_.add_stiffness(p_, 1.0 / (n * n), q_);
    }
    /// p <- z + b p
    static void add_scaled(const Waves<float>& z, double b, Waves<float>& p) {
        const auto factor = static_cast<float>(b);
#pragma omp parallel for schedule(static)
        for (int y = 0; y < p.sites(); ++y)
            for (int c = 0; c < 3; ++c)
                for (int i = 0; i < 2 * p.columns(); ++i)
                    p.row(c, y)[i] = z.row(c, y)[i] + factor * p.row(c, y)[i];
    }

    static constexpr int most_products = 60;
    const SpectralBlock& block_;
    InterfaceStiffness stiffness_;
    VectorField<float> at_sites_;
    SurfaceTransform<float> transform_;
    Waves<float> r_, z_, p_, q_, d_;
};

/// The descent: where it is, what is left, and how it goes on.
class Descent {
public:
    Descent(SpectralBlock& block, const Interface& interface, double reference_height,
            const RelaxOptions& options, Phases& phases)
        : block_(block), interface_(interface), height_(reference_height), options_(options),
          phases_(phases), stiffness_(0.5 * options.site_stiffness), sites_(block.options().sites),
          g_(sites_), g_old_(sites_), d_(sites_), at_sites_(block.new_field()),
          curvature_(sites_, remembered_pairs), newton_(block) {}

    void evaluate(bool observe) {
        {
            const auto t = phases_.time(Phase::interface);
            sums_ =
                interface_.sweep(block_.lowest_layer(), block_.interface_force(), height_, observe);
        }
        const auto t = phases_.time(Phase::advance);
        block_.gradient(options_.load, g_);
        rms_ = std::sqrt(dot(g_, g_)) / sites_;
    }

    /// The mean residual, or, where that is below the tolerance, the largest of a site.
    double residual() {
        if (!(rms_ <= options_.tolerance)) return rms_;
        return largest_residual();
    }
    double largest_residual() {
        const auto t = phases_.time(Phase::sums);
        block_.at_sites(g_, at_sites_);
        return largest(at_sites_);
    }
    const InterfaceSums& sums() const { return sums_; }

    /// One step downhill. False if there is no way down.
    bool step(long long iteration) {
        const bool newton =
            settled_ && rms_ < near_ && iteration >= newton_from_ && newton_direction(iteration);
        if (!newton) {
            const auto t = phases_.time(Phase::sums);
            curvature_.descend(block_, stiffness_, g_, d_);
            block_.at_sites(d_, at_sites_);
        }
        const bool clipped = clip(options_.max_move, at_sites_);
        if (clipped) block_.to_waves(at_sites_, d_);
        settled_ = !clipped;
        const double slope = dot(g_, d_);
        if (!(slope < 0.0)) return turn_back(newton, iteration);

        std::swap(g_, g_old_);
        double step = 1.0;
        block_.displace(step, d_, at_sites_);
        evaluate(false);
        constexpr int most_cuts = 8;
        for (int cut = 0; cut < most_cuts; ++cut) {
            const double there = dot(g_, d_);
            if (there <= 0.5 * std::abs(slope)) break;
            const double ratio = std::isfinite(there) ? slope / (slope - there) : 0.1;
            const double shorter = step * std::clamp(ratio, 0.1, 0.7);
            block_.displace(shorter - step, d_, at_sites_);
            step = shorter;
            evaluate(false);
        }
        const auto t = phases_.time(Phase::sums);
        if (!newton) curvature_.learn(step, d_, g_, g_old_);
        return true;
    }

private:
    /// Newton's direction at the sites too, if it is of use: the energy is convex along it and no
    /// site is sent far away (where it is, the state is still moving, and Newton must wait).
    bool newton_direction(long long iteration) {
        const auto t = phases_.time(Phase::relax);
        if (newton_.direction(interface_, height_, stiffness_, rms_, g_, d_)) {
            block_.at_sites(d_, at_sites_);
            if (largest(at_sites_) <= 2.0 * options_.max_move) return true;
        }
        newton_from_ = iteration + patience;
        return false;
    }
    /// The direction, clipped, does not go down: what it was made of is forgotten.
    bool turn_back(bool newton, long long iteration) {
        if (newton) {
            newton_from_ = iteration + patience;
            return true;
        }
        if (curvature_.empty()) return false;
        curvature_.forget();
        return true;
    }

    static constexpr long long patience = 10; ///< iterations before Newton is tried (again)
    static constexpr double near_ = 0.005;    ///< mean residual, eV/Å, at which Newton is tried

    SpectralBlock& block_;
    const Interface& interface_;
    double height_;
    const RelaxOptions& options_;
    Phases& phases_;
    double stiffness_; ///< k: half of what a bonded site has, for not all are
    int sites_;
    Waves<double> g_, g_old_, d_;
    VectorField<double> at_sites_; ///< the direction, or the residual
    Curvature curvature_;
    Newton newton_;
    InterfaceSums sums_;
    double rms_ = 0.0;
    bool settled_ = false; ///< no site wanted further than max_move
    long long newton_from_ = patience;
};

} // namespace

RelaxedState relax(SpectralBlock& block, const Interface& interface, double reference_height,
                   const RelaxOptions& options, Phases& phases) {
    Descent descent(block, interface, reference_height, options, phases);
    RelaxedState state;
    descent.evaluate(false);
    for (;; ++state.iterations) {
        state.residual = descent.residual();
        if (state.residual <= options.tolerance || !std::isfinite(state.residual) ||
            state.iterations >= options.max_iterations)
            break;
        if (options.report && state.iterations % 10 == 0 &&
            options.report(state.iterations, state.residual)) {
            state.interrupted = true;
            break;
        }
        if (!descent.step(state.iterations)) break;
    }
    block.settle();
    descent.evaluate(true);
    const InterfaceSums& sums = descent.sums();
    state.residual = descent.largest_residual();
    state.converged = state.residual <= options.tolerance;
    state.interface_energy = sums.energy.value();
    state.force = sums.force_z.value();
    state.top_force = block.top_force();
    state.elastic_energy = block.elastic_energy();
    state.mean_height = block.mean_height();
    state.in_contact = sums.in_contact;
    state.pushed = sums.pushed;
    state.closest = std::sqrt(sums.closest_r2);
    return state;
}

std::size_t spectral_relaxation_bytes(int sites) {
    // Vectors of the sites: in double, the gradients, the direction (at the sites too) and a
    // displaced layer with its force; in single, the pairs, Newton's five and its map of six, and
    // its sites.
    const std::size_t vector =
        3 * static_cast<std::size_t>(sites) * static_cast<std::size_t>(sites);
    return vector * (6 * sizeof(double) + (2 * remembered_pairs + 8) * sizeof(float));
}

} // namespace asperity
