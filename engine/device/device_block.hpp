// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A block and its interface resident on a device: fields and tables, and the step in time
// (kernels/device/device.hpp). The host's block keeps the same shape; upload() and download() are
// the only ways between the two. The bits are those of the host's step.
//
// Each rank has a device of its own. Halos, and the forces that go to a level which every rank
// holds, are packed on the device, sent by MPI from the host's memory, and unpacked on the device.
#pragma once

#include "engine/block/block.hpp"
#include "engine/block/interface.hpp"
#include "kernels/device/device.hpp"

#include <string>
#include <vector>

namespace asperity {

/// Which device a scene asks for (numerics.device): "none", "emulated", "auto" or a number.
struct DeviceChoice {
    enum class Kind { none, emulated, cuda } kind = Kind::none;
    int index = 0;
    bool operator==(const DeviceChoice&) const = default;
};
/// "none", "emulated", "NVIDIA H100 (device 0)".
std::string describe_device(const DeviceChoice& choice);

/// This rank's share of the sums of a step.
struct DeviceSums {
    InterfaceSums interface;
    KickSums kick;
    ExactSum top_force, lowest_z, elastic, heat;
};

class DeviceBlock {
public:
    /// Allocates; copies the tables. Throws io::FileError where the device or its memory fails.
    DeviceBlock(const DeviceChoice& choice, const Block& block, const Interface& interface);
    ~DeviceBlock();
    DeviceBlock(const DeviceBlock&) = delete;
    DeviceBlock& operator=(const DeviceBlock&) = delete;

    /// Displacements and velocities, halos included.
    void upload(const Block& block);
    void download(Block& block) const;

    // One step in time, verb by verb. block: whose constants and ranks these are.
    /// What the step is; top: displacement of the top plane at its start.
    void begin(const Block& block, const StepParameters& step, double top, double reference_height);
    /// In a scene with a temperature, after begin().
    void set_noise(const ThermalNoise& noise);
    void interpolate();
    void forces(const Block& block);
    void advance();
    void exchange(const Block& block);
    /// Waits for the launches.
    DeviceSums sums() const;

    /// Of device memory: in use, and known before anything is allocated.
    std::size_t bytes() const { return used_; }
    static std::size_t bytes_for(const BlockOptions& block, const ProcessGrid& grid,
                                 const InterfaceOptions& interface);
    /// Bytes copied to other ranks in the last step.
    std::size_t halo_bytes() const { return halo_bytes_; }

private:
    struct LevelMemory {
        VectorVolume<double> u[2], v;
        VectorPlane<double> incoming, upper_force;
    };
    void trade(const Block& block, bool along_x);
    void share_restricted_forces(const Block& block);
    void check(const char* error, const char* doing) const;
    template <class T>
    T* place(std::size_t count);
    template <class T>
    VolumeView<T> place(const Field<T>& shape);
    template <class T>
    VectorVolume<T> place(const VectorField<T>& shape);

    DeviceChoice choice_;
    const DeviceFunctions& device_;
    std::byte* memory_ = nullptr;
    std::size_t bytes_ = 0, used_ = 0;
    std::vector<LevelMemory> levels_;
    DeviceStep step_;
    LevelKicks* kicks_ = nullptr;
    DeviceHalo halo_x_, halo_y_;
    std::vector<double> to_before_, to_after_, from_before_, from_after_;
    int shared_level_ = -1; ///< whose incoming forces are put together over the ranks
    VectorField<double> shared_;
    StepParameters kicked_with_;
    bool kicks_known_ = false;
    std::size_t halo_bytes_ = 0;
};

} // namespace asperity
