// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Conversion of a scene to the types of theory/ and to the input of the renormalised theory
// (python/asperity/theories/renormalised.py).
#pragma once

#include "engine/case/case.hpp"
#include "theory/flat_interface.hpp"
#include "theory/spectrum.hpp"

#include <nlohmann/json_fwd.hpp>

namespace asperity {

/// Returns the flat interface of a scene with atoms, for theory/.
theory::FlatInterface flat_interface(const Case& c);

/// Returns the input of the renormalised theory and of the theory of sliding friction as JSON, in Å
/// and eV:
///     q_L, spectrum    smallest wavevector; [[qa, qb, c, n], ...], C = c (q/qa)^n from qa to qb
///     realised         the spectrum is that of the surface itself
///     pressure         drive.load
///     friction         true if the substrate exerts lateral forces on the sites
///     stiffness        lattice's stiffness per area, averaged over directions, up to Nyquist:
///                      [[q, S_zz, S_xx, |S_xz|, 1/(S^-1)_zz], ...]
///     flat             rings [[R, density], ...], none over a wall; spacing of the substrate,
///                      contact (separation of a site in contact, at most), closest and reach
///                      (separations that matter); the pair energy V as a table: at (r), energy,
///                      first (V'/r), second ((V'/r)'/r), zero beyond; of a wall at (separation)
///                      and energy per area
/// The last three are replaced by a note with the reason if the renormalised theory does not apply.
nlohmann::ordered_json renormalised_inputs(const Case& c, const theory::Spectrum& spectrum,
                                           bool realised);

} // namespace asperity
