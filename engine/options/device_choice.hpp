// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#pragma once

namespace asperity {

/// Processor or device that computes the steps of a dynamic path (numerics.device).
struct DeviceChoice {
    /// Kind of device.
    enum class Kind {
        none,     ///< the processor
        emulated, ///< the emulated device
        /// A CUDA device that can run the scene, otherwise the processor; resolved in a case.
        automatic,
        cuda ///< the CUDA device `index`
    };
    Kind kind = Kind::none;
    int index = 0; ///< index of the CUDA device

    explicit operator bool() const { return kind != Kind::none; }
    bool operator==(const DeviceChoice&) const = default;
};

} // namespace asperity
