// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// On a piece, with L = ln(q/qa) and m = k + 1 + n,
//     ∫ q^k C dq = c qa^(k+1) g(m, L),   g = (e^{mL} - 1)/m,   g -> L as m -> 0.
#include "theory/spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "theory/error.hpp"

namespace asperity::theory {
namespace {

double power_integral(double m, double L) {
    const double x = m * L;
    return std::abs(x) < 1e-8 ? L * (1 + x / 2) : std::expm1(x) / m;
}

} // namespace

Spectrum Spectrum::self_affine(const SelfAffine& o) {
    if (!(o.q_L > 0 && o.q_L <= o.q0 && o.q0 <= o.q1 && o.q_L < o.q1 && std::isfinite(o.q1)))
        throw InvalidInput(message("spectrum: q_L = ", o.q_L, ", q0 = ", o.q0, ", q1 = ", o.q1,
                                   " are not in the order 0 < q_L <= q0 <= q1 with q_L < q1; give "
                                   "three rising wavevectors, and a narrow band (q1 = 1.001 q_L) "
                                   "in place of one of no width"));
    if (!(o.hurst >= -1 && o.hurst <= 2))
        throw InvalidInput(
            message("spectrum: Hurst exponent H = ", o.hurst,
                    " is not between -1 and 2; check the exponent (0..1 as a rule)"));
    Spectrum s;
    s.q_smallest_ = o.q_L;
    s.q_largest_ = o.q1;
    s.append(o.q_L, o.q0, 1, 1);
    s.append(o.q0, o.q1, 1, std::pow(o.q1 / o.q0, -2 * (1 + o.hurst)));
    s.accumulate();
    return s.with_rms_height(o.h_rms);
}

Spectrum Spectrum::rings(std::span<const double> edges, std::span<const double> C) {
    const auto refuse = [](const auto&... what) {
        throw InvalidInput(message("spectrum rings: ", what...,
                                   "; n rings of C >= 0 (n > 0) have n + 1 rising edges"));
    };
    if (C.empty() || edges.size() != C.size() + 1)
        refuse(edges.size(), " edges for ", C.size(), " values");
    Spectrum s;
    s.q_smallest_ = edges.front();
    s.q_largest_ = edges.back();
    for (std::size_t i = 0; i < C.size(); ++i) {
        if (!(edges[i] > 0 && edges[i + 1] > edges[i] && C[i] >= 0 &&
              std::isfinite(edges[i + 1] + C[i])))
            refuse("C = ", C[i], " from ", edges[i], " to ", edges[i + 1], " in ring ", i);
        s.append(edges[i], edges[i + 1], C[i], C[i]);
    }
    s.accumulate();
    return s;
}

void Spectrum::append(double qa, double qb, double ca, double cb) {
    if (!(qb > qa) || ca == 0 || cb == 0) return;
    const double width = std::log(qb / qa);
    segments_.push_back({{qa, qb, ca, std::log(cb / ca) / width}, width, 0, 0, 0});
}

void Spectrum::accumulate() {
    double height = 0, energy = 0, slope = 0;
    for (auto& s : segments_) {
        s.height = height;
        s.energy = energy;
        s.slope = slope;
        height += partial(s, 1, s.log_width);
        energy += partial(s, 2, s.log_width);
        slope += partial(s, 3, s.log_width);
    }
    height_ = height;
    if (!std::isfinite(height) || !std::isfinite(slope))
        throw InvalidInput("spectrum: its moments overflow; choose other units");
}

double Spectrum::partial(const Segment& s, int k, double log_ratio) {
    return s.c * std::pow(s.qa, k + 1) * power_integral(k + 1 + s.exponent, log_ratio);
}

Spectrum Spectrum::with_rms_height(double h_rms) const {
    if (!(h_rms >= 0) || !std::isfinite(h_rms))
        throw InvalidInput(message("spectrum: rms roughness ", h_rms, " is no length; give one"));
    Spectrum s = *this;
    s.flat_ = h_rms == 0;
    if (s.flat_) return s;
    if (segments_.empty())
        throw InvalidInput("spectrum: a smooth surface has no spectrum to scale");
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

Magnification Spectrum::within(const Segment& s, double q, double log_ratio) {
    const double L = std::min(log_ratio, s.log_width);
    return {q, s.slope + partial(s, 3, L), s.energy + partial(s, 2, L)};
}

Magnification Spectrum::at(double q) const {
    const Segment* s = segment_below(q);
    return s == nullptr ? Magnification{q, 0, 0} : within(*s, q, std::log(q / s->qa));
}

Magnification Spectrum::from_first(double L) const {
    if (smooth()) return last();
    const Segment& first = segments_.front();
    const double q = std::min(q_largest_, first.qa * std::exp(L));
    return L <= first.log_width ? within(first, q, L) : at(q);
}

std::vector<double> Spectrum::edges() const {
    if (smooth()) return {};
    std::vector<double> q = {segments_.front().qa};
    for (std::size_t i = 1; i < segments_.size(); ++i)
        if (segments_[i].qa > segments_[i - 1].qb)
            q.insert(q.end(), {segments_[i - 1].qb, segments_[i].qa});
    q.push_back(segments_.back().qb);
    for (double& edge : q)
        edge = std::log(edge / segments_.front().qa);
    return q;
}

std::vector<PowerLaw> Spectrum::pieces() const {
    if (smooth()) return {};
    return {segments_.begin(), segments_.end()};
}

} // namespace asperity::theory
