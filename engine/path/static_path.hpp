// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A path of states of force balance: the points of a quasi-static path (quasistatic.hpp), segment
// by segment. A segment "relax" is one relaxation with the top plane free, which leaves the block
// in its state.
#pragma once

#include "engine/path/path.hpp"
#include "engine/statics/quasistatic.hpp"

#include <algorithm>
#include <optional>

namespace asperity {

/// A quasi-static path.
class StaticPath : public Path {
public:
    /// Places the block beyond the interaction range. Collective.
    StaticPath(const Case& c, const Surface& surface, const Communicator& ranks);

    const StepRecord& now() const override { return points_ ? points_->now() : before_first_; }
    long long steps() const override { return now().step; }
    std::size_t segment() const override { return concluded(); }
    VectorPlane<const double> layer() const override { return block_.lowest_layer(); }
    const Interface& interface() const override { return interface_; }
    const ProcessGrid& grid() const override { return grid_; }
    const Communicator& communicator() const override { return block_.communicator(); }
    std::string position() const override;
    std::optional<long long> iterations() const override;
    std::size_t bytes() const override { return block_.bytes() + interface_.bytes(); }
    void free_workspace() const override { block_.workspace()->free_kept(); }
    Remedy remedy() const override;
    /// Returns the reason and remedy for points whose energy balance is violated.
    static Remedy remedy_of_points();
    const SpectralBlock& block() const { return block_; }

    void collect(CollectNumbers& numbers) const override { numbers.members_of(*this); }
    std::vector<StateArray> arrays() const override;
    void restore(RestoreNumbers& numbers) override { visit(numbers); }
    std::vector<RestoredArray> arrays_to_restore() override;
    void restored() override;

    /// Passes the numbers to a visitor, for checkpoints.
    template <class Visitor>
    void visit(Visitor& v) {
        Path::visit(v);
        double top = block_.drive();
        bool on_points = points_.has_value();
        v("top", top);
        v("on_points", on_points);
        if constexpr (Visitor::restores) {
            top_restored_ = top;
            if (on_points) make_points();
        }
        if (on_points) v("points", *points_);
    }

private:
    /// Makes the next point. The first point of a path, and the first one after a state, is the
    /// present state of the block.
    std::optional<Status> make_next(const Wish& wish) override;
    std::optional<LayerAtRest> find_state() override;
    void conclude() override;
    void make_points();
    void record_slide();
    SlideAverage::Lengths lengths() const {
        const SurfaceOptions& map = case_.surface;
        const bool known = case_.simulation.block.continuum && map.kind == SurfaceKind::self_affine;
        return {correlation_length(surface_), block_.options().spacing,
                known ? map.length / std::min(map.cutoff, 0.5 * map.sites) : 0.0};
    }
    /// Updates results.edge_distance with the present contact. Collective.
    void look_at_edges();
    void look_at_heights();

    const ProcessGrid grid_;
    Interface interface_;
    SpectralBlock block_;
    std::optional<QuasistaticPath> points_;
    StepRecord before_first_; ///< record before the first point
    double top_restored_ = 0.0;
};

} // namespace asperity
