// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/theory/rough_interface.hpp"

#include "engine/options/block_options.hpp"
#include "engine/units.hpp"
#include "io/json.hpp"
#include "kernels/surface_stiffness.hpp"
#include "theory/error.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <type_traits>

namespace asperity {

namespace {

using io::Json;

WavePhase phase_of(double angle) { return {std::cos(angle), std::sin(angle)}; }

/// q, S_zz, S_xx, |S_xz| and 1/(S⁻¹)_zz of a wave in the direction `angle`, per area.
using WaveStiffness = std::array<double, 5>;

WaveStiffness wave_stiffness(const BlockOptions& block, double q, double angle) {
    const double c = std::cos(angle), s = std::sin(angle), spacing = block.spacing;
    const WavePhase x = phase_of(q * spacing * c), y = phase_of(q * spacing * s);
    const SurfaceMatrix m = block.stiffness(x, y);
    const double area = spacing * spacing;
    return {q, m.zz / area, (c * c * m.xx + s * s * m.yy + 2.0 * c * s * m.xy) / area,
            std::abs(c * m.xz + s * m.yz) / area, 1.0 / block.normal_compliance(x, y) / area};
}

/// Returns the stiffness of waves up to Nyquist, averaged over directions.
Json lattice_stiffness(const Case& c) {
    const BlockOptions& block = c.simulation.block;
    const double low = 2.0 * std::numbers::pi / c.edge();
    const double high = std::numbers::pi / block.spacing;
    constexpr int waves = 48;
    // The lattice has the symmetry of the square: directions in an eighth of the circle, Gauss.
    constexpr double nodes[] = {0.112701665379258, 0.5, 0.887298334620742};
    constexpr double weights[] = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
    Json table = Json::array();
    for (int k = 0; k <= waves; ++k) {
        const double q =
            k == waves ? high : low * std::pow(high / low, static_cast<double>(k) / waves);
        WaveStiffness mean = {q};
        for (int d = 0; d < 3; ++d) {
            const WaveStiffness w = wave_stiffness(block, q, nodes[d] * std::numbers::pi / 4.0);
            for (std::size_t i = 1; i < w.size(); ++i)
                mean[i] += weights[d] * w[i];
        }
        table.push_back(mean);
    }
    return table;
}

constexpr int points = 400; ///< number of points in a table of the interaction

Json table_of_pairs(const Case& c) {
    const theory::FlatInterface flat = flat_interface(c);
    const double closest = 0.75 * flat.pair.zero;
    Json rings = Json::array(), at, energy, first, second;
    for (const auto& [radius, density] : flat.rings)
        rings.push_back({radius, density});
    // Even in ln r, up to just below the furthest, where V ends in a kink.
    const double last = (1.0 - 1e-12) * flat.furthest;
    for (int i = 0; i <= points; ++i) {
        const double r = closest * std::pow(last / closest, static_cast<double>(i) / points);
        const theory::PairTerms v = flat.pair(r * r);
        at.push_back(r);
        energy.push_back(v.energy);
        first.push_back(v.first);
        second.push_back(v.second);
    }
    const double reach = (flat.pair.tail ? 2.0 : 1.0) * flat.pair.cutoff;
    return {{"rings", rings},     {"spacing", flat.spacing}, {"contact", flat.contact},
            {"closest", closest}, {"reach", reach},          {"at", at},
            {"energy", energy},   {"first", first},          {"second", second}};
}

template <class Law>
Json table_of_wall(const Case& c, const Law& law) {
    bool kink = std::is_same_v<Law, ExponentialWall>;
    if constexpr (std::is_same_v<Law, ShapedWall>) kink = law.has_kink();
    if (kink)
        return {{"note", "it follows the curvature of a smooth law, and the exponential wall, like "
                         "each that repels by a stiffness, has a kink where it is touched; take "
                         "interface.law = \"smeared\" or atoms"}};
    const double area = c.simulation.block.spacing * c.simulation.block.spacing;
    const double separation = c.flat.separation;
    // Inwards to a repulsion of about twice the largest tension.
    const double closest = separation - 2.0 * (law.contact_gap() - separation);
    const double reach = reach_of(c.simulation.interface);
    Json at, energy;
    for (int i = 0; i <= 10 * points; ++i) {
        const double u = closest + (reach - closest) * i / (10 * points);
        at.push_back(u);
        energy.push_back(law.energy(u) / area);
    }
    return {{"rings", Json::array()}, {"spacing", 0.0}, {"contact", law.contact_gap()},
            {"closest", closest},     {"reach", reach}, {"at", at},
            {"energy", energy}};
}

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

} // namespace

theory::FlatInterface flat_interface(const Case& c) {
    const InterfaceOptions& options = c.simulation.interface;
    const theory::PairInteraction pair = pair_interaction(options.potential, options.tail);
    const double spacing = c.simulation.block.spacing;
    if (c.substrate() == c.simulation.block.sites)
        return theory::FlatInterface::hollow_sites(pair, spacing);
    return theory::FlatInterface::all_registries(pair, spacing, c.edge() / c.substrate());
}

Json renormalised_inputs(const Case& c, const theory::Spectrum& spectrum, bool realised) {
    const auto& wall = c.simulation.interface.wall;
    Json flat = wall ? std::visit([&](const auto& law) { return table_of_wall(c, law); }, *wall)
                     : table_of_pairs(c);
    Json pieces = Json::array();
    for (const theory::PowerLaw& piece : spectrum.pieces())
        pieces.push_back({piece.qa, piece.qb, piece.c, piece.exponent});
    Json inputs = {{"q_L", spectrum.q_L()},
                   {"spectrum", pieces},
                   {"realised", realised},
                   {"pressure", c.simulation.drive.load_force / c.area()}};
    if (flat.contains("note")) {
        inputs.update(flat);
        return inputs;
    }
    inputs.update(
        {{"friction", c.effects.lateral.on}, {"stiffness", lattice_stiffness(c)}, {"flat", flat}});
    return inputs;
}

} // namespace asperity
