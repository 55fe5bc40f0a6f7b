// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/interface/interface.hpp"

#include "engine/options/sweep_limits.hpp"
#include "engine/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <type_traits>
#include <utility>

namespace asperity {

namespace {

/// Throws std::invalid_argument for potentials that no sweep can take.
void check(const InterfaceOptions& options, bool anywhere, double spacing, double between_atoms) {
    if (!options.by_type.empty() && !anywhere)
        throw std::invalid_argument(
            "interface: pairs by type need a substrate of atoms anywhere, which have types");
    const PairTable pairs = options.pairs();
    for (int type = 0; type < pairs.types; ++type)
        std::visit(
            [](const auto& p) {
                if (!(p.cutoff > 0.0) || !(p.zero() > 0.0) || !(p.depth() >= 0.0))
                    throw std::invalid_argument(fmt::format(
                        "interface: a {} potential of depth {} eV, zero at {} Å and with a cutoff "
                        "of {} Å; all must be positive numbers",
                        p.name, p.depth(), p.zero(), p.cutoff));
            },
            pairs.of[type]);
    const double most = largest_cutoff(spacing, between_atoms);
    if (!anywhere && pairs.cutoff > most)
        throw std::invalid_argument(fmt::format(
            "interface: a cutoff of {:.6g} Å is more than the {:.6g} Å that the tables hold for "
            "sites {:.6g} Å and atoms {:.6g} Å apart; choose a smaller one (4 r0 = {:.6g} Å keeps "
            "98 % of the work of adhesion) and set interface.tail = true",
            pairs.cutoff, most, spacing, between_atoms, 4.0 * zero_of(options.potential)));
}

/// Returns the sweep for options that leave it open.
InterfaceMethod method_for(const InterfaceOptions& options, const Surface& surface, int sites) {
    if (options.wall) return InterfaceMethod::wall;
    if (options.method != InterfaceMethod::automatic) return options.method;
    if (surface.atoms.size() > 0) return InterfaceMethod::cells;
    return surface.sites == sites ? InterfaceMethod::lattice : InterfaceMethod::rows;
}

} // namespace

namespace {

/// Allows mixed sweeps only for lengths that single precision can hold: positions in it are
/// multiples of a fixed length, down to a fixed depth; other scenes are relaxed in double
/// precision.
InterfaceOptions within_single(InterfaceOptions options) {
    const double cutoff = options.pairs().cutoff;
    options.mixed_on_request =
        options.mixed_on_request && cutoff > 0.5 && cutoff < 0.25 * fixed_depth;
    return options;
}

} // namespace

Interface::Interface(const Surface& substrate, const Tile& tile, double spacing,
                     const InterfaceOptions& options)
    : options_(within_single(options)), tile_(tile), spacing_(spacing),
      across_(static_cast<int>(std::lround(substrate.length / spacing))),
      map_(substrate, tile, across_, spacing, options_),
      method_(method_for(options, substrate, tile.sites)),
      substrate_(substrate_of(substrate.atoms)) {
    set_reference_height(start_height());
    if (options.tail && !wall()) find_mean_heights();
    if (options.slides) atoms_ = substrate.atoms;
    if (wall()) map_.free_heights();
    if (yielding_wall()) std::get<OverWall>(substrate_).lower_by(keep("set"));
}

void Interface::slide_to(double x, double y) {
    if (std::array{x, y} == place_) return;
    if (!options_.slides) throw std::logic_error("interface: it was not made to slide");
    place_ = {x, y};
    if (auto* const wall = std::get_if<OverWall>(&substrate_)) return wall->slide_to(x, y);
    const double step = map_.spacing();
    const auto spacings = [&](double at) { return static_cast<int>(std::lround(at / step)); };
    const std::array whole{spacings(x), spacings(y)};
    remainder_ = {x - whole[0] * step, y - whole[1] * step};
    if (slid_.empty()) slid_ = VectorField<double>(tile_, 1);
    if (whole == spacings_) return;
    // The block goes one way, the substrate the other.
    map_.shift(spacings_[0] - whole[0], spacings_[1] - whole[1]);
    spacings_ = whole;
    AtomPositions moved = atoms_;
    const double edge = tile_.sites * spacing_;
    const auto wrap = [&](std::vector<double>& list, double by) {
        for (double& at : list) {
            at = std::fmod(at - by, edge);
            if (at < 0.0) at += edge;
        }
    };
    wrap(moved.x, whole[0] * step);
    wrap(moved.y, whole[1] * step);
    substrate_ = substrate_of(moved);
    if (!mean_height_.empty()) find_mean_heights();
}

/// Returns the displacements in the frame of the substrate.
VectorPlane<const double>
Interface::over_substrate(const VectorPlane<const double>& displacement) const {
    if (remainder_ == std::array{0.0, 0.0}) return displacement;
    const VectorPlane<double> to = slid_.plane(0);
#pragma omp parallel for schedule(static)
    for (int y = 0; y < tile_.ny; ++y)
        for (int x = 0; x < tile_.nx; ++x) {
            to.x(x, y) = displacement.x(x, y) + remainder_[0];
            to.y(x, y) = displacement.y(x, y) + remainder_[1];
        }
    const VectorPlane<const double> from = std::as_const(slid_).plane(0);
    return {from.x, from.y, displacement.z};
}

Interface::Substrate Interface::substrate_of(const AtomPositions& atoms) const {
    const auto refuse = [](const char* why) {
        throw std::invalid_argument(std::string("interface: ") + why);
    };
    const bool anywhere = atoms.size() > 0;
    if (across_ > tile_.sites || (across_ < tile_.sites && method_ != InterfaceMethod::wall))
        refuse("the substrate and the box differ in width");
    if (method_ != InterfaceMethod::wall) check(options_, anywhere, spacing_, map_.spacing());
    switch (method_) {
    case InterfaceMethod::wall:
        if (!options_.wall) refuse("a wall needs its law");
        return OverWall(map_, across_, tile_, options_);
    case InterfaceMethod::cells:
        if (!anywhere) refuse("the sweep over cells needs atoms anywhere, and there are none");
        return OverAtoms(atoms, tile_, spacing_, options_);
    case InterfaceMethod::rows:
        if (anywhere) refuse("atoms anywhere have no rows; use the sweep over cells");
        return OverRows(map_, tile_, spacing_, options_);
    case InterfaceMethod::lattice:
        if (anywhere || map_.sites() != tile_.sites)
            refuse("the lattice sweep needs one layer with as many atoms as sites across the box; "
                   "use the sweep over rows or cells");
        return OverLattice(map_, tile_, spacing_, options_);
    default: // the reference loop
        if (anywhere) return OverAtoms(atoms, tile_, spacing_, options_);
        return {};
    }
}

void Interface::find_mean_heights() {
    mean_height_ = Field<double>(tile_, 1);
    auto mean = mean_height_.plane(0);
    const double cutoff = cutoff_of(options_.potential);
#pragma omp parallel for schedule(static)
    for (int y = 0; y < tile_.ny; ++y)
        for (int x = 0; x < tile_.nx; ++x) {
            double sum = 0.0;
            int atoms = 0;
            map_.around((tile_.x0 + x + 0.5) * spacing_, (tile_.y0 + y + 0.5) * spacing_, cutoff,
                        [&](double, double h) {
                            sum += h;
                            ++atoms;
                        });
            mean(x, y) = atoms ? sum / atoms : 0.0;
        }
}

InterfaceSums Interface::sweep(const VectorPlane<const double>& displacement,
                               const VectorPlane<double>& force, SweepOptions how) const {
    const InterfaceSites sites{over_substrate(displacement),
                               force,
                               spacing_,
                               how.height.value_or(reference_height_),
                               tile_.x0,
                               tile_.y0,
                               {}};
    InterfaceSums total;
#pragma omp parallel
    {
        InterfaceSums mine;
#pragma omp for schedule(static) nowait
        for (int y = 0; y < tile_.ny; ++y)
            sweep_row(sites, y, how, mine);
#pragma omp critical(asperity_interface_sums)
        total.merge(mine);
    }
    return total;
}

void Interface::sweep_row(const InterfaceSites& sites, int y, SweepOptions how,
                          InterfaceSums& sums) const {
    std::visit(
        [&](const auto& substrate) {
            using Kind = std::decay_t<decltype(substrate)>;
            if constexpr (std::is_same_v<Kind, std::monostate>)
                reference_sweep(sites, map_.view(), options_.potential, y, y + 1, sums);
            else if constexpr (std::is_same_v<Kind, OverAtoms>)
                method_ == InterfaceMethod::reference ? substrate.reference_row(sites, y, sums)
                                                      : substrate.sweep_row(sites, y, how, sums);
            else
                substrate.sweep_row(sites, y, how, sums);
        },
        substrate_);
    if (!mean_height_.empty())
        tail_sweep(sites, options_.potential, density(), mean_height_.plane(0), y, y + 1,
                   how.observe, sums);
}

InterfaceMaps Interface::maps(const VectorPlane<const double>& displacement) const {
    InterfaceMaps maps;
    maps.nx = tile_.nx;
    maps.ny = tile_.ny;
    const auto nx = static_cast<std::size_t>(tile_.nx);
    const std::size_t count = nx * static_cast<std::size_t>(tile_.ny);
    maps.contact.resize(count);
    for (std::vector<double>* map : {&maps.distance, &maps.gap, &maps.pressure})
        map->resize(count);
    const VectorPlane<const double> u = over_substrate(displacement);
    const double to_gpa = 1.0 / (units::gigapascal * spacing_ * spacing_);
#pragma omp parallel
    {
        Tile one_row = tile_;
        one_row.ny = 1;
        VectorField<double> force(one_row, 1);
        Field<double> nearest(one_row, 1);
        // Every row of the sites has its forces in this one.
        const auto of_all_rows = [&](PlaneView<double> row) {
            return PlaneView<double>{row.origin, 0, tile_.nx, tile_.ny};
        };
        const InterfaceSites sites{u,
                                   {of_all_rows(force.x.plane(0)), of_all_rows(force.y.plane(0)),
                                    of_all_rows(force.z.plane(0))},
                                   spacing_,
                                   reference_height_,
                                   tile_.x0,
                                   tile_.y0,
                                   of_all_rows(nearest.plane(0)),
                                   {maps.contact.data(), tile_.nx, tile_.nx, tile_.ny}};
        InterfaceSums sums;
#pragma omp for schedule(static)
        for (int y = 0; y < tile_.ny; ++y) {
            sweep_row(sites, y, {.observe = true}, sums);
            for (int x = 0; x < tile_.nx; ++x) {
                const std::size_t i =
                    static_cast<std::size_t>(y) * nx + static_cast<std::size_t>(x);
                const double r2 = sites.nearest_r2(x, y);
                maps.distance[i] = r2 < no_pair ? std::sqrt(r2) : HUGE_VAL;
                maps.pressure[i] = sites.force.z(x, y) * to_gpa;
                const double below =
                    wall() ? wall()->below(x, y)
                           : map_.between((tile_.x0 + x + 0.5) * spacing_ + u.x(x, y),
                                          (tile_.y0 + y + 0.5) * spacing_ + u.y(x, y));
                maps.gap[i] = reference_height_ + displacement.z(x, y) - below;
            }
        }
    }
    const auto add = [&](const std::string& name, const auto& value) {
        std::vector<double>& map = maps.of_sites.emplace_back(name, std::vector<double>()).second;
        map.reserve(count);
        for (int y = 0; y < tile_.ny; ++y)
            for (int x = 0; x < tile_.nx; ++x)
                map.push_back(value(x, y));
    };
    for (const auto& [name, field] : kept_)
        add(name, field.plane(0));
    if (const OverWall* const wall = yielding_wall())
        add("yielded_height", [&](int x, int y) { return wall->below(x, y); });
    for (const auto& map : options_.site_maps())
        maps.of_sites.emplace_back(map->name, map->under(tile_));
    return maps;
}

std::size_t Interface::maps_of_sites() const {
    return kept_.size() + (yielding_wall() ? 1 : 0) + options_.site_maps().size();
}

double Interface::start_height() const { return map_.highest() + reach_of(options_); }

double Interface::contact_gap() const {
    return std::visit([](const auto& law) { return law.contact_gap(); }, *options_.wall);
}

double Interface::attraction_grows_down_to() const {
    return wall() ? map_.highest() + contact_gap() : start_height();
}

std::function<bool(int, int)>
Interface::contact_test(const VectorPlane<const double>& displacement) const {
    return [this, u = displacement.z, limit = contact_gap() - reference_height_](int x, int y) {
        return u(x, y) - wall()->below(x, y) < limit;
    };
}

std::int64_t Interface::contact_edges(const VectorPlane<const double>& displacement,
                                      const Communicator& ranks) const {
    const PlaneView<const double> u = displacement.z;
    const auto in_contact = contact_test(displacement);
    // The first row of the next rank is above the last one of this rank.
    const int size = ranks.size(), rank = ranks.rank();
    std::vector<double> first(static_cast<std::size_t>(u.nx)), above(first.size());
    for (int x = 0; x < u.nx; ++x)
        first[static_cast<std::size_t>(x)] = in_contact(x, 0) ? 1.0 : 0.0;
    const Message message{(rank + size - 1) % size, (rank + 1) % size, 0, first, above};
    ranks.exchange(std::span(&message, 1));
    std::array<std::int64_t, 1> edges{};
    for (int y = 0; y < u.ny; ++y)
        for (int x = 0; x < u.nx; ++x) {
            const bool here = in_contact(x, y);
            const bool next =
                y + 1 < u.ny ? in_contact(x, y + 1) : above[static_cast<std::size_t>(x)] > 0.5;
            edges[0] += (here != in_contact((x + 1) % u.nx, y)) + (here != next);
        }
    ranks.sum(edges);
    return edges[0];
}

Interface::Tables Interface::tables() const {
    return {std::get_if<OverLattice>(&substrate_), map_.heights(),
            mean_height_.empty() ? nullptr : &mean_height_, density()};
}

std::size_t Interface::bytes_of_map() const {
    return map_.heights().size() * sizeof(double) + (wall() ? wall()->bytes_of_map() : 0);
}

std::size_t Interface::bytes() const {
    std::size_t all = map_.heights().size() * sizeof(double) +
                      (mean_height_.empty() ? 0 : mean_height_.bytes()) +
                      3 * atoms_.size() * sizeof(double) + (slid_.empty() ? 0 : slid_.bytes());
    for (const auto& [name, field] : kept_)
        all += field.bytes();
    std::visit(
        [&](const auto& substrate) {
            if constexpr (!std::is_same_v<std::decay_t<decltype(substrate)>, std::monostate>)
                all += substrate.bytes();
        },
        substrate_);
    return all;
}

ContactCount count_contacts(const InterfaceSums& sums, const Communicator& ranks) {
    std::array<std::int64_t, 2> counts = {sums.in_contact, sums.repulsive};
    ranks.sum(counts);
    const double r2 = -ranks.max(-sums.closest_r2);
    return {counts[0], counts[1], r2 < no_pair ? std::sqrt(r2) : HUGE_VAL};
}

} // namespace asperity
