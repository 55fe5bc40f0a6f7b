// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Picks the row kernels once, at the first call, for the processor the program runs on.
#include "kernels/surface_rows.hpp"
#include "kernels/variant.hpp"

namespace asperity {

#if ASPERITY_HAS_X86_VARIANTS
namespace v2 {
RowKernels surface_rows();
} // namespace v2
namespace v3 {
RowKernels surface_rows();
} // namespace v3
namespace v4 {
RowKernels surface_rows();
} // namespace v4
#else
namespace portable {
RowKernels surface_rows();
} // namespace portable
#endif

namespace {

RowKernels pick() {
#if ASPERITY_HAS_X86_VARIANTS
    switch (processor_level()) {
    case ProcessorLevel::v4:
        return v4::surface_rows();
    case ProcessorLevel::v3:
        return v3::surface_rows();
    default:
        return v2::surface_rows();
    }
#else
    return portable::surface_rows();
#endif
}

} // namespace

const RowKernels& row_kernels() {
    static const RowKernels kernels = pick();
    return kernels;
}

} // namespace asperity
