// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/run/renormalised_case.hpp"

#include "engine/block/block.hpp"
#include "engine/units.hpp"
#include "kernels/surface_stiffness.hpp"
#include "theory/error.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

namespace asperity {

namespace {

/// The steepest roughness at which the theory was held against simulations
/// (docs/explanation/theory.md).
constexpr double compared_slope = 0.6;

WavePhase phase_of(double angle) { return {std::cos(angle), std::sin(angle)}; }

/// Of a wave of wavevector q in the direction `angle`, per area.
theory::WaveStiffness wave_stiffness(const CellElasticity& elasticity, double spacing,
                                     int thickness, double q, double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    const SurfaceMatrix m = surface_stiffness(elasticity, phase_of(q * spacing * c),
                                              phase_of(q * spacing * s), thickness);
    const double area = spacing * spacing;
    return {q, m.zz / area, (c * c * m.xx + s * s * m.yy + 2.0 * c * s * m.xy) / area,
            std::abs(c * m.xz + s * m.yz) / area, 1.0 / inverse(m).zz / area};
}

template <class Law>
theory::FlatInterface wall_interface(const Case& c, const Law& law) {
    if constexpr (std::is_same_v<Law, ExponentialWall>)
        throw theory::InvalidInput("the renormalised theory follows the curvature of a smooth law, "
                                   "and the exponential wall has a kink where it is touched; take "
                                   "interface.law = \"smeared\" or atoms");
    const double area = c.simulation.block.spacing * c.simulation.block.spacing;
    const double separation = c.flat.separation;
    // As far inwards as the repulsion is about twice the largest tension.
    const double closest = separation - 2.0 * (law.contact_gap() - separation);
    return theory::FlatInterface::wall([law, area](double u) { return law.energy(u) / area; },
                                       closest, reach_of(c.simulation.interface),
                                       law.contact_gap());
}

} // namespace

theory::PairInteraction pair_interaction(const PairPotential& potential, bool tail) {
    return std::visit(
        [tail](const auto& p) {
            return theory::PairInteraction{[pair = Pair(p)](double r2) {
                                               const PairDerivatives d = pair.derivatives(r2);
                                               return theory::PairTerms{d.energy, d.slope, d.bend};
                                           },
                                           p.zero(),
                                           p.minimum(),
                                           p.inflection(),
                                           p.cutoff,
                                           tail};
        },
        potential);
}

theory::FlatInterface flat_interface(const Case& c) {
    const InterfaceOptions& options = c.simulation.interface;
    if (options.wall)
        return std::visit([&](const auto& law) { return wall_interface(c, law); }, *options.wall);
    const theory::PairInteraction pair = pair_interaction(options.potential, options.tail);
    const double spacing = c.simulation.block.spacing;
    if (c.substrate() == c.scene.surface.sites)
        return theory::FlatInterface::hollow_sites(pair, spacing);
    return theory::FlatInterface::all_registries(pair, spacing, c.scene.edge() / c.substrate());
}

theory::StiffnessTable lattice_stiffness(const Case& c) {
    const BlockOptions& block = c.simulation.block;
    const CellElasticity elasticity = block.elasticity(0);
    const double low = 2.0 * std::numbers::pi / c.scene.edge();
    const double high = std::numbers::pi / block.spacing;
    constexpr int waves = 48;
    // The lattice has the symmetry of the square: directions in an eighth of the circle, Gauss.
    constexpr double nodes[] = {0.112701665379258, 0.5, 0.887298334620742};
    constexpr double weights[] = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
    std::vector<theory::WaveStiffness> table;
    for (int k = 0; k <= waves; ++k) {
        theory::WaveStiffness mean;
        mean.q = k == waves ? high : low * std::pow(high / low, static_cast<double>(k) / waves);
        for (int d = 0; d < 3; ++d) {
            const theory::WaveStiffness w =
                wave_stiffness(elasticity, block.spacing, block.thickness, mean.q,
                               nodes[d] * std::numbers::pi / 4.0);
            mean.zz += weights[d] * w.zz;
            mean.xx += weights[d] * w.xx;
            mean.xz += weights[d] * w.xz;
            mean.free_zz += weights[d] * w.free_zz;
        }
        table.push_back(mean);
    }
    return theory::StiffnessTable(std::move(table));
}

RenormalisedCase renormalised_case(const Case& c, const theory::Spectrum& spectrum, bool realised) {
    try {
        return {theory::RoughInterface{spectrum, flat_interface(c), lattice_stiffness(c),
                                       !c.scene.interface.frictionless,
                                       c.scene.drive.load * units::megapascal, !realised},
                ""};
    } catch (const std::exception& error) {
        return {std::nullopt, error.what()};
    }
}

RenormalisedResult solve_renormalised(const RenormalisedCase& what) {
    RenormalisedResult result;
    result.note = what.note;
    if (!what.rough) return result;
    try {
        const theory::RoughInterface& rough = *what.rough;
        const theory::RenormalisedState state = theory::solve(rough);
        const double depth = units::milli_per_unit * rough.flat.work_of_adhesion();
        RenormalisedNumbers n;
        n.gamma_eff = units::milli_per_unit * state.gamma_eff;
        n.gamma_eff_ratio = state.gamma_ratio;
        n.gamma_eff_error = depth * state.gamma_ratio_error;
        n.contact_fraction = state.contact_fraction;
        n.contact_fraction_error = state.contact_error;
        if (state.expected) {
            n.gamma_eff_expected_error = depth * state.expected->gamma_ratio;
            n.contact_fraction_expected_error = state.expected->contact;
        }
        // Below this the potential is rounding, and its minimum anywhere.
        if (state.gamma_ratio > 1e-9 || rough.pressure > 0.0) n.separation = state.separation;
        n.tension = state.tension / units::gigapascal;
        if (!state.converged)
            result.note = fmt::format(
                "renormalised theory: known to {:.1e} of the work of adhesion and {:.1e} of the "
                "contact only, on the finest grid that is tried",
                state.gamma_ratio_error, state.contact_error);
        if (const double slope = rough.spectrum.rms_slope(); slope > compared_slope)
            result.note += fmt::format("{}the theory is of second order in the slope, and its "
                                       "expected error is calibrated "
                                       "up to an rms slope of {}; here it is {:.2f}",
                                       result.note.empty() ? "renormalised theory: " : "; ",
                                       compared_slope, slope);
        result.numbers = n;
    } catch (const std::exception& error) {
        result.note = error.what();
    }
    return result;
}

void record_renormalised(const RenormalisedResult& renormalised, io::Result& result) {
    if (renormalised.numbers) {
        const RenormalisedNumbers& n = *renormalised.numbers;
        result.set("theory.renormalised.gamma_eff", n.gamma_eff);
        result.set("theory.renormalised.gamma_eff_ratio", n.gamma_eff_ratio);
        result.set("theory.renormalised.contact_fraction", n.contact_fraction);
        result.set("theory.renormalised.separation", n.separation);
        result.set("theory.renormalised.tension", n.tension);
        result.set("theory.renormalised.gamma_eff_error", n.gamma_eff_error);
        result.set("theory.renormalised.contact_fraction_error", n.contact_fraction_error);
        if (n.gamma_eff_expected_error) {
            result.set("theory.renormalised.gamma_eff_expected_error", *n.gamma_eff_expected_error);
            result.set("theory.renormalised.contact_fraction_expected_error",
                       *n.contact_fraction_expected_error);
        }
    }
    if (!renormalised.note.empty()) result.set("theory.renormalised.note", renormalised.note);
}

} // namespace asperity
