// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The interface of a scene in the terms of theory/, and all that the renormalised theory
// (python/asperity/theory.py) needs to know of a scene.
#pragma once

#include "engine/setup/case.hpp"
#include "theory/flat_interface.hpp"
#include "theory/spectrum.hpp"

#include <nlohmann/json_fwd.hpp>

namespace asperity {

/// The flat interface of a scene with atoms.
theory::FlatInterface flat_interface(const Case& c);

/// In Å and eV:
///     q_L, spectrum    smallest wavevector; [[qa, qb, c, n], ...], C = c (q/qa)^n from qa to qb
///     realised         the spectrum is that of the surface itself
///     pressure, friction
///     stiffness        of the lattice for waves, averaged over directions, up to Nyquist:
///                      [[q, S_zz, S_xx, |S_xz|, 1/(S^-1)_zz], ...], per area
///     flat             rings [[R, density], ...], none over a wall; spacing of the substrate,
///                      contact (a site is, below), closest and reach (separations that matter);
///                      the pair energy V as a table: at (r), energy, first (V'/r), second
///                      ((V'/r)'/r), zero beyond; of a wall at (separation) and energy per area
/// Or, where the theory does not apply: note, why.
nlohmann::ordered_json renormalised_inputs(const Case& c, const theory::Spectrum& spectrum,
                                           bool realised);

} // namespace asperity
