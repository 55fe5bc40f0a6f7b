// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Options of the interaction between the substrate and the block's lowest layer.
#pragma once

#include "kernels/interface_kernels.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace asperity {

class PotentialTable;
class WallShape;

/// Methods of finding pairs. The reference loop is for tests; rows hold for any spacing.
enum class InterfaceMethod { automatic, reference, lattice, rows, cells, wall };

/// A number for each site of the box, from a map or a formula (a field of sites).
struct SiteMap {
    std::string name;           ///< name in results: "adhesion"
    std::string source;         ///< file or formula, as the scene gives it
    std::string file;           ///< file as found; empty: a formula
    std::uint32_t digest = 0;   ///< digest of the values of the whole box
    int sites = 0;              ///< number of sites across the box
    std::vector<double> values; ///< values[y * sites + x], in the unit of the scene's key
    double least = 0.0;         ///< least value of the whole box
    double largest = 0.0;       ///< largest value of the whole box

    /// Returns the value of site (x, y); 0 beyond the box.
    double at(int x, int y) const {
        if (x >= sites || y >= sites) return 0.0;
        return values[static_cast<std::size_t>(y) * static_cast<std::size_t>(sites) +
                      static_cast<std::size_t>(x)];
    }
    /// Returns the part of so many sites across.
    SiteMap corner(int across) const;
};

/// Options of the interface.
struct InterfaceOptions {
    std::optional<WallLaw> wall = {};            ///< wall in place of atoms
    std::shared_ptr<const WallShape> shape = {}; ///< shape that this law reads; null: none
    /// Work of adhesion of each site over the wall, meV/Å^2, the largest that of the law; null:
    /// that of the law
    std::shared_ptr<const SiteMap> adhesion = {};
    double mean_adhesion_factor = 1.0; ///< mean of adhesion_factor() over the sites
    PairPotential potential;
    /// Potentials of atoms anywhere, by AtomPositions::type; empty: `potential` for all.
    std::vector<PairPotential> by_type = {};
    /// Tables that these potentials read.
    std::vector<std::shared_ptr<const PotentialTable>> tables = {};
    bool tail = false;             ///< continuum correction beyond the cutoff
    bool mixed = false;            ///< pairs in single precision, in the sweep over a lattice
    bool mixed_on_request = false; ///< sweeps may be asked for with SweepOptions::mixed_precision
    bool free_edges = false;       ///< a wall below the first N x N of 2N x 2N sites
    bool slides = false; ///< the block is moved over the substrate (Interface::slide_to())
    InterfaceMethod method = InterfaceMethod::automatic;
    /// Skip offsets or atoms beyond reach; false: visit all (bitwise identical; for tests).
    bool skip = true;

    /// Returns the maps of the sites that the interface has.
    std::vector<std::shared_ptr<const SiteMap>> site_maps() const;
    /// Replaces each map of the sites by its part of so many sites across.
    void crop_site_maps(int across);
    /// Returns the factor of the law of site (x, y) over the wall (kernels/wall_law.hpp).
    double adhesion_factor(int x, int y) const;

    PairTable pairs() const {
        if (by_type.empty()) return potential;
        return {by_type.data(), static_cast<int>(by_type.size())};
    }
};

/// Options of one sweep.
struct SweepOptions {
    bool observe = false;         ///< energies, contacts and nearest distances too
    bool mixed_precision = false; ///< forces with errors of some 1e-6 eV/Å suffice
    std::optional<double> height =
        {}; ///< reference height for this sweep, Å; none: the interface's own
};

/// Returns the law of a wall with the mean of the sites' attractions.
WallLaw mean_wall(const InterfaceOptions& options);

/// Returns the distance beyond which the substrate does not act on a site, Å: the cutoff; with the
/// tail, which has no end, 4 cutoffs, where 1/256 of its energy is left.
double reach_of(const InterfaceOptions& options);

} // namespace asperity
