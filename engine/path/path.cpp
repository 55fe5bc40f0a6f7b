// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/path/path.hpp"

#include "engine/path/static_path.hpp"
#include "engine/path/time_path.hpp"

#include <algorithm>

namespace asperity {

bool Path::ends_in_state() const {
    const Segment::Kind kind = segment_to_conclude().kind;
    return case_.effects.relaxation && (kind == Segment::approach || kind == Segment::relax);
}

bool Path::advance(const Wish& wish) {
    switch (status_) {
    case Status::beginning:
    case Status::under_way:
        if (const std::optional<Status> made = make_next(wish)) {
            status_ = *made;
            return true;
        }
        status_ = Status::under_way; // an interrupted point belongs to a segment that has begun
        return false;
    case Status::at_end:
        if (make_behind_end(wish)) {
            status_ = Status::behind_end;
            return true;
        }
        [[fallthrough]];
    case Status::already_at_end:
    case Status::behind_end:
        if (ends_in_state()) {
            status_ = Status::relaxing;
            return true;
        }
        break;
    case Status::relaxing:
        state_ = find_state();
        if (state_) status_ = Status::at_rest;
        return state_.has_value();
    case Status::at_rest:
        state_.reset();
        break;
    case Status::done:
        return true;
    }
    conclude();
    status_ = ++concluded_ == case_.path().size() ? Status::done : Status::beginning;
    return true;
}

void Observer::look(const Path& path) {
    using Status = Path::Status;
    if (path.has_stepped()) look_at_step(path);
    if (path.status() == Status::at_end || path.status() == Status::already_at_end)
        look_at_end(path);
    if (path.status() == Status::at_rest) look_at_state(path);
    if (path.status() == Status::beginning) look_at_beginning(path);
}

std::unique_ptr<Path> path_of(const Case& c, const Surface& surface, const Communicator& ranks) {
    if (c.effects.dynamic) return std::make_unique<TimePath>(c, surface, ranks);
    return std::make_unique<StaticPath>(c, surface, ranks);
}

void copy_layer(const VectorPlane<const double>& from, const VectorPlane<double>& to) {
    for (const auto& [source, copy] :
         {std::pair{&from.x, &to.x}, {&from.y, &to.y}, {&from.z, &to.z}})
        for (int y = 0; y < copy->ny; ++y)
            std::copy_n(source->line(y), copy->nx, copy->line(y));
}

} // namespace asperity
