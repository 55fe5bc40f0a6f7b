// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What a setting is worth: errors against a reference, the Pareto front of error against time, the
// order of an error in its knob. Numbers only; the runs they come from are cost.cpp.
#pragma once

#include "io/json_value.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace asperity {

/// What is judged. Energies are compared over the flat reference of the same interaction, so that a
/// cutoff is not blamed for the adhesion that it takes from both.
enum class CostQuantity {
    gamma,    ///< binding energy at zero load, over flat
    contact,  ///< contact area fraction at zero load
    approach, ///< work of adhesion of the approach, over flat
    pull_off, ///< of the pull-off, over flat
    force,    ///< largest attraction of the pull-off, eV/Å
    count
};
inline constexpr std::size_t cost_quantities = static_cast<std::size_t>(CostQuantity::count);
std::string_view name(CostQuantity quantity);

/// One number a quantity; NaN: none.
using CostNumbers = std::array<double, cost_quantities>;
/// Of a result.json.
CostNumbers cost_numbers(const io::JsonValue& result);
/// Relative and with their signs: (measured - reference) / |reference|.
CostNumbers cost_errors(const CostNumbers& measured, const CostNumbers& reference);

/// What a setting can be asked for.
enum class Question {
    state, ///< the relaxed state: gamma and contact
    path   ///< all of the path too: works of adhesion and pull-off force
};
/// The largest error without sign, of the quantities that the reference has. NaN: the measured run
/// lacks one of them, and does not answer the question.
double largest_error(const CostNumbers& measured, const CostNumbers& reference, Question question);

/// Which of them are beaten by no other in time and error at once. NaN is never among them.
std::vector<bool> pareto_front(std::span<const double> seconds, std::span<const double> errors);
/// The one of the least time with an error within the target.
std::optional<std::size_t> cheapest_within(std::span<const double> seconds,
                                           std::span<const double> errors, double target);

/// error = c |x^p - x0^p|: the power p that fits best (least squares of the logarithms), x0 the
/// knob of the run that the errors are measured against; none: there is nothing left of the error
/// there. Errors that are NaN or below `floor` are left out; empty with less than two of the rest.
/// 0.05 <= |p| <= 8; the sign is positive where the error grows with x.
std::optional<double> order_of(std::span<const double> x, std::span<const double> errors,
                               std::optional<double> x0, double floor = 1e-6);

} // namespace asperity
