// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Errors of the work of a segment of a quasi-static path and of the energy that it has dissipated.
//
// In a smooth step the work of the forces is that of a polynomial through them. What a step misses
// of it, work less energy gained, is energy lost or an error of this work; both are summed as lost.
// The error is no larger than what is missing: where many small patches lose energy, it is stated
// too large.
//
// On a path on which nothing is lost the work of a step is the difference of the energies of its
// ends. The works add up to the difference of the energies of the ends of the segment, and the
// errors of the energies between cancel.
//
// The work of a step h that passes an instability is uncertain by half of h times the jump of the
// force. The relaxation also starts up to h beyond the instability: a second patch that becomes
// unstable within h separates together with the first, and a patch that would have held beyond h
// may be pulled along by its neighbour. After n instabilities on a distance w, another one lies
// within h with probability p = h n/w; an unknown part of the energy E that the step dissipates
// then belongs to later steps. The variance is estimated as p E^2, with all of E, because the place
// where both courses meet again is unknown. (Measured over soft walls:
// scenes/validation/soft_walls.py.)
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
    /// Adds the error of the energy or of the work of a step, eV.
    void add_gap(double gap) { gap_ += std::abs(gap); }
    /// Adds a step with an instability. at: end of the step, Å; step: its length, Å; uncertain:
    /// uncertainty of its work, eV; dissipated: energy dissipated, eV.
    void add_instability(double at, double step, double uncertain, double dissipated) {
        squares_ += 9.0 * uncertain * uncertain;
        if (!(dissipated > 0.0)) return;
        if (before_ == 0.0) first_ = at;
        const double way = std::max(std::abs(at - first_), step);
        const double another = std::min(1.0, step * before_ / way);
        squares_ += 4.0 * another * dissipated * dissipated;
        ++before_;
    }
    /// Returns the uncertainty, eV: the sum of the gaps and of the errors of both ends, plus the
    /// root of the sum of squares of three times the uncertainties of works (which are not
    /// independent) and of two standard deviations of the dissipated energies.
    double total() const { return gap_ + start_ + end_ + std::sqrt(squares_); }

    template <class Visitor>
    void visit(Visitor& v) {
        v("gap", gap_);
        v("start", start_);
        v("end", end_);
        v("squares", squares_);
        v("first", first_);
        v("before", before_);
    }

private:
    double gap_ = 0.0;     ///< sum of the errors of the energy balance, eV
    double start_ = 0.0;   ///< error of the energy at the beginning, eV
    double end_ = 0.0;     ///< error of the energy at the last point, eV
    double squares_ = 0.0; ///< sum of squares, eV^2
    double first_ = 0.0;   ///< place of the first instability, Å
    double before_ = 0.0;  ///< number of instabilities so far
};

} // namespace asperity
