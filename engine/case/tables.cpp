// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Errors that tables of potentials bring into a scene: the error of the spline between their rows
// and the noise of the rows, summed over the pairs of two flat surfaces at any distance, over the
// work of adhesion. To first order a binding energy is wrong by the errors of the pairs of its
// state, which that bounds.
#include "engine/case/potential_table.hpp"
#include "engine/case/resolving.hpp"

#include "engine/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <stdexcept>

namespace asperity {

namespace {

/// Errors of a table over the work of adhesion: the largest accepted, and the least noted.
constexpr double largest_error = 0.01, worth_a_note = 0.001;

/// Errors of a table over the work of adhesion.
struct Errors {
    double spline = 0.0, noise = 0.0;
    double sum() const { return spline + noise; }
};

/// Returns bounds of a table's errors with this cutoff. Without a flat reference they are those of
/// a pair at the distance of the minimum, over the depth of the well.
Errors errors_of(const Case& c, const PotentialTable& table, double cutoff) {
    const BlockOptions& block = c.simulation.block;
    InterfaceOptions layer = c.simulation.interface;
    layer.potential = table.potential(cutoff);
    layer.by_type.clear();
    std::optional<FlatReference> flat;
    try {
        flat = flat_reference(layer, block.spacing, block.sites, c.substrate());
    } catch (const std::invalid_argument&) { // rows so wrong that nothing binds, or another lattice
    }
    const auto bound = [&](const Tabulated& errors) {
        if (!flat || !(flat->work_of_adhesion > 0.0)) {
            const Pair<Tabulated> pair(errors);
            double most = 0.0;
            for (double r = minimum_of(layer.potential); r < cutoff; r += errors.step)
                most = std::max(most, pair.energy(r * r));
            return most / table.depth();
        }
        layer.potential = errors;
        constexpr int places = 100;
        double most = 0.0;
        for (int k = 0; k < places; ++k)
            most = std::max(most,
                            flat_pair_sum(layer, block.spacing, block.sites, c.substrate(),
                                          std::lerp(flat->separation, cutoff, k / double(places)))
                                .energy);
        const double area = block.spacing * block.spacing;
        return most / area * units::milli_per_unit / flat->work_of_adhesion;
    };
    return {bound(table.spline_error(cutoff)), bound(table.noise(cutoff))};
}

/// Returns a smaller cutoff at which the table can be used, Å; empty if there is none.
std::optional<double> usable_cutoff(const Case& c, const PotentialTable& table, double below) {
    const double cutoff = std::floor(98.0 * below) / 100.0;
    if (cutoff < 2.0 * zero_of(PairPotential(table.potential(table.last())))) return std::nullopt;
    if (table.repulsion(cutoff).nearest || errors_of(c, table, cutoff).sum() > largest_error)
        return std::nullopt;
    return cutoff;
}

/// Returns the problem of a table; empty if it has none.
std::optional<io::Problem> problem_of(const Case& c, const PotentialTable& table, double cutoff,
                                      const Errors& errors) {
    const Pair<Tabulated> noise(table.noise(cutoff));
    const double well = minimum_of(PairPotential(table.potential(cutoff)));
    constexpr const char* smoother =
        "write them with more digits, or fit a smooth curve to them and give its values";
    if (errors.sum() > largest_error) {
        const double rows = static_cast<double>(table.rows());
        const double enough = 1.5 * rows * std::pow(errors.sum() / largest_error, 0.25);
        return io::Problem{
            "", fmt::format("its {} rows do not determine a curve", table.rows()),
            fmt::format("by the spline through every second row and the scatter from row to row "
                        "(about {:.2g} eV at the well), energies of flat surfaces may be wrong by "
                        "{:.2g} % of the work of adhesion, and {:.2g} % is allowed",
                        noise.unshifted(well * well) / 4.0, 100.0 * errors.sum(),
                        100.0 * largest_error),
            fmt::format("if the energies are exact, give about {:.0f} rows with the same relative "
                        "distances; if they have noise, {}",
                        std::max(64.0, std::ceil(enough)), smoother)};
    }
    const PotentialTable::Repulsion again = table.repulsion(cutoff);
    if (!again.nearest || again.barrier > 10.0 * again.noise) return std::nullopt;
    const auto other = usable_cutoff(c, table, *again.nearest);
    return io::Problem{
        "",
        fmt::format("it repels again beyond its well, between {:.4g} and {:.4g} Å", *again.nearest,
                    *again.farthest),
        fmt::format("its rows scatter there by about {:.1g} eV (noise, or too few digits), and "
                    "solids that approach each other would stop",
                    again.noise / 4.0),
        other ? fmt::format("{}; or take interface.cutoff = {:.4g}", smoother, *other) : smoother};
}

} // namespace

bool check_tables(Case& c, io::Problems& problems) {
    const InterfaceOptions& interface = c.simulation.interface;
    if (interface.tables.empty()) return true;
    std::vector<PairPotential> all = interface.by_type;
    if (all.empty()) all.push_back(interface.potential);
    bool right = true;
    for (const PairPotential& potential : all) {
        const auto* tabulated = std::get_if<Tabulated>(&potential);
        if (!tabulated || tabulated->cutoff <= tabulated->minimum()) continue;
        const auto at = std::find_if(interface.tables.begin(), interface.tables.end(),
                                     [&](const auto& table) { return table->is_of(*tabulated); });
        const PotentialTable& table = **at;
        const std::string& file =
            c.table_files[static_cast<std::size_t>(at - interface.tables.begin())];
        const double cutoff = tabulated->cutoff;
        const Errors errors = errors_of(c, table, cutoff);
        c.table_error = std::max(c.table_error.value_or(0.0), errors.sum());
        if (const auto problem = problem_of(c, table, cutoff, errors)) {
            problems.add(interface.by_type.empty() ? "interface.table" : "interface.pairs",
                         fmt::format(": {}: {}", file, problem->what), problem->why, problem->fix);
            right = false;
            continue;
        }
        if (errors.sum() > worth_a_note)
            c.notes.push_back(fmt::format(
                "{}: between its {} rows energies of flat surfaces may be wrong by {:.2g} % of the "
                "work of adhesion (interface.table_error)",
                file, table.rows(), 100.0 * errors.sum()));
        if (const auto again = table.repulsion(cutoff); again.nearest)
            c.notes.push_back(fmt::format("{} repels again beyond its well, between {:.4g} and "
                                          "{:.4g} Å: on the way in a pair climbs {:.2g} eV",
                                          file, *again.nearest, *again.farthest, again.barrier));
    }
    return right;
}

} // namespace asperity
