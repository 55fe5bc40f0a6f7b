// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// How long do the launches of a step take on a device, and how near is that to the device's limits?
// Steps of the program's own Simulation, every site in contact (as step_bench):
//
//     build/release/perf/device_bench SECONDS [section.key=value ...]
//
// numerics.device is "emulated" unless given. Prints JSON: the limits of memory (GB/s of a triad)
// and arithmetic (GFLOP/s of fused multiplications), measured on the device in the same run; the
// fastest stretch of steps, and for each launch its time by the device's clock, the bytes and
// operations counted for it (docs/explanation/device.md), and the fraction of the limit that it
// reaches.
#include "engine/scene/scene.hpp"
#include "engine/setup/case.hpp"
#include "io/error.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <string_view>
#include <vector>

using namespace asperity;

namespace {

// Counted from the kernels' texts (docs/explanation/device.md): bytes that memory must move at
// least, and operations, a fused one as two.
constexpr double moved_node = 96.0, operations_node = 159.0;
constexpr double moved_site = 56.0, operations_pair = 15.5;
constexpr double moved_face = 72.0, moved_constrained = 30.0;

void check(const char* error) {
    if (error) throw std::runtime_error(error);
}

/// The fastest of several launches, s, by the device's clock.
template <class Launch>
double fastest(const DeviceFunctions& device, const Launch& launch) {
    double best = 1e300;
    for (int trial = 0; trial < 10; ++trial) {
        double seconds = 0.0;
        check(device.mark(0));
        check(launch());
        check(device.mark(1));
        check(device.wait(1));
        check(device.seconds_between(0, 1, seconds));
        best = std::min(best, seconds);
    }
    return best;
}

struct Limits {
    double bytes, fused, fused_single; ///< a second
};

Limits limits_of(const DeviceFunctions& device, int index, bool emulated) {
    // Arrays well above a device's caches; a processor that plays the device takes smaller ones.
    const long long n = emulated ? 1ll << 20 : 1ll << 26, threads = emulated ? 1 << 10 : 1 << 18;
    const int rounds = emulated ? 256 : 4096;
    std::byte* memory = nullptr;
    check(device.allocate(index, 3 * static_cast<std::size_t>(n) * sizeof(double), &memory));
    auto* a = reinterpret_cast<double*>(memory);
    Limits limits{};
    limits.bytes = 24.0 * static_cast<double>(n) /
                   fastest(device, [&] { return device.triad(a, a + n, a + 2 * n, n); });
    const double operations = 2.0 * fused_chains * rounds * static_cast<double>(threads);
    limits.fused =
        operations / fastest(device, [&] { return device.fused_double(a, threads, rounds); });
    limits.fused_single =
        operations / fastest(device, [&] {
            return device.fused_single(reinterpret_cast<float*>(memory), threads, rounds);
        });
    device.release(memory);
    return limits;
}

/// Pairs of a site within the cutoff, over a flat lattice.
double pairs_of_site(double a, double cutoff, double z) {
    double pairs = 0.0;
    const int most = static_cast<int>(cutoff / a) + 1;
    for (int j = -most; j <= most; ++j)
        for (int i = -most; i <= most; ++i) {
            const double x = (i + 0.5) * a, y = (j + 0.5) * a;
            pairs += x * x + y * y + z * z < cutoff * cutoff;
        }
    return pairs;
}

nlohmann::json measure(double seconds, std::vector<std::string> settings) {
    settings.insert(settings.begin(), "numerics.device=emulated");
    const Scene scene = read_scene_text("[surface]\nrms = 0.3\n", "device_bench", settings);
    const Case setup = resolve(scene);
    const DeviceChoice& choice = setup.simulation.device;
    if (choice.kind == DeviceChoice::Kind::none)
        throw std::runtime_error("there is no device here; take numerics.device=emulated");
    const bool emulated = choice.kind == DeviceChoice::Kind::emulated;
    Simulation simulation(
        setup.simulation, surface_of(resolve(scene)), Communicator(),
        ProcessGrid(1, 0, scene.surface.sites, static_cast<int>(setup.levels.size())));
    const Limits limits =
        limits_of(emulated ? emulated_device() : *cuda_device(), choice.index, emulated);
    simulation.start(setup.flat.separation);

    using Clock = std::chrono::steady_clock;
    constexpr Phase phases[] = {Phase::interpolate, Phase::interface, Phase::advance, Phase::sums};
    double best = 1e300, launch[4] = {};
    const auto begin = Clock::now();
    const auto since = [](Clock::time_point start) {
        return std::chrono::duration<double>(Clock::now() - start).count();
    };
    constexpr int steps = 10;
    for (int n = 0; n < 3 || since(begin) < seconds; ++n) {
        double before[4];
        for (int k = 0; k < 4; ++k)
            before[k] = simulation.phases()[phases[k]].seconds;
        const auto start = Clock::now();
        for (int step = 0; step < steps; ++step)
            simulation.step(false);
        const double took = since(start) / steps;
        if (took >= best) continue;
        best = took;
        for (int k = 0; k < 4; ++k)
            launch[k] = (simulation.phases()[phases[k]].seconds - before[k]) / steps;
    }

    double nodes = 0.0, planes = 0.0;
    for (const auto& level : simulation.block().levels()) {
        nodes += static_cast<double>(level.nodes());
        planes += static_cast<double>(level.tile.nx) * level.tile.ny;
    }
    const bool mixed = setup.simulation.interface.mixed;
    const double sites = static_cast<double>(scene.surface.sites) * scene.surface.sites;
    const double pairs = sites * pairs_of_site(setup.simulation.block.spacing,
                                               cutoff_of(setup.simulation.interface.potential),
                                               setup.flat.separation);
    const auto row = [&](const char* name, double took, double moved, double operations,
                         double rate) {
        const double by_memory = moved / limits.bytes, by_arithmetic = operations / rate;
        return nlohmann::json{{"launch", name},
                              {"seconds", took},
                              {"bytes", moved},
                              {"operations", operations},
                              {"bound_by_memory", by_memory},
                              {"bound_by_arithmetic", by_arithmetic},
                              {"fraction", std::max(by_memory, by_arithmetic) / took}};
    };
    return {
        {"device", describe_device(choice)},
        {"note", emulated ? "emulated: its times mean nothing for a GPU" : ""},
        {"sites", scene.surface.sites},
        {"nodes", nodes},
        {"pairs", pairs},
        {"precision", mixed ? "mixed" : "double"},
        {"GB/s", 1e-9 * limits.bytes},
        {"GFLOP/s", 1e-9 * limits.fused},
        {"GFLOP/s single", 1e-9 * limits.fused_single},
        {"step", best},
        {"waits_for_host", launch[3]},
        {"launches",
         {row("follow", launch[0], planes * moved_constrained, 0.0, limits.fused),
          row("forces", launch[1], sites * moved_site + planes * moved_face,
              pairs * operations_pair, mixed ? limits.fused_single : limits.fused),
          row("advance", launch[2], nodes * moved_node, nodes * operations_node, limits.fused)}}};
}

} // namespace

int main(int argc, char** argv) {
    const double seconds = argc > 1 ? std::atof(argv[1]) : 0.0;
    if (!(seconds > 0.0)) {
        std::fprintf(stderr, "usage: device_bench SECONDS [section.key=value ...]\n");
        return 2;
    }
    try {
        std::printf("%s\n", measure(seconds, {argv + 2, argv + argc}).dump(1).c_str());
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "device_bench: %s\n", error.what());
        return 2;
    }
}
