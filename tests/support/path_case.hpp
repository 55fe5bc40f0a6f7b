// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Quasi-static paths of small contacts, and flat on flat as a problem in one dimension.
#pragma once

#include "engine/case/flat_reference.hpp"
#include "engine/statics/quasistatic.hpp"
#include "support/cases.hpp"

#include <boost/math/tools/minima.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

namespace asperity::test {

/// The paper's interface with a wall in place of the atoms.
inline InterfaceOptions over(const WallLaw& wall) {
    InterfaceOptions o = paper_interface();
    o.wall = wall;
    return o;
}

enum class Friction { with, without };
/// What is held.
namespace held {
inline constexpr auto top = Constraint::Of::top, height = Constraint::Of::mean_height;
}

/// Makes all points of a segment that was begun.
inline std::vector<StepRecord> points_of(QuasistaticPath& path) {
    std::vector<StepRecord> points = {path.now()};
    for (auto o = QuasistaticPath::Outcome::point; o == QuasistaticPath::Outcome::point;) {
        o = path.advance();
        points.push_back(path.now());
        if (points.size() > 20000) throw std::runtime_error("no end");
    }
    return points;
}

/// A path that keeps the numbers of the last segment of each kind.
class KeptPath : public QuasistaticPath {
public:
    using QuasistaticPath::advance;
    using QuasistaticPath::QuasistaticPath;

    /// A new segment.
    void lead(const Segment& segment) {
        if (begun_) ended_[static_cast<std::size_t>(kind_)] = here();
        kind_ = segment.kind;
        begin(segment, begun_++);
    }
    /// Of a segment of this kind, which begins with it where another was under way.
    Outcome advance(Segment::Kind kind) {
        if (!begun_ || kind != kind_) lead({kind, 0.0, 0, ""});
        return QuasistaticPath::advance();
    }
    double work(Segment::Kind kind) const { return of(kind).work; } ///< on the block, eV
    double uncertainty(Segment::Kind kind) const { return of(kind).uncertainty; }
    double lost(Segment::Kind kind) const { return of(kind).lost; } ///< eV

private:
    struct Numbers {
        double work = 0.0, uncertainty = 0.0, lost = 0.0;
    };
    Numbers here() const {
        return {QuasistaticPath::work(), QuasistaticPath::uncertainty(), in_segment()[Term::lost]};
    }
    Numbers of(Segment::Kind kind) const {
        return begun_ && kind == kind_ ? here() : ended_[static_cast<std::size_t>(kind)];
    }
    std::size_t begun_ = 0; ///< segments
    Segment::Kind kind_ = Segment::approach;
    std::array<Numbers, Segment::kinds> ended_{};
};

/// A block over a surface, and the path of equilibria.
struct PathCase {
    BlockOptions options;
    Surface surface;
    ProcessGrid grid = serial_grid(options);
    Interface interface;
    SpectralBlock block;

    PathCase(const BlockOptions& o, Surface s, Friction friction = Friction::with)
        : options(o), surface(std::move(s)),
          interface(surface, grid.tile(0), o.spacing, paper_interface()),
          block(o, Communicator(), friction == Friction::without) {}
    /// Over a wall.
    PathCase(const BlockOptions& o, Surface s, const WallLaw& wall)
        : PathCase(o, std::move(s), over(wall)) {}
    PathCase(const BlockOptions& o, Surface s, const InterfaceOptions& wall)
        : options(o), surface(std::move(s)), interface(surface, grid.tile(0), o.spacing, wall),
          block(o, Communicator(), true) {}

    KeptPath path(double tolerance, double step = 0.25, double load = 0.0,
                  Constraint::Of along = Constraint::Of::top) {
        PathOptions p;
        p.along = along;
        p.step = step;
        p.tolerance = tolerance;
        p.scales = paper_scales();
        p.load = load;
        return KeptPath(block, interface, p);
    }
    /// At the end of its approach.
    KeptPath approached(double tolerance, double step = 0.25, double load = 0.0,
                        Constraint::Of along = Constraint::Of::top);
    /// From where the block is, to its end.
    RelaxedState relax(const Constraint& constraint, double tolerance, RelaxOptions how = {}) {
        how.tolerance = tolerance;
        how.scales = paper_scales();
        Phases phases;
        const RelaxedState s = asperity::relax(block, interface, constraint, how, phases);
        EXPECT_TRUE(s.converged) << s.residual << " at " << constraint.value;
        return s;
    }
    double sites() const { return static_cast<double>(options.sites) * options.sites; }
    /// Of the whole block under uniform stretch, eV/Å^2.
    double stretch_stiffness() const {
        return (options.lame() + 2.0 * options.shear_modulus()) * sites() * options.spacing /
               options.thickness;
    }
};

/// All points of a new segment.
inline std::vector<StepRecord> follow(KeptPath& path, const Segment& segment) {
    path.lead(segment);
    std::vector<StepRecord> points = {path.now()};
    using Outcome = QuasistaticPath::Outcome;
    for (Outcome o = Outcome::point; o == Outcome::point;) {
        o = path.QuasistaticPath::advance();
        points.push_back(path.now());
        if (points.size() > 5000) ADD_FAILURE() << "no end";
        if (points.size() > 5000) break;
    }
    return points;
}

inline std::vector<StepRecord> follow(KeptPath& path, Segment::Kind kind) {
    return follow(path, {kind, 0.0, 0, ""});
}

inline KeptPath PathCase::approached(double tolerance, double step, double load,
                                     Constraint::Of along) {
    KeptPath approach = path(tolerance, step, load, along);
    approach.start();
    follow(approach, Segment::approach);
    return approach;
}

/// The first instability of an approach that has been started, and the point before it; the path
/// has then passed it. One of no more than `least`, eV, does not count: just before a fold the
/// force on the mean height changes so steeply that a step may miss some 1e-5 of what the fall
/// loses.
struct FirstFall {
    StepRecord before;
    Instability fall;
};
inline FirstFall first_fall(KeptPath& path, double least = 0.0) {
    for (;;) {
        const StepRecord before = path.now();
        const std::size_t known = path.dissipation().jumps.size();
        EXPECT_EQ(path.advance(Segment::approach), QuasistaticPath::Outcome::point);
        const std::vector<Instability>& jumps = path.dissipation().jumps;
        if (jumps.size() > known && jumps.back().energy > least) return {before, jumps.back()};
    }
}

/// The strongest attraction of points.
inline double strongest_of(const std::vector<StepRecord>& points) {
    double strongest = 0.0;
    for (const StepRecord& r : points)
        strongest = std::max(strongest, -r.force);
    return strongest;
}

/// Of a record or a relaxed state.
inline double energy(const auto& r) { return r[Term::interface] + r[Term::elastic]; }

/// Flat on flat as one coordinate: N^2 sites at gap z on the spring of the block.
struct OneDimension {
    const PathCase& c;
    double force(double z) const { return c.sites() * pair(z).force[2]; }
    double potential(double z) const { return c.sites() * pair(z).energy; }
    /// Where pairs of a flat layer leave the cutoff together, the force jumps: by this much within
    /// 1e-3 Å of z. A point may stand in the jump, some pairs in reach and some not.
    double jump(double z) const {
        constexpr double h = 1e-3;
        const double across = force(z + h) - force(z - h);
        const double beside = force(z + 2 * h) - force(z + h) + force(z - h) - force(z - 2 * h);
        return std::abs(across - beside); // of a smooth force third differences, h^3
    }
    /// Displacement of the top plane at which z is an equilibrium.
    double top(double z) const {
        return z - c.interface.start_height() - force(z) / c.stretch_stiffness();
    }
    double total(double z, double top_at) const {
        const double stretch = z - c.interface.start_height() - top_at;
        return potential(z) + 0.5 * c.stretch_stiffness() * stretch * stretch;
    }
    /// The z in [from, to] where top() is least (sign 1) or greatest (-1): d force/dz = spring.
    double turning_point(double from, double to, double sign) const {
        double best = from;
        for (double z = from; z < to; z += 1e-3)
            if (sign * top(z) < sign * top(best)) best = z;
        return boost::math::tools::brent_find_minima([&](double z) { return sign * top(z); },
                                                     best - 1e-3, best + 1e-3,
                                                     std::numeric_limits<double>::digits)
            .first;
    }
    /// The equilibrium at this top between from and to.
    double other(double top_at, double from, double to) const {
        const bool rising = top(to) > top(from);
        for (int i = 0; i < 80; ++i) {
            const double z = 0.5 * (from + to);
            ((top(z) < top_at) == rising ? from : to) = z;
        }
        return 0.5 * (from + to);
    }

private:
    PairSum pair(double z) const {
        return flat_pair_sum(c.interface.options(), c.options.spacing, c.options.sites,
                             c.options.sites, z);
    }
};

} // namespace asperity::test
