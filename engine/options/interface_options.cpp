// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/options/interface_options.hpp"

#include "engine/units.hpp"

#include <cmath>
#include <variant>

namespace asperity {

SiteMap SiteMap::corner(int across) const {
    SiteMap part = *this;
    part.sites = across;
    part.values.clear();
    for (int y = 0; y < across; ++y)
        for (int x = 0; x < across; ++x)
            part.values.push_back(at(x, y));
    return part;
}

std::vector<std::shared_ptr<const SiteMap>> InterfaceOptions::site_maps() const {
    std::vector<std::shared_ptr<const SiteMap>> maps;
    for (const auto& map : {adhesion, hardness_map})
        if (map) maps.push_back(map);
    return maps;
}

void InterfaceOptions::crop_site_maps(int across) {
    for (auto* const map : {&adhesion, &hardness_map})
        if (*map) *map = std::make_shared<SiteMap>((*map)->corner(across));
}

double InterfaceOptions::adhesion_factor(int x, int y) const {
    return std::visit(
        [&]<class Law>(const Law& of_largest) {
            if constexpr (ScaledBySite<Law>)
                if (adhesion && adhesion->largest > 0.0)
                    return of_largest.factor_of(adhesion->at(x, y) / adhesion->largest);
            return 1.0;
        },
        *wall);
}

double InterfaceOptions::hardness_at(int x, int y) const {
    return hardness_map ? hardness_map->at(x, y) * units::gigapascal : hardness.value();
}

double InterfaceOptions::mean_hardness() const {
    if (!hardness_map) return hardness.value();
    double sum = 0.0;
    for (const double value : hardness_map->values)
        sum += value;
    return units::gigapascal * sum / static_cast<double>(hardness_map->values.size());
}

WallLaw mean_wall(const InterfaceOptions& options) {
    if (!options.adhesion) return *options.wall;
    return std::visit(
        [&]<class Law>(const Law& law) -> WallLaw {
            if constexpr (ScaledBySite<Law>)
                return law.scaled(options.mean_adhesion_factor);
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
