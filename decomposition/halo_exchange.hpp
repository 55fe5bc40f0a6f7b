// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Fills the halo of displacement fields: from neighbouring tiles where a level is cut, by periodic
// wrapping where a rank holds it whole.
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

/// One field of the exchange: planes [0, planes) of it.
struct HaloField {
    VolumeView<double> view;
    int planes = 0;
    bool tiled = false; ///< cut over the ranks, or held whole by this rank
};

class HaloExchange {
public:
    HaloExchange(const Communicator& communicator, const ProcessGrid& grid)
        : communicator_(communicator), grid_(grid) {}

    void exchange(std::span<const HaloField> fields);
    /// Bytes sent by this rank in the last exchange, to other ranks.
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

/// Every rank's footprint of a level's plane, put together on every rank: the forces that fine
/// tiles hand to a level that all ranks hold. Fields are in global coordinates of the level.
void gather_footprints(const Communicator& communicator, const ProcessGrid& grid, int level,
                       std::span<const PlaneView<double>> planes);

/// A plane of a level as a dense sites * sites array (row-major) on the root; empty elsewhere.
std::vector<double> gather_plane(const Communicator& communicator, const ProcessGrid& grid,
                                 int level, PlaneView<const double> plane);
/// The inverse: each rank copies its tile out of the root's array.
void scatter_plane(const Communicator& communicator, const ProcessGrid& grid, int level,
                   std::vector<double>& dense, PlaneView<double> plane);

} // namespace asperity
