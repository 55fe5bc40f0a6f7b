// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/block/interface.hpp"

#include "engine/scene/sweep_limits.hpp"
#include "engine/units.hpp"
#include "kernels/variant.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <type_traits>

namespace asperity {

namespace {

constexpr double nothing_there = -1e30;

/// Calls visit(sideways distance, height) for every atom within `reach` sideways of (x, y).
template <class Visit>
void for_atoms_around(const SubstrateMap& map, double x, double y, double reach, Visit visit) {
    const int j_first = static_cast<int>(std::floor((y - reach) / map.spacing));
    const int j_last = static_cast<int>(std::ceil((y + reach) / map.spacing));
    const int i_first = static_cast<int>(std::floor((x - reach) / map.spacing));
    const int i_last = static_cast<int>(std::ceil((x + reach) / map.spacing));
    for (int j = j_first; j <= j_last; ++j) {
        const double* row =
            map.height + static_cast<std::ptrdiff_t>(periodic(j, map.sites)) * map.sites;
        const double dy = y - j * map.spacing;
        for (int i = i_first; i <= i_last; ++i) {
            const double dx = x - i * map.spacing;
            const double lateral = std::sqrt(dx * dx + dy * dy);
            if (lateral <= reach) visit(lateral, row[periodic(i, map.sites)]);
        }
    }
}

} // namespace

Interface::Interface(const Surface& substrate, const Tile& tile, double spacing,
                     const InterfaceOptions& options)
    : options_(options), tile_(tile), spacing_(spacing), margin_(sideways_margin(spacing)) {
    if (static_cast<std::size_t>(substrate.sites) * static_cast<std::size_t>(substrate.sites) !=
        substrate.height.size())
        throw std::invalid_argument(
            fmt::format("interface: a substrate of {} x {} atoms has {} heights", substrate.sites,
                        substrate.sites, substrate.height.size()));
    highest_ = *std::max_element(substrate.height.begin(), substrate.height.end());
    const bool same_lattice = substrate.sites == tile.sites;
    if (options.wall) {
        if (!same_lattice)
            throw std::invalid_argument(fmt::format(
                "interface: a wall needs a height below each site, and {} x {} sites have {} x {}; "
                "take surface.lattice_ratio = 1",
                tile.sites, tile.sites, substrate.sites, substrate.sites));
        method_ = InterfaceMethod::wall;
        build_wall(substrate);
        return;
    }
    map_height_ = substrate.height;
    const bool anywhere = substrate.atoms.size() > 0;
    if (!options.by_type.empty() && !anywhere)
        throw std::invalid_argument(
            "interface: pairs by type need a substrate of atoms anywhere, which have types");
    const PairTable pairs = options_.pairs();
    for (int type = 0; type < pairs.types; ++type)
        if (const LennardJones& pair = pairs.of[type];
            !(pair.cutoff > 0.0) || !(pair.r0 > 0.0) || !(pair.epsilon >= 0.0))
            throw std::invalid_argument(fmt::format(
                "interface: epsilon = {} eV, r0 = {} Å and cutoff = {} Å must be positive numbers",
                pair.epsilon, pair.r0, pair.cutoff));
    const double cutoff = pairs.cutoff;
    const double between_atoms = tile.sites * spacing / substrate.sites;
    if (const double most = largest_cutoff(spacing, between_atoms); !anywhere && cutoff > most)
        throw std::invalid_argument(fmt::format(
            "interface: a cutoff of {:.6g} Å is more than the {:.6g} Å that the tables hold for "
            "sites {:.6g} Å and atoms {:.6g} Å apart; choose a smaller one (4 r0 = {:.6g} Å keeps "
            "98 % of the work of adhesion) and set interface.tail = true",
            cutoff, most, spacing, between_atoms, 4.0 * options.potential.r0));
    if (anywhere) build_cells(substrate);
    map_ = {map_height_.data(), substrate.sites, between_atoms};
    if (same_lattice) map_.spacing = spacing;
    method_ = options.method;
    if (method_ == InterfaceMethod::automatic)
        method_ = cells_         ? InterfaceMethod::cells
                  : same_lattice ? InterfaceMethod::lattice
                                 : InterfaceMethod::rows;
    if (cells_) return;
    if (method_ == InterfaceMethod::lattice && !same_lattice)
        throw std::invalid_argument(fmt::format(
            "interface: the lattice sweep needs as many atoms ({}) as sites ({}) across the box; "
            "use the sweep over rows",
            substrate.sites, tile.sites));
    if (method_ != InterfaceMethod::reference) build_reach();
    if (method_ == InterfaceMethod::lattice) build_lattice();
    if (method_ == InterfaceMethod::rows) build_rows();
    if (options.tail) {
        tail_ = {options.potential, 1.0 / (map_.spacing * map_.spacing)};
        mean_height_ = Field<double>(tile, 1);
        auto mean = mean_height_.plane(0);
#pragma omp parallel for schedule(static)
        for (int y = 0; y < tile_.ny; ++y)
            for (int x = 0; x < tile_.nx; ++x) {
                double sum = 0.0;
                int atoms = 0;
                for_atoms_around(map_, (tile_.x0 + x + 0.5) * spacing_,
                                 (tile_.y0 + y + 0.5) * spacing_, cutoff, [&](double, double h) {
                                     sum += h;
                                     ++atoms;
                                 });
                mean(x, y) = atoms ? sum / atoms : 0.0;
            }
    }
}

void Interface::build_wall(const Surface& substrate) {
    height_ = Field<double>(tile_, 1, 0);
    const PlaneView<double> below = height_.plane(0);
    for (int y = 0; y < tile_.ny; ++y)
        for (int x = 0; x < tile_.nx; ++x)
            below(x, y) = substrate.height[static_cast<std::size_t>(tile_.y0 + y) *
                                               static_cast<std::size_t>(substrate.sites) +
                                           static_cast<std::size_t>(tile_.x0 + x)];
}

namespace {

CellOptions cell_options(const InterfaceOptions& options, double spacing, double margin) {
    std::vector<double> cutoffs;
    const PairTable pairs = options.pairs();
    for (int type = 0; type < pairs.types; ++type)
        cutoffs.push_back(pairs.of[type].cutoff);
    return {spacing,
            std::move(cutoffs),
            margin,
            !options.mixed,
            options.mixed || options.single_too,
            options.skip};
}

} // namespace

void Interface::build_cells(const Surface& substrate) {
    const double cutoff = options_.pairs().cutoff;
    const bool others =
        options_.method == InterfaceMethod::lattice || options_.method == InterfaceMethod::rows;
    if (options_.tail || others || cutoff > largest_cell_cutoff)
        throw std::invalid_argument(fmt::format(
            "interface: a substrate of atoms anywhere has no mean plane for a tail and no rows, "
            "and a cutoff of {} Å at most; it was asked for {} Å{}{}",
            largest_cell_cutoff, cutoff, options_.tail ? ", a tail" : "",
            others ? ", the sweep over a lattice or rows" : ""));
    cells_.emplace(substrate.atoms, tile_, cell_options(options_, spacing_, margin_));
}

/// For each block of sites and each ring of lateral distance: the greatest and least height in it.
/// An atom counts in all rings between the nearest and the farthest point of the block's row.
void Interface::build_reach() {
    const double widest = options_.potential.cutoff + margin_;
    reach_.offset_margin = margin_;
    reach_.ring_width = widest / interface_rings;
    reach_.blocks = (tile_.nx + interface_block - 1) / interface_block;
    const std::size_t rings = static_cast<std::size_t>(reach_.blocks) *
                              static_cast<std::size_t>(tile_.ny) * interface_rings;
    reach_highest_.assign(rings, nothing_there);
    reach_lowest_.assign(rings, -nothing_there);
    const double b = map_.spacing;
    // Slightly wider, so that rounding leaves no atom out.
    const double reach = widest + 1e-3;
    const auto ring = [&](double lateral) {
        return std::clamp(static_cast<int>(lateral / reach_.ring_width), 0, interface_rings - 1);
    };
#pragma omp parallel for schedule(static)
    for (int y = 0; y < tile_.ny; ++y)
        for (int block = 0; block < reach_.blocks; ++block) {
            const std::size_t first =
                (static_cast<std::size_t>(y) * static_cast<std::size_t>(reach_.blocks) +
                 static_cast<std::size_t>(block)) *
                interface_rings;
            double *highest = &reach_highest_[first], *lowest = &reach_lowest_[first];
            const int last = std::min(tile_.nx, (block + 1) * interface_block) - 1;
            const double left = (tile_.x0 + block * interface_block + 0.5) * spacing_;
            const double right = (tile_.x0 + last + 0.5) * spacing_;
            const double site_y = (tile_.y0 + y + 0.5) * spacing_;
            const int j_last = static_cast<int>(std::ceil((site_y + reach) / b));
            for (int j = static_cast<int>(std::floor((site_y - reach) / b)); j <= j_last; ++j) {
                const double* row =
                    map_.height + static_cast<std::ptrdiff_t>(periodic(j, map_.sites)) * map_.sites;
                const double dy = site_y - j * b;
                if (std::abs(dy) > reach) continue;
                const double half = std::sqrt(reach * reach - dy * dy);
                const int i_last = static_cast<int>(std::floor((right + half) / b));
                for (int i = static_cast<int>(std::ceil((left - half) / b)); i <= i_last; ++i) {
                    const double x = i * b, h = row[periodic(i, map_.sites)];
                    const double nearest = std::max({left - x, x - right, 0.0});
                    const double farthest = std::min(std::max(x - left, right - x), half);
                    // An atom on the border of two rings counts in both.
                    const int from = ring(std::sqrt(nearest * nearest + dy * dy) - 1e-9);
                    const int to = ring(std::sqrt(farthest * farthest + dy * dy) + 1e-9);
                    for (int r = from; r <= to; ++r) {
                        highest[r] = std::max(highest[r], h);
                        lowest[r] = std::min(lowest[r], h);
                    }
                }
            }
        }
    if (!options_.skip) {
        reach_highest_.assign(rings, -nothing_there);
        reach_lowest_.assign(rings, nothing_there);
    }
    reach_.highest = reach_highest_.data();
    reach_.lowest = reach_lowest_.data();
}

SubstrateHeights Interface::heights_on(const Tile& atoms, int halo) {
    const auto fill = [&](auto& field, auto as) {
        field = std::remove_reference_t<decltype(field)>(atoms, 1, halo);
        auto height = field.plane(0);
#pragma omp parallel for schedule(static)
        for (int y = -halo; y < atoms.ny + halo; ++y)
            for (int x = -halo; x < atoms.nx + halo; ++x)
                height(x, y) =
                    as(map_height_[static_cast<std::size_t>(periodic(atoms.y0 + y, map_.sites)) *
                                       static_cast<std::size_t>(map_.sites) +
                                   static_cast<std::size_t>(periodic(atoms.x0 + x, map_.sites))] -
                       highest_);
    };
    SubstrateHeights heights;
    heights.datum = highest_;
    if (options_.mixed || options_.single_too) {
        fill(fixed_height_, [](double h) {
            return static_cast<std::int32_t>(
                std::nearbyint(std::max(h, -fixed_depth) / fixed_quantum));
        });
        heights.fixed = fixed_height_.plane(0);
    }
    if (!options_.mixed) {
        fill(height_, [](double h) { return h; });
        heights.height = height_.plane(0);
    }
    return heights;
}

namespace {

/// Of the lattice sweep: offsets along half an axis, and lateral distances in its table.
struct LatticeReach {
    double cuts_per_length;
    int half_offsets, cut_count;
    LatticeReach(double widest, double spacing)
        // A sixteenth of a spacing is fine enough a cut and keeps the table in the nearest cache.
        : cuts_per_length(16.0 / spacing),
          half_offsets(static_cast<int>(std::ceil(widest / spacing + 0.5))),
          cut_count(static_cast<int>(widest * cuts_per_length) + 2) {}
};
int blocks_in_row(const Tile& tile) { return (tile.nx + interface_block - 1) / interface_block; }

/// Atoms of a substrate of another spacing that lie within `widest` of a tile's sites.
Tile atoms_under(const Tile& tile, double spacing, int atoms, double widest) {
    const double b = tile.sites * spacing / atoms;
    const auto first = [&](int begin) {
        return static_cast<int>(std::floor(((begin + 0.5) * spacing - widest) / b));
    };
    const auto count = [&](int begin, int sites) {
        const double end = (begin + sites - 0.5) * spacing + widest;
        return static_cast<int>(std::ceil(end / b)) + 1 - first(begin);
    };
    return {first(tile.x0), first(tile.y0), count(tile.x0, tile.nx), count(tile.y0, tile.ny),
            atoms};
}

} // namespace

Interface::Tables Interface::tables() const {
    Tables tables;
    tables.lattice = lattice_;
    tables.rows = rows_;
    if (options_.mixed)
        tables.fixed = &fixed_height_;
    else
        tables.heights = &height_;
    tables.columns = columns_;
    tables.highest = reach_highest_;
    tables.lowest = reach_lowest_;
    tables.map = map_height_;
    if (options_.tail) tables.mean_height = &mean_height_;
    tables.tail = tail_;
    return tables;
}

Interface::TableSizes Interface::tables_for(const InterfaceOptions& options, const Tile& tile,
                                            double spacing, int substrate_sites) {
    const double widest = options.potential.cutoff + sideways_margin(spacing);
    const LatticeReach reach(widest, spacing);
    const auto size = [](auto... n) { return (static_cast<std::size_t>(n) * ...); };
    const bool same_lattice = substrate_sites == tile.sites;
    const Tile under = same_lattice ? tile : atoms_under(tile, spacing, substrate_sites, widest);
    const int halo = same_lattice ? reach.half_offsets + 1 : int{interface_block};
    return {options.mixed ? 0 : Field<double>::bytes_for(under, 1, halo),
            options.mixed || options.single_too ? Field<std::int32_t>::bytes_for(under, 1, halo)
                                                : 0,
            options.tail ? Field<double>::bytes_for(tile, 1) : 0,
            size(blocks_in_row(tile), tile.ny, interface_rings) * sizeof(double),
            same_lattice ? size(reach.cut_count, reach.half_offsets) * sizeof(std::int32_t) : 0,
            size(substrate_sites, substrate_sites) * sizeof(double)};
}

/// The tile's heights with their halo, and how many offsets lie within each lateral distance.
void Interface::build_lattice() {
    const LatticeReach reach(options_.potential.cutoff + margin_, spacing_);
    const int half = reach.half_offsets;
    lattice_.heights = heights_on(tile_, half + 1);
    lattice_.cuts_per_length = reach.cuts_per_length;
    lattice_.cut_count = reach.cut_count;
    lattice_.half_offsets = half;
    for (int k = 0; k < lattice_.cut_count; ++k) {
        const double lateral = k / lattice_.cuts_per_length + 1e-9;
        for (int n = 1; n <= half; ++n) {
            const auto within = [&](int m) {
                return std::hypot((m - 0.5) * spacing_, (n - 0.5) * spacing_) < lateral;
            };
            int m = 0;
            while (m < half && within(m + 1))
                ++m;
            columns_.push_back(m);
        }
    }
    lattice_.columns = columns_.data();
    lattice_.reach = reach_;
    lattice_.map = map_;
}

/// The heights of the atoms around the tile, on the substrate's own lattice.
void Interface::build_rows() {
    const Tile atoms =
        atoms_under(tile_, spacing_, map_.sites, options_.potential.cutoff + margin_);
    rows_.i0 = atoms.x0;
    rows_.j0 = atoms.y0;
    rows_.heights = heights_on(atoms, interface_block);
    rows_.reach = reach_;
    rows_.map = map_;
}

InterfaceSums Interface::sweep(const VectorPlane<const double>& displacement,
                               const VectorPlane<double>& force, double reference_height,
                               bool observe, bool in_single) const {
    return sweep_sites({displacement, force, spacing_, reference_height, tile_.x0, tile_.y0, {}},
                       observe, options_.mixed || (in_single && options_.single_too));
}

InterfaceSums Interface::sweep_sites(const InterfaceSites& sites, bool observe, bool mixed) const {
    const auto pick = [&](const auto& sweeps) {
        return (mixed ? sweeps.in_mixed : sweeps.plain)[observe];
    };
    const auto lattice = pick(interface_kernels().lattice);
    const auto rows = pick(interface_kernels().rows);
    const auto cells = pick(interface_kernels().cells);
    const CellSubstrate in_cells = cells_ ? cells_->view() : CellSubstrate{};
    const LennardJones& potential = options_.potential;
    const PairTable pairs = options_.pairs();
    InterfaceSums total;
#pragma omp parallel
    {
        InterfaceSums mine;
#pragma omp for schedule(static) nowait
        for (int y = 0; y < tile_.ny; ++y) {
            switch (method_) {
            case InterfaceMethod::wall:
                std::visit(
                    [&](const auto& law) {
                        interface_kernels().wall.over(law).sweep[observe](
                            sites, {height_.plane(0), law}, y, y + 1, mine);
                    },
                    *options_.wall);
                break;
            case InterfaceMethod::lattice:
                lattice(sites, lattice_, potential, y, y + 1, mine);
                break;
            case InterfaceMethod::rows:
                rows(sites, rows_, potential, y, y + 1, mine);
                break;
            case InterfaceMethod::cells:
                cells(sites, in_cells, pairs, y, y + 1, mine);
                break;
            default:
                if (cells_)
                    reference_sweep(sites, in_cells.atoms, pairs, y, y + 1, mine);
                else
                    reference_sweep(sites, map_, potential, y, y + 1, mine);
            }
            if (options_.tail)
                tail_sweep(sites, tail_, mean_height_.plane(0), y, y + 1, observe, mine);
        }
#pragma omp critical(asperity_interface_sums)
        total.merge(mine);
    }
    return total;
}

WallSums Interface::settle_row(const WallRow<double>& row, const WallRule& rule, int sites) const {
    return std::visit(
        [&](const auto& law) {
            return interface_kernels().wall.over(law).settle_double(law, row, rule, sites);
        },
        *options_.wall);
}
WallSums Interface::settle_row(const WallRow<float>& row, const WallRule& rule, int sites) const {
    return std::visit(
        [&](const auto& law) {
            return interface_kernels().wall.over(law).settle_single(law, row, rule, sites);
        },
        *options_.wall);
}

/// Of the substrate below a site, Å: the wall's, or bilinear between the four atoms around it.
double Interface::height_below(const VectorPlane<const double>& displacement, int x, int y) const {
    if (options_.wall) return height_.plane(0)(x, y);
    const double px = ((tile_.x0 + x + 0.5) * spacing_ + displacement.x(x, y)) / map_.spacing;
    const double py = ((tile_.y0 + y + 0.5) * spacing_ + displacement.y(x, y)) / map_.spacing;
    const double fx = px - std::floor(px), fy = py - std::floor(py);
    const auto h = [&](int i, int j) {
        return map_height_
            [static_cast<std::size_t>(periodic(static_cast<int>(std::floor(py)) + j, map_.sites)) *
                 static_cast<std::size_t>(map_.sites) +
             static_cast<std::size_t>(periodic(static_cast<int>(std::floor(px)) + i, map_.sites))];
    };
    return (1.0 - fy) * ((1.0 - fx) * h(0, 0) + fx * h(1, 0)) +
           fy * ((1.0 - fx) * h(0, 1) + fx * h(1, 1));
}

InterfaceMaps Interface::maps(const VectorPlane<const double>& displacement,
                              double reference_height) const {
    VectorField<double> force(tile_, 1);
    Field<double> nearest(tile_, 1);
    InterfaceMaps maps;
    maps.nx = tile_.nx;
    maps.ny = tile_.ny;
    const std::size_t count =
        static_cast<std::size_t>(tile_.nx) * static_cast<std::size_t>(tile_.ny);
    maps.contact.resize(count);
    const InterfaceSites sites{
        displacement,     force.plane(0),
        spacing_,         reference_height,
        tile_.x0,         tile_.y0,
        nearest.plane(0), {maps.contact.data(), tile_.nx, tile_.nx, tile_.ny}};
    sweep_sites(sites, true, options_.mixed);
    maps.distance.reserve(count);
    maps.gap.reserve(count);
    maps.pressure.reserve(count);
    const double to_gpa = 1.0 / (units::gigapascal * spacing_ * spacing_);
    for (int y = 0; y < tile_.ny; ++y)
        for (int x = 0; x < tile_.nx; ++x) {
            const double r2 = sites.nearest_r2(x, y);
            maps.distance.push_back(r2 < no_pair ? std::sqrt(r2)
                                                 : std::numeric_limits<double>::infinity());
            maps.pressure.push_back(sites.force.z(x, y) * to_gpa);
            maps.gap.push_back(reference_height + displacement.z(x, y) -
                               height_below(displacement, x, y));
        }
    return maps;
}

double reach_of(const InterfaceOptions& options) {
    if (options.wall) {
        const double reach = std::visit([](const auto& law) { return law.reach(); }, *options.wall);
        if (std::isfinite(reach)) return reach;
    }
    return (options.tail ? 4.0 : 1.0) * options.pairs().cutoff;
}

double Interface::start_height() const { return highest_ + reach_of(options_); }

std::vector<double> Interface::heights_below() const {
    const double cutoff = options_.pairs().cutoff;
    std::vector<double> heights(static_cast<std::size_t>(tile_.nx) *
                                static_cast<std::size_t>(tile_.ny));
#pragma omp parallel for schedule(static)
    for (int y = 0; y < tile_.ny; ++y)
        for (int x = 0; x < tile_.nx; ++x) {
            double highest = nothing_there;
            if (options_.wall)
                highest = height_.plane(0)(x, y);
            else // the height at which the nearest atom is at the cutoff, less the cutoff
                for_atoms_around(
                    map_, (tile_.x0 + x + 0.5) * spacing_, (tile_.y0 + y + 0.5) * spacing_, cutoff,
                    [&](double lateral, double h) {
                        const double above = std::sqrt(cutoff * cutoff - lateral * lateral);
                        highest = std::max(highest, h + above - cutoff);
                    });
            heights[static_cast<std::size_t>(y) * static_cast<std::size_t>(tile_.nx) +
                    static_cast<std::size_t>(x)] = highest;
        }
    return heights;
}

double Interface::attraction_grows_down_to() const {
    if (!options_.wall) return start_height();
    return highest_ + std::visit([](const auto& law) { return law.contact_gap(); }, *options_.wall);
}

std::size_t Interface::bytes() const {
    const std::size_t doubles = map_height_.size() + reach_highest_.size() + reach_lowest_.size();
    return doubles * sizeof(double) + columns_.size() * sizeof(std::int32_t) +
           (height_.empty() ? 0 : height_.bytes()) +
           (fixed_height_.empty() ? 0 : fixed_height_.bytes()) + tail_bytes() +
           (cells_ ? cells_->bytes() : 0);
}

ContactCount count_contacts(const InterfaceSums& sums, const Communicator& ranks) {
    std::array<std::int64_t, 2> counts = {sums.in_contact, sums.repulsive};
    ranks.sum(counts);
    const double r2 = -ranks.max(-sums.closest_r2);
    return {counts[0], counts[1], r2 < no_pair ? std::sqrt(r2) : HUGE_VAL};
}

} // namespace asperity
