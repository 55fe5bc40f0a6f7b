// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/path/slide_average.hpp"

#include "engine/step_record.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>

namespace asperity {

namespace {

constexpr std::size_t most_points = 4096, most_bins = 64;
constexpr double drift = 0.01; ///< change of a steady friction that counts as none
/// Share of the normal force below which friction is none.
constexpr double negligible = 1e-4;

double mean_from(const std::vector<double>& of, std::size_t first) {
    double sum = 0.0;
    for (std::size_t i = first; i < of.size(); ++i)
        sum += of[i];
    return sum / static_cast<double>(of.size() - first);
}

/// Returns the variance of the mean of the bins from the first on, as if they were independent.
double variance_of_mean(const std::vector<double>& of, std::size_t first) {
    const double mean = mean_from(of, first), n = static_cast<double>(of.size() - first);
    double squares = 0.0;
    for (std::size_t i = first; i < of.size(); ++i)
        squares += (of[i] - mean) * (of[i] - mean);
    return squares / (n * (n - 1.0));
}

/// Returns the standard error of the mean by blocking.
double error_of_mean(std::vector<double> of) {
    double largest = 0.0;
    while (of.size() >= 4) {
        largest = std::max(largest, variance_of_mean(of, 0));
        std::vector<double> pairs;
        for (std::size_t i = of.size() % 2; i + 1 < of.size(); i += 2)
            pairs.push_back(0.5 * (of[i] + of[i + 1]));
        of = std::move(pairs);
    }
    return std::sqrt(largest);
}

} // namespace

void SlideAverage::add(const SlidePoint& point) {
    points_.push_back(point);
    if (points_.size() <= most_points) return;
    std::vector<SlidePoint> kept;
    for (std::size_t i = 0; i < points_.size(); i += 2)
        kept.push_back(points_[i]);
    if (points_.size() % 2 == 0) kept.push_back(points_.back());
    points_ = std::move(kept);
}

namespace {

/// Returns a function that gives the work or a loss of a point.
auto flow(Term term) {
    return [term](const SlidePoint& point) { return point.flows[term]; };
}

} // namespace

double SlideAverage::at(double distance,
                        const std::function<double(const SlidePoint&)>& number) const {
    const auto right =
        std::lower_bound(points_.begin(), points_.end(), distance,
                         [](const SlidePoint& p, double d) { return p.distance < d; });
    if (right == points_.begin()) return number(points_.front());
    if (right == points_.end()) return number(points_.back());
    const SlidePoint &r = *right, &l = *(right - 1);
    return number(l) +
           (number(r) - number(l)) * (distance - l.distance) / (r.distance - l.distance);
}

double SlideAverage::Lengths::whole_window() const {
    return spacing > 0.0 ? std::max(1.0, std::round(window / spacing)) * spacing : window;
}

bool SlideAverage::is_steady(const Lengths& lengths) const {
    const double window = lengths.whole_window();
    if (points_.empty() || !(points_.back().distance >= 3.0 * window)) return false;
    const double end = points_.back().distance;
    const auto mean = [&](int i) {
        return (at(end - i * window, flow(Term::work)) -
                at(end - (i + 1) * window, flow(Term::work))) /
               window;
    };
    const double now = mean(0), last = now - mean(1), before = mean(1) - mean(2);
    const double most = drift * std::max(std::abs(now), negligible * std::abs(points_.back().load));
    if (!(std::abs(last) <= most)) return false;
    if (last * before <= 0.0) return true; // no drift one way
    if (std::abs(last) >= std::abs(before)) return std::abs(last) <= 0.1 * most;
    return std::abs(last * last / (before - last)) <= most;
}

std::optional<SteadySlide> SlideAverage::means(const Lengths& lengths) const {
    if (points_.size() < 2 || !(points_.back().distance > 0.0)) return std::nullopt;
    const double end = points_.back().distance, least = end / static_cast<double>(most_bins);
    // A slide of less than four spacings has shorter bins.
    const bool whole = end >= 4.0 * lengths.spacing && lengths.spacing > 0.0;
    const double width =
        whole ? std::ceil(least / lengths.spacing - 1e-9) * lengths.spacing : least;
    const auto bins = static_cast<std::size_t>(std::floor(end / width + 1e-9));
    const double from = end - static_cast<double>(bins) * width;
    /// Means over the bins of what adds up; or of the points' own numbers.
    const auto rate = [&](const std::function<double(const SlidePoint&)>& number) {
        std::vector<double> list;
        for (std::size_t i = 0; i < bins; ++i)
            list.push_back((at(from + static_cast<double>(i + 1) * width, number) -
                            at(from + static_cast<double>(i) * width, number)) /
                           width);
        return list;
    };
    const auto value = [&](double SlidePoint::*member) {
        std::vector<double> list;
        constexpr int samples = 8;
        for (std::size_t i = 0; i < bins; ++i) {
            double sum = 0.0;
            for (int k = 0; k < samples; ++k)
                sum += at(from + (static_cast<double>(i) + (k + 0.5) / samples) * width,
                          std::mem_fn(member));
            list.push_back(sum / samples);
        }
        return list;
    };
    const std::vector<double> work = rate(flow(Term::work));
    std::vector<double> lost(bins, 0.0); // all losses
    std::size_t first = 0;
    double smallest = HUGE_VAL;
    for (std::size_t i = 0; i <= bins / 2; ++i)
        if (const double variance = variance_of_mean(work, i); variance < smallest) {
            smallest = variance;
            first = i;
        }
    const auto steady = [&](const std::vector<double>& of) {
        return std::vector<double>(of.begin() + static_cast<std::ptrdiff_t>(first), of.end());
    };
    SteadySlide s;
    s.running_in = from + static_cast<double>(first) * width;
    const std::vector<double> contact = value(&SlidePoint::in_contact);
    s.in_contact = mean_from(contact, first);
    s.in_contact_error = error_of_mean(steady(contact));
    const double edges = mean_from(value(&SlidePoint::contact_edges), first);
    s.area = contact_sites(s.in_contact, edges);
    s.area_error = std::hypot(contact_sites_error(edges), s.in_contact_error);
    s.load = mean_from(value(&SlidePoint::load), first);
    s.mean_height = mean_from(value(&SlidePoint::mean_height), first);
    const double left_out = mean_from(rate(std::mem_fn(&SlidePoint::work_left_out)), first);
    double missing = mean_from(work, first) + left_out; // work of forces that no loss explains
    for (const io::EnergyTerm& row : io::energy_terms) {
        if (!row.is_loss()) continue;
        const std::vector<double> of_term = rate(flow(row.term));
        s.losses[row.term] = mean_from(of_term, first);
        missing -= s.losses[row.term];
        std::transform(lost.begin(), lost.end(), of_term.begin(), lost.begin(), std::plus());
    }
    s.steady = is_steady(lengths);
    const std::vector<double>& friction = s.steady && s.losses.dissipated() > 0.0 ? lost : work;
    s.friction = mean_from(friction, first);
    s.friction_error = error_of_mean(steady(friction));
    s.friction_error = std::max(s.friction_error, std::abs(s.steady ? missing : left_out));
    if (lengths.shortest_wave > 0.0 && s.area > 0.0) {
        const double a_over_wave = lengths.spacing / lengths.shortest_wave;
        s.mesh_error = 0.2 * std::abs(s.friction) *
                       std::hypot(a_over_wave * a_over_wave, s.in_contact / s.area - 1.0);
        s.friction_error = std::hypot(s.friction_error, s.mesh_error);
    }
    return s;
}

} // namespace asperity
