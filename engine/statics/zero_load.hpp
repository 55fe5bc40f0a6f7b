// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The state at zero load (or under a load): the place from which it is relaxed, its numbers, and
// the state to which a moving contact would relax.
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
    double pairwise = 0.0;       ///< -U_LJ / A0: binding energy of the pairs alone, meV/Å^2
    double elastic = 0.0;        ///< U_el / A0, meV/Å^2
    double contact_fraction = 0.0;
    std::optional<double> contact_area; ///< share of contact_sites() over a wall
    double repulsive_fraction = 0.0;
    double mean_height = 0.0; ///< mean height of the lowest layer above the substrate's zero, Å
    double residual = 0.0;    ///< largest residual force on a site, eV/Å
    long long iterations = 0;
    /// Uncertainty of the binding energy, meV/Å^2: the energy of residual forces of the size of
    /// drive.tolerance in the softest wave of the box.
    double uncertainty = 0.0;

    template <class Visitor>
    void visit(Visitor& v) {
        v("binding_energy", binding_energy);
        v("pairwise", pairwise);
        v("elastic", elastic);
        v("contact_fraction", contact_fraction);
        v("contact_area", contact_area);
        v("repulsive_fraction", repulsive_fraction);
        v("mean_height", mean_height);
        v("residual", residual);
        v("iterations", iterations);
        v("uncertainty", uncertainty);
    }
};

/// Returns the height at which the undisplaced block, lowered rigidly, is attracted most, Å. A
/// relaxation from this height ends in the state of a slow approach, apart from effects of lateral
/// forces on steep, soft surfaces. The search ends once the force presses by more than
/// `negligible`, eV/Å: tabulated potentials leave small forces of either sign beyond the
/// attraction. lowest_atom: lowest height of the substrate, Å; range: length over which the force
/// changes (Scales::length), Å. Collective.
double height_of_strongest_attraction(SpectralBlock& block, const Interface& interface,
                                      double lowest_atom, double range, double negligible = 0.0);

/// Displaces the undeformed block to height_of_strongest_attraction(). Collective.
void place_for_relaxation(SpectralBlock& block, const Interface& interface, const Surface& surface,
                          const Case& c);

/// Returns a note if rounding may prevent the relaxation of sites at this height (Å) to the
/// tolerance; otherwise an empty text.
std::string rounding_note(const Case& c, double height);

/// Relaxes the block with the top plane free under a load (eV/Å, positive presses). Returns nothing
/// if stop(iteration, residual) returned true. Collective. Throws io::PhysicsError if no state is
/// found.
std::optional<ZeroLoad> find_zero_load(SpectralBlock& block, const Interface& interface,
                                       double load, const Case& c,
                                       const std::function<bool(long long, double)>& stop);

/// A relaxed state on one rank.
struct LayerAtRest {
    std::optional<ZeroLoad> numbers;
    /// Displacements of the lowest layer of this rank's tile, Å; empty if the block that was
    /// relaxed is still in the state.
    VectorField<double> layer;
};
/// Relaxes a copy of a moving block at zero load. The state depends on the displacements of the
/// lowest layer alone (spectral_block.hpp), which are sent from the ranks' tiles to slabs of rows,
/// relaxed there by all ranks, and sent back. reference_height: height of the undisplaced lowest
/// layer, Å; place: place of the block over the substrate, Å. The state is bitwise identical on any
/// number of ranks; it has no numbers and no layer if stop() returned true. Collective.
LayerAtRest bring_to_rest(const Block& moving, const Surface& surface, double reference_height,
                          const Case& c, const std::function<bool(long long, double)>& stop,
                          const std::array<double, 2>& place);

} // namespace asperity
