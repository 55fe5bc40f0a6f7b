// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Moments of a piecewise power-law spectrum; see the header for why this form.
// On a segment, with L = ln(q/qa) and m = k + 1 + n,
//     ∫ q^k C dq = c qa^(k+1) g(m, L),   g = (e^{mL} - 1)/m,   g -> L as m -> 0 (the logarithm of H
//     = 1).
#include "theory/spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "theory/error.hpp"

namespace asperity::theory {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double power_integral(double m, double L) {
    const double x = m * L;
    return std::abs(x) < 1e-8 ? L * (1 + x / 2) : std::expm1(x) / m;
}

} // namespace

Spectrum Spectrum::self_affine(const SelfAffine& o) {
    const bool ordered = o.q_L > 0 && o.q_L <= o.q0 && o.q0 <= o.q1 && std::isfinite(o.q1);
    if (!ordered)
        throw InvalidInput(message("spectrum: q_L = ", o.q_L, ", q0 = ", o.q0, ", q1 = ", o.q1,
                                   " are not in the order 0 < q_L <= q0 <= q1, so there is no "
                                   "range to put roughness in; give three rising wavevectors"));
    if (!(o.q_L < o.q1))
        throw InvalidInput(message("spectrum: q_L = q0 = q1 = ", o.q1,
                                   " leaves a band of no width, which C(q) cannot describe; "
                                   "give a narrow band instead, such as q1 = 1.001 q_L"));
    if (!std::isfinite(o.hurst) || o.hurst < -1 || o.hurst > 2)
        throw InvalidInput(message("spectrum: Hurst exponent H = ", o.hurst,
                                   " is not between -1 and 2, where a self-affine surface makes "
                                   "sense (0..1 as a rule); check the exponent"));
    Spectrum s;
    s.q_smallest_ = o.q_L;
    s.q_largest_ = o.q1;
    s.append(o.q_L, o.q0, 1, 1);
    s.append(o.q0, o.q1, 1, std::pow(o.q1 / o.q0, -2 * (1 + o.hurst)));
    s.accumulate();
    return s.with_rms_height(o.h_rms);
}

Spectrum Spectrum::tabulated(std::span<const double> q, std::span<const double> C) {
    if (q.size() != C.size() || q.size() < 2)
        throw InvalidInput(message("spectrum table: ", q.size(), " wavevectors and ", C.size(),
                                   " values; a table needs as many of one as of the other and at "
                                   "least two points; check the columns"));
    for (std::size_t i = 0; i < q.size(); ++i) {
        if (!(q[i] > 0) || !std::isfinite(q[i]) || (i > 0 && q[i] < q[i - 1]))
            throw InvalidInput(message("spectrum table: wavevector ", q[i], " in row ", i,
                                       " is not positive or is below the one before it; sort the "
                                       "table by wavevector and leave out q = 0"));
        if (!(C[i] >= 0) || !std::isfinite(C[i]))
            throw InvalidInput(message("spectrum table: C = ", C[i], " in row ", i,
                                       " is negative or not a number, and a power spectrum is "
                                       "neither; write 0 where there is no roughness"));
    }
    if (!(q.front() < q.back()))
        throw InvalidInput(message("spectrum table: all wavevectors equal ", q.front(),
                                   ", a band of no width; give a narrow band instead"));
    Spectrum s;
    s.q_smallest_ = q.front();
    s.q_largest_ = q.back();
    for (std::size_t i = 0; i + 1 < q.size(); ++i)
        s.append(q[i], q[i + 1], C[i], C[i + 1]);
    s.accumulate();
    return s;
}

Spectrum Spectrum::rings(std::span<const double> edges, std::span<const double> C) {
    if (edges.size() != C.size() + 1)
        throw InvalidInput(message("spectrum rings: ", edges.size(), " edges for ", C.size(),
                                   " values; n rings have n + 1 edges"));
    std::vector<double> q, value;
    for (std::size_t i = 0; i < C.size(); ++i) {
        q.insert(q.end(), {edges[i], edges[i + 1]});
        value.insert(value.end(), {C[i], C[i]});
    }
    return tabulated(q, value);
}

void Spectrum::append(double qa, double qb, double ca, double cb) {
    if (!(qb > qa) || ca == 0 || cb == 0) return;
    const double width = std::log(qb / qa);
    segments_.push_back({qa, qb, ca, std::log(cb / ca) / width, width, 0, 0, 0, 0, 0});
}

void Spectrum::accumulate() {
    double height = 0, energy = 0, slope = 0;
    for (auto& s : segments_) {
        s.height = height;
        s.energy = energy;
        s.slope = slope;
        s.y_begin = slope > 0 ? std::log(slope) + std::log(s.qa) : -infinity;
        height += partial(s, 1, s.log_width);
        energy += partial(s, 2, s.log_width);
        slope += partial(s, 3, s.log_width);
        s.y_end = std::log(slope) + std::log(s.qb);
    }
    height_ = height;
    if (!std::isfinite(height) || !std::isfinite(slope))
        throw InvalidInput(message("spectrum: its moments overflow (∫ q C dq = ", height,
                                   ", ∫ q³ C dq = ", slope,
                                   "); choose units in which they are ordinary numbers"));
}

double Spectrum::partial(const Segment& s, int k, double log_ratio) {
    return s.c * std::pow(s.qa, k + 1) * power_integral(k + 1 + s.exponent, log_ratio);
}

Spectrum Spectrum::with_rms_height(double h_rms) const {
    if (!(h_rms >= 0) || !std::isfinite(h_rms))
        throw InvalidInput(message("spectrum: rms roughness ", h_rms,
                                   " is negative or not a number; give a length, 0 for smooth"));
    Spectrum s = *this;
    s.flat_ = h_rms == 0;
    if (s.flat_) return s;
    if (segments_.empty())
        throw InvalidInput(message("spectrum: cannot scale a smooth surface to rms roughness ",
                                   h_rms,
                                   " because it has no spectrum to scale; start from one "
                                   "with C > 0 somewhere"));
    const double factor = h_rms * h_rms / (2 * std::numbers::pi * height_);
    for (auto& segment : s.segments_)
        segment.c *= factor;
    s.accumulate();
    return s;
}

const Spectrum::Segment* Spectrum::segment_below(double q) const {
    if (flat_) return nullptr;
    auto next = std::upper_bound(segments_.begin(), segments_.end(), q,
                                 [](double value, const Segment& s) { return value < s.qa; });
    return next == segments_.begin() ? nullptr : &*std::prev(next);
}

double Spectrum::operator()(double q) const {
    const Segment* s = segment_below(q);
    if (s == nullptr || q > s->qb) return 0;
    return s->c * std::exp(s->exponent * std::log(q / s->qa));
}

double Spectrum::rms_height() const {
    return flat_ ? 0 : std::sqrt(2 * std::numbers::pi * height_);
}

double Spectrum::rms_slope() const { return std::sqrt(2 * std::numbers::pi * last().slope); }

double Spectrum::waves() const {
    if (smooth()) return 0;
    double squares = 0; // ∫ q (C / ∫ q C dq)² dq: no overflow for heights of any size
    for (const Segment& s : segments_)
        squares += std::pow(s.c / height_, 2) * s.qa * s.qa *
                   power_integral(2 + 2 * s.exponent, s.log_width);
    return 2 * std::numbers::pi / (q_smallest_ * q_smallest_ * squares);
}

double Spectrum::height_variance_above(double q) const {
    double below = 0;
    if (const Segment* s = segment_below(q))
        below = s->height + partial(*s, 1, std::min(std::log(q / s->qa), s->log_width));
    return 2 * std::numbers::pi * std::max(0.0, height_ - below);
}

Magnification Spectrum::at(double q) const {
    const Segment* s = segment_below(q);
    if (s == nullptr) return {q, 0, 0, -infinity};
    const double L = std::min(std::log(q / s->qa), s->log_width);
    const double slope = s->slope + partial(*s, 3, L);
    return {q, slope, s->energy + partial(*s, 2, L),
            slope > 0 ? std::log(slope) + std::log(q) : -infinity};
}

Magnification Spectrum::at_coordinate(double y) const {
    if (flat_) return last();
    const auto found =
        std::lower_bound(segments_.begin(), segments_.end(), y,
                         [](const Segment& s, double value) { return s.y_end < value; });
    if (found == segments_.end()) return last();
    const Segment& s = *found;
    const auto point = [&](double L) {
        return Magnification{s.qa * std::exp(L), s.slope + partial(s, 3, L),
                             s.energy + partial(s, 2, L), y};
    };
    if (y <= s.y_begin) return point(0);
    // Solve ln M3(L) + L = y - ln qa by Newton kept inside a bracket. On the first segment M3
    // starts at zero, and ln L is the variable in which the equation is nearly a straight line.
    const double target = y - std::log(s.qa);
    const double scale = s.c * std::pow(s.qa, 4);
    const double m = 4 + s.exponent;
    const bool first = !(s.slope > 0);
    const double x_top = first ? std::log(s.log_width) : s.log_width;
    // At the bottom M3 <= (largest rate) L, so ln L is at least this far down.
    double low = first ? std::min(x_top, target - std::log(scale) - std::max(0.0, m * s.log_width) -
                                             s.log_width) -
                             1
                       : 0;
    double high = x_top;
    double x = first ? std::min(x_top, target - std::log(scale)) : s.log_width / 2;
    for (int iteration = 0; iteration < 200; ++iteration) {
        const double L = first ? std::exp(x) : x;
        const double M3 = s.slope + scale * power_integral(m, L);
        const double residual = std::log(M3) + L - target;
        (residual > 0 ? high : low) = x;
        double derivative = scale * std::exp(m * L) / M3 + 1;
        if (first) derivative *= L;
        double next = x - residual / derivative;
        if (!(next > low && next < high)) next = (low + high) / 2;
        const double moved = std::abs(next - x);
        x = next;
        if (moved <= 4e-16 * std::max(1.0, std::abs(x)) || high - low <= 0) break;
    }
    return point(std::min(first ? std::exp(x) : x, s.log_width));
}

std::vector<Spectrum::Band> Spectrum::bands() const {
    constexpr std::size_t few =
        32; // above this a table's kinks are small and left to the integration
    std::vector<Band> result;
    if (flat_) return result;
    for (std::size_t i = 0; i < segments_.size(); ++i) {
        const bool gap = i > 0 && segments_[i].qa > segments_[i - 1].qb;
        if (i == 0 || gap || segments_.size() <= few)
            result.push_back({segments_[i].y_begin, segments_[i].y_end});
        else
            result.back().y_end = segments_[i].y_end;
    }
    return result;
}

} // namespace asperity::theory
