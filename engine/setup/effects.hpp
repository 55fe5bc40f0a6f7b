// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The effects that a scene calls for: decided here, once, from the scene.
//
// make_setup() and the run build from these decisions, `asperity plan` prints them with their
// costs, and the counters of a finished run are held against them (run.effects in result.json). An
// effect that is off allocates nothing and is called zero times.
#pragma once

#include "engine/scene/scene.hpp"
#include "io/json_value.hpp"

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace asperity {

enum class Effect {
    inertia,       ///< velocities, steps in time
    lateral,       ///< displacements along x and y
    damping,       ///< against a medium that moves with the top plane
    temperature,   ///< noise
    finite_strain, ///< geometrically exact springs
    coarse_levels, ///< a block that gets coarser with depth
    skipping,      ///< sites out of reach are left out of the sweep
    tail,          ///< continuum correction beyond the cutoff
    curvature,     ///< a spherical cap under the roughness
    relaxation,    ///< states of equilibrium
    observation,   ///< energies, contacts and the energy balance; a row of the series
    maps,          ///< of states that the scene asks for
    trajectory,    ///< frames of the block
    checkpoints,   ///< states to go on from
    theory,        ///< Persson's, beside the result
    count
};
inline constexpr std::size_t effect_count = static_cast<std::size_t>(Effect::count);

std::string_view name(Effect effect);
/// How often an effect that is on takes place.
enum class Occurs {
    always,   ///< at every step, or once in the making of the scene
    path_end, ///< where the path is followed from its beginning to its end
    when_due  ///< perhaps never: after so much wall time, or where there is something to leave out
};
Occurs occurs(Effect effect);

/// What was done of an effect, on the first rank.
struct Done {
    long long calls = 0;   ///< in the unit of the effect: see unit_of
    std::size_t bytes = 0; ///< held for it
};
/// What its calls count: "node-steps", "rows", ...
std::string_view unit_of(Effect effect);

class Effects {
public:
    Effects() = default; ///< all off
    /// Decides. Knows nothing but the scene.
    explicit Effects(const Scene& scene);

    bool on(Effect effect) const { return decision(effect).on; }
    /// The key that asks for it, or what would.
    const std::string& why(Effect effect) const { return decision(effect).why; }

private:
    struct Decision {
        bool on = false;
        std::string why;
    };
    const Decision& decision(Effect effect) const {
        return decisions_[static_cast<std::size_t>(effect)];
    }
    void decide(Effect effect, bool on, std::string why);

    std::array<Decision, effect_count> decisions_;
};

/// Planned beside done, effect by effect.
class EffectBooks {
public:
    Done& operator[](Effect effect) { return done_[static_cast<std::size_t>(effect)]; }
    const Done& operator[](Effect effect) const { return done_[static_cast<std::size_t>(effect)]; }

    /// One sentence for each effect that took place unasked, or was asked for and did not.
    /// complete: the path was followed from its beginning to its end.
    std::vector<std::string> differences(const Effects& planned, bool complete) const;
    /// { name: { planned, calls, unit, bytes } }
    io::JsonValue json(const Effects& planned) const;

private:
    std::array<Done, effect_count> done_{};
};

} // namespace asperity
