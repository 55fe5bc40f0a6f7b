// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The course of a path, for progress: the part that is done, and the time that the rest will take.
// A segment that has ended tells what its kind takes, and an approach also where its time went: the
// pull-off passes the same heights again. Before that a model says where: of a dynamic path in
// proportion to the time of the drive; of a quasi-static one mostly within the range of the
// roughness and the attraction, where steps are short and relaxations long.
#pragma once

#include "engine/path/expected_path.hpp"
#include "engine/step_record.hpp"

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace asperity {

/// Course of a path in the time that the run takes.
class Course {
public:
    /// Begins the course of a case. rms: of the surface, start: height of the lowest layer at the
    /// start, Å.
    Course(const Case& c, double rms, double start);
    /// Looks at a step or point in a segment. seconds: time since the run began or was resumed, s;
    /// it never falls.
    void look(std::size_t segment, const StepRecord& now, double seconds);
    /// Returns the part of the whole time that has passed, 0 to 0.99. It never falls.
    double fraction() const { return fraction_; }
    /// Returns the time left, s; negative: not known yet. It follows a changed estimate within a
    /// part of the time so far, and grows by three seconds a second at most.
    double left() const { return left_; }

private:
    void begin(std::size_t segment, const StepRecord& now, double seconds);
    double part_done(const StepRecord& now, double seconds);
    double part_of_approach(const StepRecord& now);
    double part_of_pull_off(const StepRecord& now) const;
    double place(const StepRecord& now) const;
    double profile(double place) const;
    double rate(Segment::Kind kind) const;
    double rest(double part, double seconds) const;
    double rest_of_drive(const StepRecord& now, double seconds) const;

    const Case& case_;
    ExpectedPath expected_;
    double reach_;                ///< range of roughness and attraction, Å
    double contact_;              ///< expected mean height in contact, Å
    std::vector<double> weights_; ///< expected times of the segments, in one unit
    std::size_t segment_ = 0;     ///< number of the segment under way
    bool begun_ = false;
    double start_time_ = 0.0;    ///< simulated time when the path was first seen, fs
    StepRecord first_{};         ///< record at the beginning of the segment
    double first_seconds_ = 0.0; ///< wall time of the path at first_, s
    bool whole_ = false;         ///< the segment was seen from its beginning
    double strongest_ = 0.0;     ///< largest attraction of an approach so far, eV/Å
    double part_ = 0.0;          ///< part of the segment that is done; it never falls
    /// Weights and seconds of the segments that have ended, by kind.
    std::array<std::pair<double, double>, Segment::kinds> ended_{};
    /// Seconds of the last approach down to falling places (Å).
    std::vector<std::pair<double, double>> descent_;
    double base_ = 0.0; ///< part that was done when the path was first seen
    double fraction_ = 0.0, left_ = -1.0, last_seconds_ = 0.0;
};

} // namespace asperity
