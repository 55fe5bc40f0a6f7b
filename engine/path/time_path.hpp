// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A dynamic path: a simulation, its drive, which observes each step, and the works of the segments.
#pragma once

#include "engine/dynamics/approach_start.hpp"
#include "engine/dynamics/simulation.hpp"
#include "engine/path/path.hpp"

#include <array>
#include <optional>

namespace asperity {

/// A dynamic path.
class TimePath : public Path {
public:
    /// Places the undeformed block at the start of the path. With a temperature the path starts
    /// beyond the interaction range, so that the thermostat warms the block on its way down.
    TimePath(const Case& c, const Surface& surface, const Communicator& ranks);

    bool done() const override { return !ended_ && !concluding_ && simulation_.drive().done(); }
    Made advance(const Wish& wish) override;
    std::optional<std::size_t> ended() const override { return concluding_; }
    bool at_end() const override { return ended_.has_value(); }
    bool about_to_conclude() const override { return at_end(); }
    /// Relaxes a copy of the lowest layer under no load; the block is not changed.
    std::optional<LayerAtRest> find_state() override;
    void conclude() override;
    /// Relaxes a copy of the lowest layer from its present place at zero load.
    LayerAtRest state_from_here();

    const StepRecord& now() const override { return simulation_.now(); }
    long long steps() const override { return simulation_.steps(); }
    std::size_t segment() const override { return segment_; }
    VectorPlane<const double> layer() const override { return layer_.plane(0); }
    VectorPlane<const double> velocities() const override { return velocities_.plane(0); }
    const Interface& interface() const override { return simulation_.interface(); }
    Interface& interface() override { return simulation_.interface(); }
    double reference_height() const override { return simulation_.reference_height(); }
    const ProcessGrid& grid() const override { return simulation_.block().grid(); }
    const Communicator& communicator() const override { return simulation_.communicator(); }
    std::string position() const override;
    const Phases* phases() const override { return &simulation_.phases(); }
    std::size_t bytes() const override {
        return simulation_.block().bytes() + simulation_.interface().bytes();
    }
    Remedy remedy() const override;
    Simulation& simulation() { return simulation_; }
    const Simulation& simulation() const { return simulation_; }

    void collect(CollectNumbers& numbers) override { visit(numbers); }
    void restore(RestoreNumbers& numbers) override { visit(numbers); }
    std::vector<StateArray> arrays() override;
    void restored() override { simulation_.block_to_write().exchange(); }

private:
    template <class Visitor>
    void visit(Visitor& v) {
        v("simulation", simulation_);
        v("segment", segment_);
        v("end", end_);
        v("scatter", scatter_);
        v("ended", ended_);
        v("concluding", concluding_);
        v("start", start_);
        v("kinetic_at_full_speed", kinetic_at_full_speed_);
        v("segment_start", segment_start_);
        v("interface_work", interface_work_);
        v("ledger", ledger_);
        v("results", results_);
    }
    void keep(const Wish& wish);
    LayerAtRest state_at(const std::array<double, 2>& place);
    std::optional<std::size_t> tell_drive(const StepRecord& now);
    Works so_far() const;
    static Works at_rest_apart(Works works, double bound, double moving);
    double kinetic_as_top(double time) const;

    Simulation simulation_;
    ApproachStart start_;
    std::size_t segment_ = 0;
    /// Kinetic energy of the whole block at the drive's velocity, eV
    double kinetic_at_full_speed_ = 0.0;
    Works segment_start_;              ///< works since the start at the beginning of the segment
    double interface_work_ = 0.0;      ///< int F dz up to the end of the last segment, eV
    StepRecord end_;                   ///< the step that ended the last segment
    std::optional<double> scatter_;    ///< SegmentResults::scatter of the last segment, eV/Å
    std::optional<std::size_t> ended_; ///< the segment that the last step ended
    std::optional<std::size_t> concluding_;  ///< the segment that ended in the step before
    VectorField<double> layer_, velocities_; ///< at now(), if they were wished for
};

} // namespace asperity
