// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The coordinate z = (σ + σ_a)/ℓ keeps the absorbing boundary at z = 0 and the width of P near one,
//     ∂G/∂τ + ∂/∂z [ (db - z dℓ)/ℓ G ] = dT/(2ℓ²) ∂²G/∂z²,      G = ℓ P,  b = σ_a,
// with ℓ² = T + ((b + p)/12)²: √T as long as P is near the boundary, and growing with the
// boundary's distance once that runs away, so that the mesh (fine at z = 0, ending at z = 20)
// always holds P. Exponentially fitted (Scharfetter-Gummel) fluxes, conservative and free of
// wiggles at any cell Peclet number; Crank-Nicolson; the boundary at the end of a step depends on
// the area left, so a step is solved by secants on that area. In a gap of the spectrum only the
// boundary moves: P is then carried over to the new mesh by its cumulative sum.
//
// Cost: cells × nodes × ~4 tridiagonal sweeps. Second order in both.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "support/diffusion.hpp"

namespace asperity::theory {
namespace {

constexpr double z_end = 20;

double normal_below(double x) { return 0.5 * std::erfc(-x * (std::numbers::sqrt2 / 2)); }

double bernoulli(double x) {
    if (std::abs(x) < 1e-4) return 1 - x / 2 + x * x / 12;
    return x / std::expm1(x);
}

/// Cells in z, their faces and the fraction of P in each.
class StressCells {
public:
    explicit StressCells(int cells)
        : count_(static_cast<std::size_t>(cells)), face_(count_ + 1), centre_(count_),
          mass_(count_), left_(count_ + 1), right_(count_ + 1), next_(count_), work_(count_) {
        constexpr double stretch = 2.5;
        for (std::size_t k = 0; k <= count_; ++k)
            face_[k] =
                z_end * std::sinh(stretch * static_cast<double>(k) / cells) / std::sinh(stretch);
        for (std::size_t k = 0; k < count_; ++k)
            centre_[k] = (face_[k] + face_[k + 1]) / 2;
    }

    /// A normal distribution of the stress about p, seen from the boundary.
    void start(double b, double p, double T, double length) {
        double before = normal_below((-b - p) / std::sqrt(T));
        for (std::size_t k = 0; k < count_; ++k) {
            const double upto = normal_below((face_[k + 1] * length - b - p) / std::sqrt(T));
            mass_[k] = upto - before;
            before = upto;
        }
    }

    /// The boundary moves by db, the length by dl, the variance by dT; returns the area left.
    /// The old state stays until accept().
    double advance(double db, double l0, double l1, double dT) {
        const double l2 = l0 * l1, l = std::sqrt(l2), D = dT / (2 * l2);
        // Flux through face k: left_[k] times the density on its left minus right_[k] times that on
        // its right, for the whole step. At z = 0 the density is zero, at the far end the flux is.
        for (std::size_t k = 0; k < count_; ++k) {
            const double h = k == 0 ? centre_[0] : centre_[k] - centre_[k - 1];
            const double peclet = (db - face_[k] * (l1 - l0)) / l * h / D;
            left_[k] = k == 0 ? 0 : D / h * bernoulli(-peclet);
            right_[k] = D / h * bernoulli(peclet);
        }
        left_[count_] = right_[count_] = 0;
        // Crank-Nicolson by the Thomas algorithm, unknown: the mass of each cell.
        double sub_before = 0, g_before = 0;
        for (std::size_t k = 0; k < count_; ++k) {
            const double w = width(k);
            const double diagonal = 1 + (left_[k + 1] + right_[k]) / (2 * w);
            const double sub = k == 0 ? 0 : -left_[k] / (2 * width(k - 1));
            const double super = k + 1 == count_ ? 0 : -right_[k + 1] / (2 * width(k + 1));
            double rhs = mass_[k] * (2 - diagonal);
            if (k > 0) rhs -= sub * mass_[k - 1];
            if (k + 1 < count_) rhs -= super * mass_[k + 1];
            const double pivot = diagonal - sub * sub_before;
            work_[k] = sub_before = super / pivot;
            next_[k] = g_before = (rhs - sub * g_before) / pivot;
        }
        double area = next_[count_ - 1];
        for (std::size_t k = count_ - 1; k-- > 0;) {
            next_[k] -= work_[k] * next_[k + 1];
            area += next_[k];
        }
        return area;
    }
    void accept() { mass_.swap(next_); }

    /// The same P about another boundary and length.
    void carry_over(double b0, double l0, double b1, double l1) {
        std::size_t k = 0;
        double below = 0, previous = 0; // mass below face k, below the last new face
        for (std::size_t m = 0; m < count_; ++m) {
            const double z = (face_[m + 1] * l1 - b1 + b0) / l0; // the new face in old z
            while (k < count_ && face_[k + 1] <= z)
                below += mass_[k++];
            double upto = below;
            if (k < count_ && z > face_[k]) upto += mass_[k] * (z - face_[k]) / width(k);
            next_[m] = upto - previous;
            previous = upto;
        }
        accept();
    }

private:
    [[nodiscard]] double width(std::size_t k) const { return face_[k + 1] - face_[k]; }

    std::size_t count_;
    std::vector<double> face_, centre_, mass_, left_, right_, next_, work_;
};

} // namespace

IntegrationPath diffusion(const IntegrationGrid& grid, const IntegrationInput& in, double spacing) {
    const int cells = static_cast<int>(std::lround(std::max(20.0, 40 / spacing)));
    const std::size_t n = grid.q.size();
    IntegrationPath path;
    double area = 1, energy = grid.energy[0];
    double gamma = (in.g0 + energy) / grid.stretch[0];
    const auto boundary = [&](double gamma_now, std::size_t i) {
        return std::sqrt(std::max(gamma_now, 0.0) * in.contact_modulus * grid.q[i]);
    };
    const auto length = [&](double b_now, std::size_t i) {
        const double far = (b_now + in.pressure) / 12;
        return std::sqrt(grid.T[i] + far * far);
    };
    double b = boundary(gamma, 0);
    const auto record = [&] {
        path.area.push_back(area);
        path.energy.push_back(energy);
        path.gamma.push_back(gamma);
        path.detachment_stress.push_back(b);
    };
    record();

    StressCells stress(cells);
    double l = 0;
    if (grid.ever_detaches) {
        l = length(b, 0);
        stress.start(b, in.pressure, grid.T[0], l);
    }
    double rate = 0;
    for (std::size_t i = 1; i < n; ++i) {
        const double dT = grid.T[i] - grid.T[i - 1];
        const double d_energy = grid.energy[i] - grid.energy[i - 1];
        const double area0 = area, energy0 = energy, b0 = b, l0 = l;
        // The state at the end if `trial` of the area is left.
        const auto solve_boundary = [&](double trial) {
            area = trial;
            energy =
                energy0 +
                d_energy * (energy_fraction(area0, in.beta) + energy_fraction(area, in.beta)) / 2;
            gamma = (in.g0 + energy) / (area * grid.stretch[i]);
            b = boundary(gamma, i);
            l = length(b, i);
        };
        if (!grid.ever_detaches || !(dT > 0)) {
            solve_boundary(area0);
            if (grid.ever_detaches) stress.carry_over(b0, l0, b, l);
            record();
            continue;
        }
        const double log_step = std::log(grid.T[i] / grid.T[i - 1]);
        solve_boundary(area0);
        if (b - b0 > 6 * std::sqrt(dT)) { // nearly a gap: the boundary leaves first, then P spreads
            stress.carry_over(b0, l0, b, l);
            solve_boundary(std::min(area0, stress.advance(0, l, l, dT)));
            stress.accept();
            rate = 0;
            record();
            continue;
        }
        const auto mismatch = [&](double trial) {
            solve_boundary(trial);
            return stress.advance(b - b0, l0, l, dT) - trial;
        };
        double x0 = area0, f0 = mismatch(x0);
        double x1 = std::max(0.5 * area0, area0 - rate * log_step);
        if (x1 == x0) x1 = std::clamp(x0 + f0, 0.5 * area0, area0);
        for (int iteration = 0; iteration < 30 && x1 != x0; ++iteration) {
            const double f1 = mismatch(x1);
            if (std::abs(f1) < 1e-14 * area0 || f1 == f0) break;
            const double next = std::clamp(x1 - f1 * (x1 - x0) / (f1 - f0), 0.2 * x1, area0);
            x0 = x1;
            f0 = f1;
            x1 = next;
        }
        solve_boundary(x1);
        stress.accept();
        rate = (area0 - area) / log_step;
        record();
    }
    return path;
}

} // namespace asperity::theory
