// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The segments of a path (drive.path), one after the other: what is done to the block until what.
#pragma once

#include "io/scene_reader.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace asperity {

struct Segment {
    enum Kind {
        approach, ///< down, through attraction, to drive.load
        pull_off, ///< up, until beyond the interaction range
        relax,    ///< straight to the relaxed state under drive.load, nothing held
        load,     ///< up or down to a pressure, MPa
        height,   ///< up or down to a height of the lowest layer, Å: its mean height where that is
                  ///< held; else where the lowest layer of the undeformed block would be
        hold,     ///< at rest, for so many ps
        slide     ///< sideways, by so many Å, at the same height
    };
    static constexpr std::size_t kinds = 7;

    Kind kind = approach;
    double amount = 0.0; ///< in the unit above
    int axis = 0;        ///< of a slide: 0 along x, 1 along y
    std::string text{};  ///< as the scene has it
};

/// "slide" of a Segment::slide.
const char* word(Segment::Kind kind);

/// One for each member of drive.path; what is no segment is added to the problems and left out.
std::vector<Segment> parse_path(const std::vector<std::string>& path, io::Problems& problems);

} // namespace asperity
