// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "kernels/variant.hpp"

#include <cstdlib>
#include <cstring>

namespace asperity {

namespace {

constexpr std::initializer_list<ProcessorLevel> compiled = {
#if ASPERITY_HAS_V2
    ProcessorLevel::v2,
#endif
#if ASPERITY_HAS_V3
    ProcessorLevel::v3,
#endif
#if ASPERITY_HAS_V4
    ProcessorLevel::v4,
#endif
};

/// Returns the level of the running processor; every processor for which the tables exist has v2.
ProcessorLevel detect() {
#if ASPERITY_HAS_V2 || ASPERITY_HAS_V3 || ASPERITY_HAS_V4
    __builtin_cpu_init();
    if (!(__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
          __builtin_cpu_supports("bmi2")))
        return ProcessorLevel::v2;
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
        __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl") &&
        __builtin_cpu_supports("avx512cd"))
        return ProcessorLevel::v4;
    return ProcessorLevel::v3;
#elif defined(__aarch64__)
    return ProcessorLevel::aarch64;
#else
    return ProcessorLevel::portable;
#endif
}

std::optional<ProcessorLevel> asked_for() {
    if (const char* asked = std::getenv("ASPERITY_KERNELS"))
        for (ProcessorLevel level : {ProcessorLevel::v2, ProcessorLevel::v3, ProcessorLevel::v4})
            if (std::strcmp(asked, name(level)) == 0) return level;
    return std::nullopt;
}

} // namespace

ProcessorLevel choose_level(std::initializer_list<ProcessorLevel> levels, ProcessorLevel has,
                            std::optional<ProcessorLevel> asked) {
    if (levels.size() == 0) return has;
    ProcessorLevel chosen = *levels.begin();
    for (ProcessorLevel level : levels)
        if (level <= has && (!asked || level <= *asked)) chosen = level;
    return chosen;
}

ProcessorLevel processor_level() {
    static const ProcessorLevel level = choose_level(compiled, detect(), asked_for());
    return level;
}

std::optional<ProcessorLevel> missing_level() {
    if (compiled.size() == 0 || *compiled.begin() <= detect()) return std::nullopt;
    return *compiled.begin();
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
