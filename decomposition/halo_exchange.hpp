// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Fills the halo of displacement fields: from neighbouring tiles if a level is cut, by periodic
// wrapping if a rank holds it whole.
//
// Two phases, x then y (whose rows include the x halo just received, so corners come along), and in
// each phase one message to each of the two neighbours that carries all levels. Values are copied,
// never computed, so a halo node is the exact double of its owner.
#pragma once

#include "decomposition/communicator.hpp"
#include "decomposition/process_grid.hpp"
#include "kernels/views.hpp"

#include <span>
#include <vector>

namespace asperity {

/// One field of the exchange: its planes [0, planes).
struct HaloField {
    VolumeView<double> view;
    int planes = 0;
    bool tiled = false; ///< cut over the ranks; false: held whole by this rank
};

/// Exchange of halos with the neighbouring tiles.
class HaloExchange {
public:
    HaloExchange(const Communicator& communicator, const ProcessGrid& grid)
        : communicator_(communicator), grid_(grid) {}

    /// Fills the halos of all fields. Collective.
    void exchange(std::span<const HaloField> fields);
    /// Returns the bytes that this rank sent to other ranks in the last exchange.
    std::size_t bytes_sent() const { return bytes_; }

private:
    void along_x(std::span<const HaloField> fields);
    void along_y(std::span<const HaloField> fields);
    void trade(int before, int after, std::size_t size);

    Communicator communicator_;
    ProcessGrid grid_;
    std::vector<double> to_before_, to_after_, from_before_, from_after_;
    std::size_t bytes_ = 0;
};

/// Copies every rank's footprint of a level's plane to every rank: the forces that fine tiles hand
/// to a level that all ranks hold. Fields are in global coordinates of the level. Collective.
void gather_footprints(const Communicator& communicator, const ProcessGrid& grid, int level,
                       std::span<const PlaneView<double>> planes);

/// Returns a plane of a level as a dense sites * sites array (row-major) on the root; empty
/// elsewhere. Collective.
std::vector<double> gather_plane(const Communicator& communicator, const ProcessGrid& grid,
                                 int level, PlaneView<const double> plane);
/// Copies each rank's tile out of the root's dense array: the inverse of gather_plane().
/// Collective.
void scatter_plane(const Communicator& communicator, const ProcessGrid& grid, int level,
                   std::vector<double>& dense, PlaneView<double> plane);

} // namespace asperity
