// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The plots of a sweep: simulated points, with their spread over the seeds, beside the curves of
// the theory. The axis of numbers with the most values is the x axis; the others give a curve each.
#pragma once

#include "engine/commands/sweep_table.hpp"
#include "io/plot.hpp"

#include <optional>
#include <string>
#include <vector>

namespace asperity {

/// The axis along x, by its place in table.axes; none if no axis has numbers.
std::optional<std::size_t> plotted_axis(const std::vector<SweepAxis>& axes,
                                        const std::vector<SweepPoint>& points);

/// The plots that the tables allow, gamma first; several tables (of simulations over the same key)
/// share them. note: what kept others out.
std::vector<io::Plot> sweep_plots(const std::vector<SweepTable>& tables, std::string& note);

} // namespace asperity
