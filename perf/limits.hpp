// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What the machine can do at best, measured: what the benchmarks hold their kernels against, in the
// same run.
#pragma once

namespace asperity {

/// GB/s of a = b + s c on arrays three times the size of a large cache, counted as two reads and
/// one write, on so many threads; best of ten, measured once.
double stream_rate(int threads);

/// GFLOP/s of one core in fused multiply-adds (multiplications and additions where the kernels in
/// use have no fused ones), in independent chains on their registers; best of many, measured once.
/// single: in single precision. 0 where no loop has been written.
double fused_rate(bool single);

} // namespace asperity
