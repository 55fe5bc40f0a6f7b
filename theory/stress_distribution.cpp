// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The coordinate z = (σ + b)/ℓ, b = σ_a, keeps the absorbing boundary at z = 0 and the width of P
// near one,
//     ∂G/∂τ + ∂/∂z [ (db - z dℓ)/ℓ G ] = dT/(2ℓ²) ∂²G/∂z²,      G = ℓ P,
// with ℓ² = T + ((b + p)/12)²: √T as long as P is near the boundary, and growing with its distance,
// so that the cells (narrow at z = 0, ending at z = 20) always hold P. Fluxes are exponentially
// fitted (Scharfetter and Gummel), steps those of Crank and Nicolson. The boundary at the end of a
// step depends on the area that is left, which is found by the secant method. In a gap of the
// spectrum only the boundary moves: P is then carried over by its cumulative sum.
#include "theory/stress_distribution.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace asperity::theory {
namespace {

constexpr double out_of_reach = 9; ///< standard deviations: beyond it nothing is absorbed

double normal_below(double x) { return 0.5 * std::erfc(-x * (std::numbers::sqrt2 / 2)); }

double bernoulli(double x) {
    if (std::abs(x) < 1e-4) return 1 - x / 2 + x * x / 12;
    return x / std::expm1(x);
}

/// Cells in z and the fraction of P in each.
class StressCells {
public:
    explicit StressCells(int cells)
        : count_(static_cast<std::size_t>(cells)), face_(count_ + 1), centre_(count_),
          width_(count_), mass_(count_), left_(count_ + 1), right_(count_ + 1), next_(count_),
          work_(count_) {
        constexpr double z_end = 20, stretch = 2.5;
        for (std::size_t k = 0; k <= count_; ++k)
            face_[k] =
                z_end * std::sinh(stretch * static_cast<double>(k) / cells) / std::sinh(stretch);
        for (std::size_t k = 0; k < count_; ++k) {
            centre_[k] = (face_[k] + face_[k + 1]) / 2;
            width_[k] = face_[k + 1] - face_[k];
        }
    }

    /// Starts with a normal distribution of the stress about p, seen from the boundary b.
    void start(double b, double p, double T, double length) {
        double before = normal_below((-b - p) / std::sqrt(T));
        for (std::size_t k = 0; k < count_; ++k) {
            const double upto = normal_below((face_[k + 1] * length - b - p) / std::sqrt(T));
            mass_[k] = upto - before;
            before = upto;
        }
    }

    /// Returns the area left after the boundary has moved by db, the length from l0 to l1 and the
    /// variance by dT. The state does not change until accept().
    double advance(double db, double l0, double l1, double dT) {
        const double l2 = l0 * l1, D = dT / (2 * l2), dl = l1 - l0, l = std::sqrt(l2);
        // Through face k flows left_[k] times the density on its left less right_[k] times that on
        // its right. At z = 0 the density is zero, at the far end the flux is.
        for (std::size_t k = 0; k < count_; ++k) {
            const double h = k == 0 ? centre_[0] : centre_[k] - centre_[k - 1];
            const double peclet = (db - face_[k] * dl) / l * h / D;
            const double b = bernoulli(peclet);
            left_[k] = k == 0 ? 0 : D / h * (b + peclet); // = bernoulli(-peclet)
            right_[k] = D / h * b;
        }
        left_[count_] = right_[count_] = 0;
        // The Thomas algorithm for the mass of each cell.
        double super_before = 0, before = 0;
        for (std::size_t k = 0; k < count_; ++k) {
            const double diagonal = 1 + (left_[k + 1] + right_[k]) / (2 * width_[k]);
            const double sub = k == 0 ? 0 : -left_[k] / (2 * width_[k - 1]);
            const double super = k + 1 == count_ ? 0 : -right_[k + 1] / (2 * width_[k + 1]);
            double rhs = mass_[k] * (2 - diagonal);
            if (k > 0) rhs -= sub * mass_[k - 1];
            if (k + 1 < count_) rhs -= super * mass_[k + 1];
            const double pivot = 1 / (diagonal - sub * super_before);
            work_[k] = super_before = super * pivot;
            next_[k] = before = (rhs - sub * before) * pivot;
        }
        double area = next_[count_ - 1];
        for (std::size_t k = count_ - 1; k-- > 0;) {
            next_[k] -= work_[k] * next_[k + 1];
            area += next_[k];
        }
        return area;
    }
    void accept() { mass_.swap(next_); }

    /// Transfers the same P to another boundary and length.
    void carry_over(double b0, double l0, double b1, double l1) {
        std::size_t k = 0;
        double below = 0, previous = 0; // mass below face k, below the last new face
        for (std::size_t m = 0; m < count_; ++m) {
            const double z = (face_[m + 1] * l1 - b1 + b0) / l0; // the new face in old z
            while (k < count_ && face_[k + 1] <= z)
                below += mass_[k++];
            double upto = below;
            if (k < count_ && z > face_[k]) upto += mass_[k] * (z - face_[k]) / width_[k];
            next_[m] = upto - previous;
            previous = upto;
        }
        accept();
    }

private:
    std::size_t count_;
    std::vector<double> face_, centre_, width_, mass_, left_, right_, next_, work_;
};

} // namespace

Magnifications magnifications(const AdhesiveContact& c, double spacing) {
    Magnifications at;
    const auto add = [&](const Magnification& m) {
        at.q.push_back(m.q);
        at.T.push_back(std::numbers::pi / 2 * c.contact_modulus * c.contact_modulus * m.slope);
        at.energy.push_back(std::numbers::pi / 2 * c.contact_modulus * m.energy);
        at.stretch.push_back(
            area_factor(c.area_factor, 2 * std::numbers::pi * m.slope, c.tilt_cost));
    };
    // L = ln(q/q_first), q_first the smallest wavevector with any roughness.
    constexpr double first = -75; // start of ln(q/q_first - 1): T is 1e-32 of the whole
    const std::vector<double> edges = c.spectrum.edges();
    const double last = edges.back();
    std::vector<double> marks(edges.begin() + 1, edges.end());
    for (double x = first; x < 40 && std::log1p(std::exp(x)) < last; x += spacing)
        marks.push_back(std::log1p(std::exp(x)));
    std::sort(marks.begin(), marks.end());
    add(c.spectrum.from_first(marks.front()));
    for (std::size_t i = 1; i < marks.size(); ++i) {
        // In halves as long as T grows too much.
        std::vector<double> ends = {marks[i]};
        double L = marks[i - 1], slope = c.spectrum.from_first(L).slope;
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
    if (c.spectrum.q1() > (1 + 1e-12) * at.q.back()) add(c.spectrum.last()); // smooth up to there
    return at;
}

StressPath stress_path(const AdhesiveContact& c, const Magnifications& at, double g0, int cells) {
    const std::size_t n = at.q.size();
    StressPath path;
    double area = 1, energy = 0, gamma = 0, b = 0, l = 0;
    const auto set_boundary = [&](std::size_t i) {
        gamma = (g0 + energy) / (area * at.stretch[i]);
        b = std::sqrt(std::max(gamma, 0.0) * c.contact_modulus * at.q[i]);
        const double far = (b + c.pressure) / 12;
        l = std::sqrt(at.T[i] + far * far);
    };
    const auto record = [&] {
        path.area.push_back(area);
        path.energy.push_back(energy);
        path.gamma.push_back(gamma);
        path.detachment_stress.push_back(b);
    };
    // Full contact up to the last magnification before the boundary comes into reach.
    bool reached = false;
    for (std::size_t i = 0; i < n && !reached; ++i) {
        energy = at.energy[i];
        set_boundary(i);
        reached = b + c.pressure < out_of_reach * std::sqrt(at.T[i]);
        if (!reached || i == 0) record();
    }
    path.start = path.area.size() - 1;
    if (!reached) return path;
    energy = path.energy.back();
    set_boundary(path.start);

    StressCells stress(cells);
    stress.start(b, c.pressure, at.T[path.start], l);
    double rate = 0; // rate of the area in ln T, over the step before
    for (std::size_t i = path.start + 1; i < n; ++i) {
        const double dT = at.T[i] - at.T[i - 1], d_energy = at.energy[i] - at.energy[i - 1];
        const double area0 = area, energy0 = energy, b0 = b, l0 = l;
        // The state at the end of the step if `trial` of the area is left.
        const auto try_area = [&](double trial) {
            area = trial;
            energy =
                energy0 +
                d_energy * (energy_fraction(area0, c.beta) + energy_fraction(area, c.beta)) / 2;
            set_boundary(i);
        };
        try_area(area0);
        if (!(dT > 0) || b - b0 > 6 * std::sqrt(dT)) { // a gap, or nearly one: P spreads hardly
            stress.carry_over(b0, l0, b, l);
            if (dT > 0) {
                try_area(std::min(area0, stress.advance(0, l, l, dT)));
                stress.accept();
            }
            rate = 0;
        } else {
            const double log_step = std::log(at.T[i] / at.T[i - 1]);
            const auto mismatch = [&](double trial) {
                try_area(trial);
                return stress.advance(b - b0, l0, l, dT) - trial;
            };
            double x0 = area0, f0 = mismatch(x0);
            double x1 = std::max(0.5 * area0, area0 - rate * log_step);
            if (x1 == x0) x1 = std::clamp(x0 + f0, 0.5 * area0, area0);
            for (int iteration = 0; iteration < 30 && x1 != x0; ++iteration) {
                const double f1 = mismatch(x1);
                if (std::abs(f1) < 1e-10 * area0 || f1 == f0) break;
                const double next = std::clamp(x1 - f1 * (x1 - x0) / (f1 - f0), 0.2 * x1, area0);
                x0 = x1;
                f0 = f1;
                x1 = next;
            }
            try_area(x1);
            stress.accept();
            rate = (area0 - area) / log_step;
        }
        record();
    }
    return path;
}

} // namespace asperity::theory
