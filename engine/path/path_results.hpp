// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What a run has come to so far: the numbers behind the summary and result.json.
#pragma once

#include "engine/equilibrium/dissipation.hpp"
#include "engine/equilibrium/zero_load.hpp"
#include "engine/scene/segment.hpp"
#include "engine/step_record.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

namespace asperity {

/// A segment of the path that has ended: what was done on the way, and where it ended.
struct SegmentResults {
    std::size_t number = 0; ///< in the path
    Segment::Kind kind = Segment::approach;
    // Works are done on the solids, meV/Å^2; from rest beyond the interaction range where the path
    // starts there, and to rest there at a pull-off.
    /// By what drives or holds the block: the top plane (on a dynamic path with the medium that
    /// damps, which moves along), or the holder of the mean height.
    double work = 0.0;
    /// Of the interface's force on the mean height of the lowest layer, int F dz. Empty on a
    /// quasi-static path that controls the top, where the mean height jumps at instabilities.
    std::optional<double> interface_work;
    std::optional<double> relaxed; ///< dissipated in time by a block that relaxes
    double lost = 0.0;             ///< damped (less the heat of a thermostat) or dissipated
    std::optional<double>
        stored; ///< change of the energy of interface and block; quasi-static only
    /// What still moves at the end, in time at T = 0: kinetic energy and vibrations about the state
    /// at zero load behind an approach (empty where that is not known), or about the solids at rest
    /// apart behind a pull-off.
    std::optional<double> kinetic;
    std::optional<double> uncertainty;  ///< of works and losses; quasi-static only
    double attraction = 0.0;            ///< the largest, eV/Å
    std::optional<double> lateral_mean; ///< force against a slide, work over distance, eV/Å
    std::optional<double> lateral_most; ///< the largest of it, eV/Å
    // At its end:
    double force = 0.0, mean_height = 0.0, top = 0.0; ///< eV/Å, Å, Å
    std::array<double, 2> slide{};                    ///< Å
    long long in_contact = 0;                         ///< sites

    template <class Visitor>
    void visit(Visitor& v) {
        v("number", number);
        v("kind", kind);
        v("work", work);
        v("work_of_interface", interface_work);
        v("relaxed", relaxed);
        v("lost", lost);
        v("stored", stored);
        v("kinetic", kinetic);
        v("uncertainty", uncertainty);
        v("attraction", attraction);
        v("lateral_mean", lateral_mean);
        v("lateral_most", lateral_most);
        v("force", force);
        v("mean_height", mean_height);
        v("top", top);
        v("slide", slide);
        v("in_contact", in_contact);
    }
};

struct PathResults {
    std::optional<ZeroLoad> zero_load;      ///< of the last approach, or of the path's start
    std::optional<double> lost_in_cycle;    ///< from rest apart to rest apart, meV/Å^2
    std::optional<double> relaxed_in_cycle; ///< likewise
    double strongest = 0.0;                 ///< attraction of the path so far, eV/Å
    std::optional<double> contact_made;     ///< when the last approach ended, fs
    std::optional<Dissipation> dissipated;  ///< of a quasi-static path (which lists it itself)
    std::vector<SegmentResults> segments;   ///< those that have ended
    // Of the segment under way, eV/Å:
    double attraction = 0.0, lateral_most = 0.0;

    /// The last segment of a kind that has ended, or null.
    const SegmentResults* last(Segment::Kind kind) const {
        const auto is = [&](const SegmentResults& s) { return s.kind == kind; };
        const auto found = std::find_if(segments.rbegin(), segments.rend(), is);
        return found == segments.rend() ? nullptr : &*found;
    }
    void begin_segment() { attraction = lateral_most = 0.0; }
    /// What a step or point of the segment under way has felt.
    void feel(const Segment& segment, const StepRecord& now) {
        attraction = std::max(attraction, -now.force);
        strongest = std::max(strongest, attraction);
        if (segment.kind == Segment::slide)
            lateral_most = std::max(lateral_most, against(segment, now));
    }
    /// Force against a slide, eV/Å.
    static double against(const Segment& slide, const StepRecord& now) {
        const double force = now.lateral_force[static_cast<std::size_t>(slide.axis)];
        return slide.amount > 0.0 ? -force : force;
    }
    /// Where the segment under way has ended: what of it follows from the last step or point.
    /// lateral_work: of what moves the block sideways, eV.
    SegmentResults ended(std::size_t number, const Segment& segment, const StepRecord& now,
                         double lateral_work) const {
        SegmentResults r;
        r.number = number;
        r.kind = segment.kind;
        r.attraction = attraction;
        if (segment.kind == Segment::slide) {
            r.lateral_mean = lateral_work / std::abs(segment.amount);
            r.lateral_most = lateral_most;
        }
        r.force = now.force;
        r.mean_height = now.mean_height;
        r.top = now.top;
        r.slide = now.slide;
        r.in_contact = now.in_contact;
        return r;
    }

    /// For checkpoints; but what was dissipated, which the path keeps.
    template <class Visitor>
    void visit(Visitor& v) {
        v("lost_in_cycle", lost_in_cycle);
        v("relaxed_in_cycle", relaxed_in_cycle);
        v("strongest", strongest);
        v("contact_made", contact_made);
        v("segments", segments);
        v("attraction", attraction);
        v("lateral_most", lateral_most);
        v("zero_load", zero_load);
    }
};

} // namespace asperity
