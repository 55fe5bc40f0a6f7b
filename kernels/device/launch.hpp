// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// launch(): calls body(i, sums) for every i in [0, count), one thread each; if sums are asked for,
// they are added into *total, which is exact in any order (exact_sum.hpp).
//
// The emulated device runs the bodies one after the other, in the host's process. Its memory is
// pages of its own that can be read and written only during a launch or a copy: a host that reads
// device memory stops with a segmentation fault, as with CUDA.
#pragma once

#include "kernels/device/device.hpp"

#include <type_traits>

namespace asperity {

/// True if a type can be copied byte by byte and has the same members for the compilers of host and
/// device.
template <class T>
inline constexpr bool goes_to_a_device =
    std::is_trivially_copyable_v<T>&& std::is_standard_layout_v<T>;

/// Adds the sums of some nodes to those of others.
ASPERITY_HOST_DEVICE inline void merge(PassSums& into, const PassSums& other) {
    for (int k = 0; k < PassSums::sums; ++k)
        into.sum[k].merge(other.sum[k]);
    for (int k = 0; k < 2; ++k)
        into.count[k] += other.count[k];
    into.least = other.least < into.least ? other.least : into.least;
}

} // namespace asperity

#if defined(__CUDACC__)

#include <cuda_runtime.h>

namespace asperity::cuda {

inline constexpr int threads_per_block = 128;

/// Adds up the sums of a block: within warps, then over the block, then once to the total (behind a
/// carry, as exact_sum.hpp asks for: merge() ends with one).
__device__ inline void reduce(PassSums& mine, PassSums* total) {
    constexpr int warps = threads_per_block / 32;
    __shared__ PassSums of_warp[warps];
    for (int far = 16; far > 0; far /= 2) {
        PassSums other;
        for (int k = 0; k < PassSums::sums; ++k)
            for (int bin = 0; bin < ExactSum::bins; ++bin)
                other.sum[k].bin[bin] = __shfl_down_sync(~0u, mine.sum[k].bin[bin], far);
        for (int k = 0; k < 2; ++k)
            other.count[k] = __shfl_down_sync(~0u, mine.count[k], far);
        other.least = __shfl_down_sync(~0u, mine.least, far);
        merge(mine, other);
    }
    if (threadIdx.x % 32 == 0) of_warp[threadIdx.x / 32] = mine;
    __syncthreads();
    if (threadIdx.x != 0) return;
    for (int w = 1; w < warps; ++w)
        merge(mine, of_warp[w]);
    for (int k = 0; k < PassSums::sums; ++k)
        for (int bin = 0; bin < ExactSum::bins; ++bin)
            if (mine.sum[k].bin[bin] != 0.0)
                atomicAdd(&total->sum[k].bin[bin], mine.sum[k].bin[bin]);
    for (int k = 0; k < 2; ++k)
        if (mine.count[k] != 0.0) atomicAdd(&total->count[k], mine.count[k]);
    // Positive numbers have the order of their bits.
    if (mine.least < no_pair)
        atomicMin(reinterpret_cast<unsigned long long*>(&total->least),
                  static_cast<unsigned long long>(__double_as_longlong(mine.least)));
}

template <bool with_sums, class Body>
__global__ void __launch_bounds__(threads_per_block)
    run(const Body body, long long count, PassSums* total) {
    const long long i = static_cast<long long>(blockIdx.x) * threads_per_block + threadIdx.x;
    PassSums mine;
    if (i < count) body(i, mine);
    if constexpr (with_sums) reduce(mine, total);
}

/// Returns the runtime's text of an error; nullptr if there is none.
inline const char* text_of(cudaError_t error) {
    return error == cudaSuccess ? nullptr : cudaGetErrorString(error);
}

template <bool with_sums, class Body>
const char* launch(const Body& body, long long count, PassSums* total) {
    static_assert(goes_to_a_device<Body>);
    if (count == 0) return nullptr;
    const auto blocks = static_cast<unsigned>((count + threads_per_block - 1) / threads_per_block);
    run<with_sums><<<blocks, threads_per_block>>>(body, count, total);
    return text_of(cudaGetLastError());
}

} // namespace asperity::cuda

#else

#include <algorithm>

namespace asperity::emulated {

/// Allows or forbids the host to read and write the device's memory.
void open_memory(bool open);
/// Counts a launch. Returns nullptr, or that the device is lost (EmulatedSettings::lost_after).
const char* count_launch();
/// Returns the k-th node of a launch over count nodes, in the order asked for.
long long node_in_order(long long k, long long count);

inline constexpr long long nodes_per_block = 4096;

template <bool with_sums, class Body>
const char* launch(const Body& body, long long count, PassSums* total) {
    static_assert(goes_to_a_device<Body>);
    if (const char* error = count_launch()) return error;
    open_memory(true);
    for (long long k = 0; k < count;) { // a block of nodes at a time, as CUDA's
        PassSums sums;
        for (const long long end = std::min(count, k + nodes_per_block); k < end; ++k)
            body(node_in_order(k, count), sums);
        if constexpr (with_sums) merge(*total, sums);
    }
    open_memory(false);
    return nullptr;
}

} // namespace asperity::emulated

#endif
