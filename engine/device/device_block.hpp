// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A block and its interface in the memory of a device: fields and tables, and the time step
// (kernels/device/device.hpp). The host's block keeps the same shape; only upload() and download()
// copy between the two. Results are bitwise identical to those of the host's step.
//
// Each rank has its own device. Halos, and the forces on a level that every rank holds whole, are
// packed on the device, copied to the host, sent by MPI, copied back and unpacked on the device.
#pragma once

#include "engine/block/block.hpp"
#include "engine/interface/interface.hpp"
#include "engine/options/device_choice.hpp"
#include "kernels/device/device.hpp"

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace asperity {

/// Returns the name of a device: "none", "emulated", "NVIDIA H100 (device 0)".
std::string describe_device(const DeviceChoice& choice);

/// Share of this rank in the sums of a step.
struct DeviceSums {
    InterfaceSums interface;
    KickSums kick;
    NoiseSums noise;
    ExactSum top_force, lowest_z, elastic;
};

/// Offsets of the arrays in device memory. The layout follows from the options alone and therefore
/// also gives the memory of a run before anything is allocated.
struct DeviceLayout {
    /// A part of the device memory, bytes.
    struct Region {
        std::size_t begin = 0, bytes = 0;
    };
    using Vector = std::array<Region, 3>; ///< regions of the components of a field
    /// Regions of the fields of a level; u has two buffers.
    struct Level {
        std::array<Vector, 2> u;
        Vector v, transferred, upper_force;
    };

    /// Computes the layout for this rank.
    DeviceLayout(const BlockOptions& block, const ProcessGrid& grid,
                 const InterfaceOptions& interface);

    std::vector<Level> levels;
    Region level_table, kicks, sums; ///< DeviceLevel and LevelKicks of each level; two PassSums
    Region heights, highest, lowest, columns, map, mean_height, cubics; ///< arrays of the substrate
    Region sent, received; ///< halos of both sides of an axis
    std::size_t bytes = 0; ///< total size, bytes
};

/// A block and its interface in the memory of a device.
class DeviceBlock {
public:
    /// Allocates device memory and copies the tables. Throws io::FileError if the device fails or
    /// lacks memory, std::invalid_argument for finite strain and for a substrate without the
    /// block's lattice, which a device does not support.
    DeviceBlock(const DeviceChoice& choice, const Block& block, const Interface& interface);

    /// Copies displacements and velocities, halos included, to the device.
    void upload(const Block& block);
    /// Copies displacements and velocities, halos included, back to the block.
    void download(Block& block) const;

    /// Makes one time step, halos included, and returns this rank's share of the sums. block:
    /// source of constants, ranks and top plane; reference_height: Å; noise: thermal noise, empty
    /// without a temperature. Collective.
    DeviceSums step(const Block& block, double reference_height, const StepParameters& step,
                    const std::optional<ThermalNoise>& noise);

private:
    /// A strip of halo and its messages in the host's memory.
    struct Strip {
        DeviceHalo halo;
        std::vector<double> sent, received;
    };
    void make_levels(const Block& block);
    void copy_tables(const Interface& interface);
    void set_kicks(const Block& block, const StepParameters& step);
    void exchange(const Block& block, Strip& strip);
    void share_restricted_forces(const Block& block);
    void copy(void* to, const void* from, std::size_t bytes) const;
    void check(const char* error, const char* doing) const;
    template <class T>
    T* at(const DeviceLayout::Region& region) const;
    template <class T>
    T* copied(const DeviceLayout::Region& region, std::span<const T> values) const;
    void fetch(const DeviceLayout::Region& region, Field<double>& to) const;
    VolumeView<double> view(const DeviceLayout::Region& region, const Field<double>& host) const;
    VectorVolume<double> view(const DeviceLayout::Vector& regions,
                              const VectorField<double>& host) const;

    DeviceChoice choice_;
    const DeviceFunctions& device_;
    DeviceLayout layout_;
    /// Device memory, released by the device's own function, also if the constructor throws.
    std::unique_ptr<std::byte, void (*)(std::byte*)> memory_{nullptr, device_.release};
    std::vector<DeviceLevel> levels_; ///< levels as the device has them
    DeviceStep step_;
    PairPotential potential_;     ///< potential; a table's numbers are in device memory
    std::array<Strip, 2> strips_; ///< strips along x and along y
    /// Level whose transferred forces are summed over the ranks; negative: none.
    int shared_level_ = -1;
    VectorField<double> shared_;                ///< transferred forces of that level on the host
    std::optional<StepParameters> kicked_with_; ///< parameters of the kicks in device memory
};

} // namespace asperity
