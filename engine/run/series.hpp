// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The observables of a run: what of each observed step or point is recorded, a column each, with
// name, unit, meaning and how it is found. /series of run.h5, docs/reference/result.md and Python's
// result.series follow from this table.
#pragma once

#include "engine/path/path.hpp"
#include "io/quantities.hpp"

#include <span>
#include <string>
#include <vector>

namespace asperity {

struct SeriesColumn {
    /// time: where it passes; sliding: where the path slides; relaxing: where the block does;
    /// thermal: where the scene has a temperature.
    enum In { both, dynamic, quasistatic, time, sliding, relaxing, thermal };
    In in;
    io::Quantity quantity; ///< its name is that of the data set, "series/force"
    /// At path.now(). Collective: the same on all ranks.
    double (*value)(const Path& path);
    /// The value is found from the sites, path.layer(): it is wanted in each row.
    bool of_sites = false;

    bool is_in(bool in_time, const Effects& effects) const;
    /// "force"
    std::string name() const {
        return std::string(quantity.name.substr(quantity.name.find('/') + 1));
    }
};

std::span<const SeriesColumn> series_columns();
std::vector<io::Quantity> series_quantities();

} // namespace asperity
