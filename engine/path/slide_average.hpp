// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Means of a slide after its running-in.
//
// Friction is work over distance, so that means are differences of accumulated works. The slide is
// cut into equal bins of whole spacings of the sites, from its end backwards. The running-in is the
// number of bins, at most half of them, whose omission at the beginning minimises the variance of
// the remaining bins divided by their number (White, Simulation 69, 323 (1997)). The standard error
// of the mean is the largest of the errors from blocks of one, two, four, ... bins (Flyvbjerg and
// Petersen, J. Chem. Phys. 91, 461 (1989)).
//
// The friction of a steady slide is what is dissipated over the distance. The work over the
// distance is the same in a steady slide, and is the friction of another one. Of a viscoelastic
// block the works of long steps are those of energies and dissipation; the forces at the ends of
// steps give another work, which is (q d)^2/3 too large for waves q in steps d that are long
// compared with the relaxation times. The error is the larger of the standard error and the
// difference of the ways.
//
// The spacing a changes the friction of a map whose shortest wave is n a long; part of the error is
// 0.2 of the friction times the root of the sum of squares of 1/n^2 and of what a count of sites in
// contact exceeds their area by (docs/howto/rubber-friction.md).
//
// A slide is steady if the mean friction over a correlation length of the map differs by less than
// a hundredth from the mean over the correlation length before, and if the remaining change,
// extrapolated from the last two changes as a geometric series, is below a hundredth as well.
#pragma once

#include "engine/energy/energies.hpp"

#include <functional>
#include <optional>
#include <vector>

namespace asperity {

/// Means of a slide after its running-in; _error: standard error of a mean.
struct SteadySlide {
    double running_in = 0.0;                     ///< distance left out, Å
    double friction = 0.0, friction_error = 0.0; ///< force against the slide, eV/Å
    double mesh_error = 0.0; ///< part of friction_error: that of the spacing; 0: not told
    double load = 0.0;       ///< normal force, eV/Å
    double in_contact = 0.0, in_contact_error = 0.0; ///< number of sites in contact
    double area = 0.0, area_error = 0.0; ///< contact_sites(), with the error of the spacing
    double mean_height = 0.0;            ///< mean height of the lowest layer, Å
    Energies losses;                     ///< losses over the distance, eV/Å
    bool steady = false;                 ///< the friction no longer drifts

    template <class Visitor>
    void visit(Visitor& v) {
        v("running_in", running_in);
        v("friction", friction);
        v("friction_error", friction_error);
        v("mesh_error", mesh_error);
        v("load", load);
        v("in_contact", in_contact);
        v("in_contact_error", in_contact_error);
        v("area", area);
        v("area_error", area_error);
        v("mean_height", mean_height);
        v("losses", losses);
        v("steady", steady);
    }
};

/// Numbers of a point of a slide.
struct SlidePoint {
    double distance = 0.0; ///< distance since the slide began, Å
    Energies flows; ///< work that moves the block sideways, and losses, since the slide began, eV
    // State at the point:
    double load = 0.0;          ///< normal force, eV/Å
    double in_contact = 0.0;    ///< number of sites in contact
    double contact_edges = 0.0; ///< Interface::contact_edges()
    double mean_height = 0.0;   ///< mean height of the lowest layer, Å
    /// Work of the forces less that of flows since the slide began, eV
    /// (QuasistaticPath::work_left_out()).
    double work_left_out = 0.0;

    template <class Visitor>
    void visit(Visitor& v) {
        v("distance", distance);
        v("flows", flows);
        v("load", load);
        v("in_contact", in_contact);
        v("contact_edges", contact_edges);
        v("mean_height", mean_height);
        v("work_left_out", work_left_out);
    }
};

/// Points of the slide under way, and their means.
class SlideAverage {
public:
    /// Forgets the points of the slide before.
    void begin() { points_.clear(); }
    /// Adds a point. A long slide keeps every second point, later every fourth and so on.
    void add(const SlidePoint& point);
    /// Lengths of an interface, Å.
    struct Lengths {
        double window = 0.0; ///< correlation length of the map
        /// Spacing of the sites, the period of lateral forces; bins are multiples.
        double spacing = 0.0;
        /// Shortest wave of a map under a continuum; 0: not known, or another block.
        double shortest_wave = 0.0;
        /// Returns the window rounded to a multiple of the spacing, Å.
        double whole_window() const;
    };
    /// Returns true if the friction no longer drifts.
    bool is_steady(const Lengths& lengths) const;
    /// Returns the means of the points so far; nothing before the second point.
    std::optional<SteadySlide> means(const Lengths& lengths) const;

    template <class Visitor>
    void visit(Visitor& v) {
        v("points", points_);
    }

private:
    /// Returns a number of the points at this distance, interpolated linearly between them.
    double at(double distance, const std::function<double(const SlidePoint&)>& number) const;

    std::vector<SlidePoint> points_;
};

} // namespace asperity
