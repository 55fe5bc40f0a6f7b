// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Options of the interaction between the substrate and the block's lowest layer.
#pragma once

#include "decomposition/bands.hpp"
#include "decomposition/tile.hpp"
#include "io/site_quantities.hpp"
#include "kernels/interface_kernels.hpp"
#include "kernels/law_factors.hpp"

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

/// Factors of a law that is the same at all sites.
inline constexpr LawFactors<double> no_factors = [] {
    LawFactors<double> factors{};
    for (double& factor : factors.of)
        factor = 1.0;
    return factors;
}();

/// Options of the interface.
struct InterfaceOptions {
    std::optional<WallLaw> wall = {};            ///< wall in place of atoms
    std::shared_ptr<const WallShape> shape = {}; ///< shape to which `wall` refers; nullptr: none
    /// Maps of the sites over the wall, in the units of the scene's keys; nullptr: the number of
    /// the wall, or of the member below, for all sites. The wall has the largest of their values.
    PerSiteMap<std::shared_ptr<const SiteMap>> maps = {};
    /// Mean of law_factors() over the sites.
    LawFactors<double> mean_law_factors = no_factors;
    /// Largest net pressure of a site over the wall, eV/Å^3, of all sites without a map; empty: no
    /// site yields.
    std::optional<double> hardness = {};
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
    /// Returns true if the law of the wall differs from site to site.
    bool has_law_factors() const { return !maps_of_law().empty(); }
    /// Returns the maps from which the factors of the law of a site follow.
    std::vector<SiteMapOf> maps_of_law() const;
    /// Returns the factors of the law of a site with these values of maps_of_law(), in the units of
    /// the scene's keys (kernels/law_factors.hpp).
    LawFactors<double> law_factors(const PerSiteMap<double>& of_site) const;
    /// Sets mean_law_factors; the mean of equal sites is exactly that of one. Collective over the
    /// ranks of the maps. Requires has_law_factors().
    void find_mean_law_factors();
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
