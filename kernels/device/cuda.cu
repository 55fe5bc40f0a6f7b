// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The device of CUDA: memory and copies; the launches are passes.hpp. All calls use the default
// stream, so they are carried out in order.
#include "kernels/device/passes.hpp"

namespace asperity::cuda {

namespace {

const char* allocate(int index, std::size_t bytes, std::byte** memory) {
    if (const char* error = text_of(cudaSetDevice(index))) return error;
    void* at = nullptr;
    if (const char* error = text_of(cudaMalloc(&at, bytes))) return error;
    *memory = static_cast<std::byte*>(at);
    return nullptr;
}
void release(std::byte* memory) { cudaFree(memory); }

const char* copy(void* to, const void* from, std::size_t bytes) {
    return text_of(cudaMemcpy(to, from, bytes, cudaMemcpyDefault));
}

} // namespace

} // namespace asperity::cuda

namespace asperity {

const DeviceFunctions* cuda_device() {
    using namespace cuda;
    static const DeviceFunctions functions = functions_with(allocate, release, copy);
    return &functions;
}

int cuda_device_count() {
    int count = 0;
    return cudaGetDeviceCount(&count) == cudaSuccess ? count : 0;
}

std::string cuda_device_name(int index) {
    cudaDeviceProp properties{};
    return cudaGetDeviceProperties(&properties, index) == cudaSuccess ? properties.name : "CUDA";
}

} // namespace asperity
