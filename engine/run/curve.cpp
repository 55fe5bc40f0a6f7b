// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/run/curve.hpp"

#include "engine/units.hpp"
#include "theory/jkr.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace asperity {

namespace {

/// Returns the largest attraction of a running mean over 2 ps, eV/Å; nothing if rows are too rare.
std::optional<double> attraction_averaged(const PathSeries& path, std::size_t from,
                                          std::size_t to) {
    constexpr double window = 2.0; // ps
    if (path.time.empty() || to - from < 3) return std::nullopt;
    // A segment's first row is that of the step after the last one's end, between two of the
    // series.
    const double spacing = path.time[from + 2] - path.time[from + 1];
    const auto rows = static_cast<std::size_t>(std::lround(window / spacing));
    if (rows < 4 || to - from < rows) return std::nullopt;
    double sum = 0.0, strongest = 0.0;
    for (std::size_t i = from; i < to; ++i) {
        sum += path.force[i];
        if (i >= from + rows) sum -= path.force[i - rows];
        if (i + 1 >= from + rows) strongest = std::max(strongest, -sum / static_cast<double>(rows));
    }
    return strongest;
}

} // namespace

void add_sphere_path(const PathSeries& path, const std::vector<Segment>& segments, double edge,
                     double radius, io::Result& result) {
    if (!result.number("work_of_drive.pull_off")) return; // the pull-off did not come to its end
    /// Rows of the last segment of a kind, from the first to behind the last.
    const auto rows_of = [&](Segment::Kind kind) {
        std::optional<double> number;
        for (std::size_t i = 0; i < segments.size(); ++i)
            if (segments[i].kind == kind) number = static_cast<double>(i);
        if (!number) return std::pair<std::size_t, std::size_t>{};
        const auto [first, end] =
            std::equal_range(path.segment.begin(), path.segment.end(), *number);
        return std::pair{static_cast<std::size_t>(first - path.segment.begin()),
                         static_cast<std::size_t>(end - path.segment.begin())};
    };
    const auto in = rows_of(Segment::approach), out = rows_of(Segment::pull_off);
    if (in.first == in.second || out.first == out.second) return; // no cycle
    const auto strongest =
        std::min_element(path.force.begin() + static_cast<std::ptrdiff_t>(out.first),
                         path.force.begin() + static_cast<std::ptrdiff_t>(out.second));
    const double fraction =
        path.contact_fraction[static_cast<std::size_t>(strongest - path.force.begin())];
    result.set("contact_radius.pull_off", edge * std::sqrt(fraction / std::numbers::pi));
    const auto averaged = [&](std::size_t from, std::size_t to, io::Key key) {
        if (const auto force = attraction_averaged(path, from, to))
            result.set(key,
                       units::milli_per_unit * theory::jkr::work_from_pull_off(*force, radius));
    };
    averaged(in.first, in.second, "jkr.approach_averaged");
    averaged(out.first, out.second, "jkr.pull_off_averaged");
}

} // namespace asperity
