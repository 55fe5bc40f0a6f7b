// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// One binary for several processors: each kernel source is compiled once for every x86-64 level
// (v2: SSE4, v3: AVX2 and FMA, v4: AVX-512) inside a namespace of that level's name, and exports
// one table of function pointers. processor_level() picks the highest level that was compiled and
// that the running processor has; ASPERITY_KERNELS=v2|v3|v4 in the environment asks for a lower
// one. A build for one machine has one level (ASPERITY_LEVELS in cmake/AsperityLayer.cmake). On
// other architectures the kernels are compiled once: for aarch64 with the fused operations of NEON,
// which give the bits of v3.
#pragma once

#include <initializer_list>
#include <optional>

#if !defined(ASPERITY_VARIANT)
#define ASPERITY_VARIANT portable
#endif

namespace asperity {

enum class ProcessorLevel { portable, v2, v3, v4, aarch64 };

/// Returns the level whose kernels run.
ProcessorLevel processor_level();
/// Returns the lowest level compiled if the running processor lacks it, so that no kernel can run;
/// otherwise nothing.
std::optional<ProcessorLevel> missing_level();
/// Returns the highest of the compiled levels (in ascending order) that the processor has and that
/// is not above the level asked for; the lowest compiled one if all are above it.
ProcessorLevel choose_level(std::initializer_list<ProcessorLevel> compiled, ProcessorLevel has,
                            std::optional<ProcessorLevel> asked);
const char* name(ProcessorLevel level);
/// Returns true if the kernels of the level fuse multiplications and additions, as a device does.
inline bool fuses(ProcessorLevel level) { return level >= ProcessorLevel::v3; }

} // namespace asperity
