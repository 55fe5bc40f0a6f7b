// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Works and losses of a path, dynamic or quasi-static: those of each segment, and of approach and
// pull-off from and to rest beyond the interaction range.
//
//     -(work on the solids, approach) + lost + kinetic = binding energy
//       = work on the solids, pull-off - lost - kinetic there + kinetic after the approach
//
// where kinetic is what still moves at the end: kinetic energy, and that of vibrations about the
// state.
#pragma once

#include "engine/equilibrium/path_results.hpp"
#include "engine/setup/case.hpp"
#include "engine/units.hpp"

#include <cstddef>
#include <optional>

namespace asperity {

/// Between two ends of segments, eV.
struct Works {
    double on_solids = 0.0; ///< done on the block by what drives or holds it
    double lateral = 0.0;   ///< of this, by what moves it sideways
    double lost = 0.0;      ///< damped less the heat of a thermostat, or dissipated
    /// int F dz of the mean height; empty at a controlled top on quasi-static paths, where it
    /// jumps.
    std::optional<double> interface;
    std::optional<double> uncertainty; ///< of on_solids and lost; quasi-static paths only

    Works& operator+=(const Works& more);

    template <class Visitor>
    void visit(Visitor& v) {
        v("on_solids", on_solids);
        v("lateral", lateral);
        v("lost", lost);
        v("interface", interface);
        v("uncertainty", uncertainty);
    }
};

class Ledger {
public:
    /// Both are used where they are: the results are noted there.
    Ledger(const Case& c, PathResults& results) : case_(c), results_(results) {}

    /// A segment has ended, at this step or point. kinetic: what still moves there, eV; empty where
    /// nothing moves, or where it is not known.
    void conclude(std::size_t number, const StepRecord& now, const Works& works,
                  const std::optional<double>& kinetic);

    /// For checkpoints.
    template <class Visitor>
    void visit(Visitor& v) {
        v("since_apart", since_apart_);
        v("moved_apart", moved_apart_);
    }

private:
    double per_area(double energy) const { return units::milli_per_unit * energy / case_.area(); }
    std::optional<double> per_area(const std::optional<double>& energy) const;
    WayEnergies way(const Works& works, double sign, const std::optional<double>& kinetic) const;

    const Case& case_;
    PathResults& results_;
    std::optional<Works> since_apart_; ///< from the last end of a pull-off, or the start
    double moved_apart_ = 0.0;         ///< what still moved then, eV
};

} // namespace asperity
