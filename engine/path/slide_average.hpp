// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Means of a slide after its running-in.
//
// Friction is work over distance, so means are differences of what has added up. The slide is cut
// into equal bins of whole spacings of the sites, from its end backwards. Of all numbers of bins
// left out at its beginning, up to half, that is taken as the running-in with which the variance of
// the bins over their number is least (White, Simulation 69, 323 (1997)). The standard error of the
// mean is the largest that bins, pairs of bins, fours and so on give (Flyvbjerg and Petersen, J.
// Chem. Phys. 91, 461 (1989)).
//
// The friction of a steady slide is also what is dissipated over the distance, and of a
// viscoelastic block that is the more accurate of the two: forces at the ends of steps have the
// rates there, from the steps before, which are (q d)^2/3 too large for waves q in steps of d that
// are long beside the relaxation times. It is the friction then; where work and dissipation differ
// by more than the standard error, this is the error.
//
// A slide is steady if the mean friction over a correlation length of the map has changed by less
// than a hundredth since the one before, and what a geometric series of the last two changes has
// still to come is less than that as well.
#pragma once

#include <optional>
#include <vector>

namespace asperity {

/// Means of a slide after its running-in; uncertainties are standard errors.
struct SteadySlide {
    double running_in = 0.0;                         ///< Å
    double friction = 0.0, friction_error = 0.0;     ///< force against the slide, eV/Å
    double load = 0.0;                               ///< normal force, eV/Å
    double in_contact = 0.0, in_contact_error = 0.0; ///< sites
    double mean_height = 0.0;                        ///< Å
    double relaxed = 0.0; ///< energy dissipated by a viscoelastic block, eV/Å
    double lost = 0.0;    ///< energy dissipated at instabilities, eV/Å
    bool steady = false;  ///< the friction no longer drifts

    template <class Visitor>
    void visit(Visitor& v) {
        v("running_in", running_in);
        v("friction", friction);
        v("friction_error", friction_error);
        v("load", load);
        v("in_contact", in_contact);
        v("in_contact_error", in_contact_error);
        v("mean_height", mean_height);
        v("relaxed", relaxed);
        v("lost", lost);
        v("steady", steady);
    }
};

/// Numbers of a point of a slide.
struct SlidePoint {
    double distance = 0.0; ///< distance since the slide began, Å
    // Energies since the slide began, eV:
    double work = 0.0;    ///< work of what moves the block sideways
    double relaxed = 0.0; ///< dissipated by a viscoelastic block
    double lost = 0.0;    ///< dissipated at instabilities
    // State at the point:
    double load = 0.0;        ///< normal force, eV/Å
    double in_contact = 0.0;  ///< sites
    double mean_height = 0.0; ///< Å

    template <class Visitor>
    void visit(Visitor& v) {
        v("distance", distance);
        v("work", work);
        v("relaxed", relaxed);
        v("lost", lost);
        v("load", load);
        v("in_contact", in_contact);
        v("mean_height", mean_height);
    }
};

/// The slide under way.
class SlideAverage {
public:
    void begin() { points_.clear(); }
    /// Adds a point. Long slides keep every second one, fourth and so on.
    void add(const SlidePoint& point);
    /// Lengths of an interface, Å.
    struct Lengths {
        double window = 0.0;  ///< correlation length of the map
        double spacing = 0.0; ///< spacing of the sites, with which forces vary: bins are whole ones
        /// Returns the window in whole spacings.
        double whole_window() const;
    };
    /// Returns true if the friction no longer drifts.
    bool is_steady(const Lengths& lengths) const;
    /// Returns the means so far; nothing before the second point.
    std::optional<SteadySlide> means(const Lengths& lengths) const;

    template <class Visitor>
    void visit(Visitor& v) {
        v("points", points_);
    }

private:
    /// Returns a member of the points at this distance, linear between points.
    double at(double distance, double SlidePoint::*member) const;

    std::vector<SlidePoint> points_;
};

} // namespace asperity
