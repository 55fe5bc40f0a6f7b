// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Annotations for code that also compiles for an accelerator. All code in kernels/ that accesses
// data is a free function on trivially copyable views; under nvcc the same source becomes device
// code.
#pragma once

#if defined(__CUDACC__)
#define ASPERITY_HOST_DEVICE __host__ __device__
#else
#define ASPERITY_HOST_DEVICE
#endif

#define ASPERITY_PRAGMA(text) _Pragma(#text)
/// Unrolls the following loop n times.
#if defined(__CUDACC__)
#define ASPERITY_UNROLL(n) ASPERITY_PRAGMA(unroll n)
#else
#define ASPERITY_UNROLL(n) ASPERITY_PRAGMA(GCC unroll n)
#endif

#define ASPERITY_INLINE ASPERITY_HOST_DEVICE inline __attribute__((always_inline))
