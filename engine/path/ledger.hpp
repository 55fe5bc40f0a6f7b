// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Works and losses of the segments of a path, in time or without. Of an approach from rest beyond
// the interaction range, and a pull-off to rest there:
//
//     -(work of the drive, approach) = binding energy - lost - kinetic
//      (work of the drive, pull-off) = binding energy + lost + kinetic there - kinetic of the
//      approach
//
// Of every segment of a quasi-static path, wherever it starts and ends,
//
//     work of the drive = stored + lost + dissipated in the block,
//
// stored: the change of the energy of interface and block. Works are done on the solids; kinetic is
// what still moves at the end: kinetic energy, and that of vibrations about the state.
#pragma once

#include "engine/path/path_results.hpp"
#include "engine/setup/case.hpp"
#include "engine/units.hpp"

#include <cstddef>
#include <optional>

namespace asperity {

/// Between two ends of segments, eV.
struct Works {
    double on_solids = 0.0;       ///< done on the block by what drives or holds it
    double lateral = 0.0;         ///< of this, by what moves it sideways
    double relaxed = 0.0;         ///< dissipated in time by a block that relaxes
    double lost = 0.0;            ///< damped less the heat of a thermostat, or dissipated
    std::optional<double> stored; ///< change of the energy; quasi-static paths only
    /// int F dz of the mean height; empty at a controlled top on quasi-static paths, where it
    /// jumps.
    std::optional<double> interface;
    std::optional<double> uncertainty; ///< of on_solids and lost; quasi-static paths only

    /// From an earlier place on the path to this one.
    Works operator-(const Works& earlier) const;

    template <class Visitor>
    void visit(Visitor& v) {
        v("on_solids", on_solids);
        v("lateral", lateral);
        v("relaxed", relaxed);
        v("lost", lost);
        v("stored", stored);
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
        v("lost_since_apart", lost_since_apart_);
        v("relaxed_since_apart", relaxed_since_apart_);
        v("moved_apart", moved_apart_);
    }

private:
    double per_area(double energy) const { return units::milli_per_unit * energy / case_.area(); }
    std::optional<double> per_area(const std::optional<double>& energy) const;

    const Case& case_;
    PathResults& results_;
    double lost_since_apart_ = 0.0;    ///< from the last end of a pull-off, or the start, eV
    double relaxed_since_apart_ = 0.0; ///< likewise
    double moved_apart_ = 0.0;         ///< what still moved then, eV
};

} // namespace asperity
