// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The paper's parameters in eV and Å, for the tests of the theory.
#pragma once

#include <numbers>

#include "theory/persson.hpp"

namespace paper {

constexpr double gpa = 1 / 160.21766; // eV/Å³
constexpr double q_L = 2 * std::numbers::pi / (512 * 2.6);
constexpr double contact_modulus = 77.2 * gpa / (1 - 0.42 * 0.42);
constexpr double work_of_adhesion = 0.1;

inline asperity::theory::AdhesiveContact
contact(double h_rms,
        asperity::theory::AreaFactor area_factor = asperity::theory::AreaFactor::gaussian) {
    asperity::theory::AdhesiveContact c;
    c.spectrum = asperity::theory::Spectrum::self_affine(
        {.q_L = q_L, .q0 = 3 * q_L, .q1 = 512 * q_L, .hurst = 0.8, .h_rms = h_rms});
    c.contact_modulus = contact_modulus;
    c.work_of_adhesion = work_of_adhesion;
    c.area_factor = area_factor;
    return c;
}

} // namespace paper
