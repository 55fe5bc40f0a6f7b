// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/plan/plan.hpp"

#include "decomposition/plane_bands.hpp"
#include "engine/case/memory.hpp"
#include "engine/device/device_block.hpp"
#include "engine/path/expected_path.hpp"
#include "engine/run/stress_record.hpp"
#include "engine/statics/zero_load.hpp"
#include "io/atoms_file.hpp"
#include "io/error.hpp"
#include "io/json.hpp"
#include "io/machine.hpp"
#include "io/terminal.hpp"
#include "kernels/variant.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

namespace asperity {

namespace {

/// Time that the states and paths of pieces may take, s.
constexpr double rehearsal_seconds = 1.5;
/// Sites across the largest piece and the smallest.
constexpr int widest_piece = 256, least_sites = 16;
/// A run of no more nodes and sites than these fits anywhere.
constexpr double small_nodes = 2e5, small_sites = 65536.0;
/// Highest point of a typical surface over its rms height; typical power of the width by which
/// states and paths take longer, and bounds of a measured power.
constexpr double highest_over_rms = 4.5, power = 2.2, least_power = 2.0, most_power = 3.0;

std::string memory_text(double bytes) {
    if (bytes <= 0.0) return "";
    return bytes < 1e9 ? fmt::format("{:.3g} MB", bytes / 1e6)
                       : fmt::format("{:.3g} GB", bytes / 1e9);
}

constexpr double one_day = 86400.0; ///< s

/// Bytes of the root for a node of a band of a map: the others' parts, the band, and what is
/// written.
constexpr double bytes_of_bands = 3.0 * sizeof(double);
/// Bytes for a component of a site of the part that the transforms of two ranks exchange at a time,
/// in double and single precision.
constexpr double bytes_exchanged = sizeof(double) + sizeof(float);

/// Returns pieces of growing width; the last is the largest that the time allows.
std::vector<Piece> timed_pieces(const Case& c, const Surface* of_file, double atoms) {
    // The box of a piece is twice the cutoff at least.
    const double reach = 2.0 * c.simulation.interface.pairs().cutoff / c.simulation.block.spacing;
    const int least = std::max(least_sites, static_cast<int>(reach) + 1);
    const int sites = c.simulation.block.sites;
    int halvings = 0;
    while (sites >> (halvings + 1) >= least)
        ++halvings;
    std::vector<Piece> pieces;
    double left = rehearsal_seconds;
    for (; halvings >= 0 && sites >> halvings <= widest_piece; --halvings) {
        // Twice the width takes four to eight times as long.
        if (!pieces.empty() && 5.0 * (pieces.back().making + pieces.back().resting) > left) break;
        const Piece piece = rehearse(c, sites >> halvings, left, of_file, atoms);
        left -= piece.making + piece.resting;
        if (piece.ended || pieces.empty()) pieces.push_back(piece);
        if (!piece.ended) break;
    }
    return pieces;
}

/// Returns the bytes of the heights that the interface of a tile holds around it.
double bytes_of_map(const Case& c, const Tile& tile) {
    const double n = c.substrate(), between = c.edge() / n;
    const InterfaceOptions& interface = c.simulation.interface;
    const int rows =
        HeightMap::rows_under(tile, c.simulation.block.spacing, c.substrate(), between, interface)
            .count;
    const bool moves = interface.slides && !interface.wall && c.surface.counter;
    return sizeof(double) * n * rows * (moves ? 2.0 : 1.0);
}

/// Returns the arrays that each rank, or the first one, holds whole.
std::vector<std::pair<std::string, double>> arrays_held_whole(const Case& c, double atoms) {
    std::vector<std::pair<std::string, double>> whole;
    const double map = sizeof(double) * std::pow(c.substrate(), 2);
    if (c.simulation.interface.slides)
        whole.emplace_back("heights below a slide, on each rank", map);
    if (atoms > 0.0)
        whole.emplace_back("atoms of the substrate, on each rank", 3.0 * sizeof(double) * atoms);
    if (c.surface.reads_file())
        whole.emplace_back("heights of a file, on the first rank while it is read", map);
    return whole;
}

/// Returns the bytes of a part on one rank of the case.
double bytes_of(Piece::Part part, int rank, const Case& c, const Piece& piece, double atoms) {
    const Tile tile = c.grid(rank).tile(0);
    const BlockOptions& block = c.simulation.block;
    const double grid = static_cast<double>(block.grid()) / block.sites; // per site, along an edge
    const double one = std::pow(grid * piece.sites, 2), h = 2.0 * halo_width;
    const double whole = std::pow(block.grid(), 2) / one;
    const double here = static_cast<double>(tile.nx) * tile.ny / one;
    const double bytes = piece.bytes[part];
    if (part == Piece::surface) {
        const double maps = c.surface.counter ? 2.0 : 1.0;
        return sizeof(double) * (maps * std::pow(c.substrate(), 2) / c.ranks + 3.0 * atoms);
    }
    if (part == Piece::maps &&
        bytes > 0.0) // the root holds bands of the others', and the stresses whole
        return bytes * here + (rank == 0
                                   ? bytes_of_bands * rows_of_band(block.grid()) * block.grid() +
                                         stress_bytes(block.sites, c.output.stress)
                                   : 0.0);
    if (c.effects.dynamic && (part == Piece::block || part == Piece::kept))
        return bytes * nodes_of(c.levels) / piece.nodes / whole * (tile.nx + h) * (tile.ny + h) /
               std::pow(piece.sites + h, 2);
    // Ranks exchange waves where a block at rest is: for good, or while a dynamic one is relaxed.
    const bool at_rest = part == (c.effects.dynamic ? Piece::rest : Piece::block) && bytes > 0.0;
    const double components = c.effects.dynamic || c.effects.lateral ? 3.0 : 1.0;
    const double map = part == Piece::interface ? piece.map : 0.0;
    return (bytes - map) * here + (map > 0.0 ? bytes_of_map(c, tile) : 0.0) +
           (at_rest && c.ranks > 1 ? bytes_exchanged * components * tile.nx * tile.ny / c.ranks
                                   : 0.0);
}

/// Returns the bytes of the maps of a state for a site: six numbers and a mark, and those of the
/// memories and of the maps that the interface reads.
double bytes_of_maps(const Piece& piece) {
    return 49.0 + 8.0 * static_cast<double>(piece.maps_of_sites);
}

/// Returns the largest memory of a rank, bytes.
double bytes_of_largest_rank(const Plan& plan) { return std::ranges::max(plan.bytes_of_rank); }

/// Returns the largest memory of all ranks together, bytes.
double bytes_at_once(const Plan& plan) {
    return std::accumulate(plan.bytes_of_rank.begin(), plan.bytes_of_rank.end(), 0.0);
}

/// Returns the seconds of the whole run.
double seconds_altogether(const Plan& plan) { return plan.making + plan.moving + plan.rest; }

/// Prints the scale of the tolerance.
void print_scales(std::FILE* to, const Case& c, double height) {
    io::print_text(to,
                   "forces      {:.3g} eV/Å on a site decides the state: {};\n"
                   "            drive.tolerance = {:.3g} of it is {:.3g} eV/Å\n",
                   c.scales.force, c.force_scale, c.tolerance / c.scales.force, c.tolerance);
    if (const std::string note = rounding_note(c, height); !note.empty())
        io::print_text(to, "            {}\n", note);
}

/// Returns the number of ranks that fit into the memory of a node, bytes.
int ranks_of_node(const Plan& plan, double node) {
    const double most = node / bytes_of_largest_rank(plan);
    return static_cast<int>(std::min(most, 1.0 * static_cast<double>(plan.bytes_of_rank.size())));
}

/// Prints how many ranks fit into a node of this memory, bytes, and how many nodes are needed.
void print_nodes(std::FILE* to, const Plan& plan, double node) {
    const int ranks = static_cast<int>(plan.bytes_of_rank.size()), fit = ranks_of_node(plan, node);
    if (fit == 0)
        io::print_text(to,
                       "nodes       of {} do not hold one rank of {}: take more ranks, or nodes of "
                       "more memory\n",
                       memory_text(node), memory_text(bytes_of_largest_rank(plan)));
    else
        io::print_text(to,
                       "nodes       of {} hold {} of these ranks each; {} such node{} for all\n",
                       memory_text(node), fit, (ranks + fit - 1) / fit,
                       ranks <= fit ? " is enough" : "s are needed");
}

} // namespace

Plan make_plan(const Case& c, int threads) {
    const SurfaceOptions& own = c.surface;
    const BlockOptions& block = c.simulation.block;
    const bool timed = threads > 0;
    std::optional<Surface> of_file;
    if (timed && own.reads_file()) of_file = surface_of(c);
    double atoms = 0.0;
    if (own.kind == SurfaceKind::atoms)
        atoms = static_cast<double>(of_file ? of_file->atoms.size() : io::atoms_announced(c.file));
    const Surface* const surface = of_file ? &*of_file : nullptr;
    const int threads_here = omp_get_max_threads();
    omp_set_num_threads(1);
    int sites = block.sites;
    while (sites > widest_piece &&
           sites / 2.0 * block.spacing >= 2.0 * c.simulation.interface.pairs().cutoff)
        sites /= 2;
    const Piece room = rehearse(c, sites, 0.0, surface, atoms);
    const std::vector<Piece> pieces = timed ? timed_pieces(c, surface, atoms) : std::vector{room};
    omp_set_num_threads(threads_here);

    Plan plan;
    for (int rank = 0; rank < c.ranks; ++rank) {
        std::array<double, Piece::parts> bytes{};
        for (std::size_t part = 0; part < Piece::parts; ++part) {
            bytes[part] = bytes_of(static_cast<Piece::Part>(part), rank, c, room, atoms);
            plan.bytes[part] += bytes[part];
        }
        // Neither states nor maps are there at the same time.
        plan.bytes_of_rank.push_back(std::accumulate(bytes.begin(), bytes.end(), 0.0) -
                                     std::min(bytes[Piece::rest], bytes[Piece::maps]));
    }
    plan.whole = arrays_held_whole(c, atoms);
    const double here = std::pow(c.simulation.block.sites, 2);
    plan.state_bytes = (bytes_of_maps(room) + (block.counter ? 8.0 : 0.0)) * here;
    if (c.effects.maps) plan.stress_bytes = stress_bytes(block.sites, c.output.stress);
    if (c.output.trajectory) plan.frame_bytes = (c.output.velocities ? 24.0 : 12.0) * here;
    if (!timed) return plan;
    const Piece& piece = pieces.back();

    // The share of the work of each thread of the slowest rank.
    const double share = (1.0 + c.grid(0).imbalance()) / c.ranks / threads;
    const double wider = static_cast<double>(block.sites) / piece.sites;
    plan.making = piece.making * wider * wider / c.ranks / threads;
    const double highest = surface                         ? surface->statistics.highest
                           : own.kind == SurfaceKind::flat ? 0.0
                                                           : highest_over_rms * own.rms;
    plan.start = highest + reach_of(c.simulation.interface);
    const ExpectedPath expected = expected_path(c, plan.start);
    if (c.effects.dynamic) {
        plan.steps = std::llround(expected.time / c.simulation.dt);
        if (const auto& most = c.simulation.drive.max_steps)
            plan.steps = std::min(plan.steps, *most);
        // An approach and a pull-off are half of their way beyond the interaction range.
        const double far = c.is_cycle() ? 0.5 : 0.0;
        plan.moving = share * static_cast<double>(plan.steps) * nodes_of(c.levels) / piece.nodes *
                      (far * piece.far_step + (1.0 - far) * piece.near_step);
    }
    double grows = power;
    if (pieces.size() > 1) {
        const Piece& before = pieces[pieces.size() - 2];
        grows = std::log(piece.resting / before.resting) /
                std::log(static_cast<double>(piece.sites) / before.sites);
    }
    plan.rest = share * piece.resting * std::pow(wider, std::clamp(grows, least_power, most_power));
    if (!piece.ended && piece.points > 0 && !c.effects.dynamic) { // the rest takes alike
        const double way = std::accumulate(expected.ways.begin(), expected.ways.end(), 0.0);
        const double points = way / c.simulation.drive.displacement_step;
        plan.rest *= std::max(1.0, points / static_cast<double>(piece.points));
    }
    if (wider > 1.0)
        plan.factor = pieces.size() > 1 ? 2.0 * std::sqrt(std::max(1.0, wider / 4.0)) : 3.0;
    plan.ended = piece.ended;
    plan.sites = piece.sites;
    return plan;
}

void print_plan(std::FILE* to, const Case& c, int threads, const Plan& plan, double node) {
    const auto s = [](auto count) { return count == 1 ? "" : "s"; };
    io::print_text(to, "{}: {}; {}\n\n", c.scene.name, c.box_in_words(), c.block_in_words());
    io::Table effects({"effect", "", "because"}, "<<<");
    for (const auto& [name, effect] : c.effects.list())
        effects.row({name, effect ? "on" : "off", effect.why});
    effects.print(to);
    fmt::print(to, "\n");
    io::Table table({"part of the run", "memory", "time", ""}, "<>><");
    const auto line = [&](const char* what, double bytes, double seconds,
                          const std::string& remark) {
        if (bytes > 0.0)
            table.row({what, memory_text(bytes), seconds > 0.0 ? io::duration_text(seconds) : "",
                       remark});
    };
    const bool path = !c.effects.dynamic && c.effects.observation;
    const std::string steps = fmt::format("{} steps of {:.4g} fs", plan.steps, c.simulation.dt);
    const std::string range = fmt::format("{} to {}", io::duration_text(plan.rest / plan.factor),
                                          io::duration_text(plan.rest * plan.factor));
    line("surface", plan.bytes[Piece::surface], plan.making, "made before the first step");
    line("interface", plan.bytes[Piece::interface], 0.0, "");
    line("block", plan.bytes[Piece::block], plan.moving, c.effects.dynamic ? steps : "");
    line("states kept", plan.bytes[Piece::kept], 0.0,
         path ? "to go back to" : "for the energy guard");
    line(path ? "path" : "relaxation", plan.bytes[Piece::rest], plan.rest,
         !plan.ended         ? "or longer: a piece of it did not come to its end"
         : plan.factor > 1.0 ? range
                             : "");
    line("maps", plan.bytes[Piece::maps], 0.0, "while nothing is relaxed");
    table.rule();
    const double bytes = bytes_at_once(plan);
    line("altogether", bytes, seconds_altogether(plan),
         fmt::format("{} rank{} of {} thread{}; memory: the most at once", c.ranks, s(c.ranks),
                     threads, s(threads)));
    table.print(to);
    fmt::print(to, "\n");
    if (c.effects.relaxation) print_scales(to, c, plan.start);
    const io::AvailableMemory there = io::available_memory();
    if (c.ranks > 1) {
        const Tile tile = c.grid(0).tile(0);
        io::print_text(to, "ranks       {} and {} x {} sites each, at most\n",
                       memory_text(bytes_of_largest_rank(plan)), tile.nx, tile.ny);
    }
    for (const auto& [what, size] : plan.whole)
        io::print_text(to, "whole       {} of {}\n", memory_text(size), what);
    if (node > 0.0) print_nodes(to, plan, node);
    io::print_text(to, "memory      {} available here ({})\n", memory_text(there.bytes),
                   there.because);
    io::print_text(
        to, "run.h5      {} for the maps of a state, before compression{}{}\n",
        memory_text(plan.state_bytes),
        plan.stress_bytes > 0.0
            ? fmt::format("; {} for the stresses below it", memory_text(plan.stress_bytes))
            : "",
        plan.frame_bytes > 0.0 ? fmt::format("; {} a frame", memory_text(plan.frame_bytes)) : "");
    if (bytes > there.bytes && node <= 0.0)
        io::print_text(to,
                       "            The run does not fit into this machine: `asperity run` will "
                       "refuse it here. Fewer sites, coarser or\n            fewer layers, or more "
                       "machines\n");
    if (const DeviceChoice& device = c.simulation.device)
        io::print_text(
            to,

            "device      {}, {} of its memory on each rank; times are the processor's\n",
            describe_device(device),
            memory_text(static_cast<double>(
                DeviceLayout(c.simulation.block, c.grid(0), c.simulation.interface).bytes)));
    io::print_text(to,
                   "wall time   of idle processors, without messages between machines; measured on "
                   "{0} x {0} sites, kernels for {1}\nNothing was run or written.\n",
                   plan.sites, name(processor_level()));
    if (seconds_altogether(plan) > one_day)
        io::print_text(to,
                       "note: the run takes more than a day: fewer sites or layers, a higher "
                       "velocity, or drive.mode = \"quasistatic\"; `asperity cost` says what each "
                       "loses\n");
}

nlohmann::ordered_json effects_json(const Effects& effects) {
    io::Json all = io::Json::object();
    for (const auto& [name, effect] : effects.list())
        all[name] = {{"on", static_cast<bool>(effect)}, {"because", effect.why}};
    return all;
}

nlohmann::ordered_json plan_json(const Case& c, int threads, const Plan& plan, double node) {
    io::Json bytes, seconds;
    constexpr std::array names = {"surface", "interface", "block", "kept", "rest", "maps"};
    static_assert(names.size() == Piece::parts);
    for (std::size_t part = 0; part < Piece::parts; ++part)
        bytes[names[part]] = plan.bytes[part];
    bytes["altogether"] = bytes_at_once(plan);
    bytes["rank"] = bytes_of_largest_rank(plan);
    bytes["available"] = io::available_memory().bytes;
    bytes["state"] = plan.state_bytes;
    bytes["stress"] = plan.stress_bytes;
    bytes["frame"] = plan.frame_bytes;
    io::Json whole = io::Json::array();
    for (const auto& [what, size] : plan.whole)
        whole.push_back({{"what", what}, {"bytes", size}});
    const Tile tile = c.grid(0).tile(0);
    seconds["surface"] = plan.making;
    seconds["steps"] = plan.moving;
    seconds["rest"] = plan.rest;
    seconds["altogether"] = seconds_altogether(plan);
    seconds["factor"] = plan.factor;
    io::Json all = {{"name", c.scene.name},
                    {"effects", effects_json(c.effects)},
                    {"ranks", c.ranks},
                    {"threads", threads},
                    {"sites_of_rank", {tile.nx, tile.ny}},
                    {"steps", plan.steps},
                    {"bytes", bytes},
                    {"whole", whole},
                    {"seconds", seconds},
                    {"ended", plan.ended}};
    if (node > 0.0) all["ranks_of_node"] = ranks_of_node(plan, node);
    return all;
}

void require_memory(const Case& c, const Communicator& ranks) {
    c.require_runnable();
    const double sites = std::pow(c.simulation.block.grid(), 2);
    // The same on all ranks.
    if (nodes_of(c.levels) <= small_nodes && sites <= small_sites) return;
    // Nor is anything made to be counted where several times what the fields of any run take is
    // there.
    const double fields = 4096.0 * sites + 512.0 * nodes_of(c.levels);
    if (!c.surface.reads_file() && ranks.max(fields / io::available_memory().bytes) < 0.5) return;
    const double mine = make_plan(c, 0).bytes_of_rank[static_cast<std::size_t>(ranks.rank())];
    const std::optional<MemoryShortage> lacks = memory_shortage(ranks, mine);
    if (!lacks) return;
    const bool coarser = c.effects.dynamic && !c.simulation.block.multiscale;
    io::Problems problems = c.scene.problems();
    problems.add(
        "surface.sites",
        fmt::format("= {}: the run does not fit into memory", c.simulation.block.sites),
        lacks->text(),
        fmt::format("take fewer sites{}, more machines (`asperity plan --ranks N` counts), or "
                    "close what else runs here",
                    coarser ? ", block.model = \"multiscale\"" : ""));
    problems.throw_if_any();
}

} // namespace asperity
