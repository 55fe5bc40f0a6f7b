// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The knobs of `asperity cost`: what each is set to, what it is compared with, and what its error
// should do. All of it follows by rule from the scene, before anything has run.
//
// A knob is turned alone, all others stay as the scene has them; its own error is that against the
// same scene with this one knob at its best ("twin"). The error that counts in the end is that
// against the reference, which is the best in every knob at once.
#pragma once

#include "engine/scene/scene.hpp"

#include <optional>
#include <string>
#include <vector>

namespace asperity {

/// Keys of the scene and what they are set to.
using Setting = std::vector<std::string>; ///< "section.key=value"

struct KnobValue {
    std::string label; ///< as in the table: "20 fs"
    Setting setting;
    double x = 0.0; ///< for the order; 0: none
};

struct Knob {
    std::string name;              ///< behind --knobs
    std::string about;             ///< for people
    std::vector<KnobValue> values; ///< from coarse to fine
    std::optional<KnobValue> twin; ///< what they are compared with; none: with the reference alone
    bool twin_is_exact = false;    ///< nothing of the knob's error is left in its twin
    std::optional<double> order;   ///< of its error in x, expected
    std::string expected;          ///< in words
    std::string
        part; ///< knobs of one part exclude each other in a combination; empty: never in one
    Setting base = {}; ///< of all its runs, where it has no effect on the scene as it is
};

/// Where a combination starts: how the path is followed.
struct CombinationBase {
    std::string label;
    Setting setting;
    std::vector<std::string> parts; ///< those that it has a use for
};

struct CostCase {
    Setting reference;
    std::string reference_text; ///< for people
    std::vector<Knob> knobs;
    std::vector<CombinationBase> bases;
    std::vector<std::string> notes;
};

/// Throws io::SceneError if the scene is none that costs can be measured of.
CostCase cost_case(const Scene& scene);

} // namespace asperity
