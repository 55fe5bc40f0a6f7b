// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The observables of a run: one column for each number recorded of an observed step or point, with
// name, unit, meaning and its function. /series of run.h5, docs/reference/result.md and Python's
// result.series follow from this table.
#pragma once

#include "engine/path/path.hpp"
#include "io/quantities.hpp"

#include <span>
#include <string>
#include <vector>

namespace asperity {

/// A column of the series.
struct SeriesColumn {
    /// Runs that have the column. time: dynamic runs and viscoelastic blocks; sliding: paths
    /// that slide; relaxing: viscoelastic blocks; thermal: scenes with a temperature; sprung: paths
    /// with a spring that holds the top plane.
    enum In { both, dynamic, quasistatic, time, sliding, relaxing, thermal, sprung };
    In in;
    io::Quantity quantity; ///< the name is that of the data set, "series/force"
    /// Returns the value at path.now(), the same on all ranks. Collective.
    double (*value)(const Path& path);
    /// The value is computed from path.layer(), which each row then needs.
    bool of_sites = false;

    /// Returns true if runs of such a path with these effects have the column.
    bool is_in(bool dynamic_path, const Effects& effects) const;
    /// Returns the name of the column, "force".
    std::string name() const {
        return std::string(quantity.name.substr(quantity.name.find('/') + 1));
    }
};

/// Returns all columns, in the order of run.h5.
std::span<const SeriesColumn> series_columns();
/// Returns the descriptions of all columns, for the reference.
std::vector<io::Quantity> series_quantities();

} // namespace asperity
