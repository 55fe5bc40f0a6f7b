// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/statics/zero_load.hpp"

#include "decomposition/global_sum.hpp"
#include "decomposition/plane_bands.hpp"
#include "engine/units.hpp"
#include "io/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

namespace asperity {

double height_of_strongest_attraction(SpectralBlock& block, const Interface& interface,
                                      double lowest_atom, double range, double negligible) {
    block.set_uniform(0.0);
    double best_height = interface.attraction_grows_down_to(), strongest = 0.0;
    const double stride = 0.057 * range;
    for (double height = best_height;; height -= stride) {
        const InterfaceSums sums = interface.sweep(block.lowest_layer(), block.interface_force(),
                                                   {.mixed_precision = true, .height = height});
        const double force = global_sum(block.communicator(), sums.force_z);
        if (force < strongest) strongest = force, best_height = height;
        if (force > negligible || height < lowest_atom) return best_height;
    }
}

void place_for_relaxation(SpectralBlock& block, const Interface& interface, const Surface& surface,
                          const Case& c) {
    const double height =
        height_of_strongest_attraction(block, interface, surface.statistics.lowest, c.scales.length,
                                       c.tolerance * surface.sites * surface.sites);
    block.set_uniform(height - interface.reference_height());
}

std::string rounding_note(const Case& c, double height) {
    const double floor = rounding_of_forces(c.scales, c.simulation.block, height);
    if (c.tolerance >= floor) return {};
    return fmt::format("drive.tolerance = {:.2g} asks for {:.1e} eV/Å, and the rounding of numbers "
                       "alone leaves about {:.1e} eV/Å: a relaxation may not come to an end; take "
                       "{:.1g} or more",
                       c.tolerance / c.scales.force, c.tolerance, floor, floor / c.scales.force);
}

std::optional<ZeroLoad> find_zero_load(SpectralBlock& block, const Interface& interface,
                                       double load, const Case& c,
                                       const std::function<bool(long long, double)>& stop) {
    RelaxOptions options;
    // A site's part of the load is the scale if the load is larger than the scale of forces.
    options.tolerance = c.tolerance * std::max(1.0, load / (c.sites() * c.scales.force));
    options.scales = c.scales;
    options.report = stop;
    Phases own;                       // apart from the lines of the step
    block.begin_step(units::forever); // branches have relaxed at the end
    const RelaxedState s = relax(block, interface, Constraint::load(load), options, own);
    if (s.interrupted) return std::nullopt;
    if (!s.converged)
        throw io::PhysicsError(
            fmt::format("the relaxed state was not found in {} iterations", s.iterations),
            why_not_converged(s, options.tolerance),
            load < 0.0   ? "take a smaller pull (drive.load): under a large one there is no state"
            : s.balanced ? "take a larger drive.tolerance"
                         : "look at run.h5 whether the surfaces touch at all");
    const double area = c.area();
    ZeroLoad z;
    const double elastic = s.elastic_of_block();
    z.binding_energy = -units::milli_per_unit * (s[Term::interface] + elastic) / area;
    z.pairwise = -units::milli_per_unit * s[Term::interface] / area;
    z.elastic = units::milli_per_unit * elastic / area;
    z.contact_fraction = c.fraction(s.in_contact);
    if (interface.wall())
        z.contact_area = contact_sites(static_cast<double>(s.in_contact),
                                       static_cast<double>(interface.contact_edges(
                                           block.lowest_layer(), block.communicator()))) /
                         c.sites();
    z.repulsive_fraction = c.fraction(s.repulsive);
    z.mean_height = interface.reference_height() + s.mean_height;
    z.residual = s.residual;
    z.iterations = s.iterations;
    // Half of force^2 / stiffness at each site, of the softest wave of the box, by the forces that
    // the tolerance allows: those left say how this relaxation ended, not where others may end.
    const double site_area = c.simulation.block.spacing * c.simulation.block.spacing;
    z.uncertainty = units::milli_per_unit * 0.5 * options.tolerance * options.tolerance /
                    (c.simulation.block.softest_wave() * site_area * site_area);
    return z;
}

LayerAtRest bring_to_rest(const Block& moving, const Surface& surface, double reference_height,
                          const Case& c, const std::function<bool(long long, double)>& stop,
                          const std::array<double, 2>& place) {
    const Communicator& ranks = moving.communicator();
    const ProcessGrid slabs =
        ProcessGrid::slabs(ranks.size(), ranks.rank(), c.simulation.block.sites);
    const auto components = [](const auto& field) { return std::array{field.x, field.y, field.z}; };
    SpectralBlock block(c.simulation.block, ranks);
    InterfaceOptions options = c.simulation.interface;
    options.mixed_on_request = true;
    Interface interface(surface, block.tile(), c.simulation.block.spacing, options);
    interface.set_reference_height(reference_height);
    interface.slide_to(place[0], place[1]);
    for (std::size_t k = 0; k < 3; ++k)
        move_plane(ranks, moving.grid(), components(moving.lowest_layer())[k], slabs,
                   components(block.layer().plane(0))[k]);
    LayerAtRest found;
    found.numbers = find_zero_load(block, interface, 0.0, c, stop);
    if (!found.numbers) return found;
    found.layer = VectorField<double>(moving.levels().front().tile, 1);
    for (std::size_t k = 0; k < 3; ++k)
        move_plane(ranks, slabs, components(block.lowest_layer())[k], moving.grid(),
                   components(found.layer.plane(0))[k]);
    return found;
}

} // namespace asperity
