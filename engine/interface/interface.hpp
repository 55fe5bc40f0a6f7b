// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The interface: one tile of the block's lowest layer over the rigid substrate
// (docs/explanation/model.md), which consists of atoms or is a wall.
//
// The interface is built once per run; its tables are rebuilt after each spacing that the block
// slides. A rank holds the rows of the height map around its tile (all rows if the block slides),
// so that the sweep is local to the tile; its sums are exact (ExactSum) and can be merged over
// ranks in any order.
//
// The kinds of substrate are small classes: OverLattice, OverRows, OverAtoms, OverWall. Each keeps
// the data that its sweep reads around the tile, and passes rows of sites to its kernel.
// substrate_of() selects one of them. Tables allow for lateral displacements up to two spacings;
// sites displaced further are summed by the reference loop, so that no pair is missed.
#pragma once

#include "decomposition/communicator.hpp"
#include "decomposition/field.hpp"
#include "decomposition/tile.hpp"
#include "engine/interface/height_map.hpp"
#include "engine/interface/over_atoms.hpp"
#include "engine/interface/over_lattice.hpp"
#include "engine/interface/over_rows.hpp"
#include "engine/interface/over_wall.hpp"
#include "engine/options/interface_options.hpp"
#include "engine/options/substrate.hpp"
#include "engine/step_record.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace asperity {

/// Returns the counts over all tiles from the sums of this rank's tile. Collective.
ContactCount count_contacts(const InterfaceSums& sums, const Communicator& ranks);

/// Cuts a map of across x across sites to its first n x n sites, in place.
template <class T>
void crop_map(std::vector<T>& map, int across, int n) {
    if (n == across) return;
    const auto width = static_cast<std::ptrdiff_t>(across);
    for (std::ptrdiff_t y = 1; y < n; ++y)
        std::copy_n(map.begin() + y * width, n, map.begin() + y * n);
    map.resize(static_cast<std::size_t>(n) * static_cast<std::size_t>(n));
}

/// Maps over the tile's sites, [y * nx + x].
struct InterfaceMaps {
    int nx = 0, ny = 0;
    std::vector<std::uint8_t> contact; ///< 1 if the nearest atom is within contact distance
    /// Distance to the nearest atom, Å; infinite if no atom is within the cutoff. Over a wall the
    /// gap, 0 if the gap is negative, infinite over a hole.
    std::vector<double> distance;
    /// Height above the substrate below the site (a wall, or interpolated bilinearly between
    /// atoms), Å; NaN over a hole.
    std::vector<double> gap;
    std::vector<double> pressure; ///< normal force on the site per a^2, GPa; repulsion is positive
    /// Further maps by their names in run.h5: each field that a memory keeps (Interface::keep()),
    /// the heights of a wall that yields less its set, Å, and each of
    /// InterfaceOptions::site_maps().
    std::vector<std::pair<std::string, std::vector<double>>> of_sites;

    /// Cuts all maps to their first n x n sites.
    void crop(int n) {
        crop_map(contact, nx, n);
        for (std::vector<double>* map : {&distance, &gap, &pressure})
            crop_map(*map, nx, n);
        for (auto& [name, map] : of_sites)
            crop_map(map, nx, n);
        nx = ny = n;
    }
};

/// The interface of one tile of sites with the substrate.
class Interface {
public:
    /// Makes the tables; copies the needed part of the surface. Collective over the ranks of the
    /// surface. spacing: a, the block's lattice constant, Å. A wall may end below the first sites
    /// of the tile's grid, where the substrate's length is less than the grid's; no solid is below
    /// the others.
    Interface(const Surface& substrate, const Tile& tile, double spacing,
              const InterfaceOptions& options);

    /// Overwrites `force` with the forces of the substrate on the tile's sites, eV/Å. Returns sums
    /// over the tile. displacement: Å; how.mixed_precision requires options.mixed_on_request.
    InterfaceSums sweep(const VectorPlane<const double>& displacement,
                        const VectorPlane<double>& force, SweepOptions how = {}) const;

    /// Returns the height of the undisplaced lowest layer above the zero of the substrate's
    /// heights, Å; initially start_height().
    double reference_height() const { return reference_height_; }
    /// Sets reference_height(), Å.
    void set_reference_height(double height) { reference_height_ = height; }

    /// Moves the block to the place (x, y) over the substrate, Å; initially (0, 0). A substrate of
    /// atoms is moved by whole spacings, for which its tables are rebuilt; the remainder is added
    /// to the displacements in each sweep. A wall is moved by a Fourier shift. Requires
    /// options.slides.
    void slide_to(double x, double y);
    /// Returns the place of the block over the substrate, Å.
    const std::array<double, 2>& place() const { return place_; }

    /// Returns the wall; nullptr if the substrate consists of atoms.
    const OverWall* wall() const { return std::get_if<OverWall>(&substrate_); }
    /// Returns the wall if it yields; nullptr otherwise.
    const OverWall* yielding_wall() const { return wall() && wall()->yields() ? wall() : nullptr; }
    /// Returns the permanent set of the wall, Å, for writing. Requires yielding_wall().
    Field<double>& set() { return std::get<OverWall>(substrate_).set(); }

    /// Returns a test of whether the site (x, y) of this tile is in contact with the wall at these
    /// displacements, Å, which it refers to. Requires a wall.
    std::function<bool(int, int)> contact_test(const VectorPlane<const double>& displacement) const;
    /// Returns the number of pairs of neighbouring sites of which one is in contact with the wall:
    /// the perimeter of the contact over the spacing. displacement: Å. Requires a wall, and whole
    /// rows of sites on each rank. Collective.
    std::int64_t contact_edges(const VectorPlane<const double>& displacement,
                               const Communicator& ranks) const;

    /// Returns a field of zeros at the sites, for a memory of them (engine/energy/memory.hpp).
    /// name: name of its map in run.h5. The reference is valid as long as the interface.
    Field<double>& keep(std::string name) {
        return kept_.emplace_back(std::move(name), Field<double>(tile_, 1, 0)).second;
    }
    /// Returns the number of InterfaceMaps::of_sites.
    std::size_t maps_of_sites() const;

    /// Returns maps of the sites at these displacements, Å. Collective.
    InterfaceMaps maps(const VectorPlane<const double>& displacement) const;

    /// Returns the lowest reference height at which undisplaced sites are beyond the interaction
    /// range, Å: highest atom + reach_of().
    double start_height() const;
    /// Returns a reference height down to which the attraction of an undisplaced block increases
    /// monotonically, Å; start_height() if no better bound is known.
    double attraction_grows_down_to() const;

    /// Views of the tables that a device copies; valid as long as this object.
    struct Tables {
        const OverLattice* lattice;       ///< null if the substrate is of another kind
        std::span<const double> map;      ///< heights around the tile, Å
        const Field<double>* mean_height; ///< mean heights for the tail, Å; nullptr without a tail
        double density;                   ///< density of the substrate's atoms, 1/Å^2
    };
    Tables tables() const; ///< returns the views

    const Tile& tile() const { return tile_; }
    InterfaceMethod method() const { return method_; }
    /// Returns the number of atoms across the box, for a substrate that is a map.
    int substrate_sites() const { return map_.sites(); }
    const InterfaceOptions& options() const { return options_; }
    /// Returns the number of sites across the box above the substrate, N.
    int sites_across() const { return across_; }
    std::size_t bytes() const; ///< returns the memory of the tables, bytes
    /// Returns the part of bytes() that holds heights of more rows than the tile's, bytes.
    std::size_t bytes_of_map() const;

private:
    /// Substrate; std::monostate: the reference loop over the map.
    using Substrate = std::variant<std::monostate, OverLattice, OverRows, OverAtoms, OverWall>;
    Substrate substrate_of(const AtomPositions& atoms) const;
    void sweep_row(const InterfaceSites& sites, int y, SweepOptions how, InterfaceSums& sums) const;
    VectorPlane<const double> over_substrate(const VectorPlane<const double>& displacement) const;
    void find_mean_heights();
    /// Returns the gap below which a site is in contact with the wall, Å. Requires a wall.
    double contact_gap() const;
    double density() const { return 1.0 / (map_.spacing() * map_.spacing()); }

    InterfaceOptions options_;
    Tile tile_;
    double spacing_;
    int across_;    ///< number of sites across the substrate
    HeightMap map_; ///< heights; for atoms anywhere, those of the topmost atoms
    InterfaceMethod method_;
    Substrate substrate_;
    std::deque<std::pair<std::string, Field<double>>> kept_; ///< fields by keep()
    /// Mean heights of the atoms within the cutoff laterally, Å; empty without a tail.
    Field<double> mean_height_;
    double reference_height_ = 0.0; ///< Å

    // Place of a block that slides.
    AtomPositions atoms_;           ///< initial positions of atoms anywhere
    std::array<double, 2> place_{}; ///< place of the block over the substrate, Å
    std::array<int, 2> spacings_{}; ///< whole spacings of place_, by which the substrate was moved
    std::array<double, 2> remainder_{}; ///< remainder of place_, Å
    mutable VectorField<double> slid_;  ///< displacements plus remainder_; x and y are used

public:
    // The views point into the object's own arrays.
    Interface(const Interface&) = delete;
    Interface& operator=(const Interface&) = delete;
    Interface(Interface&&) = default; // vectors keep their storage when moved
    Interface& operator=(Interface&&) = default;
};

} // namespace asperity
