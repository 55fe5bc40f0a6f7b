// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The end of a segment that depends on a force (an approach, a load, a pull-off), on dynamic and
// quasi-static paths alike:
//
//     down, to a load      through attraction, beyond the load if the load pulls, and back to it;
//                          or, if nothing attracts that much, to a load that presses
//     up, to a load        when the force has come down to it
//     a pull-off           when the solids are apart
//
// Forces are those of the substrate on the lowest layer, eV/Å, positive upwards.
#pragma once

#include "engine/options/segment.hpp"

namespace asperity {

/// Rule for the end of a segment.
class SegmentRule {
public:
    enum class End { no, at_load, apart };

    /// Begins a segment. load: of an approach or a load, eV/Å; area: of the interface, Å^2, for
    /// messages; force: at the beginning, which may be beyond a pull already, eV/Å; slack:
    /// uncertainty of the force, eV/Å.
    void begin(Segment::Kind kind, double load, bool down, double area, double force,
               double slack = 0.0);
    /// Returns whether a step or point ends the segment. apart: no site is within the interaction
    /// range; beside: the step is too short to pass a load unseen, as a time step always is. Throws
    /// io::PhysicsError if the segment demands a pull that was met nowhere.
    End look(double force, bool apart, double slack = 0.0, bool beside = true);
    /// Returns the load at which steps of the segment aim, eV/Å: on the way down to a pull, none
    /// below zero before the force has been there.
    double aim() const;

    /// Passes the state to a visitor, for checkpoints.
    template <class Visitor>
    void visit(Visitor& v) {
        v("kind", kind_);
        v("load", load_);
        v("down", down_);
        v("area", area_);
        v("attracted", attracted_);
        v("strongest", strongest_);
    }

private:
    [[noreturn]] void refuse() const;

    Segment::Kind kind_ = Segment::approach;
    double load_ = 0.0, area_ = 0.0;
    bool down_ = true;
    bool attracted_ = false; ///< the force has been beyond the load
    double strongest_ = 0.0; ///< strongest attraction of the segment so far
};

} // namespace asperity
