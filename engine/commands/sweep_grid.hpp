// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The points of a sweep: every combination of the values of its axes.
//
// key=v1,v2,... or key=start:stop:step (stop included) is an axis; it stands behind --set, or in
// the scene's [sweep], where a --set of the same key replaces it. A single value is no axis: it
// overrides the key at every point. The axes surface.seed and drive.seed are repetitions: their
// points are averaged over.
#pragma once

#include "io/scene_reader.hpp"

#include <string>
#include <vector>

namespace asperity {

/// One swept key and its values as they would stand behind --set.
struct SweepAxis {
    std::string key;
    std::vector<std::string> values;
    std::string where; ///< of the list of values, for messages

    bool is_seed() const;
};

/// The axes among the assignments "key=..." and the scene's [sweep]; those of a single value are
/// left in `fixed`. Throws io::SceneError.
std::vector<SweepAxis> sweep_axes(const std::vector<std::string>& assignments,
                                  std::vector<std::string>& fixed,
                                  const std::vector<io::Variation>& of_scene = {});

/// Every combination, the last axis fastest, each as a list of "key=value".
std::vector<std::vector<std::string>> sweep_grid(const std::vector<SweepAxis>& axes);

} // namespace asperity
