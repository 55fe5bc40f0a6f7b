// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/run/path_maps.hpp"

#include "engine/run/observers.hpp"
#include "engine/run/run_session.hpp"
#include "engine/units.hpp"

#include <fmt/format.h>

#include <utility>

namespace asperity {

PathMaps::PathMaps(RunSession& session) : session_(session), times_(session.scene_case().maps) {
    if (times_.pull_off) layer_ = VectorField<double>(session.grid().tile(0), 1);
}

bool PathMaps::is_due(long long step) const { return times_.every && step % *times_.every == 0; }

/// Returns true from the step after the end of the approach on, at the times of the scene.
bool PathMaps::delayed_is_due(const Path& path, double time) const { // fs
    const std::optional<double>& contact = path.results().contact_made;
    if (delayed_written_ == times_.after_approach.size() || !contact || time <= *contact)
        return false;
    return time >= *contact + times_.after_approach[delayed_written_].first * units::picosecond;
}

Path::Wish PathMaps::wish(const Path& path) const {
    const double next = static_cast<double>(path.steps()) * session_.scene_case().simulation.dt;
    // The end of a segment is known only after the step.
    return {.layer = times_.segments || (times_.pull_off && row_is_due(path)) ||
                     is_due(path.steps()) || delayed_is_due(path, next)};
}

void PathMaps::look_at_step(const Path& path) {
    const StepRecord& now = path.now();
    const Segment::Kind kind = path.scene_case().path()[path.segment()].kind;
    if (is_due(now.step)) write(path, fmt::format("step-{}", now.step), path.layer());
    while (delayed_is_due(path, now.time))
        write(path, times_.after_approach[delayed_written_++].second, path.layer());
    if (!now.observed) return;
    if (kind != Segment::pull_off) attraction_ = 0.0; // the next pull-off begins anew
    if (kind != Segment::pull_off || -now.force <= attraction_ || !times_.pull_off) return;
    attraction_ = -now.force;
    place_ = path.interface().place();
    kept_ = true;
    const auto t = session_.phases().time(Phase::output);
    copy_layer(path.layer(), layer_.plane(0));
}

void PathMaps::look_at_end(const Path& path) {
    if (times_.segments) write(path, fmt::format("segment-{}", path.segment()), path.layer());
}

void PathMaps::look_at_state(const Path& path) {
    if (times_.relaxed) write(path, "relaxed", path.state_layer());
}

void PathMaps::finish(const Path& path) {
    if (path.status() == Path::Status::done)
        for (std::size_t i = delayed_written_; i < times_.after_approach.size(); ++i)
            session_.progress().say(
                fmt::format("the maps \"{}\" were not written: the path ended before",
                            times_.after_approach[i].second));
    if (!std::exchange(kept_, false)) return;
    path.free_workspace();
    const auto write_over = [&](const Interface& interface) {
        record("pull-off", path, std::as_const(layer_).plane(0), interface);
    };
    if (place_ == path.interface().place()) return write_over(path.interface());
    // The block has slid since.
    const Interface& now = path.interface();
    Interface then(path.surface(), now.tile(), path.scene_case().simulation.block.spacing,
                   now.options());
    then.set_reference_height(now.reference_height());
    then.slide_to(place_[0], place_[1]);
    write_over(then);
}

void PathMaps::write(const Path& path, const std::string& state,
                     const VectorPlane<const double>& layer) {
    const auto t = session_.phases().time(Phase::output);
    path.free_workspace();
    record(state, path, layer, path.interface());
}

void PathMaps::record(const std::string& state, const Path& path,
                      const VectorPlane<const double>& layer, const Interface& interface) {
    session_.recorder().fields(state, layer, path.grid(), interface,
                               session_.scene_case().simulation.block);
    const Case& c = session_.scene_case();
    if (c.output.stress.points != StressPoints::none)
        session_.recorder().stresses(state, layer, path.grid(), interface, c.simulation.block,
                                     c.output.stress);
}

namespace {

/// Returns the arrays of a kept layer, none if it is empty.
template <class Array>
std::vector<Array> arrays_of(auto& layer) {
    if (layer.empty()) return {};
    return {{"/pull-off/x", 0, &layer.x, 1},
            {"/pull-off/y", 0, &layer.y, 1},
            {"/pull-off/z", 0, &layer.z, 1}};
}

} // namespace

std::vector<StateArray> PathMaps::arrays() const { return arrays_of<StateArray>(layer_); }

std::vector<RestoredArray> PathMaps::arrays_to_restore() {
    return arrays_of<RestoredArray>(layer_);
}

} // namespace asperity
