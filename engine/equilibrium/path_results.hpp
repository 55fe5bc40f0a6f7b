// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What a run has come to so far: the numbers behind the summary and result.json.
#pragma once

#include "engine/dynamics/simulation.hpp"
#include "engine/equilibrium/dissipation.hpp"
#include "engine/scene/segment.hpp"
#include "engine/units.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

namespace asperity {

/// Of the relaxed state under zero load.
struct ZeroLoad {
    double binding_energy = 0.0; ///< gamma_state = -(U_LJ + U_el) / A0, meV/Å^2
    double pairwise = 0.0;       ///< -U_LJ / A0: the atom-by-atom work, meV/Å^2
    double elastic = 0.0;        ///< U_el / A0, meV/Å^2
    double contact_fraction = 0.0;
    double repulsive_fraction = 0.0;
    double mean_height = 0.0; ///< of the lowest layer above the substrate's zero, Å
    double residual = 0.0;    ///< largest force left, eV/Å
    long long iterations = 0;
    /// Of the binding energy: what forces as large as drive.tolerance stand for in the softest wave
    /// of the box, meV/Å^2.
    double uncertainty = 0.0;

    template <class Visitor>
    void visit(Visitor& v) {
        v("binding_energy", binding_energy);
        v("pairwise", pairwise);
        v("elastic", elastic);
        v("contact_fraction", contact_fraction);
        v("repulsive_fraction", repulsive_fraction);
        v("mean_height", mean_height);
        v("residual", residual);
        v("iterations", iterations);
        v("uncertainty", uncertainty);
    }
};

/// Energies of an approach or a pull-off that has ended, meV/Å^2, from or to rest beyond the
/// interaction range. Works are positive where the solids attract: taken up on the way in, given on
/// the way out.
struct WayEnergies {
    /// Of the interface's force on the mean height of the lowest layer, int F dz / A0. Empty at a
    /// controlled top on quasi-static paths, where the mean height jumps at instabilities.
    std::optional<double> interface_work;
    /// Of what drives or holds the block: the top plane (on dynamic paths with the medium that
    /// damps, which moves along), or the holder of the mean height.
    std::optional<double> drive_work;
    std::optional<double> lost; ///< damped or dissipated; empty with a thermostat
    /// What still moves at the end of a dynamic path at T = 0: kinetic energy and vibrations about
    /// the state at zero load (empty where that is not known), or about the solids at rest apart.
    std::optional<double> kinetic;
    std::optional<double> uncertainty; ///< of each of these; quasi-static paths only

    template <class Visitor>
    void visit(Visitor& v) {
        v("work_of_interface", interface_work);
        v("drive_work", drive_work);
        v("lost", lost);
        v("kinetic", kinetic);
        v("uncertainty", uncertainty);
    }
};

/// A segment of the path that has ended: what was done on the way, and where it ended.
struct SegmentResults {
    std::size_t number = 0; ///< in the path
    /// Done on the block by what drives or holds it, meV/Å^2. That of an approach from rest apart,
    /// and of a pull-off, is minus and plus WayEnergies::drive_work.
    double work = 0.0;
    std::optional<double> interface_work; ///< int F dz / A0, meV/Å^2; empty as above
    double lost = 0.0;                    ///< damped or dissipated, meV/Å^2
    std::optional<double> uncertainty;    ///< of work and lost; quasi-static paths only, meV/Å^2
    double attraction = 0.0;              ///< the largest, eV/Å
    std::optional<double> lateral_mean;   ///< force against a slide, work over distance, eV/Å
    std::optional<double> lateral_most;   ///< the largest of it, eV/Å
    // At its end:
    double force = 0.0, mean_height = 0.0, top = 0.0; ///< eV/Å, Å, Å
    std::array<double, 2> slide{};                    ///< Å
    long long in_contact = 0;                         ///< sites

    template <class Visitor>
    void visit(Visitor& v) {
        v("number", number);
        v("work", work);
        v("work_of_interface", interface_work);
        v("lost", lost);
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
    std::optional<ZeroLoad> zero_load;   ///< of the last approach, or of the path's start
    WayEnergies approach, pull_off;      ///< the last of each
    std::optional<double> lost_in_cycle; ///< from and to rest beyond the interaction range, meV/Å^2
    double attraction_in = 0.0;          ///< largest attraction of the last approach, eV/Å
    double attraction_out = 0.0;         ///< of the last pull-off
    double strongest = 0.0;              ///< of the path so far
    std::optional<double> contact_made;  ///< when the last approach ended, fs
    std::optional<Dissipation> dissipated; ///< of a quasi-static path (which lists it itself)
    std::vector<SegmentResults> segments;  ///< those that have ended
    // Of the segment under way, eV/Å:
    double attraction = 0.0, lateral_most = 0.0;

    void begin_segment() { attraction = lateral_most = 0.0; }
    /// What a step or point of the segment under way has felt.
    void feel(const Segment& segment, const StepRecord& now) {
        attraction = std::max(attraction, -now.force);
        strongest = std::max(strongest, attraction);
        if (segment.kind == Segment::approach) attraction_in = attraction;
        if (segment.kind == Segment::pull_off) attraction_out = attraction;
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
        v("approach", approach);
        v("pull_off", pull_off);
        v("lost_in_cycle", lost_in_cycle);
        v("attraction_in", attraction_in);
        v("attraction_out", attraction_out);
        v("strongest", strongest);
        v("contact_made", contact_made);
        v("segments", segments);
        v("attraction", attraction);
        v("lateral_most", lateral_most);
        v("zero_load", zero_load);
    }
};

} // namespace asperity
