// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// In the frame of the boundary, z = σ + b with b = σ_a, Eq. (2) during one step has constant
// coefficients,
//     ∂P/∂T = ½ ∂²P/∂z² - b' ∂P/∂z,   P = 0 at z = 0,   b' = db/dT.
// On equidistant nodes z = h, 2h, ... the compact scheme of fourth order is then the same formula
// at all nodes,
//     (1 + δ²/12 - (q/24) δ) ∂P/∂T = 1/(2h²) [(1 + q²/12) δ² - (q/2) δ] P,   q = 2 b' h,
// where δP = P(z+h) - P(z-h) and δ² is the second difference. Steps are those of Crank and
// Nicolson. With the shift E, EP(z) = P(z+h), the matrix of a step is
//     c (1 - s E) (1 - t E⁻¹),
// exactly, because P = 0 at z = 0: two sweeps solve the equations, without a division. The spacing
// h follows √T, the width of P: it is doubled by leaving out every other node.
//
// The boundary at the end of a step depends on the area that is left, which is found by the secant
// method. In a gap of the spectrum only the boundary moves, and P is shifted.
#include "theory/stress_distribution.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace asperity::theory {
namespace {

/// Standard deviations beyond which there is nothing of a normal distribution: 4e-11 of it.
constexpr double tail = 6.5;
constexpr double least_area = 1e-30; ///< of a contact that has ended

/// The distribution P at the nodes z = h, 2h, ... above the boundary at the stress -b.
class StressNodes {
public:
    /// Starts with a normal distribution of variance T about the stress p.
    StressNodes(double b, double p, double T, double h) : b_(b), p_(p), h_(h) {
        prepare(b, T, h);
        for (std::size_t k = 0; k < P_.size(); ++k) {
            const double from_p = static_cast<double>(k + 1) * h - b - p;
            P_[k] = std::exp(-from_p * from_p / (2 * T)) / std::sqrt(2 * std::numbers::pi * T);
        }
    }

    /// Widens the spacing to h by leaving out every other node, and adds or removes nodes at the
    /// far end as a boundary up to b and a variance T need them.
    void prepare(double b, double T, double h) {
        while (h_ < 0.75 * h) {
            const double area_before = area();
            for (std::size_t k = 0; 2 * k + 1 < P_.size(); ++k)
                P_[k] = P_[2 * k + 1];
            P_.resize(P_.size() / 2);
            P_.resize(std::max(P_.size(), least));
            scale(area_before, 2 * h_);
        }
        const double last = (std::max(b, b_) + p_ + tail * std::sqrt(T)) / h_;
        P_.resize(static_cast<std::size_t>(std::max(last, double(least))));
    }

    /// Returns the area left after the boundary has moved to b and the variance has grown by dT.
    /// The state does not change until accept(b).
    double advance(double b, double dT) {
        const double r = dT / (4 * h_ * h_), q = 2 * (b - b_) * h_ / dT;
        const double spread = r * (1 + q * q / 12), drift = r * q / 2;
        // (before) P on the right side, (after) P on the left: factors of P(z-h), P(z), P(z+h).
        const double below = 1. / 12 + q / 24, above = 1. / 12 - q / 24, middle = 10. / 12;
        const double lower = below - spread - drift, upper = above - spread + drift;
        const double diagonal = middle + 2 * spread;
        const double c = (diagonal + std::sqrt(diagonal * diagonal - 4 * lower * upper)) / 2;
        const double s = -upper / c, t = -lower / c;
        const double from_below = (below + spread + drift) / c,
                     from_here = (middle - 2 * spread) / c,
                     from_above = (above + spread - drift) / c;
        // Each sweep as two recurrences, of the even and of the odd nodes, which run side by side.
        const std::size_t n = P_.size();
        next_.resize(n);
        double source = 0, value = 0, value_before = 0;
        for (std::size_t k = n; k-- > 0;) {
            const double P_below = k > 0 ? P_[k - 1] : 0, P_above = k + 1 < n ? P_[k + 1] : 0;
            const double now = from_below * P_below + from_here * P_[k] + from_above * P_above;
            const double solved = now + s * source + s * s * value_before;
            source = now;
            value_before = value;
            next_[k] = value = solved;
        }
        double sum = source = value = value_before = 0;
        for (std::size_t k = 0; k < n; ++k) {
            const double now = next_[k], solved = now + t * source + t * t * value_before;
            source = now;
            value_before = value;
            next_[k] = value = solved;
            sum += solved;
        }
        return area(sum, next_);
    }
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
        if (shift > 0) scale(area_before, h_);
    }

private:
    static constexpr std::size_t least = 4;

    /// Returns ∫ P dz from the sum of P, by Gregory's rule: trapezoidal, corrected at the boundary.
    [[nodiscard]] double area(double sum, const std::vector<double>& P) const {
        return h_ * (sum + P[0] / 4 - P[1] / 8 + P[2] / 36);
    }
    [[nodiscard]] double area() const {
        return area(std::accumulate(P_.begin(), P_.end(), 0.0), P_);
    }
    void scale(double wanted_area, double h) {
        h_ = h;
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

StressPath stress_path(const AdhesiveContact& c, const std::vector<StressStep>& at, double g0,
                       int nodes) {
    StressPath path;
    for (auto* column : {&path.area, &path.energy, &path.gamma, &path.detachment_stress})
        column->reserve(at.size());
    double area = 1, energy = 0, gamma = 0, b = 0;
    const auto set_boundary = [&](const StressStep& now) {
        gamma = (g0 + energy) / (area * now.stretch);
        b = std::sqrt(std::max(gamma, 0.0) * c.contact_modulus * now.q);
    };
    const auto out_of_reach = [&](const StressStep& now) {
        return b + c.pressure > tail * std::sqrt(now.T);
    };
    const auto record = [&] {
        path.area.push_back(area);
        path.energy.push_back(energy);
        path.gamma.push_back(gamma);
        path.detachment_stress.push_back(b);
    };
    // Full contact up to the last magnification before the boundary comes into reach.
    bool reached = false;
    for (std::size_t i = 0; i < at.size() && !reached; ++i) {
        energy = at[i].energy;
        set_boundary(at[i]);
        reached = !out_of_reach(at[i]);
        if (!reached || i == 0) record();
    }
    path.start = path.area.size() - 1;
    if (!reached) return path;
    energy = path.energy.back();
    set_boundary(at[path.start]);

    // Between `nodes` and twice as many in √T; whatever g0, the same at the same T.
    const auto spacing = [&, T1 = at.back().T](double T) {
        return std::sqrt(T1) / nodes * std::exp2(-std::ceil(std::log2(T1 / T) / 2));
    };
    StressNodes stress(b, c.pressure, at[path.start].T, spacing(at[path.start].T));
    double rate = 0, rate_before = 0; // of the area in ln T, over the last two steps
    double slope = -1;                // of the mismatch, in the last step
    const auto step = [&](const StressStep& from, const StressStep& to) {
        const double dT = to.T - from.T, d_energy = to.energy - from.energy;
        const double area0 = area, energy0 = energy, b0 = b;
        // The state at the end of the step if `trial` of the area is left.
        const auto try_area = [&](double trial) {
            area = std::clamp(trial, least_area, area0);
            energy =
                energy0 +
                d_energy * (energy_fraction(area0, c.beta) + energy_fraction(area, c.beta)) / 2;
            set_boundary(to);
        };
        try_area(area0);
        // A gap of the spectrum, or nearly one, or a boundary out of reach. P is then seen from a
        // boundary that is not farther away than need be.
        if (!(dT > 0) || b - b0 > 6 * std::sqrt(dT) || out_of_reach(to)) {
            const double seen_from = std::min(b, (tail + 1) * std::sqrt(to.T) - c.pressure);
            stress.prepare(seen_from, to.T, spacing(to.T));
            stress.move_boundary(seen_from);
            if (dT > 0) {
                try_area(stress.advance(seen_from, dT));
                stress.accept(seen_from);
            }
            rate = rate_before = 0;
            return;
        }
        stress.prepare(std::max(b0, b), to.T, spacing(to.T));
        stress.move_boundary(b0);
        const double log_step = std::log(to.T / from.T);
        const auto mismatch = [&](double trial) {
            try_area(trial);
            return stress.advance(b, dT) - trial;
        };
        const double guess = area0 - (2 * rate - rate_before) * log_step;
        double x = std::clamp(guess, 0.5 * area0, area0), f = mismatch(x);
        for (int iteration = 0; iteration < 30 && std::abs(f) > 1e-7 * area0; ++iteration) {
            const double x0 = x, f0 = f;
            x = std::clamp(x0 - f0 / slope, std::max(0.2 * x0, least_area), area0);
            if (x == x0) break;
            f = mismatch(x);
            if (f != f0) slope = (f - f0) / (x - x0);
        }
        try_area(x + f);
        stress.accept(b);
        rate_before = rate;
        rate = (area0 - area) / log_step;
    };
    for (std::size_t i = path.start + 1; i < at.size(); ++i) {
        const StressStep &from = at[i - 1], &to = at[i];
        // Where γ_eff becomes positive the boundary leaves zero as its root: steps of equal √γ_eff.
        const double gamma0 = gamma,
                     gamma1 =
                         (g0 + energy + (to.energy - from.energy) * energy_fraction(area, c.beta)) /
                         (area * to.stretch);
        StressStep here = from;
        if (g0 < 0 && gamma1 > 0 && gamma1 > gamma0) {
            const double root0 = std::sqrt(std::max(gamma0, 0.0)), root1 = std::sqrt(gamma1);
            const double parts = std::ceil(8 * (1 - root0 / root1));
            for (double k = gamma0 < 0 ? 0 : 1; k < parts; ++k) {
                const double root = root0 + (root1 - root0) * k / parts;
                const StressStep next =
                    between(from, to, (root * root - gamma0) / (gamma1 - gamma0));
                step(here, next);
                here = next;
            }
        }
        step(here, to);
        record();
    }
    return path;
}

} // namespace asperity::theory
