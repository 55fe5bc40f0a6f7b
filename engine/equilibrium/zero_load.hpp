// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The state at zero load (or under a load): where the search for it starts, its numbers, and the
// one that a contact in motion would come to.
#pragma once

#include "engine/block/block.hpp"
#include "engine/equilibrium/relaxation.hpp"
#include "engine/equilibrium/state_array.hpp"
#include "engine/setup/case.hpp"

#include <array>
#include <functional>
#include <optional>
#include <string>

namespace asperity {

/// Of the relaxed state under zero load.
struct ZeroLoad {
    double binding_energy = 0.0; ///< gamma_state = -(U_LJ + U_el) / A0, meV/Å^2
    double pairwise = 0.0;       ///< -U_LJ / A0: the atom-by-atom work, meV/Å^2
    double elastic = 0.0;        ///< U_el / A0, meV/Å^2
    double contact_fraction = 0.0;
    double repulsive_fraction = 0.0;
    double mean_height = 0.0; ///< of the lowest layer above the substrate's zero, Å
    double residual = 0.0;    ///< largest force left, eV/Å
    long long iterations = 0;
    /// Of the binding energy: what forces as large as drive.tolerance stand for in the softest wave
    /// of the box, meV/Å^2.
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

/// Where the block, undisplaced, feels the strongest attraction on its way down: the descent that
/// starts there ends where a slow approach does, but for lateral forces on steep, soft surfaces.
/// The descent ends where the force presses by more than `negligible`, eV/Å: rows of a table leave
/// small forces of either sign beyond the attraction.
/// Collective.
double height_of_strongest_attraction(SpectralBlock& block, const Interface& interface,
                                      double lowest_atom, double range, double negligible = 0.0);

/// Of a tolerance that the rounding of numbers may keep a relaxation from, where sites stand as
/// high as this, Å; else empty.
std::string rounding_note(const Case& c, double height);

/// The relaxed state with the top plane free under this load (eV/Å, pressing down). Empty if
/// stop(iteration, residual) asked for an end. Collective. Throws io::PhysicsError if it is not
/// found.
std::optional<ZeroLoad> find_zero_load(SpectralBlock& block, const Interface& interface,
                                       double reference_height, double load, const Case& c,
                                       const std::function<bool(long long, double)>& stop);

/// A state as one rank sees it.
struct LayerAtRest {
    std::optional<ZeroLoad> numbers;
    VectorField<double> layer; ///< displacements of the lowest layer of this rank's tile, Å
};
/// The state at zero load below a block in motion. At rest the displacements of its lowest layer
/// are all that the state depends on (spectral_block.hpp): they go from the ranks' tiles to slabs
/// of rows, where all ranks relax them, and back. place: of the block over the substrate, Å. The
/// state is bitwise identical on any number of ranks. Collective. Without numbers, and without a
/// layer, if stop asked for an end.
LayerAtRest bring_to_rest(const Block& moving, const Surface& surface, double reference_height,
                          const Case& c, const std::function<bool(long long, double)>& stop,
                          const std::array<double, 2>& place);

} // namespace asperity
