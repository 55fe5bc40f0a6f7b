// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/options/interface_options.hpp"

#include <cmath>
#include <variant>

namespace asperity {

double AdhesionMap::factor(const WallLaw& law, int x, int y) const {
    return std::visit(
        [&]<class Law>(const Law& of_largest) {
            if constexpr (ScaledBySite<Law>)
                if (largest > 0.0) return of_largest.factor_of(at(x, y) / largest);
            return 1.0;
        },
        law);
}

AdhesionMap AdhesionMap::corner(int across) const {
    AdhesionMap part = *this;
    part.sites = across;
    part.work.clear();
    for (int y = 0; y < across; ++y)
        for (int x = 0; x < across; ++x)
            part.work.push_back(at(x, y));
    return part;
}

WallLaw mean_wall(const InterfaceOptions& options) {
    if (!options.adhesion) return *options.wall;
    return std::visit(
        [&]<class Law>(const Law& law) -> WallLaw {
            if constexpr (ScaledBySite<Law>)
                return law.scaled(options.adhesion->mean_factor);
            else
                return law;
        },
        *options.wall);
}

double reach_of(const InterfaceOptions& options) {
    if (options.wall) {
        const double reach = std::visit([](const auto& law) { return law.reach(); }, *options.wall);
        if (std::isfinite(reach)) return reach;
    }
    return (options.tail ? 4.0 : 1.0) * options.pairs().cutoff;
}

} // namespace asperity
