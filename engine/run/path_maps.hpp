// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Maps along a path (output.fields): those of every so many steps or points are written at once;
// those of the largest attraction of the last pull-off are kept until the end of the work.
#pragma once

#include "engine/equilibrium/state_array.hpp"
#include "engine/run/recorder.hpp"
#include "engine/setup/case.hpp"

#include <array>
#include <vector>

namespace asperity {

/// The owned sites.
void copy_layer(const VectorPlane<const double>& from, const VectorPlane<double>& to);

class PathMaps {
public:
    PathMaps(const MapTimes& times, const ProcessGrid& grid);

    /// Whether watch() has anything to do at all, and at this step without an attraction.
    bool any() const { return times_.every || times_.pull_off; }
    bool due(long long step) const { return times_.every && step % *times_.every == 0; }
    /// layer: of the step or point, as the interface's place is. Collective.
    void watch(long long step, Segment::Kind kind, double attraction,
               const VectorPlane<const double>& layer, const Interface& interface,
               double reference_height, Recorder& recorder);
    /// At the end of the work. Collective.
    void write_kept(Interface& interface, Recorder& recorder);

    /// For checkpoints: numbers, and the layer that is kept.
    template <class Visitor>
    void visit(Visitor& v) {
        v("attraction", attraction_);
        v("reference_height", reference_height_);
        v("place", place_);
        v("kept", kept_);
    }
    std::vector<StateArray> arrays();

private:
    const MapTimes& times_;
    const ProcessGrid& grid_;
    // The lowest layer where the pull-off attracted most.
    double attraction_ = 0.0, reference_height_ = 0.0; ///< eV/Å, Å
    std::array<double, 2> place_{};                    ///< of the block over the substrate, Å
    bool kept_ = false;                                ///< there is something to be written
    VectorField<double> layer_;                        ///< only if the scene asks for these maps
};

} // namespace asperity
