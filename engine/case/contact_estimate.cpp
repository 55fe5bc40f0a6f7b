// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/case/contact_estimate.hpp"

#include "engine/units.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace asperity {

namespace {

constexpr double of_contact = 2.0; ///< wavenumber of a contact times its radius
/// Phases q a between which S(q) is computed: a longer wave takes long, a shorter one does not
/// exist.
constexpr double least_phase = 5e-4, largest_phase = 0.5 * std::numbers::pi;
constexpr double negligible = 1e-3; ///< part of the pull-off force

/// Returns 1 / (S^-1)_zz of a wave along x, eV/Å^2 per site.
double normal_stiffness(const BlockOptions& block, double phase) {
    return 1.0 / block.normal_compliance({std::cos(phase), std::sin(phase)}, {1.0, 0.0});
}

} // namespace

double contact_modulus_at(const BlockOptions& block, double q) {
    const double phase = std::clamp(q * block.spacing, least_phase, largest_phase);
    const bool deep = block.free_edges || phase * block.thickness > 10.0;
    if (deep && !block.is_coated()) return block.contact_modulus();
    BlockOptions own = block, plain = block.uncoated();
    plain.thickness = 1 << 30;
    if (block.free_edges) own.thickness = plain.thickness;
    return block.contact_modulus() * normal_stiffness(own, phase) / normal_stiffness(plain, phase);
}

double modulus_under_load(const BlockOptions& block) {
    if (block.free_edges) return contact_modulus_at(block, 2.0 * std::numbers::pi / block.edge());
    return block.thickness / (block.normal_compliance({}, {}) * block.spacing);
}

double edge_strip(const BlockOptions& block, double adhesion, double range) {
    // width -> E*(1/width) range^2 / adhesion falls or rises more slowly than the width.
    const double square = range * range / adhesion;
    double width = contact_modulus_at(block, largest_phase / block.spacing) * square;
    for (int i = 0; i < 60; ++i) {
        const double next = std::sqrt(width * contact_modulus_at(block, 1.0 / width) * square);
        if (std::abs(next - width) <= 1e-6 * width) return next;
        width = next;
    }
    return width;
}

SphereOnBlock::SphereOnBlock(const BlockOptions& block, double radius, double adhesion)
    : block_(block), radius_(radius), adhesion_(adhesion) {}

theory::jkr::Sphere SphereOnBlock::with_modulus_of(double contact_radius) const {
    return {radius_, adhesion_, contact_modulus_at(block_, of_contact / contact_radius)};
}

double SphereOnBlock::load(double contact_radius) const {
    return with_modulus_of(contact_radius).load(contact_radius);
}

double SphereOnBlock::contact_radius(double load) const {
    const double least = std::max(load, -pull_off_force());
    double radius = block_.spacing;
    for (int i = 0; i < 60; ++i) {
        const double next = with_modulus_of(radius).contact_radius(least);
        if (std::abs(next - radius) <= 1e-6 * radius) return next;
        radius = next;
    }
    return radius;
}

double SphereOnBlock::pull_off_force() const {
    return theory::jkr::pull_off_force(adhesion_, radius_);
}

double SphereOnBlock::gap(double r, double contact_radius) const {
    if (r <= contact_radius) return 0.0;
    // The gap beside Hertz' contact, and that beside a flat punch.
    const double a = contact_radius, x = r / a, angle = std::acos(1.0 / x), pi = std::numbers::pi;
    const double modulus = with_modulus_of(a).contact_modulus;
    return a * a / (pi * radius_) * ((x * x - 2.0) * angle + std::sqrt(x * x - 1.0)) +
           2.0 / pi * std::sqrt(2.0 * pi * a * adhesion_ / modulus) * angle;
}

namespace {

/// Returns the attraction of a wall outside a square of this width below a sphere, eV/Å.
/// site: area of a site, Å^2.
/// flat_gap: gap of flat surfaces at rest, Å; end: distance from the axis at which the sphere ends,
/// Å.
double attraction_outside(const WallLaw& wall, double site, double flat_gap,
                          const SphereOnBlock& sphere, double contact_radius, double width,
                          double end) {
    constexpr int points = 400;
    const double half = 0.5 * width, step = std::log(end / half) / points;
    if (!(step > 0.0)) return 0.0;
    return std::visit(
        [&](const auto& law) {
            double force = 0.0;
            for (int i = 0; i < points; ++i) {
                const double r = half * std::exp((i + 0.5) * step), x = half / r;
                const double outside =
                    x > 1.0 / std::numbers::sqrt2 ? 4.0 / std::numbers::pi * std::acos(x) : 1.0;
                const double gap = flat_gap + sphere.gap(r, contact_radius);
                force -=
                    std::min(0.0, law.force(gap)) * outside * 2.0 * std::numbers::pi * r * r * step;
            }
            return force / site;
        },
        wall);
}

} // namespace

SphereOnBlock sphere_of(const Case& c) {
    return {c.simulation.block, c.radius().value(),
            c.flat.work_of_adhesion / units::milli_per_unit};
}

double attraction_beyond(const Case& c, double contact_radius, double width) {
    const auto& wall = c.simulation.interface.wall;
    if (!wall || !(c.largest_tension > 0.0)) return 0.0;
    const double spacing = c.simulation.block.spacing;
    const SphereOnBlock sphere = sphere_of(c);
    return attraction_outside(*wall, spacing * spacing, c.flat.separation, sphere, contact_radius,
                              width, *c.radius()) /
           sphere.pull_off_force();
}

std::optional<BeyondEdges> beyond_edges(const Case& c) {
    if (!c.effects.free_edges || !c.radius() || !(c.largest_tension > 0.0)) return std::nullopt;
    const SphereOnBlock sphere = sphere_of(c);
    std::vector<double> contacts;
    if (c.has(Segment::pull_off) || c.has(Segment::height))
        contacts.push_back(sphere.contact_radius(-sphere.pull_off_force()));
    if (c.has(Segment::approach) || c.has(Segment::relax))
        contacts.push_back(sphere.contact_radius(c.simulation.drive.load_force));
    for (const Segment& segment : c.path())
        if (segment.kind == Segment::load)
            contacts.push_back(sphere.contact_radius(segment.amount));
    const auto part = [&](double width) {
        double most = 0.0;
        for (const double contact : contacts)
            most = std::max(most, attraction_beyond(c, contact, width));
        return most;
    };
    double narrow = 0.0, wide = 2.0 * *c.radius();
    while (wide - narrow > 1e-3 * wide) {
        const double middle = 0.5 * (narrow + wide);
        (part(middle) > negligible ? narrow : wide) = middle;
    }
    return BeyondEdges{part(c.edge()), wide};
}

} // namespace asperity
