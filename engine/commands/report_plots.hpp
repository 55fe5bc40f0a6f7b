// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The plots of a report, from what a directory holds: each a function that gives a plot, or nothing
// where the run has nothing to show.
#pragma once

#include "engine/commands/stored_run.hpp"
#include "io/map_plot.hpp"
#include "io/plot.hpp"

#include <optional>
#include <vector>

namespace asperity {

/// Pixels: two side by side in the page, or one on a phone.
inline constexpr int page_plot_width = 520, page_plot_height = 372;

/// Force over the mean separation, both ways; beside it what a smooth sphere would do, if it is
/// one.
std::optional<io::Plot> separation_plot(const StoredRun& run);
/// The same over the displacement of the driven top plane: what a testing machine sees.
std::optional<io::Plot> loading_plot(const StoredRun& run);
/// Energies per nominal area over time.
std::optional<io::Plot> energy_plot(const StoredRun& run);
/// The residual of the energy balance over time.
std::optional<io::Plot> balance_plot(const StoredRun& run);
/// Contact and pushed fraction over the displacement of the top.
std::optional<io::Plot> contact_plot(const StoredRun& run);
/// γ_eff/Δγ of the theory over the roughness, with this run's numbers at its own.
std::optional<io::Plot> roughness_plot(const StoredRun& run);
/// C(q), realised and target.
std::optional<io::Plot> spectrum_plot(const StoredRun& run);
/// The distribution of gaps P(u), and of the interface's pressure on the sites that feel any.
std::optional<io::Plot> gap_plot(const StoredState& state);
std::optional<io::Plot> pressure_plot(const StoredState& state);

std::optional<io::MapPlot> height_map(const StoredRun& run);
/// Gap, pressure, contact of a state.
std::vector<io::MapPlot> state_maps(const StoredRun& run, const StoredState& state);

/// A state's name ("every:1000") as part of the name of a file or an element.
std::string file_name(const std::string& state);

} // namespace asperity
