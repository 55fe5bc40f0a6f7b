// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// In the frame of the boundary, z = σ + b with b = σ_a, Eq. (2) has constant coefficients during a
// step from T to T + dT, in which b grows by db:
//     ∂P/∂T = ½ ∂²P/∂z² - (db/dT) ∂P/∂z,   P = 0 at z = 0.
// On the nodes z = h, 2h, ... the compact scheme of fourth order is
//     (1 + δ²/12 - q δ/24) ∂P/∂T = [(1 + q²/12) δ² - q δ/2] P / (2h²),   q = 2h db/dT,
// with the differences δP = P(z+h) - P(z-h) and δ²P = P(z+h) - 2P(z) + P(z-h). Crank-Nicolson steps
// lead to equations with the same three coefficients at each node. Their matrix is exactly
//     c (1 - s E)(1 - t/E),   E P(z) = P(z+h),
// because P = 0 at z = 0: a sweep towards the boundary and a sweep away from it solve the
// equations. The spacing h grows with the width √T of P: every other node is left out from time to
// time.
//
// The boundary at the end of a step depends on the area that is left, which is found by the secant
// method. While nothing reaches the boundary, P spreads freely; in a gap of the spectrum only the
// boundary moves. P is then interpolated at the nodes above the new boundary.
#include "theory/stress_distribution.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>

namespace asperity::theory {
namespace {

/// Standard deviations beyond which a normal distribution is neglected: 4e-11 of its area.
constexpr double tail = 6.5;
/// Smallest area that is computed.
constexpr double least_area = 1e-30;

/// The distribution P at the nodes z = h, 2h, ... above the boundary, which is at the stress -b.
class StressNodes {
public:
    /// Starts with a normal distribution of variance T about the stress p.
    StressNodes(double b, double p, double T, double h) : b_(b), p_(p), h_(h) {
        resize(b, T);
        for (std::size_t k = 0; k < P_.size(); ++k) {
            const double from_p = static_cast<double>(k + 1) * h - b - p;
            P_[k] = std::exp(-from_p * from_p / (2 * T)) / std::sqrt(2 * std::numbers::pi * T);
        }
    }

    /// Makes room for a boundary up to b and a variance up to T, at the spacing h.
    void make_room(double b, double T, double h) {
        while (h_ < 0.75 * h) {
            const double area_before = area();
            for (std::size_t k = 0; 2 * k + 1 < P_.size(); ++k)
                P_[k] = P_[2 * k + 1];
            P_.resize(P_.size() / 2);
            h_ *= 2;
            resize(b, T);
            scale_to(area_before);
        }
        resize(b, T);
    }

    /// Returns the area left after the boundary has moved to b and the variance has grown by dT.
    /// The state does not change until accept().
    double advance(double b, double dT) {
        const double r = dT / (4 * h_ * h_), q = 2 * h_ * (b - b_) / dT;
        const double spread = r * (1 + q * q / 12), drift = r * q / 2;
        // Coefficients of P(z-h), P(z) and P(z+h): of ∂P/∂T, before the step, after the step.
        const double rate[] = {1. / 12 + q / 24, 10. / 12, 1. / 12 - q / 24};
        const double before[] = {rate[0] + spread + drift, rate[1] - 2 * spread,
                                 rate[2] + spread - drift};
        const double after[] = {rate[0] - spread - drift, rate[1] + 2 * spread,
                                rate[2] - spread + drift};
        const double c = (after[1] + std::sqrt(after[1] * after[1] - 4 * after[0] * after[2])) / 2;
        const double s = -after[2] / c, t = -after[0] / c;
        const double below = before[0] / c, here = before[1] / c, above = before[2] / c;
        // Each sweep has two recurrences side by side: a node depends on the next but one.
        const std::size_t n = P_.size();
        next_.resize(n);
        double source_last = 0, last = 0, last_but_one = 0;
        for (std::size_t k = n; k-- > 0;) {
            const double source = (k > 0 ? below * P_[k - 1] : 0) + here * P_[k] +
                                  (k + 1 < n ? above * P_[k + 1] : 0);
            next_[k] = source + s * source_last + s * s * last_but_one;
            source_last = source;
            last_but_one = last;
            last = next_[k];
        }
        double sum = source_last = last = last_but_one = 0;
        for (std::size_t k = 0; k < n; ++k) {
            const double source = next_[k];
            next_[k] = source + t * source_last + t * t * last_but_one;
            source_last = source;
            last_but_one = last;
            last = next_[k];
            sum += last;
        }
        return area(sum, next_);
    }
    /// Takes over the state of the last advance(), whose boundary is b.
    void accept(double b) {
        P_.swap(next_);
        b_ = b;
    }

    /// Moves the boundary to b at the same P, by cubic interpolation.
    void move_boundary(double b) {
        if (b == b_) return;
        const double shift = (b - b_) / h_, whole = std::floor(shift), x = shift - whole;
        const double weights[] = {-x * (1 - x) * (2 - x) / 6, (1 - x * x) * (2 - x) / 2,
                                  x * (1 + x) * (2 - x) / 2, -x * (1 - x * x) / 6};
        const double area_before = area();
        next_.assign(P_.size(), 0);
        for (std::size_t k = 0; k < next_.size(); ++k)
            for (int j = 0; j < 4; ++j) {
                const double from = static_cast<double>(k) - whole + 1 - j;
                if (from >= 0 && from < static_cast<double>(P_.size()))
                    next_[k] += weights[j] * P_[static_cast<std::size_t>(from)];
            }
        accept(b);
        if (shift > 0) scale_to(area_before);
    }

private:
    void resize(double b, double T) {
        const double last = (std::max(b, b_) + p_ + tail * std::sqrt(T)) / h_;
        P_.resize(static_cast<std::size_t>(std::max(last, 4.0)));
    }
    /// Returns ∫ P dz from the sum of P, by Gregory's rule: trapezoidal, corrected at the boundary.
    [[nodiscard]] double area(double sum, const std::vector<double>& P) const {
        return h_ * (sum + P[0] / 4 - P[1] / 8 + P[2] / 36);
    }
    [[nodiscard]] double area() const {
        return area(std::accumulate(P_.begin(), P_.end(), 0.0), P_);
    }
    void scale_to(double wanted_area) {
        if (const double now = area(); now > 0)
            for (double& value : P_)
                value *= wanted_area / now;
    }

    double b_, p_, h_;
    std::vector<double> P_, next_;
};

StressStep between(const StressStep& a, const StressStep& b, double x) {
    return {std::lerp(a.q, b.q, x), std::lerp(a.T, b.T, x), std::lerp(a.energy, b.energy, x),
            std::lerp(a.stretch, b.stretch, x)};
}

/// The state at one magnification, which moves on to larger ones.
class StressMarch {
public:
    StressMarch(const AdhesiveContact& contact, double g0) : contact_(contact), g0_(g0) {}

    double area = 1, energy = 0, gamma = 0, b = 0; ///< A/A0, u, γ_eff, σ_a

    /// Sets full contact at a magnification. Returns true if the boundary is out of reach.
    bool set_full_contact(const StressStep& at) {
        energy = at.energy;
        set_boundary(at);
        return out_of_reach(at);
    }

    /// Prepares for steps from full contact up to `last`. There are at least `nodes` nodes in √T
    /// and at most twice as many.
    void start(const StressStep& from, const StressStep& last, int nodes) {
        set_full_contact(from);
        T_last_ = last.T;
        h_last_ = std::sqrt(last.T) / nodes;
        stress_.emplace(b, contact_.pressure, from.T, spacing(from.T));
    }

    /// Moves on from one magnification to the next.
    void advance(const StressStep& from, const StressStep& to) {
        const double gamma0 = gamma;
        const double gamma1 =
            (g0_ + energy + (to.energy - from.energy) * energy_fraction(area, contact_.beta)) /
            (area * to.stretch);
        StressStep here = from;
        if (g0_ < 0 && gamma1 > std::max(gamma0, 0.0)) {
            // The boundary leaves zero as √γ_eff, which grows by at most an eighth in a step.
            const double root0 = std::sqrt(std::max(gamma0, 0.0)), root1 = std::sqrt(gamma1);
            const double parts = std::ceil(8 * (1 - root0 / root1));
            for (double k = gamma0 < 0 ? 0 : 1; k < parts; ++k) {
                const double root = std::lerp(root0, root1, k / parts);
                const StressStep next =
                    between(from, to, (root * root - gamma0) / (gamma1 - gamma0));
                step(here, next);
                here = next;
            }
        }
        step(here, to);
    }

private:
    void set_boundary(const StressStep& at) {
        gamma = (g0_ + energy) / (area * at.stretch);
        b = std::sqrt(std::max(gamma, 0.0) * contact_.contact_modulus * at.q);
    }
    [[nodiscard]] bool out_of_reach(const StressStep& at) const {
        return b + contact_.pressure > tail * std::sqrt(at.T);
    }
    /// Returns the spacing of the nodes, which depends on T alone so that γ_eff(ζ_1) is a smooth
    /// function of g0.
    [[nodiscard]] double spacing(double T) const {
        return h_last_ * std::exp2(-std::ceil(std::log2(T_last_ / T) / 2));
    }

    void step(const StressStep& from, const StressStep& to) {
        const double dT = to.T - from.T, d_energy = to.energy - from.energy;
        const double area0 = area, energy0 = energy, b0 = b;
        const auto set_area = [&](double trial) {
            area = std::clamp(trial, least_area, area0);
            energy = energy0 + d_energy *
                                   (energy_fraction(area0, contact_.beta) +
                                    energy_fraction(area, contact_.beta)) /
                                   2;
            set_boundary(to);
        };
        set_area(area0);
        // In a gap of the spectrum, or nearly a gap, the boundary moves first. A boundary out of
        // reach is replaced by one that is just out of reach, which needs fewer nodes.
        if (!(dT > 0) || b - b0 > 6 * std::sqrt(dT) || out_of_reach(to)) {
            const double just_out = (tail + 1) * std::sqrt(to.T) - contact_.pressure;
            const double boundary = std::min(b, just_out);
            stress_->make_room(boundary, to.T, spacing(to.T));
            stress_->move_boundary(boundary);
            if (dT > 0) {
                set_area(stress_->advance(boundary, dT));
                stress_->accept(boundary);
            }
            rate_ = rate_before_ = 0;
            return;
        }
        stress_->make_room(b, to.T, spacing(to.T));
        const auto mismatch = [&](double trial) {
            set_area(trial);
            return stress_->advance(b, dT) - trial;
        };
        const double log_step = std::log(to.T / from.T);
        const double guess = area0 - (2 * rate_ - rate_before_) * log_step;
        double x = std::clamp(guess, 0.5 * area0, area0), f = mismatch(x);
        for (int iteration = 0; iteration < 30 && std::abs(f) > 1e-7 * area0; ++iteration) {
            const double x0 = x, f0 = f;
            x = std::clamp(x0 - f0 / slope_, std::max(0.2 * x0, least_area), area0);
            if (x == x0) break;
            f = mismatch(x);
            if (f != f0) slope_ = (f - f0) / (x - x0);
        }
        set_area(x + f);
        stress_->accept(b);
        rate_before_ = rate_;
        rate_ = (area0 - area) / log_step;
    }

    const AdhesiveContact& contact_;
    double g0_, T_last_ = 0, h_last_ = 0;
    std::optional<StressNodes> stress_;
    double rate_ = 0, rate_before_ = 0; // the area lost over ln T in the last two steps
    double slope_ = -1;                 // derivative of the mismatch in the step before
};

} // namespace

std::vector<StressStep> stress_steps(const AdhesiveContact& c, double spacing) {
    std::vector<StressStep> at;
    const auto add = [&](const Magnification& m) {
        at.push_back({m.q, std::numbers::pi / 2 * c.contact_modulus * c.contact_modulus * m.slope,
                      std::numbers::pi / 2 * c.contact_modulus * m.energy,
                      area_factor(c.area_factor, 2 * std::numbers::pi * m.slope, c.tilt_cost)});
    };
    // L = ln(q/q_first), q_first the smallest wavevector with any roughness.
    constexpr double first = -75; // start of ln(q/q_first - 1): T is 1e-32 of the whole
    const std::vector<double> edges = c.spectrum.edges();
    const double last = edges.back();
    std::vector<double> marks(edges.begin() + 1, edges.end());
    for (double x = first; x < 40 && std::log1p(std::exp(x)) < last; x += spacing)
        marks.push_back(std::log1p(std::exp(x)));
    std::sort(marks.begin(), marks.end());
    double L = marks.front(), slope = c.spectrum.from_first(L).slope;
    add(c.spectrum.from_first(L));
    std::vector<double> ends;
    for (std::size_t i = 1; i < marks.size(); ++i) {
        // In halves as long as T grows too much.
        ends.push_back(marks[i]);
        while (!ends.empty()) {
            const Magnification m = c.spectrum.from_first(ends.back());
            const double half = (L + ends.back()) / 2;
            if (m.slope > slope * std::exp(spacing) && half > L && half < ends.back()) {
                ends.push_back(half);
                continue;
            }
            if (ends.back() > L) add(m);
            L = ends.back();
            slope = m.slope;
            ends.pop_back();
        }
    }
    if (c.spectrum.q1() > (1 + 1e-12) * at.back().q) add(c.spectrum.last()); // smooth up to there
    return at;
}

StressPath stress_path(const AdhesiveContact& c, const std::vector<StressStep>& steps, double g0,
                       int nodes) {
    StressPath path;
    for (auto* column : {&path.area, &path.energy, &path.gamma, &path.detachment_stress})
        column->reserve(steps.size());
    StressMarch state(c, g0);
    const auto record = [&] {
        path.area.push_back(state.area);
        path.energy.push_back(state.energy);
        path.gamma.push_back(state.gamma);
        path.detachment_stress.push_back(state.b);
    };
    // Full contact up to the last magnification before the boundary comes into reach.
    for (const StressStep& at : steps) {
        if (!state.set_full_contact(at) && !path.area.empty()) break;
        record();
    }
    path.start = path.area.size() - 1;
    if (path.area.size() == steps.size()) return path;
    state.start(steps[path.start], steps.back(), nodes);
    for (std::size_t i = path.start + 1; i < steps.size(); ++i) {
        state.advance(steps[i - 1], steps[i]);
        record();
    }
    return path;
}

} // namespace asperity::theory
