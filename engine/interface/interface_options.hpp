// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What acts between the substrate and the block's lowest layer.
#pragma once

#include "engine/interface/potential_table.hpp"
#include "kernels/interface_kernels.hpp"

#include <memory>
#include <optional>
#include <vector>

namespace asperity {

/// How pairs are found. The reference loop is for tests; rows hold for any spacing.
enum class InterfaceMethod { automatic, reference, lattice, rows, cells, wall };

struct InterfaceOptions {
    std::optional<WallLaw> wall = {}; ///< in place of atoms
    PairPotential potential;
    /// Of atoms anywhere, by AtomPositions::type; empty: `potential` for all.
    std::vector<PairPotential> by_type = {};
    /// That these potentials read.
    std::vector<std::shared_ptr<const PotentialTable>> tables = {};
    bool tail = false;      ///< continuum correction beyond the cutoff
    bool mixed = false;     ///< pairs in single precision, in the sweep over a lattice
    bool rough_too = false; ///< sweeps may be asked for with SweepOptions::rough
    bool slides = false;    ///< the block is moved over the substrate (Interface::slide_to())
    InterfaceMethod method = InterfaceMethod::automatic;
    bool skip =
        true; ///< false: visit all offsets or atoms everywhere (bitwise identical; for tests)

    PairTable pairs() const {
        if (by_type.empty()) return potential;
        return {by_type.data(), static_cast<int>(by_type.size())};
    }
};

/// What a sweep is asked for.
struct SweepOptions {
    bool observe = false; ///< energies, contacts and nearest distances too
    bool rough = false;   ///< forces good to some 1e-6 eV/Å are enough
};

/// Distance from which on the substrate does not act on a site, Å: beyond the cutoff; with the
/// tail, which ends nowhere, 4 cutoffs, where 1/256 of its energy is left.
double reach_of(const InterfaceOptions& options);

} // namespace asperity
