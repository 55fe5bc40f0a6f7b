// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// In place of cuda.cu where the program is built without CUDA.
#include "kernels/device/device.hpp"

namespace asperity {

const DeviceFunctions* cuda_device() { return nullptr; }
int cuda_device_count() { return 0; }
std::string cuda_device_name(int) { return "CUDA"; }

} // namespace asperity
