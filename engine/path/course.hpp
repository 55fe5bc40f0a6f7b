// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The course of a path, for progress: the part that is done, and the time that is left.
// The time of a segment is estimated from the last ended segment of its kind. The time of a
// pull-off is spread over the heights as that of the approach was, because both pass the same
// heights. Until a segment has ended, a model spreads the time: in proportion to the time of the
// drive on a dynamic path; on a quasi-static path mostly within the range of the roughness and the
// attraction, where steps are short and relaxations long.
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
    /// Begins the course of a case. rms: rms height of the surface, Å; start: height of the lowest
    /// layer at the start, Å.
    Course(const Case& c, double rms, double start);
    /// Updates the course with a step or point of a segment. seconds: time since the run began or
    /// was resumed, s, which never decreases.
    void look(std::size_t segment, const StepRecord& now, double seconds);
    /// Returns the part of the whole time that has passed, 0 to 0.99, which never decreases.
    double fraction() const { return fraction_; }
    /// Returns the estimated time left, s; negative if no estimate exists yet. A changed estimate
    /// is approached gradually; the time left grows by three seconds a second at most.
    double left() const { return left_; }

private:
    void begin(std::size_t segment, const StepRecord& now, double seconds);
    double part_done(const StepRecord& now, double seconds);
    double part_of_approach(const StepRecord& now);
    double part_of_pull_off(const StepRecord& now) const;
    double place(const StepRecord& now) const;
    double profile(double place) const;
    double rate(Segment::Kind kind) const;
    double time_left(double part, double seconds) const;
    double time_left_of_drive(const StepRecord& now, double seconds) const;

    const Case& case_;
    ExpectedPath expected_;
    double reach_;                ///< range of roughness and attraction, Å
    double contact_;              ///< expected mean height in contact, Å
    std::vector<double> weights_; ///< expected times of the segments, in one unit
    std::size_t segment_ = 0;     ///< number of the segment under way
    bool begun_ = false;
    double start_time_ = 0.0;     ///< simulated time when the path was first seen, fs
    StepRecord first_{};          ///< record at the beginning of the segment
    double first_seconds_ = 0.0;  ///< wall time of the path at first_, s
    bool from_beginning_ = false; ///< look() has followed the segment from its beginning
    double strongest_ = 0.0;      ///< largest attraction of an approach so far, eV/Å
    double part_ = 0.0;           ///< part of the segment that is done, which never decreases
    /// Weights and seconds of the segments that have ended, by kind.
    std::array<std::pair<double, double>, Segment::kinds> ended_{};
    /// Course of the last approach: decreasing heights, Å, and seconds until each.
    std::vector<std::pair<double, double>> descent_;
    double base_ = 0.0; ///< part that was done when the path was first seen
    double fraction_ = 0.0, left_ = -1.0, last_seconds_ = 0.0;
};

} // namespace asperity
