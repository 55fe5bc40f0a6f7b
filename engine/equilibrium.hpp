// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A block at rest over its substrate, whichever of its realisations it is: what a search for the
// relaxed state needs of it.
//
// The levels of a lattice or multiscale block relax by FIRE (relaxation.hpp), the waves of a
// spectral one by L-BFGS and Newton (spectral_relaxation.hpp). Both end in the state downhill of
// where they start; the start is the same.
#pragma once

#include "engine/block.hpp"
#include "engine/findings.hpp"
#include "engine/relaxation.hpp"
#include "engine/setup.hpp"
#include "io/progress.hpp"

#include <memory>

namespace asperity {

class Equilibrium {
public:
    virtual ~Equilibrium() = default;
    virtual VectorPlane<const double> lowest_layer() const = 0;
    virtual VectorPlane<double> interface_force() = 0;
    /// Back to an undisplaced block.
    virtual void undo() = 0;
    /// Relaxes in place with the top plane free. options.max_move is the realisation's own.
    virtual RelaxedState relax(Interface& interface, double reference_height, RelaxOptions options,
                               Phases& phases) = 0;
    virtual std::size_t bytes() const = 0;
    /// Of these, in levels coarser than the first.
    virtual std::size_t coarse_bytes() const = 0;
};

/// A block of levels, taken over.
std::unique_ptr<Equilibrium> at_rest(Block block);
/// The scene's block.
std::unique_ptr<Equilibrium> make_equilibrium(const Scene& scene, const Setup& setup,
                                              const Communicator& ranks, const ProcessGrid& grid);

/// Where the block, undisplaced, feels the strongest attraction on its way down: the descent that
/// starts there ends in the state that a slow approach reaches. Collective.
double height_of_strongest_attraction(Equilibrium& block, const Interface& interface,
                                      double lowest_atom, const Communicator& ranks);

/// The relaxed state under zero load. Collective. Throws io::PhysicsError if it is not found.
ZeroLoad find_zero_load(Equilibrium& block, Interface& interface, double reference_height,
                        const Scene& scene, const Setup& setup, io::Progress& progress);

} // namespace asperity
