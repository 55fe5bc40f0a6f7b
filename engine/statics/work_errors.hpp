// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Errors of the work of a segment of a quasi-static path and of the energy that it has dissipated.
//
// A step that passes an instability has a work that is known to half the step h times the jump of
// the force. And it starts relaxing up to h beyond the instability: if another patch becomes
// unstable within h, both come off together, and if the second would have held beyond h as well, a
// neighbour may pull it along on the way. With n instabilities before on a way w, another one lies
// within h with a probability p = h n/w; of what the step dissipates, E, an unknown part was then
// to be dissipated later. Where the state is next the same again is not known, so E is taken whole,
// and the variance is p E^2. (Measured over soft walls: scenes/validation/soft_walls.py.)
#pragma once

#include <algorithm>
#include <cmath>

namespace asperity {

class WorkErrors {
public:
    void begin() { *this = {}; }
    /// Adds what is missing in the energy balance of a step, eV.
    void add_gap(double gap) { gap_ += std::abs(gap); }
    /// Adds a step that ends at a place, Å, whose work is known to `uncertain`, and in which so
    /// much was dissipated by a jump of the force, eV.
    void add_instability(double at, double step, double uncertain, double dissipated) {
        squares_ += 9.0 * uncertain * uncertain;
        if (!(dissipated > 0.0)) return;
        if (before_ == 0.0) first_ = at;
        const double way = std::max(std::abs(at - first_), step);
        const double another = std::min(1.0, step * before_ / way);
        squares_ += 4.0 * another * dissipated * dissipated;
        ++before_;
    }
    /// Returns the uncertainty, eV: gaps add up; three times what works are uncertain by (these
    /// errors are not independent) and twice the deviations add in squares.
    double total() const { return gap_ + std::sqrt(squares_); }

    template <class Visitor>
    void visit(Visitor& v) {
        v("gap", gap_);
        v("squares", squares_);
        v("first", first_);
        v("before", before_);
    }

private:
    double gap_ = 0.0;     ///< eV
    double squares_ = 0.0; ///< eV^2
    double first_ = 0.0;   ///< place of the first instability, Å
    double before_ = 0.0;  ///< instabilities so far
};

} // namespace asperity
