// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/case/spacing_limits.hpp"

#include "engine/case/contact_estimate.hpp"
#include "engine/case/wall_shape.hpp"
#include "engine/units.hpp"
#include "kernels/surface_stiffness.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace asperity {

namespace {

/// Attraction of a wall beside the edge of a contact.
struct ContactEdge {
    double strip = 0.0;    ///< width of the strip, Å
    double resolved = 0.0; ///< width of a strip that the spacing resolves, Å
    double pinning = 1.0;  ///< Case::edge_pinning
    std::string remedy;    ///< a range or a spacing that resolves it
};

/// Factor by which rows of sites that hold the edge of a contact increase the pull-off force of a
/// smooth sphere, [1 + (part x)^power]^(1/power), x = spacing / strip, as measured
/// (docs/explanation/model.md). A row lets go at its largest tension: where the strip is short the
/// force goes as x. A tension that ends suddenly holds rows in wide strips too.
struct Pinning {
    double part, power;
};

Pinning pinning_of(WallLawKind law) {
    switch (law) {
    case WallLawKind::exponential:
        return {0.68, 2.5};
    case WallLawKind::dugdale:
        return {1.0, 1.2};
    default:
        return {0.8, 2.5};
    }
}

std::optional<ContactEdge> edge_of(const Case& c) {
    const auto& wall = c.scene.interface;
    if (!wall.has_adhesion() || wall.adhesion == 0.0) return std::nullopt;
    const double adhesion = wall.adhesion / units::milli_per_unit;
    const double spacing = c.simulation.block.spacing;
    ContactEdge edge;
    // The largest tension is `steep` works of adhesion over the range; of a table, whose length is
    // its range, one.
    double range = wall.range, steep = 1.0;
    if (const auto& shape = c.simulation.interface.shape) {
        steep = shape->shape().tension;
        if (shape->length() > 0.0) range = shape->length();
    }
    edge.strip = edge_strip(c.simulation.block, adhesion, range / steep);
    const Pinning pinning = pinning_of(wall.law);
    edge.pinning = std::pow(1.0 + std::pow(pinning.part * spacing / edge.strip, pinning.power),
                            1.0 / pinning.power);
    // Strips of two spacings, or wider ones by law, in which rows change the force by 5 % at most.
    const double slack = std::pow(1.05, pinning.power) - 1.0;
    edge.resolved = std::max(2.0, pinning.part / std::pow(slack, 1.0 / pinning.power)) * spacing;
    edge.remedy =
        fmt::format("interface.range = {:.3g} Å or more, or surface.spacing = {:.3g} Å or less,",
                    steep * std::sqrt(edge.resolved * adhesion /
                                      contact_modulus_at(c.simulation.block, 1.0 / edge.resolved)),
                    spacing * edge.strip / edge.resolved);
    return edge;
}

} // namespace

std::optional<std::string> note_on_contact_edge(const Case& c) {
    const auto edge = edge_of(c);
    const double spacing = c.simulation.block.spacing;
    if (!edge || edge->strip >= edge->resolved) return std::nullopt;
    return fmt::format(
        "the attraction reaches {:.2g} Å beside the edge of a contact, {:.2g} spacings: single "
        "rows of sites hold the edge in place, and a sphere's pull-off "
        "force is about {:.3g} times too large; {} avoids that",
        edge->strip, edge->strip / spacing, edge->pinning, edge->remedy);
}

bool tension_ends_suddenly(const Case& c) { return c.scene.interface.law == WallLawKind::dugdale; }

double edge_pinning(const Case& c) {
    const auto edge = edge_of(c);
    return edge ? edge->pinning : 1.0;
}

void refuse_pinned_edge(const Case& c, io::Problems& refused) {
    const Scene& scene = c.scene;
    if (!scene.surface.radius || !c.has(Segment::pull_off) ||
        c.edge_pinning <= largest_edge_pinning ||
        scene.interface.edge_pinning == EdgePinning::allow)
        return;
    refused.add(
        "interface.range",
        fmt::format("= {:.3g} Å is not resolved by surface.spacing = {:.3g} Å",
                    scene.interface.range, scene.surface.spacing),
        fmt::format("single rows of sites hold the edge of the contact in place, and the sphere's "
                    "pull-off force would be about {:.3g} times too large",
                    c.edge_pinning),
        edge_of(c)->remedy + " resolves it; interface.edge_pinning = \"allow\" runs as it is");
}

double lattice_softness(const BlockOptions& block, const SurfaceStatistics& surface) {
    const double a = block.spacing;
    BlockOptions deep; // one material, and its top plane does not matter
    static_cast<Material&>(deep) = block.surface_material();
    deep.spacing = a;
    deep.continuum = block.continuum;
    const double modulus = deep.contact_modulus();
    constexpr int directions = 5; // directions between an axis and a diagonal of the lattice
    double lattice = 0.0, continuum = 0.0;
    for (const SpectrumBin& bin : surface.spectrum) {
        if (!(bin.q > 0.0) || bin.q * a > std::numbers::pi) continue;
        const double weight = bin.realised * bin.modes;
        deep.thickness = static_cast<int>(std::ceil(8.0 * std::numbers::pi / (bin.q * a)));
        double stiffness = 0.0;
        for (int k = 0; k < directions; ++k) {
            const double angle = 0.25 * std::numbers::pi * k / (directions - 1);
            const double x = bin.q * a * std::cos(angle), y = bin.q * a * std::sin(angle);
            const SurfaceMatrix s =
                deep.stiffness({std::cos(x), std::sin(x)}, {std::cos(y), std::sin(y)});
            stiffness += 1.0 / (inverse(s).zz * a * a * directions);
        }
        lattice += weight * stiffness;
        continuum += weight * 0.5 * modulus * bin.q;
    }
    return continuum > 0.0 ? lattice / continuum : 1.0;
}

} // namespace asperity
