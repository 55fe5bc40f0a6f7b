// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/run/rehearsal.hpp"

#include "engine/equilibrium/quasistatic.hpp"
#include "engine/run/checkpoint.hpp"
#include "engine/run/memory_meter.hpp"
#include "engine/run/recorder.hpp"
#include "io/atoms_file.hpp"
#include "io/error.hpp"
#include "io/machine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

namespace asperity {

namespace {

using Clock = std::chrono::steady_clock;
double since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Sites across the larger piece, with a clock and without; the smaller one has half as many.
constexpr int timed_sites = 256, memory_sites = 128;
/// Layers of a piece. A plain lattice has so few, for each takes as much as all levels above the
/// first together.
constexpr int most_layers = 128, most_layers_of_lattice = 48;
/// A run of no more nodes and sites than these fits anywhere, and is not rehearsed before it runs.
constexpr double small_nodes = 2e5, small_sites = 65536.0;
/// For one relaxation of a timed rehearsal, s; and iterations of one without a clock.
constexpr double relaxation_seconds = 1.0;
constexpr long long few_iterations = 3;

/// Those waves of a self-affine surface that fit into a box that is this fraction as wide.
void keep_short_waves(Scene::Surface& s, double fraction) {
    // Of the variance, 2 pi int q C dq with C flat to the roll-off and then q^(-2(1+H)), what lies
    // above the new q_L. q in q_L of the scene.
    const double top = std::min(s.cutoff, 0.5 * s.sites);
    const auto variance = [&](double from) {
        constexpr int steps = 2000;
        double sum = 0.0;
        for (int i = 0; i < steps; ++i) {
            const double q = from * std::pow(top / from, (i + 0.5) / steps);
            sum += q * q * (q <= s.rolloff ? 1.0 : std::pow(q / s.rolloff, -2.0 * (1.0 + s.hurst)));
        }
        return sum * std::log(top / from) / steps;
    };
    s.rms *= top > 1.0 / fraction ? std::sqrt(variance(1.0 / fraction) / variance(1.0)) : 0.0;
    s.rolloff = std::max(1.0, s.rolloff * fraction);
    s.cutoff = std::max(s.rolloff, s.cutoff * fraction);
}

/// The case on fewer sites, on one rank and on the processor.
Case piece_of(const Case& c, int sites) {
    Case piece = c;
    piece.ranks = 1;
    piece.simulation.device = {};
    BlockOptions& block = piece.simulation.block;
    Scene::Surface& surface = piece.scene.surface;
    const double fraction = static_cast<double>(sites) / surface.sites;
    const bool levels = c.levels.size() > 1;
    if (c.in_time && (fraction < 1.0 || c.levels.front().cells > most_layers_of_lattice))
        block.thickness = std::min(block.thickness, levels ? most_layers : most_layers_of_lattice);
    if (fraction < 1.0 && surface.kind == SurfaceKind::self_affine)
        keep_short_waves(surface, fraction);
    surface.sites = block.sites = sites;
    piece.scene.block.thickness = block.thickness;
    piece.levels = level_shapes(block);
    piece.simulation.drive.load_force *= fraction * fraction;
    return piece;
}

/// The corner of a surface that a piece stands on.
Surface corner_of(const Surface& whole, const Case& piece) {
    Surface corner;
    corner.sites = piece.substrate();
    corner.length = piece.scene.edge();
    const auto at = [&](int x, int y) {
        return whole.height[static_cast<std::size_t>(periodic(y, whole.sites)) *
                                static_cast<std::size_t>(whole.sites) +
                            static_cast<std::size_t>(periodic(x, whole.sites))];
    };
    for (int y = 0; y < corner.sites; ++y)
        for (int x = 0; x < corner.sites; ++x)
            corner.height.push_back(at(x, y));
    // Atoms nearer to the far sides than to each other would coincide across the boundary.
    constexpr double apart = 0.5;
    const double end = corner.length < whole.length ? corner.length - apart : whole.length;
    const AtomPositions& atoms = whole.atoms;
    for (std::size_t i = 0; i < atoms.size(); ++i) {
        if (atoms.x[i] >= end || atoms.y[i] >= end) continue;
        corner.atoms.x.push_back(atoms.x[i]);
        corner.atoms.y.push_back(atoms.y[i]);
        corner.atoms.z.push_back(atoms.z[i]);
        if (!atoms.type.empty()) corner.atoms.type.push_back(atoms.type[i]);
    }
    return corner;
}

/// In place of a file: a surface of its size.
Surface stand_in(Case piece, double atoms_a_site) {
    Scene::Surface& s = piece.scene.surface;
    const bool atoms = s.kind == SurfaceKind::atoms;
    s.kind = SurfaceKind::self_affine;
    s.rms = 1.0;
    if (!atoms) return surface_of(piece);
    AtomPositions positions;
    const int n = s.sites, count = static_cast<int>(std::lround(atoms_a_site * n * n));
    for (int i = 0; i < count; ++i) { // layer below layer
        positions.x.push_back(s.spacing * (i % n));
        positions.y.push_back(s.spacing * (i / n % n));
        positions.z.push_back(-s.spacing * (i / (n * n)));
        if (!piece.types.empty()) positions.type.push_back(0);
    }
    SurfaceOptions options;
    options.kind = SurfaceKind::atoms;
    options.sites = piece.substrate();
    options.length = piece.scene.edge();
    return surface_from_atoms(options, std::move(positions));
}

/// Repeats work for about this long; the shortest time.
template <class Work>
double shortest(double seconds, const Work& work) {
    double best = HUGE_VAL;
    const auto start = Clock::now();
    for (int n = 0; n < 3 || since(start) < seconds; ++n) {
        const auto begin = Clock::now();
        work();
        best = std::min(best, since(begin));
    }
    return best;
}

/// Nodes of a rank, with halos and the plane above each level.
double nodes_with_halos(const std::vector<LevelShape>& levels, const ProcessGrid& grid) {
    double nodes = 0.0;
    for (const LevelShape& level : levels) {
        const Tile tile = grid.tile(level.level);
        nodes += (tile.nx + 2.0 * halo_width) * (tile.ny + 2.0 * halo_width) * (level.cells + 1);
    }
    return nodes;
}

/// Puts the lowest layer of a block where it is at rest.
void lay_down(Block& block, const VectorField<double>& layer) {
    const VectorPlane<double> to = block.fields(block.levels().front()).u.plane(0);
    const VectorPlane<const double> from = layer.view()[0];
    for (int y = 0; y < to.x.ny; ++y) {
        std::copy_n(from.x.line(y), to.x.nx, to.x.line(y));
        std::copy_n(from.y.line(y), to.y.nx, to.y.line(y));
        std::copy_n(from.z.line(y), to.z.nx, to.z.line(y));
    }
    block.exchange();
}

/// Ends a relaxation that is rehearsed: after a few iterations, or some time.
class Limit {
public:
    explicit Limit(bool to_the_end) : to_the_end_(to_the_end) {}
    bool operator()(long long iteration, double) {
        iterations_ = iteration;
        return to_the_end_ ? since(start_) > relaxation_seconds : iteration >= few_iterations;
    }
    long long iterations() const { return iterations_; }

private:
    bool to_the_end_;
    long long iterations_ = 0;
    Clock::time_point start_ = Clock::now();
};

} // namespace

double nodes_of(const std::vector<LevelShape>& levels) {
    double nodes = 0.0;
    for (const LevelShape& l : levels)
        nodes += static_cast<double>(l.sites) * l.sites * l.cells;
    return nodes;
}

Rehearsal::Measure Rehearsal::measure(const Case& c, int rank, double atoms) {
    const ProcessGrid grid = c.grid(rank);
    const Tile tile = grid.tile(0);
    // What the interface's tables hold around a tile: its cutoff, and how far sites may go aside.
    const double beyond =
        2.0 * (c.simulation.interface.pairs().cutoff / c.scene.surface.spacing + 4.0);
    Measure m;
    m.sites = c.scene.surface.sites;
    m.atoms = std::pow(c.substrate(), 2) + atoms;
    m.whole = std::pow(m.sites, 2);
    m.here = static_cast<double>(tile.nx) * tile.ny;
    m.around = (tile.nx + beyond) * (tile.ny + beyond);
    m.nodes = nodes_with_halos(c.levels, grid);
    m.own_nodes = nodes_of(c.levels);
    return m;
}

Rehearsal::Rehearsal(const Case& c, Kind kind, const Surface* surface) : case_(c) {
    if (c.scene.surface.kind == SurfaceKind::atoms)
        atoms_ = static_cast<double>(surface ? surface->atoms.size() : io::atoms_announced(c.file));
    // The box of a piece is twice the cutoff at least.
    const double cutoff = c.simulation.interface.pairs().cutoff;
    int least = 32;
    while (least * c.scene.surface.spacing < 2.0 * cutoff)
        least *= 2;
    const int sites =
        std::min(c.scene.surface.sites,
                 std::max(2 * least, kind == Kind::timed ? timed_sites : memory_sites));
    large_ = rehearse(c, sites, kind, surface);
    small_ = sites / 2 < least ? large_ : rehearse(c, sites / 2, Kind::memory, nullptr);
}

Rehearsal::Piece Rehearsal::rehearse(const Case& c, int sites, Kind kind, const Surface* of_file) {
    const Case piece = piece_of(c, sites);
    const bool timed = kind == Kind::timed;
    Piece done;
    MemoryMeter meter;
    // Work of a part: what is allocated, most and in the end, and how long it takes.
    const auto part = [&](Part which, const auto& work) {
        Stage& stage = done.stages[static_cast<std::size_t>(which)];
        const double before = meter.held();
        meter.take_peak();
        const auto begin = Clock::now();
        work();
        stage.seconds += since(begin);
        stage.held += meter.held() - before;
        stage.peak = std::max(stage.peak, meter.take_peak() - before);
    };
    Surface surface;
    part(Part::surface, [&] {
        if (!c.scene.surface.reads_file()) {
            surface = surface_of(piece);
            return;
        }
        const double atoms = c.scene.surface.kind == SurfaceKind::atoms && !of_file
                                 ? static_cast<double>(io::atoms_announced(c.file))
                                 : 0.0;
        surface = of_file ? corner_of(*of_file, piece)
                          : stand_in(piece, atoms / std::pow(c.scene.surface.sites, 2));
    });
    done.measure = measure(piece, 0, static_cast<double>(surface.atoms.size()));
    const ProcessGrid grid = piece.grid(0);
    const BlockOptions& options = piece.simulation.block;
    InterfaceOptions relaxing = piece.simulation.interface;
    relaxing.rough_too = true;
    std::optional<Interface> interface;
    part(Part::interface, [&] {
        interface.emplace(surface, grid.tile(0), options.spacing,
                          piece.in_time ? piece.simulation.interface : relaxing);
    });
    // Where a slow approach would come to rest.
    std::optional<SpectralBlock> waves;
    double height = 0.0;
    const auto make_waves = [&] {
        waves.emplace(options, Communicator(), piece.scene.interface.frictionless);
    };
    const auto find_height = [&] {
        height = height_of_strongest_attraction(
            *waves, *interface, *std::min_element(surface.height.begin(), surface.height.end()),
            piece.scales.length);
    };
    const auto record_maps = [&](const VectorPlane<const double>& layer) {
        if (piece.on(Effect::maps))
            part(Part::maps, [&] {
                Recorder::record_of_fields("", layer, Communicator(), grid, *interface, height);
            });
    };
    const auto relax = [&](const auto& find) {
        Limit limit(timed);
        const auto begin = Clock::now();
        try {
            const std::optional<ZeroLoad> found =
                find([&](long long i, double r) { return limit(i, r); });
            done.ended = found.has_value();
            done.iterations = found ? found->iterations : limit.iterations();
        } catch (const io::PhysicsError&) { // no state under this load
            done.ended = false;
            done.iterations = limit.iterations();
        }
        done.iteration = since(begin) / static_cast<double>(std::max(1ll, done.iterations));
    };
    if (!piece.in_time) {
        part(Part::block, make_waves);
        done.everywhere = static_cast<double>(waves->table_bytes());
        find_height();
        const double start = interface->start_height();
        std::optional<QuasistaticPath> path;
        const auto keep_points = [&](const auto& work) {
            try {
                part(Part::snapshots, work);
            } catch (const io::PhysicsError&) { // for the run to tell
            }
        };
        if (piece.on(Effect::observation))
            keep_points([&] {
                path.emplace(*waves, *interface, path_options(piece, *interface));
                path->start();
                path->advance();
            });
        waves->set_uniform(height - start);
        part(Part::state, [&] {
            relax([&](const auto& stop) {
                return find_zero_load(*waves, *interface, start, piece.simulation.drive.load_force,
                                      piece, stop);
            });
        });
        record_maps(waves->lowest_layer());
        return done;
    }
    std::optional<Simulation> simulation;
    part(Part::block, [&] {
        simulation.emplace(piece.simulation, surface, Communicator(), grid);
        simulation->start(interface->start_height());
        simulation->step(true);
    });
    // It has an interface of its own, of the size of the other one.
    Stage &block = done.stages[static_cast<std::size_t>(Part::block)],
          &tables = done.stages[static_cast<std::size_t>(Part::interface)];
    block.held -= tables.held;
    block.peak -= tables.held;
    Snapshot snapshot;
    part(Part::snapshots, [&] {
        if (piece.on(Effect::observation)) snapshot.take(*simulation);
    });
    constexpr int few_steps = 8;
    const auto steps = [&] {
        for (int n = 0; n < few_steps; ++n)
            simulation->step(false);
    };
    if (timed) {
        done.far_step = shortest(0.1, steps) / few_steps;
        done.observing =
            std::max(0.0, shortest(0.05, [&] { simulation->step(true); }) - done.far_step);
    }
    make_waves();
    done.everywhere = static_cast<double>(waves->table_bytes());
    find_height();
    waves.reset();
    LayerAtRest rest;
    simulation->start(height);
    if (piece.on(Effect::relaxation))
        part(Part::state, [&] {
            relax([&](const auto& stop) {
                rest = bring_to_rest(simulation->block(), surface, height, piece, stop, {});
                return rest.numbers;
            });
        });
    if (rest.numbers) lay_down(simulation->block_to_write(), rest.layer);
    if (timed) done.near_step = shortest(0.2, steps) / few_steps;
    record_maps(simulation->block().lowest_layer());
    return done;
}

double Rehearsal::fraction(Part part, const Measure& m, bool in_time) {
    switch (part) {
    case Part::surface:
        return m.atoms;
    case Part::interface:
        return m.around;
    case Part::block:
    case Part::snapshots:
        return in_time ? m.nodes : m.here;
    case Part::state:
        return m.here;
    default:
        return m.whole;
    }
}

double Rehearsal::bytes(Part part, int rank) const {
    if (rank > 0 && part == Part::maps) return 0.0; // the root collects them
    const Measure to = measure(case_, rank, atoms_);
    const auto at = [&](const Piece& piece) {
        const Stage& stage = piece.stages[static_cast<std::size_t>(part)];
        // What each rank holds whole: the table of the waves' stiffness, and half of that again
        // for its inverse, which a relaxation makes.
        const double tables = part == Part::state   ? (case_.in_time ? 1.5 : 0.5)
                              : part == Part::block ? (case_.in_time ? 0.0 : 1.0)
                                                    : 0.0;
        const double whole = tables * piece.everywhere;
        const bool kept = part == Part::interface || part == Part::block || part == Part::snapshots;
        return std::pair((kept ? stage.held : stage.peak) - whole, whole);
    };
    const auto line = [](double x1, double y1, double x2, double y2, double x) {
        return x1 == x2 ? y2 * x / x2 : y2 + (y2 - y1) / (x2 - x1) * (x - x2);
    };
    const auto [part1, whole1] = at(small_);
    const auto [part2, whole2] = at(large_);
    const double own = line(fraction(part, small_.measure, case_.in_time), part1,
                            fraction(part, large_.measure, case_.in_time), part2,
                            fraction(part, to, case_.in_time));
    return own + line(small_.measure.whole, whole1, large_.measure.whole, whole2, to.whole);
}

double Rehearsal::most_bytes(int rank) const {
    const auto of = [&](Part part) { return bytes(part, rank); };
    const double made = large_.stages[static_cast<std::size_t>(Part::surface)].held *
                        measure(case_, rank, atoms_).atoms / large_.measure.atoms;
    return std::max(of(Part::surface), made + of(Part::interface) + of(Part::block) +
                                           of(Part::snapshots) +
                                           std::max(of(Part::state), of(Part::maps)));
}

double Rehearsal::making() const {
    const Measure to = measure(case_, 0, atoms_);
    const auto seconds = [&](Part part) {
        return large_.stages[static_cast<std::size_t>(part)].seconds;
    };
    return seconds(Part::surface) * to.atoms / large_.measure.atoms +
           (seconds(Part::interface) + seconds(Part::block)) * to.whole / large_.measure.whole;
}

double Rehearsal::over_nodes(double seconds) const {
    return seconds * nodes_of(case_.levels) / large_.measure.own_nodes;
}
double Rehearsal::far_step() const { return over_nodes(large_.far_step); }
double Rehearsal::near_step() const { return over_nodes(large_.near_step); }
double Rehearsal::observing() const { return over_nodes(large_.observing); }
double Rehearsal::iteration() const {
    return large_.iteration * std::pow(case_.scene.surface.sites, 2) / large_.measure.whole;
}

void require_memory(const Case& c, const Communicator& ranks) {
    // The same on all ranks.
    if (nodes_of(c.levels) <= small_nodes && std::pow(c.scene.surface.sites, 2) <= small_sites)
        return;
    const Rehearsal rehearsal(c, Rehearsal::Kind::memory);
    const double needed = ranks.sum_on_machine(rehearsal.most_bytes(ranks.rank()));
    const io::AvailableMemory there = io::available_memory();
    // All ranks refuse alike, with the numbers of the machine that is worst off.
    const double worst = ranks.max(needed / there.bytes);
    if (worst <= 1.0) return;
    const bool coarser = c.in_time && c.scene.block.model == BlockModel::lattice;
    io::Problems problems = c.scene.problems();
    problems.add(
        "surface.sites",
        fmt::format("= {}: the run does not fit into memory", c.scene.surface.sites),
        fmt::format("{:.3g} GB are needed on this machine, and {:.3g} GB are available ({})",
                    worst * there.bytes / 1e9, there.bytes / 1e9, there.because),
        fmt::format("take fewer sites{}, more machines (`asperity plan --ranks N` counts), or "
                    "close what else runs here",
                    coarser ? ", block.model = \"multiscale\"" : ""));
    problems.throw_if_any();
}

} // namespace asperity
