// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A block at rest over its substrate, whichever of its realisations it is: what a search for the
// relaxed state, and a path of such states, need of it.
//
// The levels of a lattice or multiscale block relax with momentum over coarse grids
// (relaxation.hpp), the waves of a spectral one as heavy balls, ended by Newton
// (spectral_relaxation.hpp), or over a wall by proximal steps (wall_descent.hpp). All end in the
// state downhill of where they start; the start is the same.
#pragma once

#include "engine/block/block.hpp"
#include "engine/equilibrium/findings.hpp"
#include "engine/equilibrium/relaxation.hpp"
#include "engine/equilibrium/state_array.hpp"
#include "engine/setup/setup.hpp"
#include "io/progress.hpp"

#include <memory>

namespace asperity {

class Equilibrium {
public:
    virtual ~Equilibrium() = default;
    virtual VectorPlane<const double> lowest_layer() const = 0;
    virtual VectorPlane<double> interface_force() = 0;
    virtual const Communicator& communicator() const = 0;

    /// The whole block, its top plane with it, displaced by (0, 0, z).
    virtual void set_uniform(double z) = 0;
    /// Displacement of the top plane along z, and the mean one of the lowest layer, Å. Collective.
    virtual double top() const = 0;
    virtual double mean_height() const = 0;

    /// Displacements of all that moves, those of the lowest layer (x, y, z) first.
    virtual std::vector<StateArray> state() = 0;
    /// Makes the rest follow after the arrays of state() were written from outside: the block
    /// stands where the constraint has it, and what is derived of the displacements is up to date.
    /// Collective.
    virtual void settle(const Constraint& constraint) = 0;

    /// Settles, then relaxes in place. options.max_move is the realisation's own. Collective.
    virtual RelaxedState relax(Interface& interface, double reference_height,
                               const Constraint& constraint, RelaxOptions options,
                               Phases& phases) = 0;
    virtual std::size_t bytes() const = 0;
};

/// A block of levels, taken over.
std::unique_ptr<Equilibrium> at_rest(Block block);
/// The spectral block; wall: one is below it (only bytes() asks).
std::unique_ptr<Equilibrium> spectral_at_rest(const BlockOptions& options,
                                              const Communicator& ranks, bool frictionless = false,
                                              bool wall = false);
/// The scene's block.
std::unique_ptr<Equilibrium> make_equilibrium(const Scene& scene, const Setup& setup,
                                              const Communicator& ranks, const ProcessGrid& grid);

/// Where the block, undisplaced, feels the strongest attraction on its way down: the descent that
/// starts there ends in the state that a slow approach reaches. Collective.
double height_of_strongest_attraction(Equilibrium& block, const Interface& interface,
                                      double lowest_atom, const Communicator& ranks);

/// The relaxed state with the top plane free under this load (eV/Å, pressing down). Empty if
/// stop(iteration, residual) asked for an end. Collective. Throws io::PhysicsError if it is not
/// found.
std::optional<ZeroLoad> find_zero_load(Equilibrium& block, Interface& interface,
                                       double reference_height, double load, const Scene& scene,
                                       const Setup& setup,
                                       const std::function<bool(long long, double)>& stop);

/// "relaxing, largest force 1e-3 eV/Å"
void show_relaxation(io::Progress& progress, long long iteration, double residual);

} // namespace asperity
