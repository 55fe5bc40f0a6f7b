// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The segments of a path (drive.path), one after the other: an action on the block and its end.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>

namespace asperity {

/// A segment of a path.
struct Segment {
    enum Kind {
        approach, ///< down, through attraction, to drive.load
        pull_off, ///< up, until beyond the interaction range
        relax,    ///< straight to the relaxed state under drive.load, nothing held
        load,     ///< up or down to a total normal force, eV/Å
        height,   ///< up or down to a height of the lowest layer, Å: its mean height if that is
                  ///< held; otherwise its height in the undeformed block
        hold,     ///< rest for a time, fs
        slide     ///< sideways by a distance, Å, at the same height or under a load
    };
    static constexpr std::size_t kinds = 7;

    Kind kind = approach;
    double amount = 0.0;       ///< amount in the unit above
    int axis = 0;              ///< axis of a slide: 0 along x, 1 along y
    std::string text{};        ///< text of the scene
    bool until_steady = false; ///< a slide ends as soon as its friction is steady
    /// Load of a slide under load, eV/Å; empty: at the same height.
    std::optional<double> under{};
};

/// Returns the word of a kind: "slide" for Segment::slide.
constexpr const char* word(Segment::Kind kind) {
    constexpr std::array<const char*, Segment::kinds> words = {
        "approach", "pull-off", "relax", "load", "height", "hold", "slide"};
    return words[static_cast<std::size_t>(kind)];
}

} // namespace asperity
