// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The tables of kernels, one of each for every processor level (variant.hpp), and which of them the
// running processor takes.
#include "kernels/elastic_level.hpp"
#include "kernels/interface_kernels.hpp"
#include "kernels/level_transfer.hpp"
#include "kernels/surface_rows.hpp"
#include "kernels/variant.hpp"

#define ASPERITY_TABLES(variant)                                                                   \
    namespace variant {                                                                            \
    extern const ElasticKernels small_strain_kernels, finite_strain_kernels;                       \
    extern const TransferKernels transfer_kernels;                                                 \
    extern const InterfaceKernels::LatticeSweeps lattice_sweeps;                                   \
    extern const InterfaceKernels::Sweeps<RowSubstrate> row_sweeps;                                \
    extern const InterfaceKernels::Sweeps<CellSubstrate, PairTable> cell_sweeps;                   \
    extern const WallKernels wall_kernels;                                                         \
    extern const RowKernels row_kernels;                                                           \
    }

namespace asperity {

#if ASPERITY_HAS_V2 || ASPERITY_HAS_V3 || ASPERITY_HAS_V4
ASPERITY_TABLES(v2)
ASPERITY_TABLES(v3)
ASPERITY_TABLES(v4)
#if ASPERITY_HAS_V2
#define ASPERITY_V2(name) &v2::name
#else
#define ASPERITY_V2(name) nullptr
#endif
#if ASPERITY_HAS_V3
#define ASPERITY_V3(name) &v3::name
#else
#define ASPERITY_V3(name) nullptr
#endif
#if ASPERITY_HAS_V4
#define ASPERITY_V4(name) &v4::name
#else
#define ASPERITY_V4(name) nullptr
#endif
#define ASPERITY_TABLE(name)                                                                       \
    of_processor<decltype(v2::name)>(ASPERITY_V2(name), ASPERITY_V3(name), ASPERITY_V4(name))
#else
ASPERITY_TABLES(portable)
#define ASPERITY_TABLE(name) portable::name
#endif

namespace {

/// Returns the table of a level; nullptr if it was not compiled and so never is processor_level().
template <class Table>
[[maybe_unused]] Table& of_processor(Table* v2, Table* v3, Table* v4) {
    switch (processor_level()) {
    case ProcessorLevel::v4:
        return *v4;
    case ProcessorLevel::v3:
        return *v3;
    default:
        return *v2;
    }
}

} // namespace

const ElasticKernels& elastic_kernels(CellStrain strain) {
    return strain == CellStrain::finite ? ASPERITY_TABLE(finite_strain_kernels)
                                        : ASPERITY_TABLE(small_strain_kernels);
}
const TransferKernels& transfer_kernels() { return ASPERITY_TABLE(transfer_kernels); }
const InterfaceKernels& interface_kernels() {
    static const InterfaceKernels kernels = {
        ASPERITY_TABLE(lattice_sweeps), ASPERITY_TABLE(row_sweeps), ASPERITY_TABLE(cell_sweeps),
        ASPERITY_TABLE(wall_kernels)};
    return kernels;
}
const RowKernels& row_kernels() { return ASPERITY_TABLE(row_kernels); }

} // namespace asperity
