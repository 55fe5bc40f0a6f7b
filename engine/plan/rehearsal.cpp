// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/plan/rehearsal.hpp"

#include "engine/dynamics/simulation.hpp"
#include "engine/path/checkpoint.hpp"
#include "engine/path/static_path.hpp"
#include "engine/statics/zero_load.hpp"
#include "io/error.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <memory>
#include <optional>
#include <utility>

#include <malloc.h>
#include <omp.h>

/// Returns the allocated bytes; defined if a sanitizer has replaced malloc().
extern "C" [[gnu::weak]] std::size_t __sanitizer_get_current_allocated_bytes();

namespace asperity {

namespace {

/// Layers of a dynamic piece; of a plain lattice, each takes as much as all coarse levels together.
constexpr int most_layers = 128, most_layers_of_lattice = 48;

/// Returns the processor time of this thread, s: other load of the machine does not count.
double now() {
    std::timespec t{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}
/// Returns the shortest time of a few calls.
double shortest(const auto& work) {
    double best = HUGE_VAL;
    for (int n = 0; n < 5; ++n) {
        const double begin = now();
        work();
        best = std::min(best, now() - begin);
    }
    return best;
}

/// Returns the bytes that this process has allocated and not freed.
double allocated() {
    if (__sanitizer_get_current_allocated_bytes)
        return static_cast<double>(__sanitizer_get_current_allocated_bytes());
    const struct mallinfo2 all = ::mallinfo2();
    return static_cast<double>(all.uordblks + all.hblkhd);
}

/// Returns the case on fewer sites, on one rank and on the processor. timed: with the whole path;
/// otherwise a quasi-static one is a relaxation over atoms, and two points over a wall, where the
/// second has a solver of its own.
Case piece_of(const Case& c, int sites, bool timed) {
    Case piece = c;
    DriveOptions& drive = piece.simulation.drive;
    if (!c.effects.dynamic && !timed) {
        const bool points = std::ranges::any_of(
            c.path(), [](const Segment& segment) { return segment.kind != Segment::relax; });
        drive.path = {{c.simulation.interface.wall && points ? Segment::approach : Segment::relax}};
        drive.max_steps = 2;
    }
    piece.ranks = 1;
    piece.simulation.device = {};
    BlockOptions& block = piece.simulation.block;
    SurfaceOptions& surface = piece.surface;
    const double fraction = static_cast<double>(sites) / block.sites;
    if (c.effects.dynamic)
        block.thickness =
            std::min(block.thickness, c.levels.size() > 1 ? most_layers : most_layers_of_lattice);
    if (fraction < 1.0 && surface.kind == SurfaceKind::self_affine) {
        // Beyond the roll-off the variance of all waves that fit into a box goes with its width to
        // the power 2H.
        surface.rms *= std::pow(std::min(1.0, surface.rolloff * fraction), surface.hurst);
        surface.rolloff = std::max(1.0, surface.rolloff * fraction);
        surface.cutoff = std::max(surface.rolloff, surface.cutoff * fraction);
    }
    piece.simulation.interface.crop_site_maps(sites);
    const double ratio = static_cast<double>(block.sites) / surface.sites;
    block.sites = sites;
    surface.sites = substrate_sites(sites, ratio);
    surface.length = block.edge();
    piece.levels = level_shapes(block);
    piece.simulation.drive.load_force *= fraction * fraction;
    for (Segment& segment : piece.simulation.drive.path)
        if (segment.kind == Segment::load) segment.amount *= fraction * fraction;
    return piece;
}

/// Returns a surface in place of one from a file: a rough one, or as many atoms in flat layers.
Surface stand_in(Case piece, double rms, int atoms) {
    SurfaceOptions& s = piece.surface;
    const BlockOptions& block = piece.simulation.block;
    if (s.kind != SurfaceKind::atoms) {
        s.counter = false;
        s.kind = SurfaceKind::self_affine;
        s.rms = rms;
        return surface_of(piece);
    }
    AtomPositions at;
    for (int i = 0; i < atoms; ++i) {
        at.x.push_back(block.spacing * (i % block.sites));
        at.y.push_back(block.spacing * (i / block.sites % block.sites));
        const int layer = i / (block.sites * block.sites);
        at.z.push_back(-block.spacing * layer);
        if (!piece.types.empty()) at.type.push_back(0);
    }
    return surface_from_atoms(s, std::move(at));
}

/// Follows a path as a run does. Returns true if it came to its end.
bool follow(Path& path, const auto& stop) {
    const auto& most = path.scene_case().simulation.drive.max_steps;
    while (path.status() != Path::Status::done) {
        if (most && path.status() == Path::Status::under_way && path.steps() >= *most) break;
        if (stop() || !path.advance({})) return false;
    }
    return true;
}

/// Returns the heights under a piece of a case: generated, those of the case's file if the piece is
/// all of the case, or a stand-in.
Surface heights_of(const Case& piece, const Case& c, const Surface* of_file, double atoms) {
    if (!piece.surface.reads_file()) return surface_of(piece);
    const double part = 1.0 * piece.simulation.block.sites / c.simulation.block.sites;
    if (of_file && part == 1.0) return *of_file;
    return stand_in(piece, of_file ? of_file->statistics.rms : 1.0,
                    static_cast<int>(atoms * std::pow(part, 2)));
}

} // namespace

Piece rehearse(const Case& c, int sites, double seconds, const Surface* of_file, double atoms) {
    const bool timed = seconds > 0.0;
    const Case piece = piece_of(c, sites, timed);
    Piece done;
    double most = 0.0; // allocated during a relaxation
    const auto part = [&](Piece::Part which, const auto& work) {
        const double before = most = allocated();
        work();
        done.bytes[which] = std::max(most, allocated()) - before;
    };
    const double begin = now();
    const Surface heights = heights_of(piece, c, of_file, atoms);
    const ProcessGrid grid = piece.grid(0);
    const BlockOptions& options = piece.simulation.block;
    std::optional<Interface> below;
    part(Piece::interface, [&] {
        below.emplace(heights, grid.tile(0), options.spacing, piece.simulation.interface);
    });
    done.map = static_cast<double>(below->bytes_of_map());
    std::optional<SpectralBlock> waves;
    part(Piece::block, [&] { waves.emplace(options, Communicator(), !piece.effects.lateral); });
    done.sites = sites;
    done.nodes = nodes_of(piece.levels);

    // Height of the state of a slow approach.
    const double lowest = heights.statistics.lowest;
    const double height =
        height_of_strongest_attraction(*waves, *below, lowest, piece.scales.length);
    const double start = below->start_height();
    below->set_reference_height(height);
    done.making = now() - begin;
    const double limit = now() + seconds;
    const auto stop = [&](long long iteration = 0, double = 0.0) {
        most = std::max(most, allocated());
        return timed ? now() > limit : iteration > 0;
    };
    std::optional<StaticPath> path;
    std::optional<Simulation> simulation;
    StateCopy kept;
    const auto come_to_rest = [&] {
        if (path) return follow(*path, stop);
        return bring_to_rest(std::as_const(*simulation).block(), heights, height, piece, stop, {})
            .numbers.has_value();
    };
    waves.reset();
    if (piece.effects.dynamic) {
        const TopMotion down{.z = -piece.simulation.drive.velocity};
        part(Piece::block, [&] {
            simulation.emplace(piece.simulation, heights, Communicator(), grid);
            simulation->start(start, down.z);
            simulation->step(down, true);
        });
        // The block has an interface of its own
        done.bytes[Piece::block] -= done.bytes[Piece::interface];
        const auto step = [&] { simulation->step(down, false); };
        if (timed) done.far_step = shortest(step);
        simulation->start(height, down.z);
        if (timed) done.near_step = shortest(step);
    } else {
        path.emplace(piece, heights, Communicator());
        path->watch(stop);
    }
    if (piece.effects.observation)
        part(Piece::kept, [&] {
            kept.take(path ? path->arrays() : state_of(std::as_const(*simulation).block()));
        });
    const double begun = now();
    try {
        if (piece.effects.relaxation) part(Piece::rest, [&] { done.ended = come_to_rest(); });
    } catch (const io::PhysicsError&) { // for the run to tell
    }
    done.resting = now() - begun;
    // A path over a wall has made its own copies.
    if (path && !piece.starts_with(Segment::relax))
        done.bytes[Piece::rest] = std::max(0.0, done.bytes[Piece::rest] - done.bytes[Piece::kept]);
    if (path) done.points = path->steps();
    const VectorPlane<const double> layer =
        path ? path->layer() : std::as_const(*simulation).block().lowest_layer();
    done.maps_of_sites = (path ? path->interface() : *below).maps_of_sites();
    std::optional<InterfaceMaps> maps;
    if (piece.effects.maps) part(Piece::maps, [&] { maps = below->maps(layer); });
    return done;
}

} // namespace asperity
