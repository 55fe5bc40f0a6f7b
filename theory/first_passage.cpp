// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// First passage of the stress through the moving detachment boundary.
//
// A path found below -b(T) at T must have crossed the boundary at some earlier T', and from there
// it is below -b(T) with probability Φ((b(T') - b(T))/√(T-T')). Hence, with F the absorbed
// fraction,
//     Φ(-(b_i + p)/√T_i) = Σ_j Φ((b_j - b_i)/√(T_i - T_j)) ΔF_j,     b = σ_a,
// a Volterra equation of the first kind, exact for any boundary. The sum takes b and T at the
// middle of each interval. The last interval's ΔF also sets b_i, through a_i = 1 - F_i and Eq. (3),
// so each step is one scalar root; the physical one is the smallest (a large step has a second,
// spurious one at nearly complete absorption), found by Newton from below.
//
// Error of order spacing^1.5 from the square root at the diagonal; persson.cpp extrapolates it
// away. Cost: n²/2 kernel evaluations times about two Newton steps, ~30 ns each.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "theory/integration.hpp"

namespace asperity::theory {
namespace {

double normal_below(double x) { return 0.5 * std::erfc(-x * (std::numbers::sqrt2 / 2)); }

double normal_density(double x) {
    return std::exp(-x * x / 2) * (std::numbers::inv_sqrtpi * std::numbers::sqrt2 / 2);
}

/// A kernel and its derivative with respect to the boundary b_i.
struct Crossing {
    double value, slope;
};

/// Absorbed so far: intervals with their middle boundary, middle variance and absorbed fraction.
struct History {
    std::vector<double> b, T, dF;

    [[nodiscard]] Crossing below(double b_now, double T_now) const {
        Crossing sum{0, 0};
        for (std::size_t j = 0; j < dF.size(); ++j) {
            const double inverse = 1 / std::sqrt(T_now - T[j]);
            const double x = (b[j] - b_now) * inverse;
            if (x < -9) continue;
            sum.value += normal_below(x) * dF[j];
            sum.slope -= normal_density(x) * inverse * dF[j];
        }
        return sum;
    }
};

/// The state at the end of a step as a function of what the step absorbs.
struct StepEnd {
    double area, energy, gamma, b;
    double b_slope; // db/dx, x the absorbed fraction of the step
};

} // namespace

IntegrationPath first_passage(const IntegrationGrid& grid, const IntegrationInput& in) {
    const std::size_t n = grid.q.size();
    IntegrationPath path;
    path.area.reserve(n);
    path.energy.reserve(n);
    path.gamma.reserve(n);
    path.detachment_stress.reserve(n);

    const auto end_of_step = [&](std::size_t i, double area, double energy_before,
                                 double share_before, double x) {
        const double a = area - x;
        const double d_energy = i == 0 ? 0 : grid.energy[i] - grid.energy[i - 1];
        StepEnd s{};
        s.area = a;
        s.energy = energy_before + d_energy * (share_before + energy_fraction(a, in.beta)) / 2;
        s.gamma = (in.g0 + s.energy) / (a * grid.stretch[i]);
        if (s.gamma > 0) {
            s.b = std::sqrt(s.gamma * in.contact_modulus * grid.q[i]);
            const double dW = in.beta + 3 * (1 - in.beta) * a * a;
            const double d_gamma = s.gamma / a - d_energy / 2 * dW / (a * grid.stretch[i]);
            s.b_slope = s.b * d_gamma / (2 * s.gamma);
        }
        return s;
    };
    const auto record = [&](const StepEnd& s) {
        path.area.push_back(s.area);
        path.energy.push_back(s.energy);
        path.gamma.push_back(s.gamma);
        path.detachment_stress.push_back(s.b);
    };

    // Everything before the first node is full contact.
    StepEnd now = end_of_step(0, 1, grid.energy[0], 1, 0);
    record(now);
    History history;
    // Absorbed fraction per unit of ln T in the last step and the one before: the next guess.
    double rate = 0, rate_before = 0;

    for (std::size_t i = 1; i < n; ++i) {
        const double T = grid.T[i], dT = T - grid.T[i - 1];
        const double fraction = energy_fraction(now.area, in.beta);
        const StepEnd before = now;
        if (!grid.ever_detaches || !(dT > 0)) { // full contact throughout, or a gap
            now = end_of_step(i, before.area, before.energy, fraction, 0);
            record(now);
            continue;
        }
        const double root_T = std::sqrt(T), root_half = std::sqrt(dT / 2);
        // Excess of paths below the boundary over those accounted for; falls as x grows.
        const auto excess = [&](double x, StepEnd& s, double& slope) {
            s = end_of_step(i, before.area, before.energy, fraction, x);
            const double y = -(s.b + in.pressure) / root_T;
            const double z = (before.b - s.b) / (2 * root_half);
            const Crossing past = history.below(s.b, T);
            const double self = normal_below(z);
            slope = (-normal_density(y) / root_T - past.slope +
                     normal_density(z) / (2 * root_half) * x) *
                        s.b_slope -
                    self;
            return normal_below(y) - past.value - self * x;
        };
        const double log_step = std::log(T / grid.T[i - 1]);
        // A boundary that runs away far faster than paths can follow (a gap of the spectrum, or
        // nearly one) absorbs nothing, and the equation would say so only as 0 = 0 x.
        const double receding =
            (before.b - end_of_step(i, before.area, before.energy, fraction, 0).b) /
            (2 * root_half);
        if (receding < -3) {
            now = end_of_step(i, before.area, before.energy, fraction, 0);
            record(now);
            rate = rate_before = 0;
            continue;
        }
        double low = 0, high = before.area * (1 - 1e-9);
        double x = std::clamp((2 * rate - rate_before) * log_step, 0.0, 0.5 * before.area);
        for (int iteration = 0; iteration < 60; ++iteration) {
            double slope = 0;
            const double f = excess(x, now, slope);
            (f > 0 ? low : high) = x;
            double next = x - f / slope;
            if (!(slope < 0) || !(next > low && next < high)) {
                // Out of the bracket: halve towards the low side, where the true root is.
                next = slope < 0 && next <= low ? low + 0.1 * (x - low) : (low + high) / 2;
            }
            const double moved = std::abs(next - x);
            x = next;
            // Newton squares the error, so the step after one this small would not be seen.
            if (moved < 1e-7 * before.area) break;
        }
        now = end_of_step(i, before.area, before.energy, fraction, x);
        record(now);
        history.b.push_back((before.b + now.b) / 2);
        history.T.push_back(grid.T[i - 1] + dT / 2);
        history.dF.push_back(x);
        rate_before = rate;
        rate = x / log_step;
    }
    return path;
}

} // namespace asperity::theory
