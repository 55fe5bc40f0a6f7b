// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/run/plan.hpp"

#include "engine/scene/accuracy.hpp"
#include "engine/setup/memory.hpp"
#include "engine/units.hpp"
#include "io/available_memory.hpp"
#include "io/table.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace asperity {

namespace {

/// Typical: writing a checkpoint, bytes/s; one solution of the theory, s.
constexpr double disk = 2e8, theory_seconds = 0.3;
/// Typical iterations of a relaxation (first-contact and flat-3A, N = 64 to 512) or of a
/// quasi-static path (first-contact, N = 32 to 128, some with large instabilities).
long long typical_iterations(const Scene& scene, double start, const Setup& setup) {
    if (scene.drive.mode == DriveMode::quasistatic &&
        (scene.has(PathPart::approach) || scene.has(PathPart::pull_off))) {
        const ExpectedPath path = expected_path(setup, start);
        const double points = 1.5 * (path.approach + path.pull_off) / scene.drive.step;
        return std::llround(65.0 * points);
    }
    return 130;
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

ExpectedPath expected_path(const Setup& setup, double start) {
    const auto& [block, drive] = std::tie(setup.simulation.block, setup.simulation.drive);
    ExpectedPath path;
    if (drive.approach) path.approach = start - setup.flat.separation;
    if (!drive.pull_off) return path;
    // Elongation of the block when it separates, at half the largest tension.
    const double modulus = block.lame() + 2.0 * block.shear_modulus();
    const double stretch =
        0.5 * setup.largest_tension * units::gigapascal * block.thickness * block.spacing / modulus;
    path.pull_off = std::max(path.approach, stretch);
    path.turn = drive.ramp;
    return path;
}

long long expected_steps(const Scene& scene, const Setup& setup, double start) {
    if (!setup.effects.on(Effect::inertia)) return 0;
    const ExpectedPath path = expected_path(setup, start);
    const double time =
        (path.approach + path.pull_off) / setup.simulation.drive.velocity + path.turn;
    const long long steps = std::llround(time / setup.simulation.dt);
    return scene.drive.max_steps > 0 ? std::min(steps, scene.drive.max_steps) : steps;
}

namespace {

/// Sites above which a piece of the surface is made instead of it.
constexpr int largest_surface = 512;
/// Typical: highest point of a rough surface over its rms height.
constexpr double highest_over_rms = 4.5;

/// A box of largest_surface sites with those waves of the scene's surface that fit into it.
Scene smaller_box(const Scene& scene) {
    Scene piece = scene;
    auto& s = piece.surface;
    const double part = static_cast<double>(largest_surface) / s.sites;
    s.sites = largest_surface;
    if (s.kind == SurfaceKind::flat) return piece;
    // Of the variance, 2 pi int q C dq with C flat to the roll-off and then q^(-2(1+H)), what lies
    // above the new q_L. q in q_L of the scene.
    const double top = std::min(s.cutoff, 0.5 * scene.surface.sites);
    const auto variance = [&](double from) {
        constexpr int steps = 2000;
        double sum = 0.0;
        for (int i = 0; i < steps; ++i) {
            const double q = from * std::pow(top / from, (i + 0.5) / steps);
            sum += q * q * (q <= s.rolloff ? 1.0 : std::pow(q / s.rolloff, -2.0 * (1.0 + s.hurst)));
        }
        return sum * std::log(top / from) / steps;
    };
    s.rms *= top > 1.0 / part ? std::sqrt(variance(1.0 / part) / variance(1.0)) : 0.0;
    s.rolloff = std::max(1.0, s.rolloff * part);
    s.cutoff = std::max(s.rolloff, s.cutoff * part);
    return piece;
}

/// Fills in a plan: the work of a scene times the rates of this process.
class Estimate {
public:
    Estimate(Plan& plan, const Scene& scene, const std::optional<Rates>& rates)
        : plan_(plan), scene_(scene) {
        const auto begin = std::chrono::steady_clock::now();
        const bool whole = scene.surface.reads_file() || scene.surface.sites <= largest_surface;
        surface_ = scene_surface(whole ? scene : smaller_box(scene));
        const double measured = static_cast<double>(surface_.height.size());
        surface_seconds_ =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        highest_ = surface_.statistics.highest;
        atoms_ = std::pow(substrate_sites(scene.surface.sites, scene.surface.lattice_ratio), 2);
        if (!whole) {
            surface_seconds_ *= atoms_ / measured;
            highest_ = scene.surface.kind == SurfaceKind::flat
                           ? 0.0
                           : highest_over_rms * scene.surface.rms;
        }
        need_ = memory_of(scene, plan.setup, plan.ranks, plan.threads);
        rates_ = rates ? *rates : measure_rates(scene, plan.setup, surface_);
        plan.rates = rates_.origin;
        count_work();
        coarse_bytes_ = coarse_bytes();
    }

    /// Before the first step: the surface and the tables made from it.
    void making() {
        plan_.making = {need_.making, surface_seconds_ + share_ * sites_ * rates_.making};
    }

    void interface() {
        const double site = rates_.far + in_contact_ * (rates_.near - rates_.far);
        const double touched = share_ * sites_ * steps_;
        plan_.interface = {need_.surface + need_.interface, touched * site};
        if (on(Effect::tail)) cost(Effect::tail) = {8.0 * sites_, touched * rates_.tail};
        cost(Effect::skipping) = {8.0 * interface_rings * sites_ / interface_block,
                                  -touched * (1.0 - in_contact_) * (rates_.near - rates_.far)};
    }

    /// The block in motion.
    void motion() {
        if (!on(Effect::inertia)) return;
        const double node_steps = share_ * steps_ * nodes_, site_steps = share_ * steps_ * sites_;
        cost(Effect::inertia) = {need_.motion, node_steps * rates_.node + site_steps * rates_.rest};
        cost(Effect::lateral).bytes = 2.0 * (need_.block + need_.motion) / 3.0;
        if (on(Effect::temperature)) cost(Effect::temperature).seconds = node_steps * rates_.noise;
        const double rows = steps_ / static_cast<double>(scene_.output.series);
        cost(Effect::observation) = {need_.snapshot, share_ * rows * nodes_ * rates_.observation};
        if (on(Effect::coarse_levels))
            cost(Effect::coarse_levels).seconds =
                share_ * steps_ * coarse_ * rates_.node + site_steps * rates_.hanging;
    }

    /// Relaxations: of the state at zero load, or at every point of a path without time.
    void relaxation() {
        EffectCost& all = cost(Effect::relaxation);
        if (on(Effect::relaxation)) {
            plan_.iterations = typical_iterations(scene_, start_, plan_.setup);
            // In time the root relaxes alone.
            const double share = on(Effect::inertia) ? share_ * plan_.ranks : share_;
            all = {need_.relaxation + (on(Effect::inertia) ? 0.0 : need_.block),
                   share * iterations() * sites_ * rates_.iteration};
        }
        if (on(Effect::coarse_levels)) cost(Effect::coarse_levels).bytes = coarse_bytes_;
        if (on(Effect::inertia)) return;
        // Without inertia, all time goes into the relaxation.
        if (on(Effect::lateral)) cost(Effect::lateral).bytes = 2.0 * all.bytes / 3.0;
    }

    void seams() {
        if (on(Effect::seams))
            cost(Effect::seams) = {need_.absorption, share_ * steps_ * sites_ * rates_.absorption};
    }

    void finite_strain() {
        if (!on(Effect::finite_strain)) return;
        EffectCost& finite = cost(Effect::finite_strain);
        finite.seconds = share_ * steps_ * nodes_ * rates_.finite;
        finite.bytes = need_.finite;
    }

    void output() {
        if (on(Effect::maps)) cost(Effect::maps) = {56.0 * sites_, 56.0 * sites_ / disk};
        if (on(Effect::theory)) cost(Effect::theory).seconds = theory_seconds;
    }

    /// The sum of all lines but those that are part of another one.
    void add_up() {
        plan_.bytes = need_.most() + cost(Effect::maps).bytes;
        plan_.seconds = plan_.making.seconds + plan_.interface.seconds;
        for (std::size_t i = 0; i < effect_count; ++i) {
            const auto effect = static_cast<Effect>(i);
            if (effect == Effect::lateral || effect == Effect::coarse_levels ||
                effect == Effect::skipping || effect == Effect::finite_strain)
                continue;
            plan_.seconds += cost(effect).seconds;
        }
        if (on(Effect::coarse_levels)) plan_.seconds += share_ * steps_ * sites_ * rates_.hanging;
        if (!on(Effect::checkpoints)) return;
        const double files = std::floor(plan_.seconds / scene_.output.checkpoint);
        cost(Effect::checkpoints).seconds = files * 48.0 * nodes_ / disk;
        plan_.seconds += cost(Effect::checkpoints).seconds;
    }

private:
    /// Steps, nodes and sites, and what the slowest rank has of them.
    void count_work() {
        const Setup& setup = plan_.setup;
        const double measured_threads = omp_get_max_threads();
        const double uneven = 1.0 + make_grid(scene_, setup, plan_.ranks, 0).imbalance();
        share_ = uneven / plan_.ranks * measured_threads / plan_.threads;
        sites_ = static_cast<double>(scene_.surface.sites) * scene_.surface.sites;
        nodes_ = on(Effect::inertia) ? nodes_of(setup.levels) : sites_;
        coarse_ = nodes_ - sites_ * (on(Effect::inertia) ? setup.levels.front().cells : 1);
        start_ = highest_ + reach_of(setup.simulation.interface);
        plan_.steps = expected_steps(scene_, setup, start_);
        steps_ = static_cast<double>(plan_.steps);
        const double turning =
            setup.simulation.drive.pull_off && steps_ > 0.0
                ? std::min(1.0, expected_path(setup, start_).turn / (steps_ * setup.simulation.dt))
                : 0.0;
        // During approach and pull-off the cost of a site changes between that of one out of reach
        // and that of one in contact; in the turn it is in contact.
        in_contact_ = turning + 0.5 * (1.0 - turning);
    }

    /// Of all levels but the finest, on all ranks.
    double coarse_bytes() const {
        double bytes = 0.0;
        for (int rank = 0; rank < plan_.ranks && on(Effect::inertia); ++rank)
            bytes += static_cast<double>(
                Block::memory_for(plan_.setup.simulation.block,
                                  make_grid(scene_, plan_.setup, plan_.ranks, rank))
                    .coarse);
        return bytes;
    }

    bool on(Effect effect) const { return plan_.setup.effects.on(effect); }
    EffectCost& cost(Effect effect) { return plan_.costs[static_cast<std::size_t>(effect)]; }
    double iterations() const { return static_cast<double>(plan_.iterations); }

    Plan& plan_;
    const Scene& scene_;
    Surface surface_;
    double surface_seconds_ = 0.0; ///< to make it
    double highest_ = 0.0;         ///< of its points, Å
    double atoms_ = 0.0;           ///< of the substrate
    MemoryNeed need_;
    Rates rates_;
    double share_ = 1.0; ///< of the work, on the slowest rank with its threads, over this process
    double sites_ = 0.0, nodes_ = 0.0, coarse_ = 0.0; ///< coarse: nodes above level 0
    double steps_ = 0.0;
    double start_ = 0.0;        ///< height of the lowest layer at the start, Å
    double in_contact_ = 0.5;   ///< fraction of the steps that a site is in contact
    double coarse_bytes_ = 0.0; ///< of the block's coarse levels
};

} // namespace

Plan make_plan(const Scene& scene, int ranks, int threads, const std::optional<Rates>& rates) {
    Plan plan;
    plan.setup = make_setup(scene, ranks);
    plan.ranks = ranks;
    plan.threads = threads;
    Estimate estimate(plan, scene, rates);
    estimate.making();
    estimate.interface();
    estimate.motion();
    estimate.relaxation();
    estimate.seams();
    estimate.finite_strain();
    estimate.output();
    estimate.add_up();
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
         fmt::format("{:.4g} Å of reach", reach_of(setup.simulation.interface)));
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
        fmt::print(to, "iterations  about {} in the relaxation (typical){}\n", plan.iterations,
                   setup.effects.on(Effect::states)
                       ? "; the search for all states takes many times as long and is not counted"
                       : "");
    const io::AvailableMemory there = io::available_memory();
    fmt::print(to, "memory      {}, the most held at once on all ranks; {} available here ({})\n",
               memory_text(plan.bytes), memory_text(there.bytes), there.because);
    if (plan.bytes > there.bytes)
        fmt::print(
            to, "            This does not fit into this machine: `asperity run` will refuse "
                "it here. Fewer sites, coarser or fewer\n            layers, or more machines\n");
    if (const DeviceChoice& device = plan.setup.simulation.device;
        device.kind != DeviceChoice::Kind::none)
        fmt::print(to, "device      {}, {} of its memory on each rank; rates are the processor's\n",
                   describe_device(device),
                   memory_text(device_memory_of(scene, plan.setup,
                                                make_grid(scene, plan.setup, plan.ranks, 0))));
    fmt::print(to, "wall time   {}, without messages between machines; {}\n",
               time_text(plan.seconds), plan.rates);
    fmt::print(
        to,
        "Damping, coarse levels, lateral displacements and the time of finite strain are parts of "
        "inertia or\nrelaxation; the time that skipping saves is already left out of the "
        "interface's line. Nothing was run or written.\n");
}

} // namespace asperity
