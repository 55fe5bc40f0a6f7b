// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Maps along a path (output.fields). Those of every so many steps or points, of the ends of
// segments, of states and of times after the approach are written at once; those of the largest
// attraction of the last pull-off are kept until the run ends.
#pragma once

#include "engine/equilibrium/state_array.hpp"
#include "engine/path/path.hpp"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace asperity {

class RunSession;

class PathMaps : public Observer {
public:
    explicit PathMaps(RunSession& session);

    Path::Wish wish(const Path& path) const override;
    void look(Path& path) override;
    void look_at_end(Path& path) override;
    void look_at_state(Path& path, const LayerAtRest& state) override;
    void finish(Path& path) override;

    /// For checkpoints: numbers, and the layer that is kept.
    template <class Visitor>
    void visit(Visitor& v) {
        v("attraction", attraction_);
        v("reference_height", reference_height_);
        v("place", place_);
        v("kept", kept_);
        v("delayed_written", delayed_written_);
    }
    std::vector<StateArray> arrays();

private:
    bool is_due(long long step) const;
    bool delayed_is_due(const Path& path, double time) const;
    void write(Path& path, const std::string& state, const VectorPlane<const double>& layer);

    RunSession& session_;
    const MapTimes& times_;
    std::size_t delayed_written_ = 0; ///< of times_.after_approach, the first
    // The lowest layer where the pull-off attracted most.
    double attraction_ = 0.0, reference_height_ = 0.0; ///< eV/Å, Å
    std::array<double, 2> place_{};                    ///< of the block over the substrate, Å
    bool kept_ = false;                                ///< there is something to be written
    VectorField<double> layer_;                        ///< only if the scene asks for these maps
};

} // namespace asperity
