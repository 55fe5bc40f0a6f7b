// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/path/static_path.hpp"

#include "engine/scene/map_statistics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace asperity {

StaticPath::StaticPath(const Case& c, const Surface& surface, const Communicator& ranks)
    : Path(c, surface), grid_(c.grid(ranks.rank())),
      interface_(surface, grid_.tile(0), c.simulation.block.spacing, c.simulation.interface),
      block_(c.simulation.block, ranks, !c.effects.lateral) {
    remember_sites(block_, interface_);
    before_first_.mean_height = interface_.reference_height();
    if (!interface_.yielding_wall()) return;
    const double a = c.simulation.block.spacing;
    const MapStatistics before =
        map_statistics(surface.height, surface.bands(), a, a, !c.effects.free_edges);
    results_.unyielded_rms = before.rms_height;
    results_.unyielded_slope = before.rms_slope;
}

void StaticPath::make_points() {
    points_.emplace(block_, interface_,
                    path_options(case_, interface_, [this](long long iteration, double residual) {
                        return stopped_by_watch(iteration, residual);
                    }));
}

std::optional<Path::Status> StaticPath::make_next(const Wish&) {
    if (status() == Status::beginning) {
        if (segment_to_conclude().kind == Segment::relax) {
            place_for_relaxation(block_, interface_, surface_, case_);
            return Status::relaxing;
        }
        const bool first = segment() == 0;
        const bool from_state = !first && case_.path()[segment() - 1].kind == Segment::relax;
        if (first || from_state) make_points();
        if (first) points_->start();
        if (from_state) points_->start_here({.from_apart = true});
        points_->begin(case_.path()[segment()], segment());
        if (case_.path()[segment()].kind == Segment::slide && interface_.wall()) record_slide();
        if (first || from_state) return Status::under_way;
    }
    const long long before = now().step;
    const QuasistaticPath::Outcome outcome = points_->advance();
    if (outcome == QuasistaticPath::Outcome::interrupted) return std::nullopt;
    results_.dissipated = points_->dissipation();
    if (now().step == before) return Status::already_at_end;
    const Segment& segment = segment_to_conclude();
    results_.record_force(segment, now());
    look_at_edges();
    if (segment.kind == Segment::slide && interface_.wall()) {
        record_slide();
        if (segment.until_steady && results_.slide.is_steady(lengths())) return Status::at_end;
    }
    return outcome == QuasistaticPath::Outcome::point ? Status::under_way : Status::at_end;
}

/// Adds the last point to the means of the slide.
void StaticPath::record_slide() {
    SlidePoint point{.distance = points_->way(),
                     .flows = points_->in_segment(),
                     .load = now().force,
                     .in_contact = static_cast<double>(now().in_contact),
                     .contact_edges =
                         static_cast<double>(interface_.contact_edges(layer(), communicator())),
                     .mean_height = now().mean_height,
                     .work_left_out = points_->work_left_out()};
    point.flows[Term::work] = points_->lateral_work();
    results_.slide.add(point);
}

void StaticPath::look_at_edges() {
    if (interface_.sites_across() == interface_.tile().sites) return; // the substrate has no edges
    const auto in_contact = interface_.contact_test(layer());
    const int n = interface_.sites_across(), first = interface_.tile().y0;
    int nearest = n;
    for (int y = 0; y < interface_.tile().ny && first + y < n; ++y)
        for (int x = 0; x < n; ++x)
            if (in_contact(x, y))
                nearest = std::min({nearest, x, n - 1 - x, first + y, n - 1 - first - y});
    const double all = -communicator().max(-static_cast<double>(nearest));
    if (!(all < n)) return;
    const double distance = all * case_.simulation.block.spacing;
    results_.edge_distance = std::min(results_.edge_distance.value_or(distance), distance);
}

std::optional<LayerAtRest> StaticPath::find_state() {
    const bool held = segment_to_conclude().kind != Segment::relax;
    if (held) points_->put_back(); // the same state as after a resume, bitwise
    const std::optional<ZeroLoad> found =
        find_zero_load(block_, interface_, held ? 0.0 : case_.simulation.drive.load_force, case_,
                       [this](long long iteration, double residual) {
                           return stopped_by_watch(iteration, residual);
                       });
    LayerAtRest state;
    if (found) look_at_edges();
    if (found) {
        // A path that starts in a state comes back to another; its numbers are of the first.
        if (!results_.zero_load || !case_.starts_with(Segment::relax)) results_.zero_load = found;
        state.numbers = found;
        if (held) {
            state.layer = VectorField<double>(grid_.tile(0), 1);
            copy_layer(layer(), state.layer.plane(0));
        }
    }
    if (held) points_->put_back();
    if (!found) return std::nullopt;
    return state;
}

void StaticPath::conclude() {
    const Segment::Kind kind = segment_to_conclude().kind;
    if (kind == Segment::relax) return;
    const bool slide = kind == Segment::slide;
    Works works{.flows = points_->in_segment(),
                .lateral = slide ? points_->lateral_work() : 0.0,
                .stored = points_->stored(),
                .uncertainty = points_->uncertainty()};
    // The force of the holder of a mean height is that of the interface.
    works.flows[Term::work_of_interface] = works.lateral - points_->work();
    if (slide && interface_.wall()) {
        works.flows[Term::work_of_interface] += points_->settling_work();
        if (segment_to_conclude().until_steady && case_.effects.branches)
            works.settling = points_->settling_work();
        works.distance = points_->way();
        works.steady = results_.slide.means(lengths());
    }
    ledger_.conclude(segment(), now(), works, {});
    if (interface_.wall())
        results_.segments.back().area =
            contact_sites(static_cast<double>(now().in_contact),
                          static_cast<double>(interface_.contact_edges(layer(), communicator())));
    if (interface_.yielding_wall()) look_at_heights();
}

/// Adds the statistics of the yielded heights to the results of the last segment.
void StaticPath::look_at_heights() {
    const int n = interface_.sites_across();
    const Tile& tile = interface_.tile(); // whole rows, in the order of the ranks
    const int rows = std::clamp(n - tile.y0, 0, tile.ny);
    std::vector<double> heights;
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < n; ++x)
            heights.push_back(interface_.wall()->below(x, y));
    const Bands bands = Bands::of_rows(communicator(), n, rows);
    const double a = block_.options().spacing;
    const MapStatistics s = map_statistics(heights, bands, a, a, !case_.effects.free_edges);
    SegmentResults& ended = results_.segments.back();
    ended.yielded_rms = s.rms_height;
    ended.yielded_slope = s.rms_slope;
}

std::string StaticPath::position() const {
    return points_ ? fmt::format("point {}", now().step) : "an unfinished relaxation";
}

std::optional<long long> StaticPath::iterations() const {
    return points_ ? std::optional(points_->iterations()) : std::nullopt;
}

Path::Remedy StaticPath::remedy_of_points() {
    return {"steps that are too long or instabilities that were not resolved miss energy, and what "
            "they miss adds up",
            "take a smaller drive.displacement_step"};
}

/// Returns the remedy. The steps of a slide over a wall are half a spacing however short
/// drive.displacement_step is.
Path::Remedy StaticPath::remedy() const {
    Remedy remedy = remedy_of_points();
    const bool slides = segment() < case_.path().size() &&
                        case_.path()[segment()].kind == Segment::slide && interface_.wall();
    if (slides)
        remedy.fix = fmt::format("take drive.tolerance = {:.2g} or less",
                                 0.1 * case_.tolerance / case_.scales.force);
    return remedy;
}

std::vector<StateArray> StaticPath::arrays() const {
    return points_ ? points_->arrays() : state_of(block_);
}

std::vector<RestoredArray> StaticPath::arrays_to_restore() {
    return points_ ? points_->arrays_to_restore() : state_to_restore(block_);
}

void StaticPath::restored() {
    if (points_) {
        points_->restored();
        results_.dissipated = points_->dissipation();
    } else {
        block_.hold(Constraint::top(top_restored_));
    }
}

} // namespace asperity
