// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A block and its interface in the memory of a device: fields and tables, and the time step
// (kernels/device/device.hpp). The host's block keeps the same shape; upload() and download() are
// the only ways between the two. The bits are those of the host's step.
//
// Each rank has a device of its own. Halos, and the forces that go to a level which every rank
// holds, are packed on the device, copied to the host, sent by MPI, copied back and unpacked on the
// device.
#pragma once

#include "engine/block/block.hpp"
#include "engine/interface/interface.hpp"
#include "engine/scene/device_choice.hpp"
#include "kernels/device/device.hpp"

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace asperity {

/// "none", "emulated", "NVIDIA H100 (device 0)"
std::string describe_device(const DeviceChoice& choice);

/// This rank's share of the sums of a step.
struct DeviceSums {
    InterfaceSums interface;
    KickSums kick;
    NoiseSums noise;
    ExactSum top_force, lowest_z, elastic;
};

/// Where the arrays lie in device memory. It follows from the options alone, so it also says how
/// much memory a run needs before anything is allocated.
struct DeviceLayout {
    struct Region {
        std::size_t begin = 0, bytes = 0;
    };
    using Vector = std::array<Region, 3>; ///< the components of a field
    struct Level {
        std::array<Vector, 2> u;
        Vector v, transferred, upper_force;
    };

    DeviceLayout(const BlockOptions& block, const ProcessGrid& grid,
                 const InterfaceOptions& interface);

    std::vector<Level> levels;
    Region level_table, kicks, sums; ///< DeviceLevel and LevelKicks of each level; two PassSums
    Region heights, highest, lowest, columns, map, mean_height, cubics; ///< of the substrate
    Region sent, received; ///< halos of both sides of an axis
    std::size_t bytes = 0; ///< in all
};

class DeviceBlock {
public:
    /// Allocates; copies the tables. Throws io::FileError where the device or its memory fails,
    /// std::invalid_argument for what a device cannot do: finite strain, a substrate that is not
    /// the block's lattice.
    DeviceBlock(const DeviceChoice& choice, const Block& block, const Interface& interface);

    /// Displacements and velocities, halos included.
    void upload(const Block& block);
    void download(Block& block) const;

    /// One time step, halos included. block: whose constants, ranks and top plane these are;
    /// noise: in a scene with a temperature.
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
    /// Released by the device's own function, also where the constructor throws.
    std::unique_ptr<std::byte, void (*)(std::byte*)> memory_{nullptr, device_.release};
    std::vector<DeviceLevel> levels_; ///< as the device has them
    DeviceStep step_;
    PairPotential potential_;     ///< a table's numbers in device memory
    std::array<Strip, 2> strips_; ///< along x, along y
    int shared_level_ = -1;       ///< whose transferred forces are put together over the ranks
    VectorField<double> shared_;  ///< the host's copy of them
    std::optional<StepParameters> kicked_with_; ///< what the kicks in device memory are made of
};

} // namespace asperity
