// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// launch(): body(i, sums) for every i in [0, count), a thread each; with sums, theirs are added
// into *total, which is exact in any order (exact_sum.hpp).
//
// The emulated device runs the bodies one after the other, in the host's process, when somebody
// waits for them. Its memory is pages of its own that can be read and written during a launch or a
// copy only: a host that reads device memory stops at once, as it would with a device of its own
// memory.
#pragma once

#include "kernels/device/device.hpp"

namespace asperity {

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
inline cudaStream_t queue = nullptr; ///< of the launches

/// All threads of a block; adds up within warps, then over the block, then once to the total
/// (behind a carry, as exact_sum.hpp asks for: merge() ends with one).
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
    // Of positive numbers the order is that of their bits.
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

/// Null, or what the runtime says.
inline const char* text_of(cudaError_t error) {
    return error == cudaSuccess ? nullptr : cudaGetErrorString(error);
}

template <bool with_sums, class Body>
const char* launch(const Body& body, long long count, PassSums* total) {
    if (count == 0) return nullptr;
    const auto blocks = static_cast<unsigned>((count + threads_per_block - 1) / threads_per_block);
    run<with_sums><<<blocks, threads_per_block, 0, queue>>>(body, count, total);
    return text_of(cudaGetLastError());
}

} // namespace asperity::cuda

#else

#include <algorithm>
#include <functional>

namespace asperity::emulated {

/// Opens the device's memory for as long as it lives.
class OpenMemory {
public:
    OpenMemory();
    ~OpenMemory();
    OpenMemory(const OpenMemory&) = delete;
    OpenMemory& operator=(const OpenMemory&) = delete;
};

/// Node number k of a launch over count of them, in the order asked for.
long long node_in_order(long long k, long long count);

inline constexpr long long nodes_per_block = 4096;

/// Does the work now or later, as a device might.
const char* enqueue(std::function<void()> work);

template <bool with_sums, class Body>
const char* launch(const Body& body, long long count, PassSums* total) {
    return enqueue([=] {
        const OpenMemory open;
        for (long long k = 0; k < count;) { // a block of nodes at a time, as CUDA's
            PassSums sums;
            for (const long long end = std::min(count, k + nodes_per_block); k < end; ++k)
                body(node_in_order(k, count), sums);
            if constexpr (with_sums) merge(*total, sums);
        }
    });
}

} // namespace asperity::emulated

#endif
