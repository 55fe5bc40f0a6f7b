// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Conditions under which keys have an effect: the column `needs` of bind(), from which refusals and
// notes follow.
#pragma once

#include "engine/scene/scene.hpp"

#include <string>
#include <utility>
#include <vector>

namespace asperity {

/// Conditions on a scene that keys may need, each with the text for the case that it is not met.
struct Needs {
    using Need = io::Schema::Need;

    explicit Needs(const Scene& s) : scene(s) {}
    const Scene& scene;

    Need self_affine = acting({[this] { return scene.surface.kind == SurfaceKind::self_affine; },
                               "surface.kind is not \"self-affine\""},
                              "take surface.kind = \"self-affine\"", {"surface.kind"});
    Need map = acting({[this] { return scene.surface.kind == SurfaceKind::file; },
                       "surface.kind is not \"file\""},
                      "take surface.kind = \"file\"", {"surface.kind"});
    Need any_map = acting({[this] { return scene.reads_map(); },
                           "surface.kind is not \"file\", and surface.counter names no map"},
                          "take surface.kind = \"file\"", {"surface.kind", "surface.counter"});
    Need counter =
        acting({[this] { return scene.surface.counter.given(); }, "surface.counter is \"none\""},
               "name the map of the second solid in surface.counter", {"surface.counter"});
    Need elastic_counter = acting({[this] { return scene.surface.counter.young.has_value(); },
                                   "surface.counter_young is \"rigid\""},
                                  "give surface.counter_young", {"surface.counter_young"});
    Need file = acting({[this] { return scene.surface.reads_file(); },
                        "surface.kind is neither \"file\" nor \"atoms\""},
                       "take surface.kind = \"file\" (a map), or \"atoms\"", {"surface.kind"});
    Need rough = acting(
        {[this] { return scene.surface.kind != SurfaceKind::flat; }, "surface.kind is \"flat\""},
        "take surface.kind = \"self-affine\"", {"surface.kind"});
    Need one_layer = acting(
        {[this] { return scene.surface.kind != SurfaceKind::atoms; }, "surface.kind is \"atoms\""},
        "take a surface that is a map", {"surface.kind"});
    Need wall = acting({[this] { return scene.interface.kind == InterfaceKind::wall; },
                        "interface.kind is not \"wall\""},
                       "take interface.kind = \"wall\"", {"interface.kind"});
    Need adhesion = acting({[this] { return scene.interface.has_adhesion(); },
                            "there is no wall with a law of its own"},
                           "take interface.kind = \"wall\" and another interface.law than "
                           "\"smeared\"",
                           {"interface.kind", "interface.law"});
    Need yielding = refusing(
        {[this] { return scene.interface.kind == InterfaceKind::wall; }, ""}, "without a wall",
        "a surface that yields is a wall, whose pressure has a cap; atoms have none",
        "take interface.kind = \"wall\" and drive.mode = \"quasistatic\", or leave it out");
    Need touched = acting(
        {[this] { return scene.interface.has_adhesion() && !scene.interface.shape_repels(); },
         "there is no wall with a law that begins where it is touched"},
        "take interface.kind = \"wall\" and interface.law = \"exponential\", \"dugdale\" or "
        "\"power\"",
        {"interface.kind", "interface.law"});
    Need ranged = acting({[this] {
                              return scene.interface.has_adhesion() &&
                                     scene.interface.law != WallLawKind::table;
                          },
                          "there is no wall with a law of a range"},
                         "take interface.kind = \"wall\" and another interface.law than "
                         "\"smeared\" and \"table\"",
                         {"interface.kind", "interface.law"});
    Need power = acting({[this] {
                             return scene.interface.has_adhesion() &&
                                    scene.interface.law == WallLawKind::power;
                         },
                         "interface.law is not \"power\""},
                        "take interface.kind = \"wall\" and interface.law = \"power\"",
                        {"interface.kind", "interface.law"});
    Need table = acting({[this] {
                             return scene.interface.has_adhesion()
                                        ? scene.interface.law == WallLawKind::table
                                        : scene.interface.potential_name() == Tabulated::name ||
                                              !scene.interface.pairs.empty();
                         },
                         "neither interface.potential nor interface.law is \"table\""},
                        "take interface.potential = \"table\", or over a wall interface.law = "
                        "\"table\"",
                        {"interface.kind", "interface.law", "interface.potential"});
    Need pairs = acting({[this] { return !adhesion.is_met(); }, "the wall has a law of its own"},
                        "take interface.law = \"smeared\", or interface.kind = \"atoms\"",
                        {"interface.kind", "interface.law"});
    // Keys of one kind of path have no effect on another, and are noted: one scene is led along
    // several paths.
    Need dynamic{[this] { return scene.is_dynamic(); }, "no time passes on this path"};
    Need time{[this] {
                  return scene.is_dynamic() ||
                         (!scene.block.prony.empty() && !scene.only_relaxes());
              },
              "no time passes on this path"};
    Need equilibria{[this] { return !scene.is_dynamic(); }, "drive.mode is \"dynamic\""};
    Need held{[this] { return !scene.only_relaxes(); }, "drive.path relaxes with nothing held"};
    Need multiscale = acting({[this] { return scene.block_model() == BlockModel::multiscale; },
                              "block.model is not \"multiscale\""},
                             "take block.model = \"multiscale\"", {"block.model"});
    Need damping = acting({[this] { return scene.drive.damping > 0.0; }, "drive.damping is 0"},
                          "take a drive.damping above 0", {"drive.damping"});
    Need temperature =
        acting({[this] { return scene.drive.temperature > 0.0; }, "drive.temperature is 0"},
               "take a drive.temperature above 0", {"drive.temperature"});
    Need spring = acting(
        {[this] { return scene.drive.stiffness.has_value(); }, "drive.stiffness is \"none\""},
        "take a drive.stiffness", {"drive.stiffness"});
    Need periodic = acting({[this] { return !scene.has_free_edges(); },
                            "surface.boundary is \"free\", and the block is a half-space"},
                           "take surface.boundary = \"periodic\"", {"surface.boundary"});
    Need trajectory = acting(
        {[this] { return scene.output.trajectory.has_value(); }, "output.trajectory is \"none\""},
        "take output.trajectory = 1000, the steps between frames", {"output.trajectory"});

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
    /// Returns a need with what meets it and the keys that decide it: a key without effect is
    /// refused.
    static Need acting(Need need, std::string instead, std::vector<std::string> deciding) {
        need.instead = std::move(instead);
        need.deciding = std::move(deciding);
        return need;
    }
    /// Returns the need of parameters of a potential: the scene uses the potential.
    Need potential(const std::string& name) const {
        return acting({[this, name] {
                           return scene.interface.potential_name() == name ||
                                  !scene.interface.pairs.empty();
                       },
                       "interface.potential is not \"" + name + "\""},
                      "take interface.potential = \"" + name + "\"", {"interface.potential"});
    }
};

} // namespace asperity
