// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The segments of drive.path, parsed.
#pragma once

#include "engine/options/segment.hpp"
#include "io/scene_reader.hpp"

#include <string>
#include <vector>

namespace asperity {

/// Returns one segment for each valid member of drive.path and adds the wrong members to problems.
/// area: area of the interface, Å^2, for loads in MPa.
std::vector<Segment> parse_path(const std::vector<std::string>& path, double area,
                                io::Problems& problems);

} // namespace asperity
