// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/options/interface_options.hpp"

#include <cmath>

namespace asperity {

double reach_of(const InterfaceOptions& options) {
    if (options.wall) {
        const double reach = std::visit([](const auto& law) { return law.reach(); }, *options.wall);
        if (std::isfinite(reach)) return reach;
    }
    return (options.tail ? 4.0 : 1.0) * options.pairs().cutoff;
}

} // namespace asperity
