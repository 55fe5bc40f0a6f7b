// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Options of the interaction between the substrate and the block's lowest layer.
#pragma once

#include "decomposition/bands.hpp"
#include "decomposition/tile.hpp"
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

/// Methods of finding pairs. `reference` is the direct loop, for tests; `rows` works for any
/// spacing of one layer.
enum class InterfaceMethod { automatic, reference, lattice, rows, cells, wall };

/// A number for each site of the box, from a map or a formula (a field of sites).
struct SiteMap {
    std::string name;         ///< name in results: "adhesion"
    std::string source;       ///< file or formula, as the scene gives it
    std::string file;         ///< path of the file; empty: a formula
    std::uint32_t digest = 0; ///< digest of the values of the whole box
    int sites = 0;            ///< number of sites across the box
    /// Band of the values on this rank, values[bands().at(x, y)], in the unit of the scene's key.
    std::vector<double> values;
    double least = 0.0;   ///< smallest value of the whole box
    double largest = 0.0; ///< largest value of the whole box
    double sum = 0.0;     ///< sum of the values of the whole box
    Communicator ranks{}; ///< ranks that hold the values

    /// Returns the division of the values among the ranks.
    Bands bands() const { return {ranks, sites}; }
    /// Returns the value of site (x, y) of the box, which lies in this rank's band.
    double at(int x, int y) const { return values[bands().at(x, y)]; }
    /// Returns the mean value of the whole box.
    double mean() const { return sum / (static_cast<double>(sites) * sites); }
    /// Returns the values of a tile's sites, [y * nx + x]; 0 outside the box. Collective.
    std::vector<double> under(const Tile& tile) const;
    /// Returns a map of across x across of this rank's values, which it alone holds.
    SiteMap piece(int across) const;
};

/// Options of the interface.
struct InterfaceOptions {
    std::optional<WallLaw> wall = {};            ///< wall in place of atoms
    std::shared_ptr<const WallShape> shape = {}; ///< shape to which `wall` refers; nullptr: none
    /// Work of adhesion of each site over the wall, meV/Å^2, of which the largest is the wall's;
    /// nullptr: the wall's for all sites.
    std::shared_ptr<const SiteMap> adhesion = {};
    double mean_adhesion_factor = 1.0; ///< mean of adhesion_factor() over the sites
    /// Largest net pressure of a site over the wall, eV/Å^3, of all sites without hardness_map;
    /// empty: no site yields.
    std::optional<double> hardness = {};
    /// Hardness of each site, GPa; nullptr: `hardness` for all sites.
    std::shared_ptr<const SiteMap> hardness_map = {};
    PairPotential potential;
    /// Potentials by AtomPositions::type; empty: `potential` for all atoms.
    std::vector<PairPotential> by_type = {};
    /// Tables to which the potentials refer.
    std::vector<std::shared_ptr<const PotentialTable>> tables = {};
    bool tail = false;             ///< continuum correction beyond the cutoff
    bool mixed = false;            ///< pairs in single precision, in the sweep over a lattice
    bool mixed_on_request = false; ///< SweepOptions::mixed_precision may be used
    bool slides = false;           ///< Interface::slide_to() may be used
    InterfaceMethod method = InterfaceMethod::automatic;
    /// Skip offsets or atoms beyond reach; false: visit all, with bitwise identical results, for
    /// tests.
    bool skip = true;

    /// Returns the maps of the sites that the interface has.
    std::vector<std::shared_ptr<const SiteMap>> site_maps() const;
    /// Replaces each map of the sites by a piece of across x across.
    void crop_site_maps(int across);
    /// Returns the factor of the attraction of a site of this work of adhesion, meV/Å^2, over the
    /// wall (kernels/wall_law.hpp).
    double adhesion_factor(double adhesion_of_site) const;
    /// Returns the mean hardness of the sites of the box, eV/Å^3. Requires `hardness`.
    double mean_hardness() const;

    /// Returns the potentials by type.
    PairTable pairs() const {
        if (by_type.empty()) return potential;
        return {by_type.data(), static_cast<int>(by_type.size())};
    }
};

/// Options of one sweep.
struct SweepOptions {
    bool observe = false;         ///< compute energies, contacts and nearest distances too
    bool mixed_precision = false; ///< allow errors of the forces of about 1e-6 eV/Å
    std::optional<double> height =
        {}; ///< reference height for this sweep, Å; empty: reference_height()
};

/// Returns the law of a wall with the attraction averaged over the sites.
WallLaw mean_wall(const InterfaceOptions& options);

/// Returns the interaction range, Å, beyond which the substrate is taken not to act on a site: the
/// cutoff; with the tail, which has no end, 4 cutoffs, at which 1/256 of the tail's energy is left.
double reach_of(const InterfaceOptions& options);

} // namespace asperity
