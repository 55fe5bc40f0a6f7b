// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Options of the interaction between the substrate and the block's lowest layer.
#pragma once

#include "kernels/interface_kernels.hpp"

#include <memory>
#include <optional>
#include <vector>

namespace asperity {

class PotentialTable;

/// Methods of finding pairs. The reference loop is for tests; rows hold for any spacing.
enum class InterfaceMethod { automatic, reference, lattice, rows, cells, wall };

/// Options of the interface.
struct InterfaceOptions {
    std::optional<WallLaw> wall = {}; ///< wall in place of atoms
    PairPotential potential;
    /// Potentials of atoms anywhere, by AtomPositions::type; empty: `potential` for all.
    std::vector<PairPotential> by_type = {};
    /// Tables that these potentials read.
    std::vector<std::shared_ptr<const PotentialTable>> tables = {};
    bool tail = false;             ///< continuum correction beyond the cutoff
    bool mixed = false;            ///< pairs in single precision, in the sweep over a lattice
    bool mixed_on_request = false; ///< sweeps may be asked for with SweepOptions::rough
    bool free_edges = false;       ///< a wall below the first N x N of 2N x 2N sites
    bool slides = false; ///< the block is moved over the substrate (Interface::slide_to())
    InterfaceMethod method = InterfaceMethod::automatic;
    /// Skip offsets or atoms beyond reach; false: visit all (bitwise identical; for tests).
    bool skip = true;

    PairTable pairs() const {
        if (by_type.empty()) return potential;
        return {by_type.data(), static_cast<int>(by_type.size())};
    }
};

/// Options of one sweep.
struct SweepOptions {
    bool observe = false;         ///< energies, contacts and nearest distances too
    bool rough = false;           ///< forces good to some 1e-6 eV/Å are enough
    std::optional<double> height; ///< reference height for this sweep, Å; none: the interface's own
};

/// Returns the distance beyond which the substrate does not act on a site, Å: the cutoff; with the
/// tail, which has no end, 4 cutoffs, where 1/256 of its energy is left.
double reach_of(const InterfaceOptions& options);

} // namespace asperity
