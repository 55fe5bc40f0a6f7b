// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A simulation whose top plane the drive of its options moves, without the path around them.
#pragma once

#include "engine/dynamics/drive.hpp"
#include "engine/dynamics/simulation.hpp"

namespace asperity::test {

/// A simulation with its drive.
class Driven : public Simulation {
public:
    Driven(const SimulationOptions& options, const Surface& surface, const Communicator& ranks,
           const ProcessGrid& grid)
        : Simulation(options, surface, ranks, grid), drive_(options.drive) {}

    /// Begins anew at this height of the lowest layer, Å, moving with the drive.
    void start(double height) {
        drive_ = Drive(options().drive);
        drive_.begin_at(height);
        Simulation::start(height, drive_.motion(0.0).z);
    }
    const StepRecord& step(bool observe) {
        return Simulation::step(drive_.motion(middle_of_step()), observe);
    }
    Drive& drive() { return drive_; }
    const Drive& drive() const { return drive_; }

    template <class Visitor>
    void visit(Visitor& v) {
        Simulation::visit(v);
        v("drive", drive_);
    }

private:
    Drive drive_;
};

} // namespace asperity::test
