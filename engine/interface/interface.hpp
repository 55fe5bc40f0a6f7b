// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The interface: one tile of the block's lowest layer over the rigid substrate
// (docs/explanation/model.md), whose atoms it meets, or a wall in their place.
//
// Built once per run, and anew for each spacing that the block slides. Every rank knows the whole
// height map, so nothing is communicated here: the sweep is local to the tile, and its sums are
// exact (ExactSum), to be merged over ranks in any order.
//
// The kinds of substrate are small classes: OverLattice, OverRows, OverAtoms, OverWall. Each keeps
// what its sweep reads around the tile, and hands rows of sites to its kernel. substrate_of() says
// which one is taken. Tables allow for sideways displacements up to two spacings; sites that go
// beyond are summed by the reference loop, so no pair is ever missed.
#pragma once

#include "decomposition/communicator.hpp"
#include "decomposition/field.hpp"
#include "decomposition/tile.hpp"
#include "engine/interface/height_map.hpp"
#include "engine/interface/interface_options.hpp"
#include "engine/interface/over_atoms.hpp"
#include "engine/interface/over_lattice.hpp"
#include "engine/interface/over_rows.hpp"
#include "engine/interface/over_wall.hpp"
#include "engine/scene/surface.hpp"
#include "engine/step_record.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <variant>
#include <vector>

namespace asperity {

/// Over all tiles, from the sums of this rank's. Collective.
ContactCount count_contacts(const InterfaceSums& sums, const Communicator& ranks);

/// Maps over the tile's sites, [y * nx + x].
struct InterfaceMaps {
    int nx = 0, ny = 0;
    std::vector<std::uint8_t> contact; ///< 1 where the nearest atom is within contact distance
    std::vector<double> distance; ///< to the nearest atom, Å; infinite where none is within the
                                  ///< cutoff; over a wall the gap, 0 where it is negative
    std::vector<double> gap; ///< height above the substrate below (a wall, or bilinear between its
                             ///< atoms), Å
    std::vector<double> pressure; ///< normal force on the site per a^2, GPa; positive pushes
};

class Interface {
public:
    /// spacing: a, the block's lattice constant, Å. The surface is copied as far as it is needed.
    Interface(const Surface& substrate, const Tile& tile, double spacing,
              const InterfaceOptions& options);

    /// Forces of the substrate on the tile's sites (overwritten) and their sums over the tile.
    /// how.rough: only where the options have rough_too.
    InterfaceSums sweep(const VectorPlane<const double>& displacement,
                        const VectorPlane<double>& force, double reference_height,
                        SweepOptions how = {}) const;

    /// The block stands at (x, y) over the substrate from now on, Å: (0, 0) at first. Whole
    /// spacings move the substrate and make its tables anew; what is left is added to the
    /// displacements of each sweep. Only with options.slides.
    void slide_to(double x, double y);
    const std::array<double, 2>& place() const { return place_; }

    /// Null where there is none.
    const OverWall* wall() const { return std::get_if<OverWall>(&substrate_); }

    /// Per-site maps of the state; makes a sweep of its own.
    InterfaceMaps maps(const VectorPlane<const double>& displacement,
                       double reference_height) const;

    /// The reference height from which undisplaced sites are beyond the interaction range: highest
    /// atom + reach_of().
    double start_height() const;
    /// Down to this reference height the attraction of undisplaced sites only grows; the start
    /// height, where no better bound is known.
    double attraction_grows_down_to() const;

    /// What a device copies. Views are of this object.
    struct Tables {
        const OverLattice* lattice; ///< null where the substrate is another
        std::span<const double> map;
        const Field<double>* mean_height; ///< with the tail; else null
        double density;                   ///< of the substrate's atoms, 1/Å^2
    };
    Tables tables() const;

    const Tile& tile() const { return tile_; }
    InterfaceMethod method() const { return method_; }
    /// Atoms across the box, of a substrate that is a map.
    int substrate_sites() const { return map_.sites(); }
    const InterfaceOptions& options() const { return options_; }
    std::size_t bytes() const;

private:
    /// None: the reference loop over the map.
    using Substrate = std::variant<std::monostate, OverLattice, OverRows, OverAtoms, OverWall>;
    Substrate substrate_of(const AtomPositions& atoms) const;
    InterfaceSums sweep_sites(const InterfaceSites& sites, SweepOptions how) const;
    VectorPlane<const double> over_substrate(const VectorPlane<const double>& displacement) const;
    void find_mean_heights();
    double density() const { return 1.0 / (map_.spacing() * map_.spacing()); }

    InterfaceOptions options_;
    Tile tile_;
    double spacing_;
    HeightMap map_; ///< of atoms anywhere, of the topmost ones
    InterfaceMethod method_;
    Substrate substrate_;
    Field<double> mean_height_; ///< tail: of the atoms within the cutoff sideways

    // Where it slides.
    AtomPositions atoms_;              ///< anywhere, where they stood at first
    std::array<double, 2> place_{};    ///< of the block over the substrate, Å
    std::array<int, 2> whole_{};       ///< of it: spacings by which the substrate was moved
    std::array<double, 2> rest_{};     ///< what is left, Å
    mutable VectorField<double> slid_; ///< displacements with that added: x and y are used

public:
    // The views point into the object's own arrays.
    Interface(const Interface&) = delete;
    Interface& operator=(const Interface&) = delete;
    Interface(Interface&&) = default; ///< vectors keep their storage when moved
    Interface& operator=(Interface&&) = default;
};

} // namespace asperity
