// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The interface of a scene in the terms of theory/, and all numbers of a scene that the
// renormalised theory (python/asperity/theories/renormalised.py) needs.
#pragma once

#include "engine/case/case.hpp"
#include "theory/flat_interface.hpp"
#include "theory/spectrum.hpp"

#include <nlohmann/json_fwd.hpp>

namespace asperity {

/// Returns the flat interface of a scene with atoms.
theory::FlatInterface flat_interface(const Case& c);

/// Returns the input of the renormalised theory and of that of sliding, in Å and eV:
///     q_L, spectrum    smallest wavevector; [[qa, qb, c, n], ...], C = c (q/qa)^n from qa to qb
///     realised         the spectrum is that of the surface itself
///     pressure         of drive.load
///     friction         sites feel lateral forces
///     stiffness        of the lattice for waves, averaged over directions, up to Nyquist:
///                      [[q, S_zz, S_xx, |S_xz|, 1/(S^-1)_zz], ...], per area
///     flat             rings [[R, density], ...], none over a wall; spacing of the substrate,
///                      contact (separation of a site in contact, at most), closest and reach
///                      (separations that matter); the pair energy V as a table: at (r), energy,
///                      first (V'/r), second ((V'/r)'/r), zero beyond; of a wall at (separation)
///                      and energy per area
/// The last three are replaced by a note with the reason if the renormalised theory does not apply.
nlohmann::ordered_json renormalised_inputs(const Case& c, const theory::Spectrum& spectrum,
                                           bool realised);

} // namespace asperity
