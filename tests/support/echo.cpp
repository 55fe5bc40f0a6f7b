// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "support/echo.hpp"

#include "support/nodes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace asperity::test {

namespace {

constexpr double pi = std::numbers::pi;

/// A wave of the infinite lattice, phases (p, 0, q) between neighbours: its displacement's
/// direction in the plane of x and z (of SH: y alone) and its frequency.
struct LatticeWave {
    double x = 0.0, y = 0.0, z = 0.0, frequency = 0.0;
};

LatticeWave lattice_wave(const BlockOptions& block, double p, double q, Polarisation kind) {
    const CellElasticity e = block.elasticity(0);
    const auto stretch = [&](double phase) { return e.k * (2.0 - 2.0 * std::cos(phase)); };
    // Springs along x, z, and the diagonals of the faces across y, z and x.
    const double both = stretch(p + q), against = stretch(p - q);
    const double sx = std::sin(0.5 * p) * std::cos(0.5 * q),
                 sz = std::cos(0.5 * p) * std::sin(0.5 * q);
    const double pressed = 4.0 * 16.0 * e.kappa;
    const double xx = stretch(p) + 0.5 * (both + against) + stretch(p) + pressed * sx * sx;
    const double zz = stretch(q) + 0.5 * (both + against) + stretch(q) + pressed * sz * sz;
    const double xz = 0.5 * (both - against) + pressed * sx * sz;
    const double yy = stretch(p) + stretch(q);
    if (kind == Polarisation::horizontal_shear)
        return {0.0, 1.0, 0.0, std::sqrt(yy / block.atom_mass)};
    const double half = 0.5 * (xx - zz), root = std::hypot(half, xz);
    const bool longitudinal = kind == Polarisation::longitudinal;
    const double value = 0.5 * (xx + zz) + (longitudinal ? root : -root);
    const double angle = 0.5 * std::atan2(xz, half); // of the stiffer direction, from x
    LatticeWave wave;
    wave.x = longitudinal ? std::cos(angle) : -std::sin(angle);
    wave.z = longitudinal ? std::sin(angle) : std::cos(angle);
    wave.frequency = std::sqrt(value / block.atom_mass);
    return wave;
}

double energy_of(const Block& block) {
    ExactSum elastic;
    block.add_elastic_energy(elastic);
    double kinetic = 0.0;
    each_node(block, [&](const Block::Level& level, int x, int y, int z) {
        for (const double* v : components(level.v.view(), x, y, z))
            kinetic += 0.5 * level.mass(z) * *v * *v;
    });
    return elastic.value() + kinetic;
}

Block made(const BlockOptions& options) {
    Block block(options, Communicator(),
                ProcessGrid(1, 0, options.sites, static_cast<int>(level_shapes(options).size())));
    block.set_uniform(0.0, 0.0);
    return block;
}

} // namespace

double Packet::angle(int sites) const {
    return std::atan2(static_cast<double>(across) / sites, 1.0 / rise) * 180.0 / pi;
}
double Packet::length(int sites) const {
    return 1.0 / std::hypot(static_cast<double>(across) / sites, 1.0 / rise);
}

double echo(const BlockOptions& options, const Packet& packet, double depth, double dt) {
    const double p = 2.0 * pi * packet.across / options.sites, q0 = 2.0 * pi / packet.rise;
    const double width = packet.waves * packet.rise; // standard deviation, a
    const auto frequency = [&](double q) {
        const double w = lattice_wave(options, p, q, packet.polarisation).frequency;
        return 2.0 / dt * std::asin(0.5 * w * dt); // that of the steps
    };
    const double speed = (frequency(q0 + 1e-4) - frequency(q0 - 1e-4)) / 2e-4; // upwards, a/fs

    // The packet starts four widths below the joint, and the lead holds what returns in the end.
    constexpr double reach = 4.0;
    BlockOptions lead_options = options;
    lead_options.multiscale = false;
    lead_options.absorption_span = 0.0;
    lead_options.thickness = static_cast<int>(std::ceil(2.0 * reach * width + 2.0 * depth));
    const double start = lead_options.thickness - reach * width;
    Block lead = made(lead_options), block = made(options);
    const Block::Level& below = lead.levels().front();
    const Block::Level& above = block.levels().front();
    const Block::Fields field = lead.fields(below);
    constexpr int waves = 61;
    const double step_q = 6.0 / width / (waves - 1);
    for (int n = 0; n < waves; ++n) {
        const double q = q0 + (n - waves / 2) * step_q;
        const LatticeWave wave = lattice_wave(options, p, q, packet.polarisation);
        const double w = frequency(q), weight = std::exp(-0.5 * std::pow((q - q0) * width, 2));
        each_node(lead, [&](const Block::Level&, int x, int y, int z) {
            const double phase = p * x + q * (z - start);
            const double u = weight * std::cos(phase);
            const double v =
                weight * 2.0 / dt * std::sin(0.5 * w * dt) * std::sin(phase + 0.5 * w * dt);
            const auto to = components(field.u.view(), x, y, z),
                       rate = components(field.v.view(), x, y, z);
            const std::array direction = {wave.x, wave.y, wave.z};
            for (std::size_t c = 0; c < 3; ++c) {
                *to[c] += u * direction[c];
                *rate[c] += v * direction[c];
            }
        });
    }
    lead.exchange();
    const double sent = energy_of(lead);

    const StepParameters parameters{dt, 0.0, 0.0, 0.0, false};
    const long long every =
        options.absorption_span > 0.0 ? std::llround(options.absorption_span / dt) : 0;
    const double time = 2.0 * (reach * width + depth) / speed;
    KickSums sums;
    ExactSum taken;
    for (long long n = 0; static_cast<double>(n) * dt < time; ++n) {
        if (every > 0 && n % every == 0) block.absorb(n / every, taken);
        block.interpolate();
        const auto joint = field.u.plane(below.shape.cells);
        const auto lowest = std::as_const(above.u).plane(0);
        for (int y = -halo_width; y < below.tile.ny + halo_width; ++y)
            for (int x = -halo_width; x < below.tile.nx + halo_width; ++x) {
                joint.x(x, y) = lowest.x(x, y);
                joint.y(x, y) = lowest.y(x, y);
                joint.z(x, y) = lowest.z(x, y);
            }
        lead.advance(parameters, sums);
        const auto push = std::as_const(below.upper_force).plane(0);
        const auto transferred = block.fields(above).transferred.plane(0);
        for (int y = 0; y < below.tile.ny; ++y)
            for (int x = 0; x < below.tile.nx; ++x) {
                transferred.x(x, y) = push.x(x, y);
                transferred.y(x, y) = push.y(x, y);
                transferred.z(x, y) = push.z(x, y);
            }
        block.advance(parameters, sums);
        block.exchange();
        lead.exchange();
    }
    return energy_of(lead) / sent;
}

} // namespace asperity::test
