// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// One binary for several processors: each kernel source is compiled once for every x86-64 level
// (v2: SSE4, v3: AVX2 and FMA, v4: AVX-512) inside a namespace of that level's name, and exports
// one table of function pointers. processor_level() picks the highest level that was compiled and
// that the running processor has; ASPERITY_KERNELS=v2|v3|v4 in the environment asks for a lower
// one. A build for one machine has one level (ASPERITY_LEVELS in cmake/AsperityLayer.cmake).
// Elsewhere they are compiled once: for aarch64 with the fused operations of NEON, which have the
// bits of v3.
#pragma once

#include <initializer_list>
#include <optional>

#if !defined(ASPERITY_VARIANT)
#define ASPERITY_VARIANT portable
#endif

namespace asperity {

enum class ProcessorLevel { portable, v2, v3, v4, aarch64 };

/// The level whose kernels run.
ProcessorLevel processor_level();
/// The lowest level compiled, where the running processor lacks it: no kernel can run.
std::optional<ProcessorLevel> missing_level();
/// Of the levels compiled, in ascending order: the highest that the processor has and, if one is
/// asked for, that is no higher; where all are higher than the one asked for, the lowest.
ProcessorLevel choose_level(std::initializer_list<ProcessorLevel> compiled, ProcessorLevel has,
                            std::optional<ProcessorLevel> asked);
const char* name(ProcessorLevel level);
/// Whether its kernels fuse multiplications and additions, as a device does.
inline bool fuses(ProcessorLevel level) { return level >= ProcessorLevel::v3; }

} // namespace asperity
