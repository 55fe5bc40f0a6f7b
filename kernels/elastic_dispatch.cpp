// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "kernels/elastic_finite.hpp"
#include "kernels/level_transfer.hpp"
#include "kernels/variant.hpp"

namespace asperity {

#if ASPERITY_HAS_X86_VARIANTS
namespace v2 {
extern const ElasticKernels elastic_kernels;
extern const FiniteKernels finite_kernels;
extern const TransferKernels transfer_kernels;
} // namespace v2
namespace v3 {
extern const ElasticKernels elastic_kernels;
extern const FiniteKernels finite_kernels;
extern const TransferKernels transfer_kernels;
} // namespace v3
namespace v4 {
extern const ElasticKernels elastic_kernels;
extern const FiniteKernels finite_kernels;
extern const TransferKernels transfer_kernels;
} // namespace v4
const ElasticKernels& elastic_kernels() {
    switch (processor_level()) {
    case ProcessorLevel::v4:
        return v4::elastic_kernels;
    case ProcessorLevel::v3:
        return v3::elastic_kernels;
    default:
        return v2::elastic_kernels;
    }
}
const FiniteKernels& finite_kernels() {
    switch (processor_level()) {
    case ProcessorLevel::v4:
        return v4::finite_kernels;
    case ProcessorLevel::v3:
        return v3::finite_kernels;
    default:
        return v2::finite_kernels;
    }
}
const TransferKernels& transfer_kernels() {
    switch (processor_level()) {
    case ProcessorLevel::v4:
        return v4::transfer_kernels;
    case ProcessorLevel::v3:
        return v3::transfer_kernels;
    default:
        return v2::transfer_kernels;
    }
}
#else
namespace portable {
extern const ElasticKernels elastic_kernels;
extern const FiniteKernels finite_kernels;
extern const TransferKernels transfer_kernels;
} // namespace portable
const ElasticKernels& elastic_kernels() { return portable::elastic_kernels; }
const FiniteKernels& finite_kernels() { return portable::finite_kernels; }
const TransferKernels& transfer_kernels() { return portable::transfer_kernels; }
#endif

Stencil make_stencil(CellElasticity e, Face face) {
    const double w = face == Face::inner ? 2.0 : 1.0;
    const double tau = face == Face::lower ? 1.0 : face == Face::upper ? -1.0 : 0.0;
    const double k = e.k, kappa = e.kappa;
    Stencil s{};
    s.own_c = -w * (4.0 * kappa + 3.0 * k);
    s.own_e = w * (2.0 * kappa + 0.5 * k);
    s.own_t = -w * 2.0 * kappa;
    s.own_d = w * (kappa + 0.25 * k);
    s.own_xy = w * (kappa + 0.25 * k);
    s.out_c = -4.0 * kappa;
    s.out_e = 2.0 * kappa + 0.5 * k;
    s.out_t = -2.0 * kappa;
    s.out_d = kappa;
    s.out_xy = kappa;
    s.normal_c = -w * (4.0 * kappa + 3.0 * k);
    s.normal_e = -w * 2.0 * kappa;
    s.normal_d = -w * kappa;
    s.out_normal_c = 4.0 * kappa + k;
    s.out_normal_e = 2.0 * kappa + 0.5 * k;
    s.out_normal_d = kappa;
    s.out_r = 2.0 * kappa + 0.5 * k;
    s.out_rd = kappa;
    s.tau_r = tau * 2.0 * kappa;
    s.tau_rd = tau * kappa;
    s.above = face == Face::upper ? 0.0 : 1.0;
    s.below = face == Face::lower ? 0.0 : 1.0;
    return s;
}

} // namespace asperity
