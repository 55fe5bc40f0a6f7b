// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/run/path_maps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace asperity {

void copy_layer(const VectorPlane<const double>& from, const VectorPlane<double>& to) {
    for (int y = 0; y < to.x.ny; ++y) {
        std::copy_n(from.x.line(y), to.x.nx, to.x.line(y));
        std::copy_n(from.y.line(y), to.y.nx, to.y.line(y));
        std::copy_n(from.z.line(y), to.z.nx, to.z.line(y));
    }
}

PathMaps::PathMaps(const MapTimes& times, const ProcessGrid& grid) : times_(times), grid_(grid) {
    if (times.pull_off) layer_ = VectorField<double>(grid.tile(0), 1);
}

void PathMaps::watch(long long step, Segment::Kind kind, double attraction,
                     const VectorPlane<const double>& layer, const Interface& interface,
                     double reference_height, Recorder& recorder) {
    if (due(step))
        recorder.fields(fmt::format("step-{}", step), layer, grid_, interface, reference_height);
    if (kind != Segment::pull_off) attraction_ = 0.0; // the next pull-off begins anew
    if (kind != Segment::pull_off || attraction <= attraction_ || !times_.pull_off) return;
    attraction_ = attraction;
    place_ = interface.place();
    reference_height_ = reference_height;
    kept_ = true;
    copy_layer(layer, layer_.plane(0));
}

void PathMaps::write_kept(Interface& interface, Recorder& recorder) {
    if (!std::exchange(kept_, false)) return;
    interface.slide_to(place_[0], place_[1]);
    recorder.fields("pull-off", std::as_const(layer_).plane(0), grid_, interface,
                    reference_height_);
}

std::vector<StateArray> PathMaps::arrays() {
    if (layer_.empty()) return {};
    return {{"/pull-off/x", 0, &layer_.x, 1},
            {"/pull-off/y", 0, &layer_.y, 1},
            {"/pull-off/z", 0, &layer_.z, 1}};
}

} // namespace asperity
