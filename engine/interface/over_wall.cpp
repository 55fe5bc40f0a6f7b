// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/interface/over_wall.hpp"

#include "engine/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <stdexcept>
#include <vector>

namespace asperity {

OverWall::OverWall(const HeightMap& map, int across, const Tile& tile,
                   const InterfaceOptions& options)
    : law_(*options.wall) {
    const int n = map.sites();
    if (across != n)
        throw std::invalid_argument(fmt::format(
            "interface: a wall needs a height below each site, and {} x {} sites have {} x {}; "
            "take surface.lattice_ratio = 1",
            across, across, n, n));
    if (options.slides) {
        sliding_.emplace(map, tile);
        return;
    }
    height_ = Field<double>(tile, 1, 0);
    const PlaneView<double> below = height_.plane(0);
    for (int y = 0; y < tile.ny; ++y)
        for (int x = 0; x < tile.nx; ++x)
            below(x, y) = tile.x0 + x < n && tile.y0 + y < n
                              ? map.at(tile.x0 + x, tile.y0 + y)
                              : std::numeric_limits<double>::quiet_NaN();
    for (const auto& field : options.site_maps())
        if (field->sites != n)
            throw std::invalid_argument(
                fmt::format("interface: {} x {} sites have a field of {} x {} values of {}", n, n,
                            field->sites, field->sites, field->name));
    if (options.has_law_factors()) find_law_factors(options, tile);
    if (options.hardness) find_yield_gaps(options, tile, n, map.spacing() * map.spacing());
}

namespace {

/// Returns the gap at which a law presses with a force above zero, eV/Å.
template <class Law>
double gap_under(const Law& law, double force) {
    // The law presses from its largest tension on inwards.
    double low = -law.depth_under(force), high = law.contact_gap();
    for (double step = 1e-3; law.force(low) < force; step *= 2.0)
        low -= step;
    while (true) {
        const double middle = 0.5 * (low + high);
        if (!(middle > low && middle < high)) return low;
        (law.force(middle) > force ? low : high) = middle;
    }
}

} // namespace

/// Finds the factors of the law of each site of the grid. Collective.
void OverWall::find_law_factors(const InterfaceOptions& options, const Tile& tile) {
    factors_ = Field<double>(tile, static_cast<int>(LawFactors<double>::count), 0);
    const std::vector<SiteMapOf> given = options.maps_of_law();
    PerSiteMap<std::vector<double>> values;
    for (const SiteMapOf map : given)
        values[map] = options.maps[map]->under(tile);
    for (int y = 0; y < tile.ny; ++y)
        for (int x = 0; x < tile.nx; ++x) {
            PerSiteMap<double> of_site;
            for (const SiteMapOf map : given)
                of_site[map] = values[map][static_cast<std::size_t>(y * tile.nx + x)];
            const LawFactors<double> factors = options.law_factors(of_site);
            for (std::size_t k = 0; k < factors.count; ++k)
                factors_.plane(static_cast<int>(k))(x, y) = factors.of[k];
        }
}

/// Finds the yield gaps of the first across x across sites of the grid.
void OverWall::find_yield_gaps(const InterfaceOptions& options, const Tile& tile, int across,
                               double area) {
    yield_gap_ = Field<double>(tile, 1, 0);
    const PlaneView<double> gap = yield_gap_.plane(0);
    std::vector<double> hardness;
    if (const auto& field = options.maps[SiteMapOf::hardness]) hardness = field->under(tile);
    const auto hardness_at = [&](int x, int y) {
        if (hardness.empty()) return options.hardness.value();
        return units::gigapascal * hardness[static_cast<std::size_t>(y * tile.nx + x)];
    };
    std::optional<double> of_all; // without maps
    for (int y = 0; y < tile.ny && tile.y0 + y < across; ++y)
        for (int x = 0; x < tile.nx && tile.x0 + x < across; ++x) {
            if (!of_all || !factors_.empty() || !hardness.empty())
                of_all = with_law(x, y, [&](const auto& law) {
                    return gap_under(law, area * hardness_at(x, y));
                });
            gap(x, y) = *of_all;
        }
}

double OverWall::stiffness_at(int x, int y, double gap) const {
    if (yields_at(x, y, gap)) return 0.0;
    return with_law(x, y, [&](const auto& law) { return law.stiffness_at(gap); });
}

double OverWall::step(int x, int y, double gap, double step, double spring) const {
    const double yield = yield_gap_.plane(0)(x, y);
    if ((gap < yield) == (gap + step < yield)) return step;
    return with_law(x, y, [&](const auto& law) {
        const double out = law.contact_gap();
        if (gap < yield || gap >= out)
            return yield + 1e-4 * (out - yield) - gap; // well above the rounding of heights
        const double excess = law.force(gap) - law.stiffness_at(gap) * step - law.force(yield);
        const double most = law.force(yield) - law.force(out);
        return yield - std::clamp(excess, 0.0, most) / spring - gap;
    });
}

bool OverWall::attracts() const {
    return std::visit([](const auto& law) { return law.softest() < 0.0; }, law_);
}

double OverWall::yield_force(int x, int y) const {
    return with_law(x, y, [&](const auto& law) { return law.force(yield_gap_.plane(0)(x, y)); });
}

double OverWall::force(int x, int y, double z) const {
    const double gap = std::fmax(z - below(x, y), yield_gap_.plane(0)(x, y));
    return with_law(x, y, [&](const auto& law) { return law.force(gap); });
}

void OverWall::sweep_row(const InterfaceSites& sites, int y, SweepOptions how,
                         InterfaceSums& sums) const {
    WallMaps maps{.height = height()};
    for (std::size_t k = 0; !factors_.empty() && k < maps.factors.count; ++k)
        maps.factors.of[k] = factors_.plane(static_cast<int>(k));
    if (yields()) {
        maps.yield_gap = yield_gap_.plane(0);
        maps.set = set();
    }
    interface_kernels().wall.sweep[how.observe](sites, maps, law_, y, y + 1, sums);
}

} // namespace asperity
