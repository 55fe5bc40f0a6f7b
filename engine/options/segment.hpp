// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The segments of a path (drive.path): a motion of the block and the condition of its end.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>

namespace asperity {

/// A segment of a path.
struct Segment {
    /// Kind of a segment.
    enum Kind {
        approach, ///< down, through attraction, to drive.load
        pull_off, ///< up, until beyond the interaction range
        relax,    ///< relaxation under drive.load with top plane and mean height free
        load,     ///< up or down to a total normal force, eV/Å
        height,   ///< up or down to a height of the lowest layer, Å: the mean height if it is
                  ///< prescribed, otherwise the height in the undeformed block
        hold,     ///< rest for a time, fs
        slide     ///< sideways by a distance, Å, at the same height or under a load
    };
    static constexpr std::size_t kinds = 7;

    Kind kind = approach;
    double amount = 0.0;       ///< load, height, time or distance, in the unit above
    int axis = 0;              ///< axis of a slide: 0 along x, 1 along y
    std::string text{};        ///< text in drive.path
    bool until_steady = false; ///< the slide ends once its friction is steady
    /// Load of a slide under load, eV/Å; empty: the slide is at constant height.
    std::optional<double> under{};
};

/// Returns the word for a kind in drive.path: "slide" for Segment::slide.
constexpr const char* word(Segment::Kind kind) {
    constexpr std::array<const char*, Segment::kinds> words = {
        "approach", "pull-off", "relax", "load", "height", "hold", "slide"};
    return words[static_cast<std::size_t>(kind)];
}

} // namespace asperity
