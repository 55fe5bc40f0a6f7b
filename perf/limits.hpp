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

/// The kernels whose arithmetic is timed by itself.
enum class Timed {
    lattice, ///< pairs of sites with atoms on their lattice, four at a time
    rows,    ///< pairs with atoms of a row, two at a time
    cells,   ///< pairs with atoms anywhere, two at a time
    node,    ///< force, kick and drift of a node at small strain, four planes and the upper one
    damped,  ///< the same with damping
    finite   ///< as node, at finite strain, without a dilatation term
};
/// Seconds of one core for a pair or node of a kernel, in loops of its operations where none waits
/// for another and nothing is loaded: what this processor's arithmetic allows at best. Best of
/// many, measured once; 0 where no loop has been written.
struct ArithmeticLimit {
    double all;  ///< of all operations
    double slow; ///< of roots and divisions alone; 0 if there are none
};
ArithmeticLimit arithmetic_limit(Timed kernel, bool single);

} // namespace asperity
