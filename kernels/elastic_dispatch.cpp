// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "kernels/elastic_level.hpp"
#include "kernels/level_transfer.hpp"
#include "kernels/variant.hpp"

namespace asperity {

#if ASPERITY_HAS_X86_VARIANTS
namespace v2 {
extern const ElasticKernels small_strain_kernels;
extern const ElasticKernels finite_strain_kernels;
extern const TransferKernels transfer_kernels;
} // namespace v2
namespace v3 {
extern const ElasticKernels small_strain_kernels;
extern const ElasticKernels finite_strain_kernels;
extern const TransferKernels transfer_kernels;
} // namespace v3
namespace v4 {
extern const ElasticKernels small_strain_kernels;
extern const ElasticKernels finite_strain_kernels;
extern const TransferKernels transfer_kernels;
} // namespace v4
const ElasticKernels& elastic_kernels(CellStrain strain) {
    const bool finite = strain == CellStrain::finite;
    switch (processor_level()) {
    case ProcessorLevel::v4:
        return finite ? v4::finite_strain_kernels : v4::small_strain_kernels;
    case ProcessorLevel::v3:
        return finite ? v3::finite_strain_kernels : v3::small_strain_kernels;
    default:
        return finite ? v2::finite_strain_kernels : v2::small_strain_kernels;
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
extern const ElasticKernels small_strain_kernels;
extern const ElasticKernels finite_strain_kernels;
extern const TransferKernels transfer_kernels;
} // namespace portable
const ElasticKernels& elastic_kernels(CellStrain strain) {
    return strain == CellStrain::finite ? portable::finite_strain_kernels
                                        : portable::small_strain_kernels;
}
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
