// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// One binary for several processors: each kernel source is compiled once for every x86-64 level
// (v2: SSE4, v3: AVX2 and FMA, v4: AVX-512) in a namespace with the level's name, and exports one
// table of function pointers. processor_level() returns the highest compiled level that the running
// processor supports; the environment variable ASPERITY_KERNELS=v2|v3|v4 selects a lower one. A
// build for one machine has one level (ASPERITY_LEVELS in cmake/AsperityLayer.cmake). On other
// architectures the kernels are compiled once: for aarch64 with the fused operations of NEON, whose
// results are bitwise those of v3.
#pragma once

#include <initializer_list>
#include <optional>

#if !defined(ASPERITY_VARIANT)
#define ASPERITY_VARIANT portable
#endif

namespace asperity {

/// Level of the instruction set.
enum class ProcessorLevel { portable, v2, v3, v4, aarch64 };

/// Returns the level of the kernels in use.
ProcessorLevel processor_level();
/// Returns the lowest compiled level if the running processor does not support it, so that no
/// kernel can run; otherwise nothing.
std::optional<ProcessorLevel> missing_level();
/// Returns the highest of the compiled levels (in ascending order) that is at most the processor's
/// level `has` and the level `asked`; the lowest compiled level if all are higher.
ProcessorLevel choose_level(std::initializer_list<ProcessorLevel> compiled, ProcessorLevel has,
                            std::optional<ProcessorLevel> asked);
/// Returns the name of a level, "v3".
const char* name(ProcessorLevel level);
/// Returns true if the kernels of the level fuse multiplications and additions, as a device does.
inline bool fuses(ProcessorLevel level) { return level >= ProcessorLevel::v3; }

} // namespace asperity
