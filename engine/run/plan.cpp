// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/run/plan.hpp"

#include "engine/device/device_block.hpp"
#include "engine/equilibrium/zero_load.hpp"
#include "engine/units.hpp"
#include "io/machine.hpp"
#include "io/terminal.hpp"
#include "kernels/variant.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace asperity {

namespace {

/// Typical: writing a checkpoint or maps, bytes/s.
constexpr double disk = 2e8;
/// Sites up to which a surface is made to know its highest point; typical: that of larger ones over
/// their rms height.
constexpr int largest_surface = 512;
constexpr double highest_over_rms = 4.5;
/// Typical of a quasi-static path (first-contact, N = 32 to 128): points, over those of steps of
/// the full length; iterations of a point.
constexpr double points_over_steps = 1.5, iterations_of_point = 40.0;

std::string time_text(double seconds) {
    if (seconds < 0.0005) return "0";
    if (seconds < 1.0) return fmt::format("{:.2g} s", seconds);
    if (seconds < 120.0) return fmt::format("{:.0f} s", seconds);
    if (seconds < 7200.0) return fmt::format("{:.0f} min", seconds / 60.0);
    return fmt::format("{:.1f} h", seconds / 3600.0);
}

std::string memory_text(double bytes) {
    if (bytes <= 0.0) return "0";
    if (bytes < 1e5) return "< 0.1 MB";
    if (bytes < 1e7) return fmt::format("{:.1f} MB", bytes / 1e6);
    if (bytes < 1e9) return fmt::format("{:.0f} MB", bytes / 1e6);
    return fmt::format("{:.1f} GB", bytes / 1e9);
}

} // namespace

ExpectedPath expected_path(const Case& c, double start) {
    const BlockOptions& block = c.simulation.block;
    const double contact = c.flat.separation - start; // displacement of the top plane
    const double modulus = block.lame() + 2.0 * block.shear_modulus(); // eV/Å^3
    const double yields = block.thickness * block.spacing / modulus;   // under a pressure
    ExpectedPath path;
    double at = 0.0, pressure = 0.0;
    for (const Segment& segment : c.path) {
        double to = at, way = 0.0;
        switch (segment.kind) {
        case Segment::approach:
            to = contact;
            pressure = 0.0;
            break;
        case Segment::pull_off: {
            // Elongation of the block when it separates, at half the largest tension.
            const double stretch = 0.5 * c.largest_tension * units::gigapascal * yields;
            way = std::max(-at, stretch);
            to = 0.0;
            break;
        }
        case Segment::load: {
            const double asked = segment.amount * units::megapascal;
            to = std::min(at, contact) + (pressure - asked) * yields;
            pressure = asked;
            break;
        }
        case Segment::height:
            to = segment.amount - start;
            break;
        case Segment::slide:
            way = std::abs(segment.amount);
            break;
        case Segment::hold:
            path.at_rest += segment.amount * units::picosecond;
            break;
        case Segment::zero_load:
            break;
        }
        way = std::max(way, std::abs(to - at));
        at = to;
        path.ways.push_back(way);
        path.deepest = std::max(path.deepest, -at);
        if (segment.kind == Segment::approach || segment.kind == Segment::pull_off)
            path.free += way;
    }
    if (c.path.size() > 1)
        path.turns = c.simulation.drive.ramp * static_cast<double>(c.path.size() - 1);
    return path;
}

long long expected_steps(const Case& c, double start) {
    if (!c.in_time) return 0;
    const ExpectedPath path = expected_path(c, start);
    const double time = path.way() / c.simulation.drive.velocity + path.at_rest + path.turns;
    const long long steps = std::llround(time / c.simulation.dt);
    const long long most = c.scene.drive.max_steps;
    return most > 0 ? std::min(steps, most) : steps;
}

namespace {

/// Height of the lowest layer at the start, Å.
double start_of(const Case& c, const Surface* of_file) {
    double highest = 0.0;
    if (of_file)
        highest = of_file->statistics.highest;
    else if (c.scene.surface.sites <= largest_surface)
        highest = surface_of(c).statistics.highest;
    else if (c.scene.surface.kind != SurfaceKind::flat)
        highest = highest_over_rms * c.scene.surface.rms;
    return highest + reach_of(c.simulation.interface);
}

/// What the tolerance is a fraction of.
void print_scales(std::FILE* to, const Case& c, double height) {
    fmt::print(to,
               "forces      {:.3g} eV/Å on a site decides the state: {};\n"
               "            drive.tolerance = {:.3g} of it is {:.3g} eV/Å\n",
               c.scales.force, c.force_scale, c.scene.drive.tolerance, c.tolerance);
    if (const std::string note = rounding_note(c, height); !note.empty())
        fmt::print(to, "            {}\n", note);
}

} // namespace

Plan make_plan(const Case& c, int threads) {
    using Part = Rehearsal::Part;
    const auto begin = std::chrono::steady_clock::now();
    std::optional<Surface> of_file;
    if (c.scene.surface.reads_file()) of_file = surface_of(c);
    const Surface* const surface = of_file ? &*of_file : nullptr;
    const double start = start_of(c, surface);
    const Rehearsal rehearsal(c, Rehearsal::Kind::timed, surface);

    Plan plan;
    plan.threads = threads;
    plan.start = start;
    const auto bytes = [&](Part part) {
        double sum = 0.0;
        for (int rank = 0; rank < c.ranks; ++rank)
            sum += rehearsal.bytes(part, rank);
        return sum;
    };
    for (int rank = 0; rank < c.ranks; ++rank)
        plan.whole.bytes += rehearsal.most_bytes(rank);
    // The slowest rank's share of the work, with its threads over those of the rehearsal.
    const double alone = static_cast<double>(omp_get_max_threads()) / threads;
    const double fraction = alone * (1.0 + c.grid(0).imbalance()) / c.ranks;

    plan.making = {bytes(Part::surface) + bytes(Part::interface), alone * rehearsal.making()};
    plan.steps = expected_steps(c, start);
    const auto steps = static_cast<double>(plan.steps);
    const ExpectedPath path = expected_path(c, start);
    // During approach and pull-off the cost of a step changes between that out of reach and that in
    // contact; elsewhere the block is in contact.
    const double free = path.free / c.simulation.drive.velocity;
    const double near =
        steps > 0.0 ? 1.0 - 0.5 * std::min(1.0, free / (steps * c.simulation.dt)) : 1.0;
    plan.block = {bytes(Part::block),
                  fraction * steps *
                      ((1.0 - near) * rehearsal.far_step() + near * rehearsal.near_step())};
    plan.snapshots = {bytes(Part::snapshots), fraction * steps /
                                                  static_cast<double>(c.scene.output.series) *
                                                  rehearsal.observing()};
    plan.state.bytes = bytes(Part::state);
    if (c.on(Effect::relaxation)) {
        plan.typical = !c.in_time && c.on(Effect::observation);
        plan.state_ended = rehearsal.state_ended();
        plan.iterations = rehearsal.iterations();
        if (plan.typical)
            plan.iterations += std::llround(iterations_of_point * points_over_steps * path.way() /
                                            std::min(c.scene.drive.step, c.longest_step));
        plan.state.seconds =
            fraction * static_cast<double>(plan.iterations) * rehearsal.iteration();
    }
    plan.maps = {bytes(Part::maps), bytes(Part::maps) / disk};
    for (const Cost* cost : {&plan.making, &plan.block, &plan.snapshots, &plan.state, &plan.maps})
        plan.whole.seconds += cost->seconds;
    if (c.on(Effect::checkpoints)) {
        const double files = std::floor(plan.whole.seconds / c.scene.output.checkpoint);
        plan.checkpoints.seconds = files * bytes(c.in_time ? Part::block : Part::snapshots) / disk;
        plan.whole.seconds += plan.checkpoints.seconds;
    }
    plan.rates =
        fmt::format("rehearsed in {:.1f} s on {} x {} sites with {} thread{}, kernels for {}",
                    std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(),
                    rehearsal.sites(), rehearsal.sites(), omp_get_max_threads(),
                    omp_get_max_threads() == 1 ? "" : "s", name(processor_level()));
    return plan;
}

void print_plan(std::FILE* to, const Case& c, const Plan& plan) {
    const Scene& scene = c.scene;
    fmt::print(to, "{}: {} x {} sites, box {:.6g} Å, {} layers in {} level{}\n\n", scene.name,
               scene.surface.sites, scene.surface.sites, scene.edge(), scene.block.thickness,
               c.levels.size(), c.levels.size() == 1 ? "" : "s");
    io::Table effects({"effect", "", "because"}, "<<<");
    for (std::size_t i = 0; i < effect_count; ++i) {
        const auto effect = static_cast<Effect>(i);
        effects.row(
            {std::string(name(effect)), c.on(effect) ? "on" : "off", c.effects.why(effect)});
    }
    effects.print(to);
    fmt::print(to, "\n");
    io::Table table({"part of the run", "memory", "time", ""}, "<>><");
    const auto line = [&](const char* what, const Cost& cost, const std::string& remark) {
        table.row({what, memory_text(cost.bytes), time_text(cost.seconds), remark});
    };
    line("surface and interface", plan.making, "made before the first step");
    line("block", plan.block,
         plan.steps > 0
             ? fmt::format("{} steps of {:.4g} fs{}", plan.steps, c.simulation.dt,
                           plan.steps == scene.drive.max_steps ? " (drive.max_steps)" : "")
             : "");
    if (c.on(Effect::observation) || plan.snapshots.bytes > 0.0)
        line("states kept", plan.snapshots,
             c.in_time ? "for the energy guard; rows of the series" : "to go back to");
    if (c.on(Effect::relaxation))
        line("relaxation", plan.state,
             fmt::format("{}{} iterations{}", plan.state_ended ? "about " : "more than ",
                         plan.iterations, plan.typical ? " (typical of a path)" : ""));
    if (c.on(Effect::maps)) line("maps", plan.maps, "while nothing is relaxed");
    if (c.on(Effect::checkpoints)) line("checkpoints", plan.checkpoints, "");
    table.rule();
    line("altogether", plan.whole,
         fmt::format("{} rank{} of {} thread{}; memory: the most at once", c.ranks,
                     c.ranks == 1 ? "" : "s", plan.threads, plan.threads == 1 ? "" : "s"));
    table.print(to);
    fmt::print(to, "\n");
    if (c.on(Effect::relaxation)) print_scales(to, c, plan.start);
    const io::AvailableMemory there = io::available_memory();
    fmt::print(to, "memory      {} available here ({})\n", memory_text(there.bytes), there.because);
    if (plan.whole.bytes > there.bytes)
        fmt::print(to, "            The run does not fit into this machine: `asperity run` will "
                       "refuse it here. Fewer sites, coarser or\n            fewer layers, or more "
                       "machines\n");
    if (const DeviceChoice& device = c.simulation.device)
        fmt::print(to, "device      {}, {} of its memory on each rank; times are the processor's\n",
                   describe_device(device),
                   memory_text(static_cast<double>(
                       DeviceLayout(c.simulation.block, c.grid(0), c.simulation.interface).bytes)));
    fmt::print(to, "wall time   without messages between machines; {}\n", plan.rates);
    fmt::print(to, "Nothing was run or written.\n");
}

} // namespace asperity
