// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// One binary for several processors: each kernel source is compiled once for every x86-64 level
// (v2: SSE4, v3: AVX2 and FMA, v4: AVX-512) inside a namespace of that level's name, and exports
// one table of function pointers. processor_level() picks the highest level that the running
// processor has; ASPERITY_KERNELS=v2|v3|v4 in the environment asks for a lower one. Elsewhere they
// are compiled once: for aarch64 with the fused operations of NEON, which have the bits of v3.
#pragma once

#if !defined(ASPERITY_VARIANT)
#define ASPERITY_VARIANT portable
#endif

namespace asperity {

enum class ProcessorLevel { portable, v2, v3, v4, aarch64 };

/// Highest level this processor can run, or the one asked for in ASPERITY_KERNELS if it is lower.
ProcessorLevel processor_level();
const char* name(ProcessorLevel level);
/// Whether its kernels fuse multiplications and additions, as a device does.
inline bool fuses(ProcessorLevel level) { return level >= ProcessorLevel::v3; }

} // namespace asperity
