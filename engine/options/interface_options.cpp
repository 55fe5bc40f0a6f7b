// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/options/interface_options.hpp"

#include "engine/units.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <variant>

namespace asperity {

std::vector<double> SiteMap::under(const Tile& tile) const {
    const int held = std::clamp(sites - tile.y0, 0, tile.ny);
    const std::vector<double> rows = bands().fetch(values, tile.y0, held);
    const int width = std::clamp(sites - tile.x0, 0, tile.nx);
    std::vector<double> found(static_cast<std::size_t>(tile.nx) *
                              static_cast<std::size_t>(tile.ny));
    for (std::ptrdiff_t y = 0; y < held; ++y)
        std::copy_n(rows.begin() + y * sites + tile.x0, width, found.begin() + y * tile.nx);
    return found;
}

SiteMap SiteMap::piece(int across) const {
    SiteMap part = *this;
    part.sites = across;
    part.sum = mean() * across * across;
    part.ranks = Communicator();
    part.values.resize(static_cast<std::size_t>(across) * static_cast<std::size_t>(across));
    for (std::size_t i = 0; i < part.values.size(); ++i)
        part.values[i] = values.empty() ? mean() : values[i % values.size()];
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
        if (*map) *map = std::make_shared<SiteMap>((*map)->piece(across));
}

double InterfaceOptions::adhesion_factor(double adhesion_of_site) const {
    return std::visit(
        [&]<class Law>(const Law& of_largest) {
            if constexpr (ScaledBySite<Law>)
                if (adhesion && adhesion->largest > 0.0)
                    return of_largest.factor_of(adhesion_of_site / adhesion->largest);
            return 1.0;
        },
        *wall);
}

double InterfaceOptions::mean_hardness() const {
    if (!hardness_map) return hardness.value();
    const double across = hardness_map->sites;
    return units::gigapascal * hardness_map->sum / (across * across);
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
