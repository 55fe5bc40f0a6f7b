// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The results of a run so far: the numbers of the summary and of result.json.
#pragma once

#include "engine/options/segment.hpp"
#include "engine/path/slide_average.hpp"
#include "engine/statics/dissipation.hpp"
#include "engine/statics/zero_load.hpp"
#include "engine/step_record.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

namespace asperity {

/// Results of a segment of the path that has ended: its works, and the state at its end.
struct SegmentResults {
    std::size_t number = 0; ///< number in the path
    Segment::Kind kind = Segment::approach;
    // Works are done on the solids, meV/Å^2. The first segment counts from solids at rest beyond
    // the interaction range if the path starts there; a pull-off counts until they are at rest
    // beyond the range again.
    /// Terms that the case has, among them:
    /// the work of the drive or holder of the block: the top plane (on a dynamic path with the
    /// damping medium, which moves along), or the holder of the mean height;
    /// the work of the interface's force on the mean height of the lowest layer, int F dz, but not
    /// on a quasi-static path that controls the top, where the mean height jumps;
    /// the kinetic and vibrational energy left at the end, dynamic paths at T = 0: vibrations about
    /// the state at zero load after an approach (if that state is known), or about the solids at
    /// rest apart after a pull-off.
    PerTerm<std::optional<double>> energies;
    /// Part of the work that brought a viscoelastic block into the shape in which it slides
    /// steadily.
    std::optional<double> settling;
    /// Change of the energy of interface and block; quasi-static only.
    std::optional<double> stored;
    std::optional<double> uncertainty;  ///< uncertainty of works and losses; quasi-static only
    double attraction = 0.0;            ///< largest attraction, eV/Å
    std::optional<double> lateral_mean; ///< mean force against a slide, work over distance, eV/Å
    std::optional<double> lateral_most; ///< largest force against a slide, eV/Å
    std::optional<SteadySlide> steady;  ///< means of a slide over a wall after its running-in
    // State at the end of the segment:
    double force = 0.0, mean_height = 0.0, top = 0.0; ///< eV/Å, Å, Å
    std::optional<double> scatter; ///< scatter of a force averaged over thermal noise, eV/Å
    std::array<double, 2> slide{}; ///< Å
    long long in_contact = 0;      ///< sites
    std::optional<double> area;    ///< contact_sites() over a wall; quasi-static only
    YieldState yielding;
    // Heights of a surface that yields, less its set: rms, Å, and rms slope, by differences.
    double yielded_rms = 0.0, yielded_slope = 0.0;

    template <class Visitor>
    void visit(Visitor& v) {
        v("number", number);
        v("kind", kind);
        v("energies", energies);
        v("settling", settling);
        v("stored", stored);
        v("uncertainty", uncertainty);
        v("attraction", attraction);
        v("lateral_mean", lateral_mean);
        v("lateral_most", lateral_most);
        v("steady", steady);
        v("force", force);
        v("scatter", scatter);
        v("mean_height", mean_height);
        v("top", top);
        v("slide", slide);
        v("in_contact", in_contact);
        v("area", area);
        v("yielding", yielding);
        v("yielded_rms", yielded_rms);
        v("yielded_slope", yielded_slope);
    }
};

/// Results of a path so far.
struct PathResults {
    // Heights of a surface that yields, before the path: rms, Å, and rms slope, by differences.
    double unyielded_rms = 0.0, unyielded_slope = 0.0;
    std::optional<ZeroLoad> zero_load; ///< state after the last approach, or at the path's start
    PerTerm<std::optional<double>> in_cycle; ///< losses of the last cycle, meV/Å^2
    double strongest = 0.0;                  ///< strongest attraction of the path so far, eV/Å
    std::optional<double> contact_made;      ///< time of the end of the last approach, fs
    std::optional<double> edge_distance;     ///< least distance of a contact from an edge, Å
    /// Dissipation of a quasi-static path; the path keeps the numbers for checkpoints.
    std::optional<Dissipation> dissipated;
    std::vector<SegmentResults> segments; ///< segments that have ended
    // Largest attraction and force against a slide of the current segment, eV/Å.
    double attraction = 0.0, lateral_most = 0.0;
    SlideAverage slide; ///< points of a slide over a wall

    /// Returns the last segment of a kind that has ended, or nullptr.
    const SegmentResults* last(Segment::Kind kind) const {
        const auto is = [&](const SegmentResults& s) { return s.kind == kind; };
        const auto found = std::find_if(segments.rbegin(), segments.rend(), is);
        return found == segments.rend() ? nullptr : &*found;
    }
    /// Resets the extrema and the average of the current segment.
    void begin_segment() {
        attraction = lateral_most = 0.0;
        slide.begin();
    }
    /// Updates the largest forces with a step or point of the current segment.
    void record_force(const Segment& segment, const StepRecord& now) {
        attraction = std::max(attraction, -now.force);
        strongest = std::max(strongest, attraction);
        if (segment.kind == Segment::slide)
            lateral_most = std::max(lateral_most, against(segment, now));
    }
    /// Returns the component of the lateral force against a slide, eV/Å.
    static double against(const Segment& slide, const StepRecord& now) {
        const double force = now.lateral_force[static_cast<std::size_t>(slide.axis)];
        return slide.amount > 0.0 ? -force : force;
    }
    /// Returns the results of a segment that has ended with this step or point. lateral_work: work
    /// that moved the block sideways, eV; distance: length of the slide, Å.
    SegmentResults ended(std::size_t number, const Segment& segment, const StepRecord& now,
                         double lateral_work, double distance) const {
        SegmentResults r;
        r.number = number;
        r.kind = segment.kind;
        r.attraction = attraction;
        if (segment.kind == Segment::slide) {
            r.lateral_mean = lateral_work / distance;
            r.lateral_most = lateral_most;
        }
        r.force = now.force;
        r.mean_height = now.mean_height;
        r.top = now.top;
        r.slide = now.slide;
        r.in_contact = now.in_contact;
        r.yielding = now;
        return r;
    }

    /// Passes the results to a visitor, for checkpoints; the path passes `dissipated`.
    template <class Visitor>
    void visit(Visitor& v) {
        v("in_cycle", in_cycle);
        v("strongest", strongest);
        v("contact_made", contact_made);
        v("segments", segments);
        v("attraction", attraction);
        v("lateral_most", lateral_most);
        v("slide", slide);
        v("zero_load", zero_load);
        v("edge_distance", edge_distance);
    }
};

} // namespace asperity
