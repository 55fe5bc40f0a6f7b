// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The condition that ends a segment at a force (an approach, a load, a pull-off), for dynamic and
// quasi-static paths:
//
//     down, to a load      through attraction, beyond the load if the load pulls, and back;
//                          without such attraction, at a load that presses
//     up, to a load        when the force has decreased to the load
//     a pull-off           when the solids are separated
//
// Forces are those of the substrate on the lowest layer, eV/Å, positive upwards.
#pragma once

#include "engine/options/segment.hpp"

namespace asperity {

/// Returns true if a pull-off is complete: the block is back beyond the interaction range, and the
/// force is at most at_start or small compared with the strongest attraction so far (eV/Å). The
/// force alone is not sufficient, because it passes through zero when compression ends.
bool are_apart(bool beyond, double force, double strongest, double at_start = 0.0);

/// Rule for the end of a segment.
class SegmentRule {
public:
    /// Result of look(): the segment goes on, or ends at its load, or with separated solids.
    enum class End { no, at_load, apart };

    /// Begins a segment. load: target of an approach or a load, eV/Å; down: direction of a load;
    /// area: area of the interface for messages, Å^2; force: force at the beginning, which may
    /// already exceed a tensile load, eV/Å; slack: uncertainty of the force, eV/Å.
    void begin(Segment::Kind kind, double load, bool down, double area, double force,
               double slack = 0.0);
    /// Updates the rule with a step or point and returns the end of the segment that it makes, or
    /// `no`. apart: no site is within the interaction range; beside: the step is too short to pass
    /// the load unnoticed, as all time steps are. Throws io::PhysicsError if the segment demands a
    /// tension that the attraction never reached.
    End look(double force, bool apart, double slack = 0.0, bool beside = true);
    /// Returns the load at which steps of the segment aim, eV/Å. While moving down to a tensile
    /// load this is at least zero until the attraction has exceeded the load.
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
    bool attracted_ = false; ///< the attraction has exceeded the load
    double strongest_ = 0.0; ///< strongest attraction of the segment so far
};

} // namespace asperity
