// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/options/interface_options.hpp"

#include "engine/units.hpp"

#include <algorithm>
#include <array>
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
    std::vector<std::shared_ptr<const SiteMap>> given;
    for (const auto& map : maps.of)
        if (map) given.push_back(map);
    return given;
}

void InterfaceOptions::crop_site_maps(int across) {
    for (auto& map : maps.of)
        if (map) map = std::make_shared<SiteMap>(map->piece(across));
}

std::vector<SiteMapOf> InterfaceOptions::maps_of_law() const {
    std::vector<SiteMapOf> given;
    for (const io::SiteQuantity& of : io::site_quantities)
        if (of.scales_law && maps[of.map]) given.push_back(of.map);
    return given;
}

LawFactors<double> InterfaceOptions::law_factors(const PerSiteMap<double>& of_site) const {
    LawFactors<double> factors = no_factors;
    const auto& adhesion = maps[SiteMapOf::adhesion];
    std::visit(
        [&]<class Law>(const Law& of_largest) {
            if constexpr (ScaledBySite<Law>)
                if (adhesion && adhesion->largest > 0.0)
                    factors[LawFactor::attraction] =
                        of_largest.factor_of(of_site[SiteMapOf::adhesion] / adhesion->largest);
        },
        *wall);
    return factors;
}

void InterfaceOptions::find_mean_law_factors() {
    const std::vector<SiteMapOf> given = maps_of_law();
    const SiteMap& any = *maps[given.front()]; // all have the same bands
    std::array<double, LawFactors<double>::count> below{};
    any.bands().in_order(below, [&] {
        for (std::size_t i = 0; i < any.values.size(); ++i) {
            PerSiteMap<double> of_site;
            for (const SiteMapOf map : given)
                of_site[map] = maps[map]->values[i];
            const LawFactors<double> factors = law_factors(of_site);
            for (std::size_t k = 0; k < below.size(); ++k)
                below[k] += 1.0 - factors.of[k];
        }
    });
    const double across = any.sites;
    for (std::size_t k = 0; k < below.size(); ++k)
        mean_law_factors.of[k] = 1.0 - below[k] / (across * across);
}

double InterfaceOptions::mean_hardness() const {
    const auto& map = maps[SiteMapOf::hardness];
    if (!map) return hardness.value();
    const double across = map->sites;
    return units::gigapascal * map->sum / (across * across);
}

WallLaw mean_wall(const InterfaceOptions& options) {
    if (!options.has_law_factors()) return *options.wall;
    return std::visit(
        [&]<class Law>(const Law& law) -> WallLaw {
            if constexpr (ScaledBySite<Law>)
                return law.scaled(options.mean_law_factors);
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
