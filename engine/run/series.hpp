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
#include <string_view>
#include <vector>

namespace asperity {

/// A column of the series.
struct SeriesColumn {
    /// Returns true if runs with these effects have the column.
    bool (*is_in)(const Effects& effects);
    io::Quantity quantity; ///< the name is that of the data set, "series/force"
    /// Returns the value at a record of the path, the same on all ranks. Collective.
    double (*value)(const Path& path, const StepRecord& now);
    std::string_view result{}; ///< name in result.json of the value at the last recorded step
    /// The value is computed from path.layer(), which each row then needs.
    bool of_sites = false;

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
