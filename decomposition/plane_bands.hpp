// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Planes of the box between the ranks that hold its tiles and the root, which reads and writes
// files.
//
// The root never holds a whole plane: planes reach it and leave it in bands of whole rows.
// gather_plane() is for a root that computes with a whole plane.
#pragma once

#include "decomposition/communicator.hpp"
#include "decomposition/process_grid.hpp"
#include "kernels/views.hpp"

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace asperity {

/// Returns the number of rows of a band of a plane of sites * sites nodes.
int rows_of_band(int sites);
/// Returns the largest number of values of a band; a row may have more.
inline constexpr std::size_t band_length = std::size_t{1} << 19;

/// Copies a plane from one cut of the box to another, which cut the finest level. Collective.
void move_plane(const Communicator& ranks, const ProcessGrid& from, PlaneView<const double> of,
                const ProcessGrid& to, PlaneView<double> into);

/// Receives or gives a band on the root: its first row, and the values [plane][row][x].
using TakeBand = std::function<void(int first, std::span<const double> values)>;
using GiveBand = std::function<void(int first, std::span<double> values)>;

/// Calls take() on the root with each band of planes of a level, in ascending order. Collective; an
/// exception of take() is thrown on all ranks (Communicator::on_root()).
void gather_bands(const Communicator& ranks, const ProcessGrid& grid, int level,
                  std::span<const PlaneView<const double>> planes, const TakeBand& take);
/// Fills this rank's tile of a plane of a level from bands that give() sets on the root, in
/// ascending order. Collective; an exception of give() is thrown on all ranks.
void scatter_bands(const Communicator& ranks, const ProcessGrid& grid, int level,
                   const GiveBand& give, PlaneView<double> plane);

/// Returns a plane of a level as a dense sites * sites array (row-major) on the root, and an empty
/// array on other ranks. Collective.
std::vector<double> gather_plane(const Communicator& ranks, const ProcessGrid& grid, int level,
                                 PlaneView<const double> plane);

} // namespace asperity
