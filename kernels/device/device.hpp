// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Functions of a device: memory, copies, and the launches of a step. There are two tables of
// functions: one for CUDA (cuda.cu, if its compiler was found) and one for the emulated device
// (emulated.cpp, always). Both compile the same kernels (passes.hpp).
//
// A step from u(n), v(n - 1/2) to u(n + 1), v(n + 1/2) over all levels takes three launches:
//   interpolate  constrained planes from the coarse planes; the top plane is set
//   forces       sites of the interface, and the upper faces of all levels
//   advance      restriction, elastic forces, kick, and drift into the other displacement array,
//                with the periodic images of every node
// Several ranks need three more launches: restrict_to_shared (forces on a level that every rank
// holds whole), pack and unpack (halos).
//
// Launches are executed in order, on one stream. copy() returns once all earlier launches and the
// copy are complete.
//
// Every function returns nullptr, or an error message.
#pragma once

#include "kernels/elastic_level.hpp"
#include "kernels/level_transfer.hpp"
#include "kernels/pair_sum.hpp"
#include "kernels/thermal_noise.hpp"

#include <cstddef>
#include <optional>
#include <string>

namespace asperity {

/// Largest number of levels of a block: each halves a box of fewer than 2^24 sites.
inline constexpr int most_levels = 24;

/// One level on the device; all views are of device memory.
struct DeviceLevel {
    int nx = 0, ny = 0, cells = 0;
    int number = 0, x0 = 0, y0 = 0; ///< number of the level; the tile's first node
    VectorVolume<double> u[2];      ///< displacements at the present step and the next, alternating
    VectorVolume<double> v;
    VectorPlane<double> transferred, upper_force;
    Stencil lower{}, inner{}, upper{};
    LevelCell cell;
    LevelSeam seam;                        ///< position relative to the coarser level
    bool in_line = false;                  ///< advance() restricts the forces of the level below
    bool counted = false;                  ///< global sums include this level
    bool wraps_x = false, wraps_y = false; ///< the tile contains its periodic images along an axis
};

/// Nodes of several levels, numbered consecutively.
struct NodeRanges {
    int levels = 0;
    long long first[most_levels + 1] = {}; ///< index of the first node of each level, and the end
    /// Appends a level with this number of nodes.
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
/// Indices of the sums of the launch `forces` in PassSums.
struct ForceSum {
    enum { interface_z, interface_energy, lowest_z, top_z };
    enum { in_contact, repulsive };
};
/// Indices of the sums of the launch `advance` in PassSums.
struct AdvanceSum {
    enum { kinetic, of_step, dissipated, dragged, elastic, heat };
};

/// Arguments of every launch, passed by value.
struct DeviceStep {
    const DeviceLevel* levels = nullptr; ///< levels, in device memory
    const LevelKicks* kicks = nullptr;   ///< kicks of each level, in device memory
    NodeRanges moving;                   ///< nodes that move
    NodeRanges faces;                    ///< nodes of upper planes and one node beyond the tile
    NodeRanges constrained;              ///< nodes of upper planes and their halo
    int now = 0;                         ///< index of the displacement array of the present step
    bool observe = false;
    bool damped = false; ///< some nodes are damped
    double dt = 0.0;     ///< fs
    double top = 0.0;    ///< displacement of the top plane, Å
    bool noisy = false;  ///< thermal noise acts on damped nodes
    ThermalNoise noise;

    InterfaceSites sites;
    LatticeSubstrate lattice;
    bool with_tail = false;
    double tail_density = 0.0; ///< atoms per Å^2
    PlaneView<const double> mean_height;

    PassSums* sums = nullptr; ///< sums of the launches forces and advance, in device memory
};

/// A strip of halo exchanged with the two neighbours along an axis.
struct DeviceHalo {
    bool along_x = true;
    NodeRanges strip; ///< numbers of one side's message, level by level
    /// Messages to or from both neighbours, the lower one first, in device memory.
    double* messages = nullptr;
    int buffer = 0; ///< index of the displacement array
};

/// Functions of one kind of device.
struct DeviceFunctions {
    /// Allocates memory on device `index`, to which all later calls refer.
    const char* (*allocate)(int index, std::size_t bytes, std::byte** memory);
    /// Frees the memory.
    void (*release)(std::byte* memory);
    /// Copies between host and device, in either direction.
    const char* (*copy)(void* to, const void* from, std::size_t bytes);

    /// Interpolates the constrained planes and sets the top plane.
    const char* (*interpolate)(const DeviceStep& step);
    /// Computes the forces of the interface and of the upper faces. The numbers of a tabulated
    /// potential are in device memory.
    const char* (*forces)(const DeviceStep& step, const PairPotential& potential);
    /// Transfers forces to nodes of a level `coarse` that every rank holds whole.
    const char* (*restrict_to_shared)(const DeviceStep& step, int coarse, Patch nodes);
    /// Computes elastic forces, kicks and drifts.
    const char* (*advance)(const DeviceStep& step);
    /// Copies the strip to messages, or messages to the halo.
    const char* (*pack)(const DeviceStep& step, const DeviceHalo& halo);
    const char* (*unpack)(const DeviceStep& step, const DeviceHalo& halo);
};

/// Returns the functions of the emulated device.
const DeviceFunctions& emulated_device();
/// Returns the functions of CUDA; nullptr if the program was built without CUDA.
const DeviceFunctions* cuda_device();
/// Returns the number of devices that CUDA finds.
int cuda_device_count();
/// Returns the name of a device.
std::string cuda_device_name(int index);

/// Behaviour of the emulated device, for tests.
struct EmulatedSettings {
    /// Order of the nodes of a launch, which run one after the other: their own (0), or one of many
    /// others. If a result depends on the order, two threads access the same number.
    unsigned order = 0;
    std::size_t memory = 0; ///< memory of the device, bytes; 0: that of the machine
    std::optional<long long> lost_after = {}; ///< number of launches after which calls fail
};
EmulatedSettings& emulated_settings();

} // namespace asperity
