// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What comes back of a wave that is sent into a block from below: the block stands on a lead, a
// plain lattice as wide, whose upper plane is the block's lowest layer. Both are steps of the
// engine's own Block; the lowest layer's full atoms make the joint a piece of the lattice.
#pragma once

#include "engine/block/block.hpp"

namespace asperity::test {

enum class Polarisation { longitudinal, vertical_shear, horizontal_shear };

/// A packet that travels upwards: a Gaussian over waves of the lattice.
struct Packet {
    int across = 0;     ///< periods over the box, along x
    double rise = 8.0;  ///< vertical wavelength, a
    double waves = 2.0; ///< of them in a standard deviation of the envelope
    Polarisation polarisation = Polarisation::longitudinal;

    /// Angle to the vertical, degrees; wavelength, a.
    double angle(int sites) const;
    double length(int sites) const;
};

/// Fraction of the packet's energy that is in the lead when what the block returns from its lowest
/// `depth` cells of edge a has come back.
double echo(const BlockOptions& block, const Packet& packet, double depth, double dt);

} // namespace asperity::test
