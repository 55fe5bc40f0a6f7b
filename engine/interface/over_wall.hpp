// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A wall in place of atoms (kernels/wall_law.hpp). The wall acts along z alone. The height below
// site (x, y) is value (x, y) of the surface, which has the block's lattice.
//
// A surface that yields (scene: interface.hardness) bears a net pressure of no more than its
// hardness H. The wall below a site has a permanent set s, by which it is lower:
//
//     gap = height of the site - (height of the wall - s),      pressure = that of the law at the
//                                                               gap, and no more than H.
//
// The law's pressure is H at the yield gap g_H. If a step ends at a smaller gap, the set grows by
// the difference (plastic_set.hpp): then the gap is g_H, and H times the growth is the plastic
// work. The set is the same whichever of the two solids yields, because only the gap enters.
#pragma once

#include "decomposition/field.hpp"
#include "engine/interface/height_map.hpp"
#include "engine/interface/sliding_map.hpp"
#include "engine/options/interface_options.hpp"

#include <cmath>
#include <cstddef>
#include <optional>
#include <type_traits>
#include <utility>
#include <variant>

namespace asperity {

/// A wall in place of atoms.
class OverWall {
public:
    /// Makes the wall below the first across x across sites of the grid of a tile; the other sites
    /// have no solid below them. With options.slides slide_to() moves the map, which then is below
    /// all sites.
    OverWall(const HeightMap& map, int across, const Tile& tile, const InterfaceOptions& options);

    /// Moves the block to (x, y) over the wall, Å. Requires options.slides.
    void slide_to(double x, double y) { sliding_->slide_to(x, y); }
    /// Returns the derivative of height() with respect to the place along axis 0 (x) or 1 (y).
    /// Requires options.slides.
    PlaneView<const double> slope(std::size_t axis) const { return sliding_->slope(axis); }

    /// Computes the forces on row y of the sites and adds to the sums. how: options of the sweep.
    void sweep_row(const InterfaceSites& sites, int y, SweepOptions how, InterfaceSums& sums) const;

    /// Returns true if the surface yields.
    bool yields() const { return !yield_gap_.empty(); }
    /// Keeps a reference to the permanent set of the sites, Å, by which a wall that yields is
    /// lower.
    void lower_by(Field<double>& set) { set_ = &set; }
    /// Returns the permanent set of the sites, Å, for writing. Requires yields().
    Field<double>& set() { return *set_; }
    /// Returns the permanent set of the sites, Å. Requires yields().
    PlaneView<const double> set() const { return std::as_const(*set_).plane(0); }
    /// Returns the depth of a site below its yield gap, Å: the growth of its set if a step ends
    /// there; 0 over a hole. z: height of the site, Å. Requires yields().
    double growth(int x, int y, double z) const {
        return std::fmax(0.0, yield_gap_.plane(0)(x, y) - (z - below(x, y)));
    }
    /// Returns the force of the hardness on a site, eV/Å. Requires yields().
    double yield_force(int x, int y) const;
    /// Returns the force of the wall on a site at this height, eV/Å. Requires yields().
    double force(int x, int y, double z) const;

    /// Moves the sites of row y to their equilibria, each under its own external force. row: data
    /// of the row except those of the wall, which are filled in; sites: number of sites.
    template <class T>
    WallSums rest_row(int y, WallRow<T> row, const WallRule& rule, int sites) const {
        row.below = height().line(y);
        for (std::size_t k = 0; !factors_.empty() && k < row.factors.count; ++k)
            row.factors.of[k] = factors_.plane(static_cast<int>(k)).line(y);
        row.yield_gap = yields() ? yield_gap_.plane(0).line(y) : nullptr;
        row.set = yields() ? set().line(y) : nullptr;
        const WallKernels& kernels = interface_kernels().wall;
        if constexpr (std::is_same_v<T, double>)
            return kernels.rest_double(law_, row, rule, sites);
        else
            return kernels.rest_single(law_, row, rule, sites);
    }
    /// Returns true if a site of the tile yields at this gap, Å.
    bool yields_at(int x, int y, double gap) const {
        return yields() && gap < yield_gap_.plane(0)(x, y);
    }
    /// Returns the stiffness -dF/dg of the law of a site of the tile at this gap, Å, in eV/Å^2.
    double stiffness_at(int x, int y, double gap) const;
    /// Returns the step that a site of the tile at this gap makes, Å, where that of Newton's method
    /// is `step`: another one if it begins or ends to yield (wall_newton.hpp). spring: stiffness of
    /// the block's stiffest wave, eV/Å^2. Requires yields().
    double step(int x, int y, double gap, double step, double spring) const;
    /// Returns true if the wall attracts sites.
    bool attracts() const;

    /// Returns the height of the wall below a site, Å, with its set; NaN over a hole.
    double below(int x, int y) const { return height()(x, y) - (yields() ? set()(x, y) : 0.0); }
    /// Returns the height of the wall below each site of the tile before the wall yields, Å; NaN if
    /// there is no solid below the site.
    PlaneView<const double> height() const {
        return sliding_ ? sliding_->height() : height_.plane(0);
    }
    /// Returns the part of bytes() that every rank holds whole: the map of a wall that slides.
    std::size_t bytes_of_map() const { return sliding_ ? sliding_->bytes_of_map() : 0; }
    std::size_t bytes() const {
        return (sliding_ ? sliding_->bytes() : height_.bytes()) +
               (factors_.empty() ? 0 : factors_.bytes()) + (yields() ? yield_gap_.bytes() : 0);
    }

private:
    /// Returns use(law) with the law of a site.
    template <class Use>
    auto with_law(int x, int y, Use use) const {
        return std::visit(
            [&]<class Law>(const Law& law) {
                if constexpr (ScaledBySite<Law>)
                    if (!factors_.empty()) return use(law.scaled(factors_at(x, y)));
                return use(law);
            },
            law_);
    }
    /// Returns the factors of the law of a site. Requires planes of factors.
    LawFactors<double> factors_at(int x, int y) const {
        LawFactors<double> factors{};
        for (std::size_t k = 0; k < factors.count; ++k)
            factors.of[k] = factors_.plane(static_cast<int>(k))(x, y);
        return factors;
    }
    void find_law_factors(const InterfaceOptions& options, const Tile& tile);
    void find_yield_gaps(const InterfaceOptions& options, const Tile& tile, int across,
                         double area);

    Field<double> height_; ///< empty with options.slides
    std::optional<SlidingMap> sliding_;
    Field<double> factors_;   ///< plane k: factor k of the law of each site; empty: one for all
    Field<double> yield_gap_; ///< WallMaps::yield_gap; empty: no site yields
    Field<double>* set_ = nullptr; ///< permanent set, Å, kept by the interface
    WallLaw law_;
};

} // namespace asperity
