// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "kernels/variant.hpp"

#include <cstdlib>
#include <cstring>
#include <initializer_list>

namespace asperity {

namespace {

ProcessorLevel detect() {
#if ASPERITY_HAS_X86_VARIANTS
    __builtin_cpu_init();
    ProcessorLevel best = ProcessorLevel::v2;
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
        __builtin_cpu_supports("bmi2"))
        best = ProcessorLevel::v3;
    if (best == ProcessorLevel::v3 && __builtin_cpu_supports("avx512f") &&
        __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") &&
        __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512cd"))
        best = ProcessorLevel::v4;
    if (const char* asked = std::getenv("ASPERITY_KERNELS"))
        for (ProcessorLevel level : {ProcessorLevel::v2, ProcessorLevel::v3, ProcessorLevel::v4})
            if (std::strcmp(asked, name(level)) == 0 && level < best) best = level;
    return best;
#elif defined(__aarch64__)
    return ProcessorLevel::aarch64;
#else
    return ProcessorLevel::portable;
#endif
}

} // namespace

ProcessorLevel processor_level() {
    static const ProcessorLevel level = detect();
    return level;
}

const char* name(ProcessorLevel level) {
    switch (level) {
    case ProcessorLevel::v2:
        return "v2";
    case ProcessorLevel::v3:
        return "v3";
    case ProcessorLevel::v4:
        return "v4";
    case ProcessorLevel::aarch64:
        return "aarch64";
    case ProcessorLevel::portable:
        break;
    }
    return "portable";
}

} // namespace asperity
