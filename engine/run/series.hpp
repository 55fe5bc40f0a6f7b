// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The observables of a run: one column for each number recorded of an observed step or point, with
// name, unit, meaning and its function. The energies are the terms of io/energy_terms.hpp. /series
// of run.h5, docs/reference/result.md and Python's result.series follow from this table.
#pragma once

#include "engine/path/path.hpp"
#include "io/quantities.hpp"

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace asperity {

/// A column of the series.
struct SeriesColumn {
    /// Returns true if runs with these effects have the column.
    std::function<bool(const Effects& effects)> is_in;
    io::Quantity quantity; ///< the name is that of the data set, "series/force"
    /// Returns the value at a record of the path, the same on all ranks. Collective.
    std::function<double(const Path& path, const StepRecord& now)> value;
    std::string_view result{}; ///< name in result.json of the value at the last recorded step
    /// The value is computed from path.layer(), which each row then needs.
    bool of_sites = false;

    /// Returns the name of the column, "force".
    std::string name() const {
        return std::string(quantity.name.substr(quantity.name.find('/') + 1));
    }
};

/// Returns all columns, in the order of run.h5: those of io::energy_terms among them.
const std::vector<SeriesColumn>& series_columns();
/// Returns the descriptions of all columns, for the reference.
std::vector<io::Quantity> series_quantities();

} // namespace asperity
