// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/waves/block_memory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace asperity {

namespace {

/// Returns exp(-x) - 1 + x without loss of digits.
double beyond_linear(double x) {
    if (x > 0.5) return std::expm1(-x) + x;
    double term = 0.5 * x * x, sum = term;
    for (int n = 3; n < 20; ++n)
        sum += term *= -x / n;
    return sum;
}

/// Factors of a step that is x relaxation times long: h' = e h + b d + g c.
struct Decay {
    double e, b = 1.0, g = 0.0;
    explicit Decay(double x) : e(std::exp(-x)) {
        if (x == 0.0) return;
        const double left = -std::expm1(-x);
        b = left / x;
        if (x > 0.1) {
            g = (1.0 - b - 0.5 * left) / x;
            return;
        }
        // x/12 - x^2/24 + ...: (-1)^n x^(n - 1) (n - 1)/(2 (n + 1)!), from n = 2 on
        double power = x / 12.0;
        for (int n = 2; n < 14; ++n) {
            g += power;
            power *= -x * n / ((n - 1.0) * (n + 2.0));
        }
    }
};

/// 1/tau int h.(S h) dt over a step as a sum of squares, |y0|^2 + |y1|^2 + |y2|^2 with
/// y0 = l00 h + l10 d + l20 c, y1 = l11 d + l21 c, y2 = l22 c: Cholesky's factor of the integrals
/// of products of exp(-s), (1 - exp(-s))/x and (exp(-s) - 1 + s - (1 - exp(-s)) x/2)/x^2, which h,
/// d and c are multiplied by in h(s), over 0 < s < x.
struct Loss {
    double l00 = 0.0, l10 = 0.0, l11 = 0.0, l20 = 0.0, l21 = 0.0, l22 = 0.0;
    explicit Loss(double x) {
        if (x == 0.0) return;
        double m[3][3] = {};
        if (x < 2.0) {
            // Gauss' rule of eight points: to rounding.
            constexpr double at[4] = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267,
                                      0.9602898564975363},
                             weight[4] = {0.3626837833783620, 0.3137066458778873,
                                          0.2223810344533745, 0.1012285362903763};
            for (int i = 0; i < 8; ++i) {
                const double s = 0.5 * x * (1.0 + (i % 2 ? at[i / 2] : -at[i / 2]));
                const double left = -std::expm1(-s);
                const double f[3] = {std::exp(-s), left / x,
                                     (beyond_linear(s) - 0.5 * x * left) / (x * x)};
                for (int a = 0; a < 3; ++a)
                    for (int b = 0; b <= a; ++b)
                        m[a][b] += 0.5 * x * weight[i / 2] * f[a] * f[b];
            }
        } else {
            // Integrals of exp(-2 s), exp(-s) (1 - exp(-s)), (1 - exp(-s))^2, with
            // q = exp(-s) - 1 + s: q exp(-s), q (1 - exp(-s)) and q^2.
            const double e = std::exp(-x), left = -std::expm1(-x);
            const double ee = -0.5 * std::expm1(-2.0 * x), el = left - ee, ll = x - left - el;
            // int s exp(-s) = left - x e (x e vanishes for long steps)
            const double xe = std::isinf(x) ? 0.0 : x * e;
            const double se = left - xe, eq = ee - left + se;
            if (std::isinf(x)) {
                m[0][0] = ee;
            } else {
                const double sl = 0.5 * x * x - se, lq = sl - ll;
                const double qq = x * x * x / 3.0 - 2.0 * sl + ll;
                m[0][0] = ee;
                m[1][0] = el / x;
                m[1][1] = ll / (x * x);
                m[2][0] = (eq - 0.5 * x * el) / (x * x);
                m[2][1] = (lq - 0.5 * x * ll) / (x * x * x);
                m[2][2] = (qq - x * lq + 0.25 * x * x * ll) / (x * x * x * x);
            }
        }
        const auto root = [](double y) { return std::sqrt(std::max(y, 0.0)); };
        const auto over = [](double y, double by) { return by > 0.0 ? y / by : 0.0; };
        l00 = root(m[0][0]);
        l10 = over(m[1][0], l00);
        l20 = over(m[2][0], l00);
        l11 = root(m[1][1] - l10 * l10);
        l21 = over(m[2][1] - l20 * l10, l11);
        l22 = root(m[2][2] - l20 * l20 - l21 * l21);
    }
};

/// Computes to = a x + b y, site by site; `to` may be x or y.
void combine(double a, const SiteField<double>& x, double b, const SiteField<double>& y,
             SiteField<double>& to) {
    for (std::size_t c = 0; c < to.size(); ++c) {
        const PlaneView<const double> from_x = x[c].plane(0), from_y = y[c].plane(0);
        const PlaneView<double> result = to[c].plane(0);
#pragma omp parallel for schedule(static)
        for (int row = 0; row < result.ny; ++row) {
            const double* const xs = from_x.line(row);
            const double* const ys = from_y.line(row);
            double* const line = result.line(row);
            for (int i = 0; i < result.nx; ++i)
                line[i] = a * xs[i] + b * ys[i];
        }
    }
}

} // namespace

BlockMemory::BlockMemory(const std::vector<Branch>& branches, const Slab& slab, int components,
                         Workspace& workspace, BranchedBlock block)
    : branches_(branches), slab_(slab), components_(components), workspace_(workspace),
      block_(std::move(block)), w_(new_field()) {
    for (std::size_t k = 0; k < branches.size(); ++k)
        h_.push_back(new_field());
    for (int i = 0; i < 2; ++i)
        history_.push_back(new_field());
}

namespace {

/// Returns the components of fields as arrays "/level0/<what><number>_<component>".
std::vector<RestoredArray> arrays_of(const char* what, std::vector<SiteField<double>>& fields) {
    std::vector<RestoredArray> list;
    for (std::size_t k = 0; k < fields.size(); ++k)
        for (std::size_t c = 0; c < fields[k].size(); ++c)
            list.push_back({fmt::format("/level0/{}{}_{}", what, k, c), 0, &fields[k][c], 1});
    return list;
}

} // namespace

std::vector<RestoredArray> BlockMemory::arrays() { return arrays_of("branch", h_); }
std::vector<RestoredArray> BlockMemory::arrays_of_last_step() {
    return arrays_of("history", history_);
}

void BlockMemory::forget_last_step() {
    for (SiteField<double>& field : history_)
        field = new_field();
}

void BlockMemory::begin(const TimeStep& step) {
    w_ = block_.shape();
    step_ = step;
    if (std::isinf(step.dt)) step_.last = units::forever;
}

double BlockMemory::weight() const {
    return std::isinf(step_.last) ? 0.0 : 2.0 * ratio() / (1.0 + ratio());
}

double BlockMemory::stiffening() const {
    double sum = 0.0;
    for (const Branch& branch : branches_) {
        const Decay decay(step_.dt / branch.time);
        sum += branch.ratio * (decay.b + weight() * decay.g);
    }
    return sum;
}

SiteField<double> BlockMemory::known_force() const {
    SiteField<double> sum = new_field();
    combine(-stiffening(), w_, 0.0, w_, sum);
    double of_last = 0.0;
    for (std::size_t k = 0; k < branches_.size(); ++k) {
        const Decay decay(step_.dt / branches_[k].time);
        combine(branches_[k].ratio * decay.e, h_[k], 1.0, sum, sum);
        if (weight() > 0.0) of_last -= branches_[k].ratio * weight() * ratio() * decay.g;
    }
    if (of_last != 0.0) combine(of_last, history_[0], 1.0, sum, sum);
    return sum;
}

SiteField<double> BlockMemory::second_difference(const SiteField<double>& d) const {
    SiteField<double> c = new_field();
    if (weight() > 0.0) combine(weight(), d, -weight() * ratio(), history_[0], c);
    return c;
}

StepEnergies BlockMemory::energies() const {
    const auto& [shape, square, product] = block_;
    StepEnergies energies;
    SiteField<double> d = new_field(), field = new_field();
    combine(1.0, shape(), -1.0, w_, d);
    const SiteField<double> c = second_difference(d);
    const bool bent = weight() > 0.0;
    const double of_c = bent ? square(c) : 0.0;
    SiteField<double> change = new_field(); // change of the second difference
    double of_change = 0.0;
    if (bent) {
        combine(1.0, c, -ratio() * ratio(), history_[1], change);
        of_change = square(change);
    }
    const double of_d = bent ? 0.0 : square(d);
    for (std::size_t k = 0; k < branches_.size(); ++k) {
        const auto& [ratio, time] = branches_[k];
        const Decay decay(step_.dt / time);
        const Loss loss(step_.dt / time);
        combine(decay.e, h_[k], decay.b, d, field);
        if (bent) combine(decay.g, c, 1.0, field, field);
        const double of_h = square(field);
        energies[Term::branches] += 0.5 * ratio * of_h;
        if (bent)
            energies.error += ratio * std::abs(decay.g) *
                              (product(change, field) + 0.5 * std::abs(decay.g) * of_change);
        combine(loss.l00, h_[k], loss.l10, d, field);
        if (bent) combine(loss.l20, c, 1.0, field, field);
        double lost = square(field);
        if (bent) {
            combine(loss.l11, d, loss.l21, c, field);
            lost += square(field) + loss.l22 * loss.l22 * of_c;
        } else {
            lost += loss.l11 * loss.l11 * of_d;
        }
        energies[Term::in_block] += ratio * lost;
    }
    return energies;
}

void BlockMemory::accept() {
    SiteField<double> to = block_.shape();
    combine(1.0, to, -1.0, w_, w_); // the step
    history_[1] = second_difference(w_);
    for (std::size_t k = 0; k < branches_.size(); ++k) {
        const Decay decay(step_.dt / branches_[k].time);
        combine(decay.e, h_[k], decay.b, w_, h_[k]);
        if (weight() > 0.0) combine(decay.g, history_[1], 1.0, h_[k], h_[k]);
    }
    history_[0] = std::move(w_);
    w_ = std::move(to);
}

std::size_t BlockMemory::bytes() const {
    std::size_t sum = 0;
    for (const Field<double>& field : w_)
        sum += field.bytes();
    return sum * (3 + h_.size());
}

} // namespace asperity
