// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The device of CUDA: memory and copies; the launches are passes.hpp.
#include "kernels/device/passes.hpp"

namespace asperity::cuda {

namespace {

const char* describe(int index, std::string& name, std::size_t& free_bytes) {
    cudaDeviceProp properties{};
    if (const char* error = text_of(cudaSetDevice(index))) return error;
    if (const char* error = text_of(cudaGetDeviceProperties(&properties, index))) return error;
    name = properties.name;
    std::size_t total = 0;
    return text_of(cudaMemGetInfo(&free_bytes, &total));
}

const char* allocate(int index, std::size_t bytes, std::byte** memory) {
    if (const char* error = text_of(cudaSetDevice(index))) return error;
    void* at = nullptr;
    if (const char* error = text_of(cudaMalloc(&at, bytes))) return error;
    *memory = static_cast<std::byte*>(at);
    return nullptr;
}

void release(std::byte* memory) { cudaFree(memory); }

const char* upload(void* to, const void* from, std::size_t bytes) {
    return text_of(cudaMemcpy(to, from, bytes, cudaMemcpyHostToDevice));
}

const char* download(void* to, const void* from, std::size_t bytes) {
    return text_of(cudaMemcpy(to, from, bytes, cudaMemcpyDeviceToHost));
}

} // namespace

} // namespace asperity::cuda

namespace asperity {

const DeviceFunctions* cuda_device() {
    using namespace cuda;
    static const DeviceFunctions functions = {
        describe, allocate, release,            upload,  download,   follow,
        forces,   restrict_to_shared, advance, halo<true>, halo<false>};
    return &functions;
}

int cuda_device_count() {
    int count = 0;
    return cudaGetDeviceCount(&count) == cudaSuccess ? count : 0;
}

} // namespace asperity
