// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// When a segment that a force ends has come to its end (an approach, a load, a pull-off), in time
// and quasi-static alike:
//
//     down, to a load      through attraction, beyond the load where that pulls, and back to it;
//     or,
//                          where nothing attracts that much, to a load that presses
//     up, to a load        where the force has come down to it
//     a pull-off           where the solids are apart
//
// Forces are those of the substrate on the lowest layer, eV/Å, positive upwards.
#pragma once

#include "engine/scene/segment.hpp"

namespace asperity {

class SegmentRule {
public:
    enum class End { no, at_load, apart };

    /// load: of an approach or a load, eV/Å; area: of the interface, Å^2, for messages; slack: what
    /// a force may be wrong by; force: where the segment begins, which may be beyond a pull
    /// already.
    void begin(Segment::Kind kind, double load, bool down, double area, double force,
               double slack = 0.0);
    /// At each step or point. apart: nothing is within the interaction range any more. beside: the
    /// step is too short to go past a load unseen, as one in time always is. Throws
    /// io::PhysicsError where a pull that the segment is to end at was nowhere met.
    End look(double force, bool apart, double slack = 0.0, bool beside = true);
    /// The load that steps of the segment are to come to: on the way down to a pull, none below
    /// zero before the force has been there.
    double aim() const;

    /// For checkpoints.
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
    double strongest_ = 0.0; ///< attraction of the segment so far
};

} // namespace asperity
