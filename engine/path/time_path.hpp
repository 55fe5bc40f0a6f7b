// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A dynamic path: a simulation, the drive, which moves its top and observes each step, and the
// works of the segments.
#pragma once

#include "engine/dynamics/approach_start.hpp"
#include "engine/dynamics/drive.hpp"
#include "engine/dynamics/simulation.hpp"
#include "engine/path/checkpoint.hpp"
#include "engine/path/path.hpp"

#include <array>
#include <optional>

namespace asperity {

/// A dynamic path.
class TimePath : public Path {
public:
    /// Places the undeformed block at the start of the path. With a temperature the path starts
    /// beyond the interaction range, so that the thermostat warms the block before contact.
    /// Collective.
    TimePath(const Case& c, const Surface& surface, const Communicator& ranks);

    /// Makes a time step with the top plane moved by the caller instead of the drive. No segment
    /// ends with such a step; a segment that had ended before is concluded next. Collective.
    void step(const TopMotion& motion, const Wish& wish);
    /// Relaxes a copy of the lowest layer at zero load, starting from its present displacements.
    /// Returns nothing if the watch stopped the relaxation. Collective.
    std::optional<LayerAtRest> state_from_here();

    const StepRecord& now() const override { return simulation_.now(); }
    long long steps() const override { return simulation_.steps(); }
    std::size_t segment() const override { return segment_; }
    VectorPlane<const double> layer() const override { return layer_.plane(0); }
    VectorPlane<const double> velocities() const override { return velocities_.plane(0); }
    const Interface& interface() const override { return simulation_.interface(); }
    const ProcessGrid& grid() const override { return simulation_.block().grid(); }
    const Communicator& communicator() const override { return simulation_.communicator(); }
    bool has_short_steps() const override { return true; }
    std::string position() const override;
    const Phases* phases() const override { return &simulation_.phases(); }
    std::size_t bytes() const override {
        return simulation_.block().bytes() + simulation_.interface().bytes();
    }
    Remedy remedy() const override;
    Simulation& simulation() { return simulation_; }
    const Simulation& simulation() const { return simulation_; }
    const Drive& drive() const { return drive_; }

    void collect(CollectNumbers& numbers) const override { numbers.members_of(*this); }
    std::vector<StateArray> arrays() const override { return state_of(simulation_.block()); }
    void restore(RestoreNumbers& numbers) override { visit(numbers); }
    std::vector<RestoredArray> arrays_to_restore() override {
        return state_to_restore(simulation_.block_to_write());
    }
    void restored() override { simulation_.block_to_write().exchange(); }

    /// Passes the numbers to a visitor, for checkpoints.
    template <class Visitor>
    void visit(Visitor& v) {
        Path::visit(v);
        v("simulation", simulation_);
        v("drive", drive_);
        v("segment", segment_);
        v("end", end_);
        v("scatter", scatter_);
        v("start", start_);
        v("kinetic_at_full_speed", kinetic_at_full_speed_);
        v("segment_start", segment_start_);
        v("interface_work", interface_work_);
    }

private:
    std::optional<Status> make_next(const Wish& wish) override;
    bool make_behind_end(const Wish& wish) override;
    /// Relaxes a copy of the lowest layer at zero load; the block is not changed.
    std::optional<LayerAtRest> find_state() override;
    void conclude() override;
    void make_step(const TopMotion& motion, const Wish& wish);
    void copy_fields(const Wish& wish);
    std::optional<LayerAtRest> state_at(const std::array<double, 2>& place);
    bool end_segment_if_met(const StepRecord& now);
    Works so_far() const;
    static Works at_rest_apart(Works works, double bound, double moving);
    double kinetic_as_top(double time) const;

    Simulation simulation_;
    Drive drive_;
    ApproachStart start_;
    std::size_t segment_ = 0;
    /// Kinetic energy of the whole block moving at the drive's velocity, eV.
    double kinetic_at_full_speed_ = 0.0;
    Works segment_start_;           ///< works from the start to the beginning of the segment
    double interface_work_ = 0.0;   ///< int F dz up to the end of the last segment, eV
    StepRecord end_;                ///< the step that ended the last segment
    std::optional<double> scatter_; ///< SegmentResults::scatter of the last segment, eV/Å
    /// Displacements and velocities at now(), if wished for.
    VectorField<double> layer_, velocities_;
};

} // namespace asperity
