// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The stresses inside the block by the tractions on its surface (docs/explanation/model.md): the
// block is the continuum of BlockOptions::solid(), and each wave of the tractions gives the stress
// of kernels/subsurface_stress.hpp. z leads from the surface into the block; tension is positive.
//
// The uniform wave of a periodic box has no strain along the surface. With free edges the tractions
// are on a grid of twice the edge, as in free_edges.hpp, whose images are not cut off, and the
// uniform wave is the mean over directions of the limit of long waves: in a box of 8 and 16 contact
// radii the stress below a sphere is wrong by 0.008 and 0.002 of the largest pressure.
//
// A surface stress bears part of the pressure: gamma q^2 of the stiffness S + gamma q^2. Branches
// of a viscoelastic block, the same for all of its layers, change no stress at given tractions.
#pragma once

#include "decomposition/surface_transform.hpp"
#include "engine/options/block_options.hpp"
#include "kernels/subsurface_stress.hpp"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace asperity {

/// Tractions on the sites of the box, [y * n + x], all in one unit. A repulsive pressure is
/// positive; shear is the traction of the substrate on the block.
struct SurfaceTractions {
    std::vector<double> pressure;
    std::vector<double> shear_x, shear_y; ///< empty: none
};

/// Returns the tractions of Coulomb friction while the block slides along +x: minus the friction
/// coefficient times the pressure along x, where the pressure is repulsive.
SurfaceTractions with_friction(std::vector<double> pressure, double coefficient);

/// Returns the tractions of a wall without friction of its own over which the block has slid: minus
/// the pressure times the slope of the wall, whose sum is the friction of the slide. pressure and
/// height (Å): [y * n + x] of a periodic box.
SurfaceTractions with_slopes(const BlockOptions& block, std::vector<double> pressure,
                             const std::vector<double>& height);

/// The tractions within a site: the sum of the waves of the sites, or constant.
enum class WithinSite { waves, constant };

/// The stresses below a surface, on one rank.
class Subsurface {
public:
    /// Computes the waves of the tractions. refinement: number of points along the edge of a site;
    /// padding: with free edges, the edge of the grid over that of the box.
    Subsurface(const BlockOptions& block, const SurfaceTractions& tractions, int refinement = 1,
               WithinSite within = WithinSite::waves, int padding = 2);

    /// Returns the number of points along the edge of the box.
    int points() const { return points_; }
    /// Returns the place of point i along x or y, Å.
    double place(int i) const { return (i + 0.5) * step_; }
    /// Returns the stresses at a depth, [y * points() + x], in the unit of the tractions. depth: Å,
    /// less than the thickness of the block. At the boundary of two layers the stresses are those
    /// of the layer nearer to the surface.
    std::vector<Stress> at(double depth) const;
    const std::vector<SolidLayer>& layers() const { return layers_; }

private:
    std::vector<SolidLayer> layers_;
    bool free_edges_;
    int points_;
    double step_; ///< distance of the points, Å
    Slab slab_;
    SurfaceTransform<double> transform_;
    Waves<double> tractions_; ///< waves of the tractions along x and y and of the pressure
};

/// Names of the measures of a stress, of which the largest values are sought.
inline constexpr std::array<const char*, 3> stress_measures = {"von_mises", "tresca", "tension"};
/// Returns the measures: the stress of von Mises, that of Tresca (the difference of the outer
/// principal stresses) and the largest principal stress.
std::array<double, 3> measures(const Stress& s);

/// The largest value of a measure in a layer.
struct LargestStress {
    double value = 0.0;          ///< value in the unit of the tractions
    double x = 0.0, y = 0.0;     ///< place, Å
    double depth = 0.0;          ///< Å
    double between_depths = 0.0; ///< change with depths between those of the search
    double between_points = 0.0; ///< change from the sites to twice the points
    double within_site = 0.0;    ///< change of a measure there with tractions constant on each site
    double images = 0.0;         ///< change by images of the contact; 0 in a periodic box
    std::string reason;          ///< reason why the value is not to be quoted; empty: none

    double error() const { return between_depths + between_points + within_site + images; }
};

/// The largest stresses in a layer of the block.
struct LayerStresses {
    double from = 0.0, to = 0.0;            ///< depths of the layer, Å
    std::array<LargestStress, 3> largest{}; ///< largest of each measure
};

/// The search for the largest stresses.
struct StressSearch {
    std::vector<LayerStresses> layers; ///< layers, that of the surface first
    /// Depths of the search in ascending order, Å, and the largest measures at each.
    std::vector<double> depth;
    std::vector<std::array<double, 3>> largest;
};

/// Replaces a pressure on the sites of the grid in this rank's slab, eV/Å^3, by the displacement of
/// the surface of a block into the block, Å; the far end is held. Collective.
void displace_surface(const BlockOptions& block, const Slab& slab, SiteField<double>& field);

/// Searches the largest stresses between half a spacing and half the edge of the box below the
/// surface, or up to 0.999 of the block's thickness.
StressSearch search_stresses(const BlockOptions& block, const SurfaceTractions& tractions);

} // namespace asperity
