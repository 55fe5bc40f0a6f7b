// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A block and its interface resident on a device: fields and tables, and the step in time
// (kernels/device/device.hpp). The host's block keeps the same shape; upload() and download() are
// the only ways between the two. The bits are those of the host's step.
//
// Each rank has a device of its own. Halos, and the forces that go to a level which every rank
// holds, are packed on the device, sent by MPI from pinned memory of the host (from the device's
// where MPI takes it), and unpacked on the device.
//
// Nothing of a step waits for the device but its sums and, between ranks, its messages. Both come
// beside the launches: while the host looks at the sums of a step, the device is at the forces of
// the next one.
#pragma once

#include "engine/block/block.hpp"
#include "engine/interface/interface.hpp"
#include "engine/phases.hpp"
#include "kernels/device/device.hpp"

#include <memory>
#include <optional>
#include <span>
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

    /// Displacements and velocities, halos included.
    void upload(const Block& block);
    void download(Block& block) const;

    /// What decides about the forces on the present displacements.
    struct At {
        double top = 0.0; ///< displacement of the top plane, Å
        double reference_height = 0.0;
        bool observe = false; ///< with energies and contacts
        bool operator==(const At&) const = default;
    };
    // One step in time. block: whose constants and ranks these are.
    /// Constrained planes and forces. Launched already if the last call since advance() was the
    /// same.
    void forces(const At& at);
    /// Everything else of the step, halos included. noise: in a scene with a temperature.
    void advance(const Block& block, const StepParameters& step,
                 const std::optional<ThermalNoise>& noise);
    /// Of the last step; waits for them.
    DeviceSums sums();

    /// Adds the device's own times of all steps to the phases: those whose end the host has seen,
    /// or all, for which it waits.
    void record_times(Phases& phases, bool all);

    /// Of device memory: in use, and known before anything is allocated.
    std::size_t bytes() const { return used_; }
    static std::size_t bytes_for(const BlockOptions& block, const ProcessGrid& grid,
                                 const InterfaceOptions& interface, int substrate_sites);

private:
    struct LevelMemory {
        VectorVolume<double> u[2], v;
        VectorPlane<double> transferred, upper_force;
    };
    /// Places in the queue.
    enum StepMark { begun, followed, pushed, resumed, advanced, exchanged, marks_of_step };
    enum { sums_are_here = 3 * marks_of_step, messages_are_here, all_marks };
    static_assert(all_marks <= device_marks);
    static int number_of(StepMark mark, long long step);
    void mark(StepMark mark);
    void wait_for_messages();
    void exchange(const Block& block);
    void trade(const Block& block, bool along_x);
    void share_restricted_forces(const Block& block);
    void take_tables(const Interface& interface);
    void check(const char* error, const char* doing) const;
    template <class T>
    T* place(std::size_t count);
    template <class T>
    VolumeView<T> place(const Field<T>& shape);
    template <class T>
    VectorVolume<T> place(const VectorField<T>& shape);
    template <class T>
    VolumeView<T> copy_of(const Field<T>& field);
    template <class T>
    T* copy_of(std::span<const T> values);

    /// Given back by the device's own function, also where the constructor throws.
    using Memory = std::unique_ptr<std::byte, void (*)(std::byte*)>;

    DeviceChoice choice_;
    const DeviceFunctions& device_;
    Memory memory_{nullptr, device_.release};
    Memory pinned_memory_{nullptr, device_.release_pinned};
    std::size_t bytes_ = 0, used_ = 0;
    std::vector<LevelMemory> levels_;
    DeviceStep step_;
    PairPotential potential_; ///< a table's numbers in device memory
    LevelKicks* kicks_ = nullptr;
    PassSums* all_sums_ = nullptr; ///< [2][2]: of even and of odd steps, forces and advance
    DeviceHalo halo_x_, halo_y_;
    /// Halos on their way, in device memory: to and from the neighbours before and after.
    double *to_before_ = nullptr, *to_after_ = nullptr, *from_before_ = nullptr,
           *from_after_ = nullptr;
    int shared_level_ = -1; ///< whose transferred forces are put together over the ranks
    VectorField<double> shared_;
    std::size_t shared_bytes_ = 0; ///< of a component

    /// Memory of the host that the device copies from and to by itself.
    struct Pinned {
        PassSums* sums = nullptr; ///< of forces, of advance
        LevelKicks* kicks = nullptr;
        double *to_before = nullptr, *to_after = nullptr, *from_before = nullptr,
               *from_after = nullptr;
        double* shared[3] = {};
    } pinned_;            ///< in pinned_memory_
    bool direct_ = false; ///< MPI takes device memory

    StepParameters kicked_with_;
    bool kicks_known_ = false;
    std::optional<At> launched_; ///< forces, since the last advance()
    long long steps_ = 0;        ///< advanced
    long long recorded_ = 0;
};

} // namespace asperity
