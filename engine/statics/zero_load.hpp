// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The state at zero load (or under a load): the start of the search for it, its numbers, and the
// state to which a contact in motion would relax.
#pragma once

#include "engine/block/block.hpp"
#include "engine/case/case.hpp"
#include "engine/statics/relaxation.hpp"
#include "engine/statics/state_array.hpp"

#include <array>
#include <functional>
#include <optional>
#include <string>

namespace asperity {

/// Numbers of the relaxed state under zero load.
struct ZeroLoad {
    double binding_energy = 0.0; ///< gamma_state = -(U_LJ + U_el) / A0, meV/Å^2
    double pairwise = 0.0;       ///< -U_LJ / A0: the atom-by-atom work, meV/Å^2
    double elastic = 0.0;        ///< U_el / A0, meV/Å^2
    double contact_fraction = 0.0;
    double repulsive_fraction = 0.0;
    double mean_height = 0.0; ///< mean height of the lowest layer above the substrate's zero, Å
    double residual = 0.0;    ///< largest force left, eV/Å
    long long iterations = 0;
    /// Uncertainty of the binding energy, meV/Å^2: the energy of forces as large as drive.tolerance
    /// in the softest wave of the box.
    double uncertainty = 0.0;

    template <class Visitor>
    void visit(Visitor& v) {
        v("binding_energy", binding_energy);
        v("pairwise", pairwise);
        v("elastic", elastic);
        v("contact_fraction", contact_fraction);
        v("repulsive_fraction", repulsive_fraction);
        v("mean_height", mean_height);
        v("residual", residual);
        v("iterations", iterations);
        v("uncertainty", uncertainty);
    }
};

/// Returns the height of the strongest attraction of the undisplaced block on its way down, Å. The
/// descent from this height ends in the state of a slow approach, apart from lateral forces on
/// steep, soft surfaces. The search ends if the force presses by more than `negligible`, eV/Å: rows
/// of a table leave small forces of either sign beyond the attraction. Collective.
double height_of_strongest_attraction(SpectralBlock& block, const Interface& interface,
                                      double lowest_atom, double range, double negligible = 0.0);

/// Displaces the undeformed block to that height, from which the state of a slow approach is found.
/// Collective.
void place_for_relaxation(SpectralBlock& block, const Interface& interface, const Surface& surface,
                          const Case& c);

/// Returns a note if rounding may keep a relaxation from the tolerance with sites at this height
/// (Å); otherwise an empty text.
std::string rounding_note(const Case& c, double height);

/// Relaxes with the top plane free under this load (eV/Å, pressing down). Returns nothing if
/// stop(iteration, residual) asked for an end. Collective. Throws io::PhysicsError if no state is
/// found.
std::optional<ZeroLoad> find_zero_load(SpectralBlock& block, const Interface& interface,
                                       double load, const Case& c,
                                       const std::function<bool(long long, double)>& stop);

/// A relaxed state as one rank sees it.
struct LayerAtRest {
    std::optional<ZeroLoad> numbers;
    VectorField<double> layer; ///< displacements of the lowest layer of this rank's tile, Å
};
/// Relaxes a copy of a block in motion at zero load. The displacements of its lowest layer are all
/// that the state depends on (spectral_block.hpp): they are sent from the ranks' tiles to slabs of
/// rows, relaxed there by all ranks, and sent back. reference_height: that of the block's
/// interface, Å. place: place of the block over the substrate, Å. The state is bitwise
/// identical on any number of ranks; it has no numbers and no layer if stop asked for an end.
/// Collective.
LayerAtRest bring_to_rest(const Block& moving, const Surface& surface, double reference_height,
                          const Case& c, const std::function<bool(long long, double)>& stop,
                          const std::array<double, 2>& place);

} // namespace asperity
