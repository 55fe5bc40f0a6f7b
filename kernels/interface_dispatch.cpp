// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Picks the interface kernels once, at the first call, for the processor the program runs on.
#include "kernels/interface_sweep.hpp"
#include "kernels/variant.hpp"

namespace asperity {

#if ASPERITY_HAS_X86_VARIANTS
namespace v2 {
InterfaceKernels interface_table();
}
namespace v3 {
InterfaceKernels interface_table();
}
namespace v4 {
InterfaceKernels interface_table();
}
#else
namespace portable {
InterfaceKernels interface_table();
}
#endif

namespace {

InterfaceKernels pick() {
#if ASPERITY_HAS_X86_VARIANTS
    switch (processor_level()) {
    case ProcessorLevel::v4:
        return v4::interface_table();
    case ProcessorLevel::v3:
        return v3::interface_table();
    default:
        return v2::interface_table();
    }
#else
    return portable::interface_table();
#endif
}

} // namespace

const InterfaceKernels& interface_kernels() {
    static const InterfaceKernels kernels = pick();
    return kernels;
}

} // namespace asperity
