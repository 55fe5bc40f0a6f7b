// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What a device is asked for: memory, copies, and the launches of a step. Two tables of functions
// of this shape exist: that of CUDA (cuda.cu, where its compiler was found) and that of the
// emulated device (emulated.cpp, always). Both are made of one text (passes.hpp).
//
// A step from u(n), v(n - 1/2) to u(n + 1), v(n + 1/2) over all levels takes three launches:
//   follow   constrained planes follow the coarse planes; the top plane is where the drive has it
//   forces   sites of the interface, and the upper faces of all levels
//   advance  restriction, elastic forces, kick, and drift into the other displacement array, with
//            the periodic images of every node
// Between ranks come three more: restrict_to_shared (forces that go to a level that every rank
// holds), pack and unpack (halos).
//
// Launches, send() and fetch() are queued: each begins when those before it are done, and the call
// returns at once. The host memory they name must be pinned, and may be read or written again when
// a mark() behind them has been waited for.
//
// Every function returns nullptr, or a text that says what went wrong.
#pragma once

#include "kernels/elastic_level.hpp"
#include "kernels/level_transfer.hpp"
#include "kernels/pair_sum.hpp"
#include "kernels/thermal_noise.hpp"

#include <cstddef>
#include <string>

namespace asperity {

/// Levels of a block at most: each halves a box of fewer than 2^24 sites.
inline constexpr int most_levels = 24;

/// One level on the device; all views are of device memory.
struct DeviceLevel {
    int nx = 0, ny = 0, cells = 0;
    int number = 0, x0 = 0, y0 = 0; ///< which level; the tile's first node
    VectorVolume<double> u[2];      ///< displacement at the present step and at the next, in turn
    VectorVolume<double> v;
    VectorPlane<double> transferred, upper_force;
    Stencil lower{}, inner{}, upper{};
    LevelCell cell;
    LevelSeam seam;       ///< to the coarser level
    bool in_line = false; ///< transferred forces are restricted from the level below where needed
    bool counted = false; ///< in global sums
    bool wraps_x = false, wraps_y = false; ///< periodic images lie in this tile
};

/// Nodes of several levels, counted through.
struct NodeRanges {
    int levels = 0;
    long long first[most_levels + 1] = {}; ///< of each level; behind the last: the end
};

/// Sums of one launch over its nodes.
struct PassSums {
    static constexpr int sums = 5;
    ExactSum sum[sums];
    double count[2] = {0.0, 0.0};
    double least = no_pair;
};
/// What they are.
struct ForceSum {
    enum { interface_z, interface_energy, lowest_z, top_z };
    enum { in_contact, repulsive };
};
struct AdvanceSum {
    enum { kinetic, dissipated, dragged, elastic, heat };
};

/// What every launch is handed, by value.
struct DeviceStep {
    const DeviceLevel* levels = nullptr; ///< in device memory
    const LevelKicks* kicks = nullptr;   ///< likewise, of each level
    NodeRanges moving;                   ///< nodes that move
    NodeRanges faces;                    ///< nodes of upper planes and one beyond
    NodeRanges constrained;              ///< nodes of upper planes and their halo
    int now = 0;                         ///< which displacement array is that of the present step
    bool observe = false;
    bool damped = false; ///< some nodes are
    double dt = 0.0;     ///< fs
    double top = 0.0;    ///< of the top plane, Å
    bool finite = false; ///< strain
    bool noisy = false;  ///< damped nodes feel thermal noise
    ThermalNoise noise;

    InterfaceSites sites;
    LatticeSubstrate lattice;
    RowSubstrate rows; ///< in place of the lattice
    bool over_rows = false;
    bool mixed = false;
    bool with_tail = false;
    double tail_density = 0.0; ///< atoms per Å^2
    PlaneView<const double> mean_height;

    PassSums* sums = nullptr; ///< in device memory: of forces, of advance
};

/// A strip of halo traded with the two neighbours along an axis.
struct DeviceHalo {
    bool along_x = true;
    NodeRanges strip;                           ///< doubles of one side's message, level by level
    double *before = nullptr, *after = nullptr; ///< messages, in device memory
    int buffer = 0;                             ///< which displacement array
};

/// Marks in the queue, by number.
inline constexpr int device_marks = 32;

struct DeviceFunctions {
    const char* (*describe)(int index, std::string& name, std::size_t& free_bytes);
    /// Device memory; from then on this device is the one that all calls mean.
    const char* (*allocate)(int index, std::size_t bytes, std::byte** memory);
    void (*release)(std::byte* memory);
    /// Memory of the host that send() and fetch() may name.
    const char* (*allocate_pinned)(std::size_t bytes, std::byte** memory);
    void (*release_pinned)(std::byte* memory);

    // Copies of any memory, which wait for all that is queued.
    const char* (*upload)(void* to, const void* from, std::size_t bytes);
    const char* (*download)(void* to, const void* from, std::size_t bytes);

    // Queued.
    const char* (*send)(void* to, const void* from, std::size_t bytes);
    const char* (*fetch)(void* to, const void* from, std::size_t bytes);
    const char* (*mark)(int number);
    /// Begins when the queue has come here, and goes on beside what is queued behind it; then its
    /// mark is reached.
    const char* (*fetch_beside)(void* to, const void* from, std::size_t bytes, int number);

    const char* (*wait)(int number);
    /// Between two marks that were reached.
    const char* (*seconds_between)(int first, int second, double& seconds);
    /// Whether an MPI that knows of CUDA can read and write this device's memory. It is opened
    /// before a message and closed behind it.
    bool (*takes_mpi)(bool mpi_knows_cuda);
    const char* (*open_to_mpi)(bool open);

    const char* (*follow)(const DeviceStep& step);
    /// A table's numbers lie in device memory.
    const char* (*forces)(const DeviceStep& step, const PairPotential& potential);
    const char* (*restrict_to_shared)(const DeviceStep& step, int coarse, Patch nodes);
    const char* (*advance)(const DeviceStep& step);
    const char* (*pack)(const DeviceStep& step, const DeviceHalo& halo);
    const char* (*unpack)(const DeviceStep& step, const DeviceHalo& halo);

    // What the device can do at best, for perf/device_bench.cpp (limits.hpp).
    /// a = b + s c; a, b, c of n numbers.
    const char* (*triad)(double* a, const double* b, const double* c, long long n);
    /// So many threads, each rounds x fused_chains fused multiplications; out: one number each.
    const char* (*fused_double)(double* out, long long threads, int rounds);
    const char* (*fused_single)(float* out, long long threads, int rounds);
};
inline constexpr int fused_chains = 8;

const DeviceFunctions& emulated_device();
/// Null where the program was built without CUDA.
const DeviceFunctions* cuda_device();
/// Devices that CUDA finds here.
int cuda_device_count();

/// How the emulated device behaves; for tests.
struct EmulatedSettings {
    /// Nodes of a launch run one after the other: in their order (0), or in one of many others. A
    /// result that depends on the order has two threads at one number.
    unsigned order = 0;
    /// What is queued is done at once, or as late as waits allow, with launches far ahead of copies
    /// beside them. A result that differs has read, or written, too early.
    bool at_once = false;
    std::size_t memory = 0;    ///< bytes that it has; 0: the machine's
    long long lost_after = -1; ///< so many more launches it is lost; negative: never
    bool open_to_mpi = false;  ///< as a device whose memory MPI takes
};
EmulatedSettings& emulated_settings();

} // namespace asperity
