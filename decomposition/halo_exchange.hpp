// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Fills the halo of displacement fields: from neighbouring tiles if a level is cut, by periodic
// wrapping if a rank holds it whole.
//
// The exchange has two phases, x then y; the rows sent along y include the halo received along x,
// so that corners are filled too. In each phase one message with all levels goes to each of the two
// neighbours. Values are copied, so that a halo node is bitwise equal to its owner.
#pragma once

#include "decomposition/communicator.hpp"
#include "decomposition/process_grid.hpp"
#include "kernels/views.hpp"

#include <span>
#include <vector>

namespace asperity {

/// A field whose planes [0, planes) are exchanged.
struct HaloField {
    VolumeView<double> view;
    int planes = 0;
    bool tiled = false; ///< cut over the ranks; false: held whole by this rank
};

/// Exchange of halos with the neighbouring tiles.
class HaloExchange {
public:
    /// Copies both arguments.
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

/// Copies every rank's footprint of planes of a level to every rank. Used for the forces of fine
/// tiles on a level that all ranks hold whole. planes: in global coordinates of the level.
/// Collective.
void gather_footprints(const Communicator& communicator, const ProcessGrid& grid, int level,
                       std::span<const PlaneView<double>> planes);

} // namespace asperity
