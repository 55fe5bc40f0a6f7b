// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Maps along a path (output.fields). Periodic maps, maps at the ends of segments, of relaxed states
// and at times after the approach are written at once. The map at the largest attraction of the
// last pull-off is kept in memory until the run ends.
#pragma once

#include "engine/path/path.hpp"
#include "engine/statics/state_array.hpp"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace asperity {

class RunSession;

/// Observer that writes maps along a path.
class PathMaps : public Observer {
public:
    /// Keeps a reference to the session.
    explicit PathMaps(RunSession& session);

    Path::Wish wish(const Path& path) const override;
    void finish(const Path& path) override;

    /// Passes the numbers to a visitor, for checkpoints; arrays() has the kept layer.
    template <class Visitor>
    void visit(Visitor& v) {
        v("attraction", attraction_);
        v("place", place_);
        v("kept", kept_);
        v("delayed_written", delayed_written_);
    }
    /// Returns the kept layer to be written to a checkpoint; an empty list if none is kept.
    std::vector<StateArray> arrays() const;
    /// Returns the kept layer to be read from a checkpoint.
    std::vector<RestoredArray> arrays_to_restore();

protected:
    void look_at_step(const Path& path) override;
    void look_at_end(const Path& path) override;
    void look_at_state(const Path& path) override;

private:
    bool is_due(long long step) const;
    bool delayed_is_due(const Path& path, double time) const;
    void write(const Path& path, const std::string& state, const VectorPlane<const double>& layer);
    /// Records the maps of a layer over an interface, and the stresses below it if the scene asks
    /// for them.
    void record(const std::string& state, const Path& path, const VectorPlane<const double>& layer,
                const Interface& interface);

    RunSession& session_;
    const MapTimes& times_;
    std::size_t delayed_written_ = 0; ///< number of times_.after_approach that have been written
    // The lowest layer at the largest attraction of the pull-off.
    double attraction_ = 0.0;       ///< eV/Å
    std::array<double, 2> place_{}; ///< place of the block over the substrate, Å
    bool kept_ = false;             ///< a layer is kept and will be written
    VectorField<double> layer_;     ///< the layer; empty unless the scene asks for these maps
};

} // namespace asperity
