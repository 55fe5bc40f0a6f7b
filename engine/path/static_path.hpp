// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A path of states of force balance: the points of a quasi-static path (quasistatic.hpp), segment
// by segment. A segment "relax" is one relaxation with the top plane free: find_state() leaves the
// block in its state.
//
// By hand: the caller leads the block to a place or a load, in place of the scene's segments.
#pragma once

#include "engine/path/path.hpp"
#include "engine/statics/quasistatic.hpp"

#include <optional>

namespace asperity {

/// A quasi-static path.
class StaticPath : public Path {
public:
    /// Places the block beyond the interaction range. Collective.
    StaticPath(const Case& c, const Surface& surface, const Communicator& ranks);

    bool done() const override { return segment_ == case_.path().size(); }
    /// Makes the next point. The first point of a path, and the first one after a state, is the
    /// present state of the block.
    Made advance(const Wish& wish) override;
    std::optional<std::size_t> ended() const override;
    bool at_end() const override { return at_end_; }
    std::optional<LayerAtRest> find_state() override;
    void conclude() override;
    bool relaxes_freely() const override { return !done() && kind() == Segment::relax; }

    const StepRecord& now() const override { return points_ ? points_->now() : nowhere_; }
    long long steps() const override { return now().step; }
    std::size_t segment() const override { return segment_; }
    VectorPlane<const double> layer() const override { return block_.lowest_layer(); }
    Interface& interface() override { return interface_; }
    const Interface& interface() const override { return interface_; }
    double reference_height() const override { return interface_.start_height(); }
    const ProcessGrid& grid() const override { return grid_; }
    const Communicator& communicator() const override { return block_.communicator(); }
    std::string position() const override;
    std::optional<long long> iterations() const override;
    std::size_t bytes() const override { return block_.bytes() + interface_.bytes(); }
    Remedy remedy() const override;
    SpectralBlock& block() { return block_; }
    const SpectralBlock& block() const { return block_; }

    void collect(CollectNumbers& numbers) override { visit(numbers); }
    void restore(RestoreNumbers& numbers) override { visit(numbers); }
    std::vector<StateArray> arrays() override;
    void restored() override;

    // Functions of a path led by hand.

    /// Returns the points, nullptr before a path of points has begun.
    const QuasistaticPath* points() const { return points_ ? &*points_ : nullptr; }
    /// Begins a path by hand with this held quantity. remembers: the path begins with the block as
    /// it is (works count from there), with the memory of its branches (true) or relaxed (false);
    /// empty: beyond the interaction range.
    void begin_by_hand(Constraint::Of held, std::optional<bool> remembers);
    /// Leads the block to a displacement of the held quantity, Å, point by point, and calls look
    /// after each point. Returns false if the watch stopped a relaxation; the same call goes on.
    bool lead_to(double at, const std::function<void()>& look);
    /// Leads the block along a segment (amounts as in QuasistaticPath::begin()), point by point,
    /// and calls look after each point. Returns false if the watch stopped a relaxation; the same
    /// call goes on.
    bool lead(const Segment& segment, const std::function<void()>& look);
    /// The last point of a path by hand, to come back to.
    struct KeptPoint {
        StateCopy fields;
        StateNumbers numbers;
    };
    /// Returns the last point.
    KeptPoint keep_point();
    /// Brings block and path back to a point.
    void back_to(const KeptPoint& point);
    /// Ends the path of points: the caller may now move the block.
    void end_points() { points_.reset(); }
    /// Relaxes the sites from their present places (from_afar: from the height of the strongest
    /// attraction) under a load, eV/Å. The block is in the found state afterwards. Returns nothing
    /// if the watch stopped the relaxation.
    std::optional<ZeroLoad> state_from_here(double load, bool from_afar);

private:
    template <class Visitor>
    void visit(Visitor& v) {
        double top = block_.top();
        bool on_points = points_.has_value();
        v("top", top);
        v("segment", segment_);
        v("begun", begun_);
        v("at_end", at_end_);
        v("on_points", on_points);
        v("ledger", ledger_);
        v("results", results_);
        if constexpr (Visitor::restores) {
            top_restored_ = top;
            if (on_points) make_points(held_of(case_));
        }
        if (on_points) v("points", *points_);
    }
    static Constraint::Of held_of(const Case& c);
    Segment::Kind kind() const { return case_.path()[segment_].kind; }
    void make_points(Constraint::Of held);
    bool lead(const std::function<void()>& look);

    const ProcessGrid grid_;
    Interface interface_;
    SpectralBlock block_;
    std::optional<QuasistaticPath> points_;
    StepRecord nowhere_;      ///< record before the first point
    std::size_t segment_ = 0; ///< number of the current segment
    bool begun_ = false;      ///< the current segment has begun
    bool at_end_ = false;     ///< the current segment has ended and is to be concluded
    bool resumed_ = false;    ///< the block is where a relaxation was interrupted
    double top_restored_ = 0.0;
};

} // namespace asperity
