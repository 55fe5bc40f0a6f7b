// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Standard error of the work of a segment of a quasi-static path and of the energy that it has
// lost.
//
// In a smooth step the work of the forces is that of a polynomial through them. What a step misses
// of it, work less energy gained, is summed as lost; it differs from the energy lost by the error
// of the work. Small patches that jump at unknown places in the steps make errors of either sign,
// which add up as the root of their squares (ForceTrail, StepDecision::sigma), so that the error
// for each site falls with the size of the box. It is no larger than what all these steps miss:
// where nothing jumps they miss less than the polynomials might.
//
// On a path on which nothing is lost the work of a step is the difference of the energies of its
// ends. The works add up to the difference of the energies of the ends of the segment, and the
// errors of the energies between cancel.
//
// The work of a step h that passes an instability has a standard deviation of h/sqrt(12) times the
// jump of the force. The place of the instability is known to what the tolerance of the relaxation
// moves it (QuasistaticPath::error_of_place()), which the jump of the force turns into an error of
// the work. The relaxation also starts up to h beyond the instability: a second patch that
// becomes unstable within h separates together with the first, and a patch that would have held
// beyond h may be pulled along by its neighbour. After n instabilities on a distance w, another one
// lies within h with probability p = h n/w; an unknown part of the energy E that the step loses,
// anything between none and all of it, then belongs to other steps: a variance of p E^2/3.
// (Measured over soft walls and over atoms: scenes/validation/works.py.)
#pragma once

#include <algorithm>
#include <cmath>

namespace asperity {

/// Errors of the works of a segment.
class WorkErrors {
public:
    /// Begins a new segment where the last one ends.
    void begin() {
        const double here = end_;
        *this = {};
        start_ = end_ = here;
    }
    /// Sets the error of the energy of the last point of a path on which nothing is lost, eV.
    void end_at(double error) { end_ = error; }
    /// Adds an error of a step that has the same sign in all steps, eV.
    void add_gap(double gap) { gap_ += std::abs(gap); }
    /// Adds a step without an instability that could be told. sigma: standard deviation of its
    /// work, eV; missing: work less energy gained, eV.
    void add_smooth(double sigma, double missing) {
        smooth_ += sigma * sigma;
        missing_ += std::abs(missing);
    }
    /// Adds the standard deviation of the work of a step that passes an instability, eV.
    void add_bracketed(double sigma) { squares_ += sigma * sigma; }
    /// Adds what an instability may have taken along, or left to others. at: end of its step, Å;
    /// step: length of the step, Å; lost: energy lost, eV.
    void add_instability(double at, double step, double lost) {
        if (!(lost > 0.0)) return;
        if (before_ == 0.0) first_ = at;
        const double way = std::max(std::abs(at - first_), step);
        const double another = std::min(1.0, step * before_ / way);
        squares_ += another * lost * lost / 3.0;
        ++before_;
    }
    /// Returns the standard error, eV: the gaps, the errors of both ends, and the root of the sum
    /// of the variances.
    double total() const {
        return gap_ + start_ + end_ + std::sqrt(std::min(smooth_, missing_ * missing_) + squares_);
    }

    template <class Visitor>
    void visit(Visitor& v) {
        v("gap", gap_);
        v("start", start_);
        v("end", end_);
        v("smooth", smooth_);
        v("missing", missing_);
        v("squares", squares_);
        v("first", first_);
        v("before", before_);
    }

private:
    double gap_ = 0.0;     ///< sum of the errors that have the same sign in all steps, eV
    double start_ = 0.0;   ///< error of the energy at the beginning, eV
    double end_ = 0.0;     ///< error of the energy at the last point, eV
    double smooth_ = 0.0;  ///< sum of the variances of smooth steps, eV^2
    double missing_ = 0.0; ///< sum of what smooth steps miss, without sign, eV
    double squares_ = 0.0; ///< sum of the other variances, eV^2
    double first_ = 0.0;   ///< place of the first instability, Å
    double before_ = 0.0;  ///< number of instabilities so far
};

} // namespace asperity
