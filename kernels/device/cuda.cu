// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The device of CUDA: memory, copies, and two queues; the launches are passes.hpp.
#include "kernels/device/limits.hpp"
#include "kernels/device/passes.hpp"

#include <utility>

namespace asperity::cuda {

namespace {

cudaStream_t beside = nullptr;          ///< the queue of copies beside the launches
cudaEvent_t marks[device_marks], here; ///< here: where such a copy may begin

const char* describe(int index, std::string& name, std::size_t& free_bytes) {
    cudaDeviceProp properties{};
    int in_use = 0;
    std::size_t total = 0;
    if (const char* error = text_of(cudaGetDevice(&in_use))) return error;
    if (const char* error = text_of(cudaGetDeviceProperties(&properties, index))) return error;
    name = properties.name;
    if (const char* error = text_of(cudaSetDevice(index))) return error;
    const char* error = text_of(cudaMemGetInfo(&free_bytes, &total));
    cudaSetDevice(in_use);
    return error;
}

void drop_queues() {
    for (cudaStream_t* stream : {&queue, &beside})
        if (*stream) cudaStreamDestroy(std::exchange(*stream, nullptr));
    for (cudaEvent_t& event : marks)
        if (event) cudaEventDestroy(std::exchange(event, nullptr));
    if (here) cudaEventDestroy(std::exchange(here, nullptr));
}

/// Queues and marks belong to a device. One that changes, or a failure, leaves none behind.
const char* make_queues() {
    static int made_for = -1;
    int index = 0;
    if (const char* error = text_of(cudaGetDevice(&index))) return error;
    if (index == made_for) return nullptr;
    made_for = -1;
    drop_queues();
    for (cudaStream_t* stream : {&queue, &beside})
        if (const char* error = text_of(cudaStreamCreateWithFlags(stream, cudaStreamNonBlocking)))
            return error;
    for (cudaEvent_t& event : marks)
        if (const char* error = text_of(cudaEventCreateWithFlags(&event, cudaEventDefault)))
            return error;
    if (const char* error = text_of(cudaEventCreateWithFlags(&here, cudaEventDisableTiming)))
        return error;
    made_for = index;
    return nullptr;
}

const char* allocate(int index, std::size_t bytes, std::byte** memory) {
    if (const char* error = text_of(cudaSetDevice(index))) return error;
    if (const char* error = make_queues()) return error;
    void* at = nullptr;
    if (const char* error = text_of(cudaMalloc(&at, bytes))) return error;
    *memory = static_cast<std::byte*>(at);
    return nullptr;
}
void release(std::byte* memory) { cudaFree(memory); }

const char* allocate_pinned(std::size_t bytes, std::byte** memory) {
    void* at = nullptr;
    if (const char* error = text_of(cudaMallocHost(&at, bytes))) return error;
    *memory = static_cast<std::byte*>(at);
    return nullptr;
}
void release_pinned(std::byte* memory) { cudaFreeHost(memory); }

const char* send(void* to, const void* from, std::size_t bytes) {
    return text_of(cudaMemcpyAsync(to, from, bytes, cudaMemcpyHostToDevice, queue));
}
const char* fetch(void* to, const void* from, std::size_t bytes) {
    return text_of(cudaMemcpyAsync(to, from, bytes, cudaMemcpyDeviceToHost, queue));
}
const char* upload(void* to, const void* from, std::size_t bytes) {
    if (const char* error = send(to, from, bytes)) return error;
    return text_of(cudaStreamSynchronize(queue));
}
const char* download(void* to, const void* from, std::size_t bytes) {
    if (const char* error = fetch(to, from, bytes)) return error;
    return text_of(cudaStreamSynchronize(queue));
}

const char* mark(int number) { return text_of(cudaEventRecord(marks[number], queue)); }
const char* fetch_beside(void* to, const void* from, std::size_t bytes, int number) {
    if (const char* error = text_of(cudaEventRecord(here, queue))) return error;
    if (const char* error = text_of(cudaStreamWaitEvent(beside, here, 0))) return error;
    if (const char* error =
            text_of(cudaMemcpyAsync(to, from, bytes, cudaMemcpyDeviceToHost, beside)))
        return error;
    return text_of(cudaEventRecord(marks[number], beside));
}
const char* wait(int number) { return text_of(cudaEventSynchronize(marks[number])); }
const char* seconds_between(int first, int second, double& seconds) {
    float milliseconds = 0.0f;
    const char* error =
        text_of(cudaEventElapsedTime(&milliseconds, marks[first], marks[second]));
    seconds = 1e-3 * static_cast<double>(milliseconds);
    return error;
}
bool takes_mpi(bool mpi_knows_cuda) { return mpi_knows_cuda; }
const char* open_to_mpi(bool) { return nullptr; } // it is always

} // namespace

} // namespace asperity::cuda

namespace asperity {

const DeviceFunctions* cuda_device() {
    using namespace cuda;
    static const DeviceFunctions functions = {
        describe, allocate, release, allocate_pinned, release_pinned, upload, download,
        send, fetch, mark, fetch_beside, wait, seconds_between, takes_mpi, open_to_mpi,
        follow, forces, restrict_to_shared, advance, halo<true>, halo<false>, triad, fused_chain<double>, fused_chain<float>};
    return &functions;
}

int cuda_device_count() {
    int count = 0;
    return cudaGetDeviceCount(&count) == cudaSuccess ? count : 0;
}

} // namespace asperity
