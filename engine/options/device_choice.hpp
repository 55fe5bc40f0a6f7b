// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#pragma once

namespace asperity {

/// Device that makes the steps of a dynamic path (numerics.device).
struct DeviceChoice {
    enum class Kind {
        none,      ///< the processor
        emulated,  ///< the emulated device
        automatic, ///< a CUDA device if there is one that can run the scene; not in a case
        cuda       ///< the CUDA device `index`
    };
    Kind kind = Kind::none;
    int index = 0; ///< index of the CUDA device

    explicit operator bool() const { return kind != Kind::none; }
    bool operator==(const DeviceChoice&) const = default;
};

} // namespace asperity
