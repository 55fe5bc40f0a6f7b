// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/commands/cost_judge.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace asperity {

namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

double number_at(const io::JsonValue& result, std::string_view path) {
    const io::JsonValue* value = result.find(path);
    return value && value->is_number() ? value->number() : nothing;
}

std::pair<std::size_t, std::size_t> range_of(Question question) {
    const auto end = question == Question::state ? CostQuantity::approach : CostQuantity::count;
    return {0, static_cast<std::size_t>(end)};
}

/// Variance of log(error) - log|x^p - x0^p|: zero if the power law holds.
double misfit(std::span<const double> x, std::span<const double> errors, std::optional<double> x0,
              double p) {
    const double rest = x0 ? std::pow(*x0, p) : 0.0;
    double sum = 0.0, squares = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double d = std::log(errors[i]) - std::log(std::abs(std::pow(x[i], p) - rest));
        sum += d;
        squares += d * d;
    }
    const double n = static_cast<double>(x.size());
    return squares / n - (sum / n) * (sum / n);
}

} // namespace

std::string_view name(CostQuantity quantity) {
    static constexpr std::array<std::string_view, cost_quantities> names = {
        "gamma", "contact", "approach", "pull-off", "force"};
    return names[static_cast<std::size_t>(quantity)];
}

CostNumbers cost_numbers(const io::JsonValue& result) {
    const double flat = number_at(result, "delta_gamma");
    return {number_at(result, "binding_energy") / flat, number_at(result, "contact_fraction"),
            number_at(result, "work_of_adhesion.approach") / flat,
            number_at(result, "work_of_adhesion.pull_off") / flat,
            number_at(result, "pull_off_force")};
}

CostNumbers cost_errors(const CostNumbers& measured, const CostNumbers& reference) {
    CostNumbers errors;
    for (std::size_t q = 0; q < cost_quantities; ++q)
        errors[q] =
            reference[q] == 0.0 ? nothing : (measured[q] - reference[q]) / std::abs(reference[q]);
    return errors;
}

double largest_error(const CostNumbers& measured, const CostNumbers& reference, Question question) {
    const CostNumbers errors = cost_errors(measured, reference);
    const auto [begin, end] = range_of(question);
    // A reference that followed no path says nothing of one.
    const auto works = reference.begin() + static_cast<std::ptrdiff_t>(CostQuantity::approach);
    if (question == Question::path &&
        std::all_of(works, reference.end(), [](double value) { return std::isnan(value); }))
        return nothing;
    double largest = nothing;
    for (std::size_t q = begin; q < end; ++q) {
        if (std::isnan(reference[q]) || reference[q] == 0.0) continue;
        if (std::isnan(errors[q])) return nothing;
        largest = std::fmax(largest, std::abs(errors[q]));
    }
    return largest;
}

std::vector<bool> pareto_front(std::span<const double> seconds, std::span<const double> errors) {
    std::vector<bool> front(seconds.size());
    for (std::size_t i = 0; i < seconds.size(); ++i) {
        front[i] = !std::isnan(seconds[i]) && !std::isnan(errors[i]);
        for (std::size_t j = 0; j < seconds.size() && front[i]; ++j) {
            const bool no_worse = seconds[j] <= seconds[i] && errors[j] <= errors[i];
            const bool better = seconds[j] < seconds[i] || errors[j] < errors[i];
            front[i] = !(no_worse && better);
        }
    }
    return front;
}

std::optional<std::size_t> cheapest_within(std::span<const double> seconds,
                                           std::span<const double> errors, double target) {
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < seconds.size(); ++i)
        if (errors[i] <= target && (!best || seconds[i] < seconds[*best])) best = i;
    return best;
}

std::optional<double> order_of(std::span<const double> x, std::span<const double> errors,
                               std::optional<double> x0, double floor) {
    std::vector<double> knob, error;
    for (std::size_t i = 0; i < x.size(); ++i)
        if (std::abs(errors[i]) > floor && x[i] > 0.0 && x[i] != x0) { // NaN is not
            knob.push_back(x[i]);
            error.push_back(std::abs(errors[i]));
        }
    if (knob.size() < 2) return std::nullopt;
    const auto [low, high] = std::minmax_element(knob.begin(), knob.end());
    if (*low == *high) return std::nullopt;
    double best = 0.0, least = std::numeric_limits<double>::infinity();
    for (int i = 5; i <= 800; ++i)
        for (const double p : {0.01 * i, -0.01 * i})
            if (const double m = misfit(knob, error, x0, p); m < least) {
                least = m;
                best = p;
            }
    return best;
}

} // namespace asperity
