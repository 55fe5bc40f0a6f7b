// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/path/path.hpp"

#include "engine/path/static_path.hpp"
#include "engine/path/time_path.hpp"

#include <algorithm>

namespace asperity {

std::unique_ptr<Path> path_of(const Case& c, const Surface& surface, const Communicator& ranks) {
    if (c.effects.dynamic) return std::make_unique<TimePath>(c, surface, ranks);
    return std::make_unique<StaticPath>(c, surface, ranks);
}

void copy_layer(const VectorPlane<const double>& from, const VectorPlane<double>& to) {
    for (const auto& [source, copy] :
         {std::pair{&from.x, &to.x}, {&from.y, &to.y}, {&from.z, &to.z}})
        for (int y = 0; y < copy->ny; ++y)
            std::copy_n(source->line(y), copy->nx, copy->line(y));
}

} // namespace asperity
