// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The effects that a scene switches on or off, decided once, by resolve(), from the scene alone
// (and, for numerics.device = "auto", from what devices there are).
//
// The options of a case and the runs are built from these switches, `asperity plan` prints them
// with their costs, and result.json lists them (run.effects). An effect that is off allocates no
// memory and none of its code is called (tests/engine/effects_test.cpp, perf/minimal_loop.cpp).
//
// A new effect is an entry here and a row of `rules` in effects.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

namespace asperity {

enum class Effect {
    inertia,       ///< velocities, steps in time
    lateral,       ///< displacements along x and y
    damping,       ///< against a medium that moves with the top plane
    temperature,   ///< thermal noise
    finite_strain, ///< geometrically exact springs
    coarse_levels, ///< a block that gets coarser with depth
    skipping,      ///< sites out of reach are left out of the sweep
    sliding,       ///< of the block over the substrate
    tail,          ///< continuum correction beyond the cutoff
    curvature,     ///< a spherical cap under the roughness
    relaxation,    ///< states of equilibrium
    observation,   ///< energies, contacts and the energy balance: a row of the series
    maps,          ///< of the states that the scene asks for
    trajectory,    ///< frames of the lowest layer
    checkpoints,   ///< states from which a run can be resumed
    theory,        ///< Persson's theory for the same scene
    device,        ///< steps in time on a device in place of the processor
    count
};
inline constexpr std::size_t effect_count = static_cast<std::size_t>(Effect::count);

struct Case;

/// As `asperity plan` and result.json call it.
std::string_view name(Effect effect);

struct Effects {
    struct Switch {
        bool on = false;
        std::string why; ///< the key that decides, with its value
    };
    std::array<Switch, effect_count> switches;

    bool on(Effect effect) const { return of(effect).on; }
    const std::string& why(Effect effect) const { return of(effect).why; }
    const Switch& of(Effect effect) const { return switches[static_cast<std::size_t>(effect)]; }
};
/// Of a case whose scene, path and maps are known.
Effects effects_of(const Case& c);

} // namespace asperity
