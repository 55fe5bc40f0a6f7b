// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/run/plan.hpp"

#include "engine/run/plan_rates.hpp"
#include "engine/scene/accuracy.hpp"
#include "engine/units.hpp"
#include "io/table.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace asperity {

namespace {

/// Writing a checkpoint, bytes/s; and one solution of the theory, s: from experience.
constexpr double disk = 2e8, theory_seconds = 0.3;
/// Iterations of a relaxation, from experience (first-contact and flat-3A, N = 64 to 512); of a
/// quasi-static path likewise (first-contact, N = 32 to 128, some with steep falls).
long long usual_iterations(const Scene& scene, double start, const Setup& setup) {
    if (scene.drive.mode == DriveMode::quasistatic &&
        (scene.has(PathPart::approach) || scene.has(PathPart::pull_off))) {
        const ExpectedWay way = expected_way(setup, start);
        const double points = 1.5 * (way.down + way.up) / scene.drive.step;
        return std::llround(points * (scene.block.model == BlockModel::spectral ? 40.0 : 100.0));
    }
    if (scene.block.model == BlockModel::spectral) return 150;
    if (!scene.has(PathPart::zero_load)) return 300; // from contact, which is near
    return std::llround(80.0 * std::sqrt(scene.surface.sites));
}

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

ExpectedWay expected_way(const Setup& setup, double start) {
    const auto& [block, drive] = std::tie(setup.simulation.block, setup.simulation.drive);
    ExpectedWay way;
    if (drive.approach) way.down = start - setup.flat.separation;
    if (!drive.pull_off) return way;
    // A block that is pulled with half the largest tension is longer by so much when it comes off.
    const double modulus = block.lame() + 2.0 * block.shear_modulus();
    const double stretch = 0.5 * setup.flat.largest_tension * units::gigapascal * block.thickness *
                           block.spacing / modulus;
    way.up = std::max(way.down, stretch);
    way.turn = drive.ramp;
    return way;
}

long long expected_steps(const Scene& scene, const Setup& setup, double start) {
    if (!setup.effects.on(Effect::inertia)) return 0;
    const ExpectedWay way = expected_way(setup, start);
    const double time = (way.down + way.up) / setup.simulation.drive.velocity + way.turn;
    const long long steps = std::llround(time / setup.simulation.dt);
    return scene.drive.max_steps > 0 ? std::min(steps, scene.drive.max_steps) : steps;
}

Plan make_plan(const Scene& scene, int ranks, int threads) {
    Plan plan;
    plan.setup = make_setup(scene, ranks);
    plan.ranks = ranks;
    plan.threads = threads;
    const Setup& setup = plan.setup;
    const auto on = [&](Effect e) { return setup.effects.on(e); };
    const bool spectral = scene.block.model == BlockModel::spectral;
    const auto begin = std::chrono::steady_clock::now();
    const Surface surface = scene_surface(scene);
    const double surface_seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    const Rates rates = measure_rates(scene, setup, surface);
    plan.rates = rates.origin;

    // What the slowest rank has to do, in units of what this process does in the same time.
    const double measured_threads = omp_get_max_threads();
    const double uneven = 1.0 + make_grid(scene, setup, ranks, 0).imbalance();
    const double share = uneven / ranks * measured_threads / threads;
    const double sites = static_cast<double>(scene.surface.sites) * scene.surface.sites;
    const double nodes = spectral ? sites : nodes_of(setup.levels);
    const double coarse = nodes - sites * (spectral ? 1 : setup.levels.front().cells);
    const double start =
        surface.statistics.highest + (on(Effect::tail) ? 4.0 : 1.0) * scene.interface.cutoff;
    plan.steps = expected_steps(scene, setup, start);
    const auto cost = [&](Effect effect) -> EffectCost& {
        return plan.costs[static_cast<std::size_t>(effect)];
    };
    const double steps = static_cast<double>(plan.steps);
    const double turning =
        setup.simulation.drive.pull_off && steps > 0.0
            ? std::min(1.0, expected_way(setup, start).turn / (steps * setup.simulation.dt))
            : 0.0;
    // On its way down and up a site's cost goes from that of one out of reach to that of one in
    // contact; in the turn it is in contact.
    const double in_contact = turning + 0.5 * (1.0 - turning);
    const double site = rates.far + in_contact * (rates.near - rates.far);
    const double touched = share * sites * steps;

    Block::Memory block;
    for (int rank = 0; rank < ranks && !spectral; ++rank) {
        const Block::Memory m = Block::memory_for(
            setup.simulation.block,
            ProcessGrid(ranks, rank, scene.surface.sites, static_cast<int>(setup.levels.size())));
        block.bytes += m.bytes, block.motion += m.motion, block.coarse += m.coarse;
    }
    const double at_rest = static_cast<double>(block.bytes - block.motion);
    const double motion = static_cast<double>(block.motion);
    plan.interface = {rates.interface_bytes * sites, touched * site};
    if (on(Effect::inertia)) {
        cost(Effect::inertia) = {motion, share * steps * (nodes * rates.node + sites * rates.rest)};
        cost(Effect::lateral) = {2.0 * (at_rest + motion) / 3.0, 0.0};
        cost(Effect::damping) = {0.0,
                                 on(Effect::damping) ? share * steps * nodes * rates.damping : 0.0};
        if (on(Effect::temperature))
            cost(Effect::temperature) = {0.0, share * steps * nodes * rates.noise};
        const double rows = steps / static_cast<double>(scene.output.series);
        cost(Effect::observation) = {motion, share * rows * nodes * rates.observation};
    }
    if (on(Effect::coarse_levels))
        cost(Effect::coarse_levels) = {static_cast<double>(block.coarse),
                                       share * steps *
                                           (coarse * rates.node + sites * rates.hanging)};
    if (on(Effect::tail)) cost(Effect::tail) = {8.0 * sites, touched * rates.tail};
    cost(Effect::skipping) = {8.0 * interface_rings * sites / interface_block,
                              -touched * (1.0 - in_contact) * (rates.near - rates.far)};
    if (on(Effect::relaxation)) {
        plan.iterations = usual_iterations(scene, start, setup);
        cost(Effect::relaxation) = {spectral ? rates.relaxation_bytes * sites : at_rest + motion,
                                    share * static_cast<double>(plan.iterations) * nodes *
                                        rates.iteration};
    }
    if (!on(Effect::inertia)) { // all there is is the relaxation
        const EffectCost& all = cost(Effect::relaxation);
        if (on(Effect::lateral)) cost(Effect::lateral).bytes = 2.0 * all.bytes / 3.0;
        if (on(Effect::coarse_levels))
            cost(Effect::coarse_levels).seconds = all.seconds * coarse / nodes;
    }
    if (on(Effect::finite_strain)) {
        cost(Effect::finite_strain).seconds =
            share * (steps + static_cast<double>(plan.iterations)) * nodes * rates.finite;
        for (int rank = 0; rank < ranks && on(Effect::inertia); ++rank)
            cost(Effect::finite_strain).bytes += static_cast<double>(
                Block::finite_bytes_for(setup.simulation.block,
                                        ProcessGrid(ranks, rank, scene.surface.sites,
                                                    static_cast<int>(setup.levels.size())),
                                        threads));
    }
    if (on(Effect::maps)) cost(Effect::maps) = {56.0 * sites, 56.0 * sites / disk};
    plan.making = {16.0 * static_cast<double>(surface.height.size()) * ranks,
                   surface_seconds + share * sites * rates.making};
    if (on(Effect::theory)) cost(Effect::theory).seconds = theory_seconds;

    // Those that are part of another line (coarse levels, skipping, lateral, the time of finite
    // strain) do not count twice.
    plan.bytes = plan.making.bytes + plan.interface.bytes + cost(Effect::finite_strain).bytes;
    plan.seconds = plan.making.seconds + plan.interface.seconds;
    for (Effect e : {Effect::inertia, Effect::damping, Effect::temperature, Effect::tail,
                     Effect::relaxation, Effect::observation, Effect::maps, Effect::theory}) {
        plan.bytes += cost(e).bytes;
        plan.seconds += cost(e).seconds;
    }
    if (on(Effect::inertia)) plan.bytes += at_rest;
    if (on(Effect::coarse_levels)) plan.seconds += share * steps * sites * rates.hanging;
    if (on(Effect::checkpoints)) {
        const double files = std::floor(plan.seconds / scene.output.checkpoint);
        cost(Effect::checkpoints).seconds = files * 48.0 * nodes / disk;
        plan.seconds += cost(Effect::checkpoints).seconds;
    }
    return plan;
}

void print_plan(std::FILE* to, const Scene& scene, const Plan& plan) {
    const Setup& setup = plan.setup;
    const auto& s = scene.surface;
    fmt::print(to, "{}: {} x {} sites, box {:.6g} Å, {} layers in {} level{}\n\n", scene.name,
               s.sites, s.sites, scene.edge(), scene.block.thickness, setup.levels.size(),
               setup.levels.size() == 1 ? "" : "s");
    io::Table table({"effect", "", "memory", "time", "because"});
    table.align_left(1);
    table.align_left(4);
    const auto line = [&](std::string_view what, const char* state, const EffectCost& cost,
                          const std::string& why) {
        const bool saves = cost.seconds < 0.0;
        table.row({std::string(what), state, memory_text(cost.bytes),
                   (saves ? "-" : "") + time_text(std::abs(cost.seconds)), why});
    };
    for (std::size_t i = 0; i < effect_count; ++i) {
        const auto effect = static_cast<Effect>(i);
        line(name(effect), setup.effects.on(effect) ? "on" : "off", plan.cost(effect),
             setup.effects.why(effect));
    }
    table.rule();
    line("the interface itself", "", plan.interface,
         fmt::format("{:.4g} Å of reach", scene.interface.cutoff));
    line("making surface and tables", "", plan.making, "before the first step");
    line("altogether", "", {plan.bytes, plan.seconds},
         fmt::format("{} rank{} of {} thread{}", plan.ranks, plan.ranks == 1 ? "" : "s",
                     plan.threads, plan.threads == 1 ? "" : "s"));
    table.print(to);
    fmt::print(to, "\n");
    if (scene.choice)
        for (const std::string& said : accuracy_lines(*scene.choice))
            fmt::print(to, "accuracy    {}\n", said);
    if (plan.steps > 0)
        fmt::print(to, "steps       {} of {:.4g} fs{}\n", plan.steps, setup.simulation.dt,
                   plan.steps == scene.drive.max_steps ? " (drive.max_steps)" : "");
    if (const auto longer = longer_timestep(scene); plan.steps > 0 && longer)
        fmt::print(to,
                   "            drive.timestep = {:g} would take {:.2g} times fewer, for up to "
                   "{:.2g} % of error (docs/accuracy.md)\n",
                   longer->timestep, longer->timestep / scene.drive.timestep,
                   100.0 * longer->error);
    if (plan.iterations > 0)
        fmt::print(to, "iterations  some {} in the relaxation (from experience)\n",
                   plan.iterations);
    fmt::print(to, "memory      {}, the most held at once\n", memory_text(plan.bytes));
    fmt::print(to, "wall time   {}, without messages between machines; {}\n",
               time_text(plan.seconds), plan.rates);
    fmt::print(
        to, "Coarse levels, lateral displacements and what finite strain takes longer are parts of "
            "inertia or\nrelaxation; what skipping saves is not in the interface's line. Nothing "
            "was run, nothing was written.\nA run says afterwards whether it kept to this list: "
            "run.effects in result.json.\n");
}

} // namespace asperity
