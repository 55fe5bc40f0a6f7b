// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The effects of a scene. resolve() decides once which are on, from the scene alone (and, for
// numerics.device = "auto", from the devices of the machine). Code tests `c.effects.sliding`;
// `asperity plan` prints all effects with the keys that decide, and result.json lists them
// (run.effects). No code of an effect that is off is called (tests/engine/effects_test.cpp).
//
// A new effect is a member here, a row of list() and its rule in effects_of().
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace asperity {

struct Case;
struct Scene;

/// One effect, on or off.
struct Effect {
    bool on = false;
    std::string why; ///< the key that decides, with its value
    operator bool() const { return on; }
};

/// All effects of a scene.
struct Effects {
    Effect dynamic,     ///< time steps with inertia; off: states of force balance only
        lateral,        ///< displacements along x and y
        damping,        ///< damping against a medium that moves with the top plane
        temperature,    ///< thermal noise
        finite_strain,  ///< geometrically exact springs
        coarse_levels,  ///< a block that gets coarser with depth
        skipping,       ///< sites beyond the interaction range are left out of the sweep
        sliding,        ///< slides of the block over the substrate
        tail,           ///< continuum correction beyond the cutoff
        site_maps,      ///< numbers of the interface that differ from site to site
        curvature,      ///< a spherical cap under the roughness
        counter,        ///< a second solid with a surface of its own
        branches,       ///< memory of a viscoelastic block
        free_edges,     ///< a box without periodic images
        layers,         ///< coatings of a solid
        surface_stress, ///< tension of a solid's surface
        yielding,       ///< a surface that yields at its hardness
        spring,         ///< a spring that holds the top plane
        relaxation,     ///< states of equilibrium
        observation,    ///< energies, contacts and the energy balance: a row of the series
        maps,           ///< maps of the states that the scene asks for
        trajectory,     ///< frames of the lowest layer
        checkpoints,    ///< states from which a run can be resumed
        theory,         ///< Persson's theory for the same scene
        device;         ///< time steps on a device in place of the processor

    /// Returns true if the solids have no layers and no surface stress, as the theories assume.
    bool one_modulus() const { return !layers && !surface_stress; }
    /// Returns true if the contact ends within the box: of a sphere, or with free edges.
    bool bounded_contact() const { return curvature || free_edges; }
    /// Returns all effects with their names in `asperity plan` and result.json.
    std::vector<std::pair<const char*, Effect>> list() const;
    /// Returns true if the effect of this name in list() is on; "" is always on. Throws
    /// std::logic_error if there is none.
    bool has(std::string_view name) const;
};
/// Returns Effects::dynamic. The options of the block need this effect before the others are known.
Effect dynamic_effect(const Case& c);
/// Reason why no theory applies to a scene, with the key that decides and the remedy.
struct NoTheory {
    std::string key{}, why{};
    std::string limit{}; ///< contacts that the theories describe: "of endless surfaces"
    std::string fix{};
};
/// Returns the reason why no theory applies to a scene with these effects; empty members if a
/// theory applies.
NoTheory no_theory(const Scene& scene, const Effects& effects);
/// Returns the effects of a case. Uses its scene, path, effects.dynamic and maps.
Effects effects_of(const Case& c);

} // namespace asperity
