// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Options of the block, and its levels.
#pragma once

#include "kernels/continuum_stiffness.hpp"
#include "kernels/elastic_level.hpp"
#include "kernels/surface_stiffness.hpp"

#include <optional>
#include <vector>

namespace asperity {

/// A Maxwell branch: a spring in series with a dashpot, parallel to the block's springs.
struct Branch {
    double ratio = 0.0; ///< modulus divided by that of the block
    double time = 0.0;  ///< relaxation time, in which the stress decays to 1/e, fs
};

/// Elastic constants of an isotropic solid.
struct Material {
    double young = 0.0; ///< Young's modulus, eV/Å^3
    double poisson = 0.42;

    /// Returns the shear modulus mu, eV/Å^3.
    double shear_modulus() const { return young / (2.0 * (1.0 + poisson)); }
    /// Returns Lamé's first parameter lambda, eV/Å^3.
    double lame() const { return young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson)); }
    /// Returns the modulus of uniaxial strain, lambda + 2 mu, eV/Å^3.
    double modulus_of_compression() const { return lame() + 2.0 * shear_modulus(); }
    /// Returns E/(1 - nu^2), eV/Å^3.
    double contact_modulus() const { return young / (1.0 - poisson * poisson); }
    /// Returns the constants of a lattice cell. edge: edge of the cell, Å.
    CellElasticity cell(double edge) const {
        return {shear_modulus() * edge, (lame() - shear_modulus()) * edge / 16.0};
    }
};

/// Layer of another material below the block's own.
struct MaterialLayer {
    Material material;
    double thickness = 0.0; ///< Å
};

/// An elastic solid below its surface.
struct Solid : Material {
    /// Layers of a solid at rest, from its surface inwards; the solid's own material is below the
    /// last layer.
    std::vector<MaterialLayer> layers{};
    double surface_stress = 0.0; ///< tension of the surface of a solid at rest, eV/Å^2

    /// Returns all materials, that of the surface first.
    std::vector<Material> materials() const;
    /// Returns the material of the surface.
    const Material& surface_material() const {
        return layers.empty() ? *this : layers.front().material;
    }
    /// Returns the largest E/(1 - nu^2) of all materials, eV/Å^3.
    double stiffest_modulus() const;
    /// Returns true if the solid has layers or a surface stress.
    bool is_coated() const { return !layers.empty() || surface_stress > 0.0; }
};

/// The spring between the machine and the top plane of a block, and the plane's mass.
struct TopSpring {
    double stiffness = 0.0; ///< eV/Å^2; 0: the machine moves the plane itself
    double mass = 0.0;      ///< eV fs^2/Å^2, in time steps; 0: the mass of the block's nodes
    explicit operator bool() const { return stiffness > 0.0; }
};

/// Shape, elasticity and resolution of a block, and the elasticity of a second solid against which
/// the block is pressed (scene: surface.counter). Without friction the two solids are one in which
/// the compliances of each wave add up, 1/S = 1/S_1 + 1/S_2.
struct BlockOptions : Solid {
    int sites = 512;        ///< atoms across the box, N
    double spacing = 2.6;   ///< a, Å
    double atom_mass = 0.0; ///< eV fs^2/Å^2
    int thickness = 512;    ///< number of cells of edge a
    int layers_per_level = 4;
    bool multiscale = true;
    bool continuum = false; ///< waves of a block at rest are those of a continuum, not of cells
    bool finite_strain = false;
    std::vector<Branch> branches{}; ///< branches of a viscoelastic block, without inertia
    /// Second solid, as thick as the block, its lower end held; empty: it is rigid.
    std::optional<Solid> counter{};
    TopSpring top_spring{};  ///< spring that holds the top plane
    bool free_edges = false; ///< no periodic images; a half-space (engine/waves/free_edges.hpp)

    /// Returns the edge of the box, Å.
    double edge() const { return sites * spacing; }
    /// Returns the number of sites along an edge of the grid of waves: N, with free edges the least
    /// even number from 2N on without a prime factor above 7, which transforms fast.
    int grid() const;
    /// Returns all materials of the solids, that of the block's surface first.
    std::vector<Material> materials() const;
    /// Returns the smallest modulus of uniaxial strain of all materials, lambda + 2 mu, eV/Å^3.
    double softest_column() const;
    /// Returns E* of the solids without their layers, eV/Å^3: 1/E* is the sum of their 1/E*.
    double contact_modulus() const;
    /// Returns E* of the stiffest materials of the solids, eV/Å^3.
    double stiffest_modulus() const;
    /// Returns true if a solid has layers or a surface stress.
    bool is_coated() const { return Solid::is_coated() || (counter && counter->is_coated()); }
    /// Returns the block without the layers and the surface stresses of its solids.
    BlockOptions uncoated() const;
    /// Returns the second solid as a block of its own. Requires `counter`.
    BlockOptions counter_block() const;
    /// Returns the layers of cells of the block at rest, from its surface upwards: `layers`, each
    /// of whole cells, then the block's own material. Neighbouring layers of the same material are
    /// merged.
    std::vector<CellLayer> column() const;
    /// Returns the layers of the block at rest as a continuum, from its surface upwards.
    std::vector<SolidLayer> solid() const;
    /// Returns the stiffness of a wave at the lowest layer of the block at rest, eV/Å^2 per site:
    /// that of the continuum or of the lattice, without the second solid, plus, for the normal
    /// component, the surface stress times (q a)^2, in the lattice (2 sin(p_x/2))^2 + (2
    /// sin(p_y/2))^2.
    SurfaceMatrix stiffness(WavePhase x, WavePhase y) const;
    /// Returns the displacement of a wave by normal forces without friction, Å^2/eV: (S^-1)_zz,
    /// summed over the solids.
    double normal_compliance(WavePhase x, WavePhase y) const;
    /// Returns the stiffness of the longest wave of the box at the lowest layer of a thick block,
    /// eV/Å^4: E* q_L / 2, or the lattice's for a block with layers. Thin blocks are stiffer.
    double softest_wave() const;
    /// Returns an estimate of the stiffness of the shortest wave at the lowest layer, eV/Å^2 per
    /// site: E* q / 2 of the stiffest material and the surface stress, with unrelaxed branches.
    double shortest_wave() const;
    /// Returns the speed of longitudinal waves, Å/fs.
    double sound_speed() const;
    /// Returns the constants of the cells of a level.
    CellElasticity elasticity(int level) const;
    /// Returns an upper bound of the angular frequencies of the lattice, 1/fs. site_stiffness:
    /// stiffness of the interface per site, eV/Å^2.
    double highest_frequency(double site_stiffness) const;
};

/// Size of a level of the block.
struct LevelShape {
    int level = 0; ///< index: the edge of a cell is 2^level a
    int sites = 0; ///< number of nodes across the box
    int cells = 0; ///< number of layers of cells
};
/// Returns levels that fill the thickness exactly, each at least layers_per_level cells thick; the
/// cells double from level to level as long as box and remaining thickness allow.
std::vector<LevelShape> level_shapes(const BlockOptions& options);
/// Returns the number of nodes of all levels.
double nodes_of(const std::vector<LevelShape>& levels);

} // namespace asperity
