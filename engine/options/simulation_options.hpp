// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Options of block, interface, drive and time step together.
#pragma once

#include "engine/options/block_options.hpp"
#include "engine/options/device_choice.hpp"
#include "engine/options/drive_options.hpp"
#include "engine/options/interface_options.hpp"

#include <cstdint>

namespace asperity {

/// Options of a simulation.
struct SimulationOptions {
    BlockOptions block;
    InterfaceOptions interface;
    DriveOptions drive;
    double dt = 10.0;          ///< time step, fs
    double damping = 0.0;      ///< damping rate, 1/fs
    double damping_from = 0.0; ///< fraction of the thickness above which damping acts
    double temperature = 0.0;  ///< temperature, K
    std::uint64_t seed = 1;    ///< seed of the noise
    DeviceChoice device;       ///< processor or device that computes the steps
};

} // namespace asperity
