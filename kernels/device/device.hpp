// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What a device is asked for: memory, copies, and the launches of a step. Two tables of functions
// of this shape exist: that of CUDA (cuda.cu, where its compiler was found) and that of the
// emulated device (emulated.cpp, always). Both compile the same kernels (passes.hpp).
//
// A step from u(n), v(n - 1/2) to u(n + 1), v(n + 1/2) over all levels takes three launches:
//   follow   constrained planes are interpolated from the coarse planes; the top plane is set
//   forces   sites of the interface, and the upper faces of all levels
//   advance  restriction, elastic forces, kick, and drift into the other displacement array, with
//            the periodic images of every node
// Between ranks come three more: restrict_to_shared (forces that go to a level that every rank
// holds), pack and unpack (halos).
//
// Launches are carried out in order, on one stream. copy() returns when all launches before it and
// the copy itself are done.
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
    VectorVolume<double> u[2];      ///< displacement at the present step and the next, alternating
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
    void add_level(long long nodes) {
        first[levels + 1] = first[levels] + nodes;
        ++levels;
    }
};

/// Sums of one launch over its nodes.
struct PassSums {
    static constexpr int sums = 6;
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
    enum { kinetic, of_step, dissipated, dragged, elastic, heat };
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
    bool noisy = false;  ///< thermal noise acts on damped nodes
    ThermalNoise noise;

    InterfaceSites sites;
    LatticeSubstrate lattice;
    bool with_tail = false;
    double tail_density = 0.0; ///< atoms per Å^2
    PlaneView<const double> mean_height;

    PassSums* sums = nullptr; ///< in device memory: of forces, of advance
};

/// A strip of halo traded with the two neighbours along an axis.
struct DeviceHalo {
    bool along_x = true;
    NodeRanges strip; ///< doubles of one side's message, level by level
    /// In device memory: to or from the neighbour before; behind it, the neighbour after.
    double* messages = nullptr;
    int buffer = 0; ///< which displacement array
};

struct DeviceFunctions {
    /// Device memory; this device is the one that all calls from then on refer to.
    const char* (*allocate)(int index, std::size_t bytes, std::byte** memory);
    void (*release)(std::byte* memory);
    /// Between host and device, in either direction.
    const char* (*copy)(void* to, const void* from, std::size_t bytes);

    const char* (*follow)(const DeviceStep& step);
    /// The numbers of a tabulated potential are in device memory.
    const char* (*forces)(const DeviceStep& step, const PairPotential& potential);
    const char* (*restrict_to_shared)(const DeviceStep& step, int coarse, Patch nodes);
    const char* (*advance)(const DeviceStep& step);
    const char* (*pack)(const DeviceStep& step, const DeviceHalo& halo);
    const char* (*unpack)(const DeviceStep& step, const DeviceHalo& halo);
};

const DeviceFunctions& emulated_device();
/// Null where the program was built without CUDA.
const DeviceFunctions* cuda_device();
/// Devices that CUDA finds here, and what they are called.
int cuda_device_count();
std::string cuda_device_name(int index);

/// How the emulated device behaves; for tests.
struct EmulatedSettings {
    /// Nodes of a launch run one after the other: in their order (0), or in one of many others. If
    /// a result depends on the order, two threads access the same number.
    unsigned order = 0;
    std::size_t memory = 0;    ///< bytes that it has; 0: the machine's
    long long lost_after = -1; ///< number of launches after which calls fail; negative: none
};
EmulatedSettings& emulated_settings();

} // namespace asperity
