// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Picks the interface kernels once, at the first call, for the processor the program runs on.
#include "kernels/interface_sweep.hpp"
#include "kernels/variant.hpp"

namespace asperity {

#if ASPERITY_HAS_X86_VARIANTS
namespace v2 {
InterfaceKernels::Sweeps<LatticeSubstrate> lattice_sweeps();
InterfaceKernels::Sweeps<RowSubstrate> row_sweeps();
InterfaceKernels::AllWalls walls();
} // namespace v2
namespace v3 {
InterfaceKernels::Sweeps<LatticeSubstrate> lattice_sweeps();
InterfaceKernels::Sweeps<RowSubstrate> row_sweeps();
InterfaceKernels::AllWalls walls();
} // namespace v3
namespace v4 {
InterfaceKernels::Sweeps<LatticeSubstrate> lattice_sweeps();
InterfaceKernels::Sweeps<RowSubstrate> row_sweeps();
InterfaceKernels::AllWalls walls();
} // namespace v4
#else
namespace portable {
InterfaceKernels::Sweeps<LatticeSubstrate> lattice_sweeps();
InterfaceKernels::Sweeps<RowSubstrate> row_sweeps();
InterfaceKernels::AllWalls walls();
} // namespace portable
#endif

namespace {

InterfaceKernels pick() {
#if ASPERITY_HAS_X86_VARIANTS
    switch (processor_level()) {
    case ProcessorLevel::v4:
        return {v4::lattice_sweeps(), v4::row_sweeps(), v4::walls()};
    case ProcessorLevel::v3:
        return {v3::lattice_sweeps(), v3::row_sweeps(), v3::walls()};
    default:
        return {v2::lattice_sweeps(), v2::row_sweeps(), v2::walls()};
    }
#else
    return {portable::lattice_sweeps(), portable::row_sweeps(), portable::walls()};
#endif
}

} // namespace

const InterfaceKernels& interface_kernels() {
    static const InterfaceKernels kernels = pick();
    return kernels;
}

} // namespace asperity
