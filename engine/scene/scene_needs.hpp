// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Conditions under which keys have an effect: the column `needs` of bind(), from which refusals and
// notes follow.
#pragma once

#include "engine/scene/scene.hpp"

#include <string>
#include <utility>

namespace asperity {

/// Conditions on a scene that keys may need, each with the text for the case that it is not met.
struct Needs {
    using Need = io::Schema::Need;

    explicit Needs(const Scene& s) : scene(s) {}
    const Scene& scene;

    Need self_affine{[this] { return scene.surface.kind == SurfaceKind::self_affine; },
                     "surface.kind is not \"self-affine\""};
    Need map{[this] { return scene.surface.kind == SurfaceKind::file; },
             "surface.kind is not \"file\""};
    Need file{[this] { return scene.surface.reads_file(); },
              "surface.kind is neither \"file\" nor \"atoms\""};
    Need rough{[this] { return scene.surface.kind != SurfaceKind::flat; },
               "surface.kind is \"flat\""};
    Need one_layer{[this] { return scene.surface.kind != SurfaceKind::atoms; },
                   "surface.kind is \"atoms\""};
    Need wall{[this] { return scene.interface.kind == InterfaceKind::wall; },
              "interface.kind is not \"wall\""};
    Need adhesion{[this] { return scene.interface.has_adhesion(); },
                  "there is no wall with a law of its own"};
    Need touched{
        [this] { return scene.interface.has_adhesion() && !scene.interface.shape_repels(); },
        "there is no wall with a law that begins where it is touched"};
    Need ranged{[this] {
                    return scene.interface.has_adhesion() &&
                           scene.interface.law != WallLawKind::table;
                },
                "there is no wall with a law of a range"};
    Need power{[this] {
                   return scene.interface.has_adhesion() &&
                          scene.interface.law == WallLawKind::power;
               },
               "interface.law is not \"power\""};
    Need table{[this] {
                   return scene.interface.has_adhesion()
                              ? scene.interface.law == WallLawKind::table
                              : scene.interface.potential_name() == Tabulated::name ||
                                    !scene.interface.pairs.empty();
               },
               "neither interface.potential nor interface.law is \"table\""};
    Need pairs{[this] { return !adhesion.is_met(); }, "the wall has a law of its own"};
    Need dynamic{[this] { return scene.is_dynamic(); }, "no time passes on this path"};
    Need time{[this] {
                  return scene.is_dynamic() ||
                         (!scene.block.prony.empty() && !scene.only_relaxes());
              },
              "no time passes on this path"};
    Need equilibria{[this] { return !scene.is_dynamic(); }, "drive.mode is \"dynamic\""};
    Need multiscale{[this] { return scene.block_model() == BlockModel::multiscale; },
                    "block.model is not \"multiscale\""};
    Need damping{[this] { return scene.drive.damping > 0.0; }, "drive.damping is 0"};
    Need temperature{[this] { return scene.drive.temperature > 0.0; }, "drive.temperature is 0"};
    Need trajectory{[this] { return scene.output.trajectory.has_value(); },
                    "output.trajectory is \"none\""};

    /// Returns the need of a substrate of one layer, for a key that is refused with surface.kind =
    /// "atoms".
    Need heights(std::string why, std::string fix) const {
        return refusing(one_layer, "with surface.kind = \"atoms\"", std::move(why), std::move(fix));
    }
    /// Returns a need with the message of a refusal: problem, reason and remedy.
    static Need refusing(Need need, std::string refused, std::string why, std::string fix) {
        need.refused = std::move(refused);
        need.why = std::move(why);
        need.fix = std::move(fix);
        return need;
    }
    /// Returns the need of parameters of a potential: the scene uses the potential.
    Need potential(const std::string& name) const {
        return {[this, name] {
                    return scene.interface.potential_name() == name ||
                           !scene.interface.pairs.empty();
                },
                "interface.potential is not \"" + name + "\""};
    }
};

} // namespace asperity
